# Stage 5: figures of the paper from the tools' outputs, in every one of FORMATS (svg, png, pdf).
#
#   make figures FIGURE_WIDTH="84 mm" FIGURE_DPI=300 FORMATS="png pdf"
#
#   Fig. 1   PF-press      three-dimensional, start, mid-run and end of the run SHOWN
#   Fig. 2   PF-setup      stack, slice, adherends parted, slab put in
#   Fig. 3   PF-grid       grid of the runs over the voxels
#   Fig. 4   film          points and profiles of a film on an incline, one for all synthetic specimens (30 s)
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

# What people call adhesives and runs.
NAME_pf := PF
NAME_pva-pf := PVA-PF
NAME_xpic := partial slip, XPIC(5)
NAME_flip := partial slip, FLIP
NAME_frictionless := frictionless, FLIP
NAME_implicit := partial slip, implicit
NAME_implicit-frictionless := frictionless, implicit
NAME_experiment := $(if $(XCT_PF)$(XCT_PVA_PF),experiment,synthetic experiment)

# The run that three-dimensional views of a press, shear rates and slices are drawn of: the implicit one, whose walls are
# the wood's.
SHOWN := $(firstword $(filter implicit,$(RUNS)) $(RUNS))
# Undamaged wood is no experiment, and its bond no stack that was parted.
OF_ONE := press $(if $(EXPERIMENTS),setup) grid pressure adhesive map shear slice start
FIGURES = $(foreach a,$(ADHESIVES),$(OF_ONE:%=$(OUT)/figures/$(a)-%.$(FIRST))) \
    $(OUT)/figures/table2.$(FIRST) $(if $(OWN),,$(OUT)/figures/film.png)
# The other formats.
OTHERS = $(foreach f,$(filter-out $(FIRST),$(FORMATS)),$(@:.$(FIRST)=.$(f)))
$(filter-out %/film.png,$(FIGURES)): private OUTPUTS = $(OTHERS)

.PHONY: figures
figures: $(FIGURES)
	@echo "figures: $(OUT)/figures"

# What people call a run, of an adhesive; and `NAME=PATH` for those of an adhesive, an option before each.
name = $(or $(NAME_$(1)),$(1))
named = $(foreach r,$(2),$(3)"$(call name,$(r))=$(OUT)/$(1)/$(r)$(4)")

define figure_rules
$(OUT)/figures/$(1)-press.$(FIRST): private READS = $(OUT)/$(1)/$(SHOWN)/snapshots
$(OUT)/figures/$(1)-press.$(FIRST): $(OUT)/$(1)/$(SHOWN)/final.mpts $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures view "$$(NAME_$(1))$$(COMMA) start=$(OUT)/$(1)/bond.mpts" \
	    "mid-run=$$$$(ls $$(READS)/*.mpts | awk '{ all[NR] = $$$$0 } END { print all[int((NR + 1) / 2)] }')" \
	    "end=$$<" $$(PICTURES))

$(OUT)/figures/$(1)-setup.$(FIRST): $(OUT)/$(1)/experiment.mpts $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures setup $(OUT)/$(1)/experiment.mpts $(OUT)/$(1)/bond.mpts $$(PICTURES))

$(OUT)/figures/$(1)-grid.$(FIRST): $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures slice "$$(NAME_$(1))=$$<" --normal $$(FRONT_$(NORMAL)) \
	    --grid $$(call q,$$(or $$(CELL),2 voxels)) --part "0 voxels:30 voxels$$(COMMA)0 voxels:30 voxels" $$(PICTURES))

$(OUT)/figures/$(1)-pressure.$(FIRST): private READS = $$(foreach f,history.csv summary.json resolved.toml,$$(patsubst %/final.mpts,%/$$(f),$$(filter %/final.mpts,$$^)))
$(OUT)/figures/$(1)-pressure.$(FIRST): $(RUNS:%=$(OUT)/$(1)/%/final.mpts) $(patsubst %,$(OUT)/$(1)/%-finer/final.mpts,$(call finer,$(1))) $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures pressure --title "$$(NAME_$(1))" $$(call named,$(1),$$(RUNS),--run ) \
	    $$(call named,$(1),$$(call finer,$(1)),--finer ,-finer) $$(PICTURES))

