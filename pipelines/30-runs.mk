# Stage 3: five runs per adhesive. The runs are independent, so they share the cores side by
# side with one thread each, which costs less than splitting each small run.

RUNS := xpic flip frictionless implicit implicit-frictionless
RUN_THREADS ?= 1
# The explicit runs of the full size take more than the week at which a run is refused unasked.
RUN_FLAGS ?= $(if $(filter full,$(SCALE)),--yes-really)
# A cell is two voxels, as in the paper.
voxels = $(shell echo "$(VOXEL)" | awk '{ unit = $$0; sub(/^[-+0-9.eE ]*/, "", unit); printf "%.9g %s", $(1) * $$0, unit }')
CELL = $(call voxels,2)

FINALS := $(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(OUT)/$(a)/$(r)/final.mpts))

define run_rule
$(OUT)/$(1)/$(2)/final.mpts: pipelines/cases/$(1)-$(2).toml $(OUT)/$(1)/bond.mpts $(BIN)/mpm-run
	$(BIN)/mpm-run $$< --particles $(OUT)/$(1)/bond.mpts --set grid.cell="$$(CELL)" \
	    --resume --overwrite --threads $(RUN_THREADS) $(RUN_FLAGS) -o $$(@D)
endef
$(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(eval $(call run_rule,$(a),$(r)))))

# The implicit runs again in cells of one voxel, for the errors of Table 2: some ten times their cost and five times
# their memory, in the quick specimens a twenty-fifth of all runs. ERROR=no leaves them out. The full size would take
# 48 M points.
ERROR ?= $(if $(filter full,$(SCALE)),no,yes)
FINER := $(if $(filter no,$(ERROR)),,$(filter implicit%,$(RUNS)))
FINER_FINALS := $(foreach a,$(ADHESIVES),$(foreach r,$(FINER),$(OUT)/$(a)/$(r)-finer/final.mpts))
# The influence length of partial slip, 0.01 cells of two voxels, stays the same length.
SLIP_implicit = --set contact.influence_length="$(call voxels,0.02)"

define finer_rule
$(OUT)/$(1)/$(2)-finer/final.mpts: pipelines/cases/$(1)-$(2).toml $(OUT)/$(1)/bond.mpts $(BIN)/mpm-run
	$(BIN)/mpm-run $$< --particles $(OUT)/$(1)/bond.mpts --set grid.cell="$$(call voxels,1)" $$(SLIP_$(2)) \
	    --resume --overwrite --threads $(RUN_THREADS) $(RUN_FLAGS) -o $$(@D)
endef
$(foreach a,$(ADHESIVES),$(foreach r,$(FINER),$(eval $(call finer_rule,$(a),$(r)))))

.PHONY: runs
runs: $(BINARIES)
	@$(MAKE) BUILT=1 --no-print-directory $(SIDE_BY_SIDE) $(FINALS) $(FINER_FINALS)
