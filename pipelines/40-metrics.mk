# Stage 4: penetration metrics, maps, profiles, shear rates, Table 2.

METRICS := $(FINALS:%/final.mpts=%/wp.csv)
# Undamaged wood is no experiment.
EXPERIMENTS := $(if $(XCT_BOTTOM),,$(ADHESIVES:%=$(OUT)/%/experiment.csv))

define wp_rule
$(OUT)/$(1)/wp.csv: $(OUT)/$(1)/final.mpts $(2) $(BIN)/wp-metrics
	$(BIN)/wp-metrics $$< --pressure $(2:%=--finer %) --map $$(@D)/map.csv --profile $$(@D)/depth.csv -o $$@
endef
$(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(eval $(call wp_rule,$(a)/$(r),$(if $(filter $(r),$(FINER)),$(OUT)/$(a)/$(r)-finer/final.mpts)))))

$(OUT)/%/experiment.csv: $(OUT)/%/experiment.mpts $(BIN)/wp-metrics
	$(BIN)/wp-metrics $< --map $(@D)/experiment-map.csv --profile $(@D)/experiment-depth.csv -o $@

$(OUT)/%/shear.csv: $(OUT)/%/final.mpts $(BIN)/shear-stats
	$(BIN)/shear-stats $(@D)/snapshots/*.mpts $< -o $@

TABLE2 = $(if $(EXPERIMENTS),$(foreach a,$(ADHESIVES),--experiment $(a)=$(OUT)/$(a)/experiment.csv)) \
    $(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),--run $(a):$(r)=$(OUT)/$(a)/$(r)/wp.csv))
$(OUT)/table2.csv: $(METRICS) $(EXPERIMENTS) $(BIN)/bond-figures
	$(BIN)/bond-figures table2 $(TABLE2) \
	    $(if $(FINER),--errors $(OUT)/errors.csv) -o $@

# The bond files and runs come first and side by side; what follows is quick.
.PHONY: table2
table2: runs
	@$(MAKE) BUILT=1 --no-print-directory $(SIDE_BY_SIDE) $(OUT)/table2.csv
	@cat $(OUT)/table2.csv $(if $(FINER),$(OUT)/errors.csv)
	@for run in $(FINALS:/final.mpts=); do \
	    ! grep -q '"end": "time-limit"' $$run/summary.json || echo "$$run: its time limit came before it closed"; done