$(OUT)/figures/$(1)-adhesive.$(FIRST): $(RUNS:%=$(OUT)/$(1)/%/final.mpts) $(EXPERIMENTS) $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures view --wood hidden $$(call experiment,$(1),,.mpts) \
	    $$(call named,$(1),$$(RUNS),,/final.mpts) $$(PICTURES))

$(OUT)/figures/$(1)-map.$(FIRST): private READS = $$(patsubst %/wp.csv,%/map.csv,$$(filter %/wp.csv,$$^)) $(EXPERIMENTS:.mpts=-map.csv)
$(OUT)/figures/$(1)-map.$(FIRST): $(RUNS:%=$(OUT)/$(1)/%/wp.csv) $(EXPERIMENT_TABLES) $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures map $$(call experiment,$(1),--map ,-map.csv) \
	    $$(call named,$(1),$$(RUNS),--map ,/map.csv) $$(PICTURES))

$(OUT)/figures/$(1)-shear.$(FIRST): $(OUT)/$(1)/$(SHOWN)/shear.csv $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures shear "$$(NAME_$(1))$$(COMMA) $$(call name,$(SHOWN))=$$<" $$(PICTURES))

$(OUT)/figures/$(1)-slice.$(FIRST): $(OUT)/$(1)/$(SHOWN)/final.mpts $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures slice "$$(NAME_$(1))$$(COMMA) $$(call name,$(SHOWN))=$$<" \
	    --normal $$(FRONT_$(NORMAL)) $$(PICTURES))

$(OUT)/figures/$(1)-start.$(FIRST): $(OUT)/$(1)/bond.mpts $(BIN)/bond-figures FORCE
	$$(call made,$(BIN)/bond-figures slice "$$(NAME_$(1))$$(COMMA) before pressing=$$<" --normal $$(FRONT_$(NORMAL)) $$(PICTURES))
endef
# The experiment beside an adhesive's runs, where there is one.
experiment = $(if $(EXPERIMENTS),$(2)"$(NAME_$(1))$(COMMA) $(NAME_experiment)=$(OUT)/$(1)/experiment$(3)")
# The axis that a slice across the bond is normal to.
FRONT_x := y
FRONT_y := z
FRONT_z := x
$(foreach a,$(ADHESIVES),$(eval $(call figure_rules,$(a))))

$(OUT)/figures/table2.$(FIRST): private READS = $(SUMMARIES)
$(OUT)/figures/table2.$(FIRST): $(METRICS) $(EXPERIMENT_TABLES) $(BIN)/bond-figures FORCE
	$(call made,$(TABLE2) $(call table2_rows,$(RUNS)) \
	    $(foreach n,$(ADHESIVES) $(RUNS) experiment,--name "$(n)=$(call name,$(n))") \
	    $(subst -o ,--picture ,$(PICTURES)) -o $(OUT)/figures/table2.csv >/dev/null)

# One film for all folders of results.
FILM := out/film/verification-incline
$(FILM).png: private OUTPUTS = $(FILM)-points.png
$(FILM).png: $(BIN)/study $(BIN)/mpm-run FORCE
	$(call made,pipelines/alone.sh $(@D) $(BIN)/study verify $(@D) incline-n6-off0 >$(@D)/log)
$(OUT)/figures/film.png: private OUTPUTS = $(OUT)/figures/film-points.png
$(OUT)/figures/film.png: private READS = $(FILM)-points.png
$(OUT)/figures/film.png: $(FILM).png FORCE
	$(call made,cp $(FILM).png $@ && cp $(FILM)-points.png $(OUT)/figures/film-points.png)
