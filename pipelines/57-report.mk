# Stage 6: one page of all that, for a browser, to hand on.

REPORT := $(OUT)/report.html
# What the pictures show, by the last word of their names.
CAPTION_pressure := Clamping pressure and closing speed against time
CAPTION_map := Weighted penetration over the bond plane
CAPTION_shear := Shear rate against time, $(SHOWN)
CAPTION_slice := Slice through the end, $(SHOWN)
CAPTION_start := Slice through the start
CAPTION_press := Start, middle and end in three dimensions, $(SHOWN); adhesive in orange, the nearer half of the wood cut away
CAPTION_setup := How the bond is set up
CAPTION_grid := The grid over the voxels
CAPTION_adhesive := The adhesive alone, experiment and runs
picture_caption = $(CAPTION_$(1)) $(foreach a,$(ADHESIVES),$(if $(filter $(a)-%,$(1)),$(NAME_$(a)): $(or $(CAPTION_$(1:$(a)-%=%)),$(1:$(a)-%=%))))
# The summary holds Table 2 itself; the film on an incline is no bond. The first two pictures stand in the summary.
DRAWN = $(filter-out %/table2.$(FIRST) %/film.png,$(filter %.svg %.png,$(FIGURES)))
FOREMOST = $(foreach a,$(firstword $(ADHESIVES)),$(filter %/$(a)-press.$(FIRST) %/$(a)-pressure.$(FIRST),$(DRAWN)))
SHOWN_PICTURES = $(FOREMOST) $(filter-out $(FOREMOST),$(DRAWN))

.PHONY: report
report: $(REPORT)
	@echo "report: $(REPORT)"

$(REPORT): private READS = $(foreach file,summary.json resolved.toml,$(FINALS:final.mpts=$(file)))
$(REPORT): $(METRICS) $(EXPERIMENT_TABLES) $(FIGURES) $(FINALS) $(BIN)/bond-report FORCE
	$(call made,$(BIN)/bond-report --title "Adhesive pressed into wood: $(notdir $(OUT))" \
	    $(foreach a,$(ADHESIVES),$(call experiment,$(a),--experiment ,.csv)) \
	    $(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),--run "$(NAME_$(a)) $(r)=$(OUT)/$(a)/$(r)")) \
	    $(foreach p,$(SHOWN_PICTURES),--picture "$(strip $(call picture_caption,$(basename $(notdir $(p)))))=$(p)") \
	    $(foreach a,$(ADHESIVES),--state "$(NAME_$(a)) $(SHOWN) at the end=$(OUT)/$(a)/$(SHOWN)/final.mpts") -o $@)

all: $(OUT)/table2.csv $(FIGURES) $(REPORT)
	$(show_table2)
	@echo "figures: $(OUT)/figures, all on one page: $(REPORT)"
