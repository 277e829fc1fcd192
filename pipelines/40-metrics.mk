# Stage 4: penetration metrics, maps, profiles, shear rates, Table 2.

METRICS := $(FINALS:%/final.mpts=%/wp.csv)

define wp_rule
$(OUT)/$(1)/wp.csv: private OUTPUTS = $$(@D)/map.csv $$(@D)/depth.csv
$(OUT)/$(1)/wp.csv: $(OUT)/$(1)/final.mpts $(2) $(BIN)/wp-metrics FORCE
	$$(call made,$(BIN)/wp-metrics $$< --pressure $(2:%=--finer %) --map $$(@D)/map.csv --profile $$(@D)/depth.csv -o $$@ && \
	    awk -F$$(COMMA) -f pipelines/row.awk run=$(1) $$@)
endef
$(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),$(eval $(call wp_rule,$(a)/$(r),$(if $(filter $(r),$(call finer,$(a))),$(OUT)/$(a)/$(r)-finer/final.mpts)))))

EXPERIMENT_TABLES := $(EXPERIMENTS:.mpts=.csv)
$(EXPERIMENT_TABLES): private OUTPUTS = $(@D)/experiment-map.csv $(@D)/experiment-depth.csv
$(EXPERIMENT_TABLES): %.csv: %.mpts $(BIN)/wp-metrics FORCE
	$(call made,$(BIN)/wp-metrics $< --map $(@D)/experiment-map.csv --profile $(@D)/experiment-depth.csv -o $@)

SHEARS := $(FINALS:final.mpts=shear.csv)
$(SHEARS): private READS = $(@D)/snapshots
$(SHEARS): %/shear.csv: %/final.mpts $(BIN)/shear-stats FORCE
	$(call made,$(BIN)/shear-stats $(@D)/snapshots/*.mpts $< -o $@)

# Rows of Table 2, of some of the runs.
table2_rows = $(if $(EXPERIMENTS),$(foreach a,$(ADHESIVES),--experiment $(a)=$(OUT)/$(a)/experiment.csv)) \
    $(foreach a,$(ADHESIVES),$(foreach r,$(1),--run $(a):$(r)=$(OUT)/$(a)/$(r)/wp.csv))
# The paper's numbers, which are of another specimen, below ours.
PAPER ?= no
$(if $(filter-out yes no,$(PAPER)),$(error PAPER=$(PAPER): yes and no are accepted))
TABLE2 = $(BIN)/bond-figures table2 $(if $(filter yes,$(PAPER)),--paper)
SUMMARIES = $(patsubst %/wp.csv,%/summary.json,$(filter %/wp.csv,$^))
$(OUT)/table2.csv: private READS = $(SUMMARIES)
$(OUT)/table2.csv: private OUTPUTS = $(OUT)/table2.txt $(if $(FINER),$(OUT)/errors.csv)
$(OUT)/table2.csv: $(METRICS) $(EXPERIMENT_TABLES) $(BIN)/bond-figures FORCE
	$(call made,$(TABLE2) $(call table2_rows,$(RUNS)) $(if $(FINER),--errors $(OUT)/errors.csv) \
	    -o $@ >$(OUT)/table2.txt $(if $(FINER),,&& rm -f $(OUT)/errors.csv))

# Said where the last table is yet far: other runs are to come, or tools to be built.
.PHONY: first-table
AHEAD := $(or $(filter-out implicit%,$(RUNS)),$(if $(wildcard $(BIN)/bond-report),,tools))
IMPLICIT := $(filter implicit%,$(RUNS))
first-table: $(foreach a,$(ADHESIVES),$(IMPLICIT:%=$(OUT)/$(a)/%/wp.csv)) $(EXPERIMENT_TABLES)
	$(if $(and $(AHEAD),$(filter %/wp.csv,$(MADE))),@$(TABLE2) $(call table2_rows,$(IMPLICIT)) -o - >/dev/null)

ifeq ($(BUILT),foremost)
$(OTHER_BINARIES) &: FORCE | $(FIRST_TABLE)
	@CARGO_TERM_PROGRESS_WHEN=never $(CARGO) build --release --workspace
endif

define show_table2
@cat $(OUT)/table2.txt $(if $(V),$(OUT)/table2.csv $(if $(FINER),$(OUT)/errors.csv))
@echo "Table 2: $(OUT)/table2.csv$(if $(FINER),$(COMMA) its errors: $(OUT)/errors.csv)"
endef
.PHONY: table2
table2: $(OUT)/table2.csv
	$(show_table2)
