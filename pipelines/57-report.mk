# Stage 6: one page of all that, for a browser, to hand on.

REPORT := $(OUT)/report.html
# What the pictures show, by the last word of their names.
CAPTION_pressure := Clamping pressure and closing speed against time
CAPTION_map := Weighted penetration over the bond plane
CAPTION_shear := Shear rate against time, $(SHOWN)
CAPTION_slice := Slice through the end, $(SHOWN)
CAPTION_start := Slice through the start
ADHESIVE_pf := PF
ADHESIVE_pva-pf := PVA-PF
picture_caption = $(foreach a,$(ADHESIVES),$(if $(filter $(a)-%,$(1)),$(ADHESIVE_$(a)): $(or $(CAPTION_$(1:$(a)-%=%)),$(1:$(a)-%=%))))
# The run that is shown in 3D: the implicit one, whose walls are the wood's.
SEEN := $(firstword $(filter implicit,$(RUNS)) $(RUNS))
PICTURES = $(filter %.svg %.png,$(FIGURES))

.PHONY: report
report: runs
	@$(MAKE) BUILT=1 --no-print-directory $(SIDE_BY_SIDE) $(REPORT)

$(REPORT): $(OUT)/table2.csv $(FIGURES) $(FINALS) $(BIN)/bond-report
	$(BIN)/bond-report --title "Adhesive pressed into wood: $(notdir $(OUT))" \
	    $(foreach a,$(ADHESIVES),$(foreach r,$(RUNS),--run "$(ADHESIVE_$(a)) $(r)=$(OUT)/$(a)/$(r)")) \
	    --table "Table 2: weighted penetration (WP)=$(OUT)/table2.csv" \
	    $(if $(FINER),--table "Error by the size of the cells=$(OUT)/errors.csv") \
	    $(foreach p,$(PICTURES),--picture "$(strip $(call picture_caption,$(basename $(notdir $(p)))))=$(p)") \
	    $(foreach a,$(ADHESIVES),--state "$(ADHESIVE_$(a)) $(SEEN) at the end=$(OUT)/$(a)/$(SEEN)/final.mpts") -o $@
