# Stage 5: figures of the paper from the tools' outputs.

# The run that shear rates and slices are drawn of.
SHOWN := $(firstword $(filter xpic,$(RUNS)) $(RUNS))
EXPERIMENT := $(if $(XCT_PF)$(XCT_PVA_PF),experiment,synthetic experiment)
FIGURES = $(foreach a,$(ADHESIVES),$(addprefix $(OUT)/figures/$(a)-,pressure.svg map.svg shear.svg slice.png start.png))

.PHONY: figures
figures: runs
	@$(MAKE) BUILT=1 --no-print-directory $(SIDE_BY_SIDE) $(FIGURES)
	@echo "figures in $(OUT)/figures"

define figure_rules
$(OUT)/figures/$(1)-pressure.svg: $(RUNS:%=$(OUT)/$(1)/%/final.mpts) $(FINER:%=$(OUT)/$(1)/%-finer/final.mpts) $(BIN)/bond-figures
	@mkdir -p $$(@D)
	$(BIN)/bond-figures pressure $(foreach r,$(RUNS),--run "$(r)=$(OUT)/$(1)/$(r)") \
	    $(foreach r,$(FINER),--finer "$(r)=$(OUT)/$(1)/$(r)-finer") --limit "2.5 MPa" -o $$@

$(OUT)/figures/$(1)-map.svg: $(RUNS:%=$(OUT)/$(1)/%/wp.csv) $(EXPERIMENTS) $(BIN)/bond-figures
	@mkdir -p $$(@D)
	$(BIN)/bond-figures map $(if $(EXPERIMENTS),--map "$(EXPERIMENT)=$(OUT)/$(1)/experiment-map.csv") \
	    $(foreach r,$(RUNS),--map "$(r)=$(OUT)/$(1)/$(r)/map.csv") -o $$@

$(OUT)/figures/$(1)-shear.svg: $(OUT)/$(1)/$(SHOWN)/shear.csv $(BIN)/bond-figures
	@mkdir -p $$(@D)
	$(BIN)/bond-figures shear $$< -o $$@

$(OUT)/figures/$(1)-slice.png: $(OUT)/$(1)/$(SHOWN)/final.mpts $(BIN)/bond-figures
	@mkdir -p $$(@D)
	$(BIN)/bond-figures slice $$< -o $$@

$(OUT)/figures/$(1)-start.png: $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures
	@mkdir -p $$(@D)
	$(BIN)/bond-figures slice $$< -o $$@
endef
$(foreach a,$(ADHESIVES),$(eval $(call figure_rules,$(a))))
