# Stage 3: the runs of each adhesive. They are independent, so they share the cores side by side, each with so many threads
# as leave no core idle (RUN_THREADS; goal.sh). Of user's stacks implicit runs alone: others take days.

RUNS := implicit implicit-frictionless $(if $(OWN),,xpic flip frictionless)
# The cases have the paper's cells, two voxels.
CELL ?=
COARSE = $(if $(CELL),--set grid.cell=$(call q,$(CELL)))

# The implicit runs again in cells of one voxel, for the errors of Table 2: some ten times their cost and five times
# their memory, in the quick specimens a twenty-fifth of all runs. ERROR=no leaves them out. The full size would take
# 48 M points.
ERROR ?= $(if $(filter full,$(SCALE))$(CELL),no,yes)
# A press whose adhesive has no room never closes, and a finer run of it tells no error; goal.sh has the room told first.
STUCK := $(foreach a,$(ADHESIVES),$(if $(shell grep -s 'gap will remain' $(OUT)/$(a)/voids.txt),$(a)))
ABLE := $(filter-out $(STUCK),$(ADHESIVES))
FINER := $(if $(filter no,$(ERROR)),,$(if $(ABLE),$(filter implicit%,$(RUNS))))
# The finer runs of an adhesive.
finer = $(if $(filter $(1),$(ABLE)),$(FINER))
FINE = --set grid.cell="1 voxel"
# The influence length of partial slip, 0.01 cells of two voxels, stays the same length.
FINE_implicit = --set contact.influence_length="0.02 cell"

finals = $(foreach a,$(ADHESIVES),$(foreach r,$(1),$(OUT)/$(a)/$(r)/final.mpts))
FINALS := $(call finals,$(RUNS))
FINER_FINALS := $(foreach a,$(ADHESIVES),$(patsubst %,$(OUT)/$(a)/%-finer/final.mpts,$(call finer,$(a))))
# A run that has just ended may be told to stop: its final state stays.
.PRECIOUS: $(FINALS) $(FINER_FINALS)

# Table 2 of the implicit runs comes before the explicit runs, which take longer.
FIRST_TABLE := $(if $(filter implicit%,$(RUNS)),first-table)

# Adhesive, run, its folder, its cells.
define run_rule
$(OUT)/$(1)/$(3)/final.mpts: pipelines/cases/$(1)-$(2).toml $(OUT)/$(1)/bond.mpts $(BIN)/mpm-run FORCE $(if $(filter implicit%,$(2)),,| $(FIRST_TABLE))
	$$(call made,$(BIN)/mpm-run $$< --particles $(OUT)/$(1)/bond.mpts $(4) $$(SETS) $$$$HOW --overwrite -o $$(@D))
endef
$(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(eval $(call run_rule,$(a),$(r),$(r),$$(COARSE)))))
$(foreach a,$(ADHESIVES),$(foreach r,$(call finer,$(a)),$(eval $(call run_rule,$(a),$(r),$(r)-finer,$$(FINE) $$(FINE_$(r))))))

# The same of every case: it follows from the bond and its sides.
%/voids.txt: pipelines/cases/pf-implicit.toml %/bond.mpts $(BIN)/mpm-run FORCE
	$(call made,{ $(BIN)/mpm-run $< --particles $*/bond.mpts $(SETS) --explain 2>/dev/null || true; } | sed -n 's/^ *voids *//p' >$@)

.PHONY: runs
runs: $(FINALS) $(FINER_FINALS)
