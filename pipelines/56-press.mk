# What each effect is worth in a press of maple: hot press PF (1 MPa within 2 s, 5 min) on the acer piece of the tutorial, with cure and
# loss of water; with trapped air, that and cure, these and loss of water, and all with menisci; then the paper's hurry (1 m/s to the
# same pressure), without and with trapped air. A table; 1350 CPU seconds, 730 of them the row with menisci.
PRESS_OUT := out/press
ACER := pipelines/examples/acer/bondline-acer-64x192x128.tif

ifneq ($(BUILT),)
$(PRESS_OUT)/acer.mpts: $(ACER) $(BIN)/xct2particles FORCE
	$(call made,$(BIN)/xct2particles $(ACER) --voxel "1.45 um" --crop 0:64$(COMMA)36:156$(COMMA)0:64 -o $@)
$(PRESS_OUT)/bond.mpts: $(PRESS_OUT)/acer.mpts $(BIN)/build-bondline FORCE
	$(call made,$(BIN)/build-bondline $< -o $@)
endif

.PHONY: press
press: $(PRESS_OUT)/bond.mpts
	@pipelines/told.sh pipelines/sweep/local.sh pipelines/sweep/press.csv pipelines/examples/hot-press-pf.toml "" $(AT_ONCE)
