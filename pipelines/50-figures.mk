# Stage 5: figures of the paper from the tools' outputs, in every one of FORMATS (svg, png, pdf).
#
#   make figures FIGURE_WIDTH="84 mm" FIGURE_DPI=300 FORMATS="png pdf"
#
#   Fig. 1   PF-press      three-dimensional, start, mid-run and end of the run SHOWN
#   Fig. 2   PF-setup      stack, slice, adherends parted, slab put in
#   Fig. 3   PF-grid       grid of the runs over the voxels
#   Fig. 4   film          points and profiles of a film on an incline, one for all (30 s)
#   5, 6     PF-pressure   pressure and closing speed over time
#   Fig. 7   PF-adhesive   the adhesive alone, experiment and all runs
#   8, 9     PF-map        weighted penetration over the bond plane
#   10, 11   PF-shear      shear rates of the run SHOWN
#   Table 2  table2
#            PF-slice, PF-start   slices of the run SHOWN and of the bond

FORMATS ?= svg png pdf
FIGURE_DPI ?= 300
FIGURE_WIDTH ?=
PRINT = $(if $(FIGURE_WIDTH),--width "$(FIGURE_WIDTH)") --dpi $(FIGURE_DPI)
# A rule makes its figure in the first format, and the others beside it.
FIRST := $(firstword $(FORMATS))
PICTURES = $(PRINT) $(foreach f,$(FORMATS),-o $(@:.$(FIRST)=.$(f)))

# A comma in a branch of $(if).
COMMA := ,
# What people call adhesives and runs.
NAME_pf := PF
NAME_pva-pf := PVA-PF
NAME_xpic := partial slip, XPIC(5)
NAME_flip := partial slip, FLIP
NAME_frictionless := frictionless, FLIP
NAME_implicit := partial slip, implicit
NAME_implicit-frictionless := frictionless, implicit
NAME_experiment := $(if $(XCT_PF)$(XCT_PVA_PF),experiment,synthetic experiment)

# The run that three-dimensional views of a press, shear rates and slices are drawn of.
SHOWN := $(firstword $(filter xpic,$(RUNS)) $(RUNS))
# Undamaged wood is no experiment, and its bond no stack that was parted.
OF_ONE := press $(if $(EXPERIMENTS),setup) grid pressure adhesive map shear slice start
FIGURES = $(foreach a,$(ADHESIVES),$(OF_ONE:%=$(OUT)/figures/$(a)-%.$(FIRST))) \
    $(OUT)/figures/table2.$(FIRST) $(OUT)/figures/film.png

# Figures are drawn again where they are asked for in another size or format.
PRINTED := $(OUT)/figures/.printed
$(PRINTED): FORCE
	@mkdir -p $(@D)
	@echo '$(PRINT) $(FORMATS)' | cmp -s - $@ || echo '$(PRINT) $(FORMATS)' > $@

.PHONY: figures
figures: runs
	@$(MAKE) BUILT=1 --no-print-directory $(SIDE_BY_SIDE) $(FIGURES)
	@echo "figures in $(OUT)/figures"

define figure_rules
$(OUT)/figures/$(1)-press.$(FIRST): $(OUT)/$(1)/$(SHOWN)/final.mpts $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures view "$(NAME_$(1)), start=$(OUT)/$(1)/bond.mpts" \
	    "mid-run=$$$$(ls $$(<D)/snapshots/*.mpts | awk '{ all[NR] = $$$$0 } END { print all[int((NR + 1) / 2)] }')" \
	    "end=$$<" $$(PICTURES)

$(OUT)/figures/$(1)-setup.$(FIRST): $(OUT)/$(1)/experiment.mpts $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures setup $(OUT)/$(1)/experiment.mpts $(OUT)/$(1)/bond.mpts $$(PICTURES)

$(OUT)/figures/$(1)-grid.$(FIRST): $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures slice "$(NAME_$(1))=$$<" --normal $(FRONT_$(NORMAL)) --grid "$$(CELL)" \
	    --part "0 um:$$(call voxels,30),0 um:$$(call voxels,30)" $$(PICTURES)

$(OUT)/figures/$(1)-pressure.$(FIRST): $(RUNS:%=$(OUT)/$(1)/%/final.mpts) $(FINER:%=$(OUT)/$(1)/%-finer/final.mpts) $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures pressure --title "$(NAME_$(1))" \
	    $(foreach r,$(RUNS),--run "$(or $(NAME_$(r)),$(r))=$(OUT)/$(1)/$(r)") \
	    $(foreach r,$(FINER),--finer "$(or $(NAME_$(r)),$(r))=$(OUT)/$(1)/$(r)-finer") \
	    --limit "2.5 MPa" $$(PICTURES)

$(OUT)/figures/$(1)-adhesive.$(FIRST): $(RUNS:%=$(OUT)/$(1)/%/final.mpts) $(EXPERIMENTS:.csv=.mpts) $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures view --wood hidden \
	    $(if $(EXPERIMENTS),"$(NAME_$(1))$(COMMA) $(NAME_experiment)=$(OUT)/$(1)/experiment.mpts") \
	    $(foreach r,$(RUNS),"$(or $(NAME_$(r)),$(r))=$(OUT)/$(1)/$(r)/final.mpts") $$(PICTURES)

$(OUT)/figures/$(1)-map.$(FIRST): $(RUNS:%=$(OUT)/$(1)/%/wp.csv) $(EXPERIMENTS) $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures map \
	    $(if $(EXPERIMENTS),--map "$(NAME_$(1))$(COMMA) $(NAME_experiment)=$(OUT)/$(1)/experiment-map.csv") \
	    $(foreach r,$(RUNS),--map "$(or $(NAME_$(r)),$(r))=$(OUT)/$(1)/$(r)/map.csv") $$(PICTURES)

$(OUT)/figures/$(1)-shear.$(FIRST): $(OUT)/$(1)/$(SHOWN)/shear.csv $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures shear "$(NAME_$(1)), $(or $(NAME_$(SHOWN)),$(SHOWN))=$$<" $$(PICTURES)

$(OUT)/figures/$(1)-slice.$(FIRST): $(OUT)/$(1)/$(SHOWN)/final.mpts $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures slice "$(NAME_$(1)), $(or $(NAME_$(SHOWN)),$(SHOWN))=$$<" --normal $(FRONT_$(NORMAL)) $$(PICTURES)

$(OUT)/figures/$(1)-start.$(FIRST): $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures slice "$(NAME_$(1)), before pressing=$$<" --normal $(FRONT_$(NORMAL)) $$(PICTURES)
endef
# The axis that a slice across the bond is normal to.
FRONT_x := y
FRONT_y := z
FRONT_z := x
$(foreach a,$(ADHESIVES),$(eval $(call figure_rules,$(a))))

$(OUT)/figures/table2.$(FIRST): $(METRICS) $(EXPERIMENTS) $(BIN)/bond-figures $(PRINTED)
	$(BIN)/bond-figures table2 $(TABLE2) $(foreach n,$(ADHESIVES) $(RUNS) experiment,--name "$(n)=$(or $(NAME_$(n)),$(n))") \
	    $(subst -o ,--picture ,$(PICTURES)) -o $(OUT)/figures/table2.csv >/dev/null

$(OUT)/figures/film.png: $(BIN)/mpm-run
	@mkdir -p $(@D)
	$(BIN)/study verify $(OUT)/figures/film incline-n6-off0
	@mv $(OUT)/figures/film/verification-incline.png $@
	@mv $(OUT)/figures/film/verification-incline-points.png $(@:.png=-points.png)
