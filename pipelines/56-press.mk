# What each effect is worth in a press of maple: hot press PF (1 MPa within 2 s, 5 min) on the acer piece of the tutorial, with cure,
# capillarity, loss of water and all three; with trapped air, that and cure, these and loss of water or capillarity, and all; then the paper's hurry
# (1 m/s to the same pressure), without and with trapped air. A table; some ten minutes.
PRESS_OUT := out/press
ACER := pipelines/examples/acer/bondline-acer-64x192x128.tif

$(PRESS_OUT)/acer.mpts: $(ACER) $(BIN)/xct2particles
	@mkdir -p $(@D)
	$(BIN)/xct2particles $(ACER) --voxel "1.45 um" --crop 0:64,36:156,0:64 -o $@
$(PRESS_OUT)/bond.mpts: $(PRESS_OUT)/acer.mpts $(BIN)/build-bondline
	$(BIN)/build-bondline $< -o $@

.PHONY: press
press: $(BINARIES)
	@$(MAKE) BUILT=1 --no-print-directory $(PRESS_OUT)/bond.mpts
	@pipelines/sweep/local.sh pipelines/sweep/press.csv pipelines/examples/hot-press-pf.toml "" \
	    $(patsubst -j%,%,$(or $(firstword $(filter -j%,$(MAKEFLAGS))),$(JOBS)))
