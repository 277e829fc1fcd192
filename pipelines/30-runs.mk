# Stage 3: five runs per adhesive. The runs are independent, so they share the cores side by
# side with one thread each, which costs less than splitting each small run.

RUNS := xpic flip frictionless implicit implicit-frictionless
RUN_THREADS ?= 1
# The explicit runs of the full size take more than the week at which a run is refused unasked.
RUN_FLAGS ?= $(if $(filter full,$(SCALE)),--yes-really)
# A cell is two voxels, as in the paper.
CELL = $(shell echo "$(VOXEL)" | awk '{ unit = $$0; sub(/^[-+0-9.eE ]*/, "", unit); printf "%.9g %s", 2 * $$0, unit }')

FINALS := $(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(OUT)/$(a)/$(r)/final.mpts))

define run_rule
$(OUT)/$(1)/$(2)/final.mpts: pipelines/cases/$(1)-$(2).toml $(OUT)/$(1)/bond.mpts $(BIN)/mpm-run
	$(BIN)/mpm-run $$< --particles $(OUT)/$(1)/bond.mpts --set grid.cell="$$(CELL)" \
	    --resume --overwrite --threads $(RUN_THREADS) $(RUN_FLAGS) -o $$(@D)
endef
$(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(eval $(call run_rule,$(a),$(r)))))

.PHONY: runs
runs: $(BINARIES)
	@$(MAKE) BUILT=1 --no-print-directory $(SIDE_BY_SIDE) $(FINALS)
