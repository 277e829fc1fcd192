# Stage 2: one specimen and one bond file per adhesive, or one bond of undamaged wood for both.

ADHESIVES := $(if $(XCT_PF)$(XCT_PVA_PF),$(if $(XCT_PF),pf) $(if $(XCT_PVA_PF),pva-pf),pf pva-pf)

# Size in voxels (x, y, z) and slab thickness of the synthetic specimens.
SIZE_quick := 40x96x40
SIZE_small := 64x160x64
SIZE_medium := 160x240x160
SIZE_full := 394x394x400
SLAB_quick_pf := 14.5 um
SLAB_quick_pva-pf := 14.5 um
SLAB_small_pf := 29 um
SLAB_small_pva-pf := 40.6 um
SLAB_medium_pf := 55.1 um
SLAB_medium_pva-pf := 78.3 um
SLAB_full_pf := 55.1 um
SLAB_full_pva-pf := 78.3 um

# Blanks of a path, for make.
EMPTY :=
XCT_pf := $(subst $(EMPTY) ,\ ,$(XCT_PF))
XCT_pva-pf := $(subst $(EMPTY) ,\ ,$(XCT_PVA_PF))

ifeq ($(XCT_PF)$(XCT_PVA_PF),)
$(OUT)/%/specimen.tif: $(BIN)/synth-xct
	@mkdir -p $(@D)
	$(BIN)/synth-xct --quiet --adhesive $* --size $(SIZE_$(SCALE)) --slab "$(SLAB_$(SCALE)_$*)" \
	    --voxel "$(VOXEL)" --seed 1 -o $@

$(OUT)/%/experiment.mpts: $(OUT)/%/specimen.tif $(BIN)/xct2particles
	$(BIN)/xct2particles --quiet $< -o $@
else
define experiment_rule
$(OUT)/$(1)/experiment.mpts: $(XCT_$(1)) $(BIN)/xct2particles
	@mkdir -p $$(@D)
	$(BIN)/xct2particles "$$<" --voxel "$(VOXEL)" $(if $(LABELS),--labels "$(LABELS)") -o $$@
endef
$(foreach a,$(ADHESIVES),$(eval $(call experiment_rule,$(a))))
endif

ifeq ($(XCT_BOTTOM),)
$(if $(XCT_TOP),$(error XCT_TOP needs XCT_BOTTOM))
$(OUT)/%/bond.mpts: $(OUT)/%/experiment.mpts $(BIN)/build-bondline
	$(BIN)/build-bondline $< --normal $(NORMAL) -o $@
else
# Undamaged wood: two stacks, or one cut at PLANE.
ifneq ($(XCT_PF)$(XCT_PVA_PF),)
$(error XCT_BOTTOM is undamaged wood, XCT_PF and XCT_PVA_PF are bonded specimens: give one kind)
endif
$(if $(SLAB),,$(error undamaged wood holds no adhesive: give SLAB="55.1 um"))
$(if $(XCT_TOP)$(PLANE),,$(error give XCT_TOP=, or PLANE= to cut XCT_BOTTOM at))
$(if $(XCT_TOP),$(if $(PLANE),$(error PLANE cuts one stack: leave out XCT_TOP or PLANE)))
TURN ?= 0
XCT_bottom := $(subst $(EMPTY) ,\ ,$(XCT_BOTTOM))
XCT_top := $(subst $(EMPTY) ,\ ,$(XCT_TOP))
PIECES := $(OUT)/bottom.mpts $(if $(XCT_TOP),$(OUT)/top.mpts)

define piece_rule
$(OUT)/$(1).mpts: $(XCT_$(1)) $(BIN)/xct2particles
	@mkdir -p $$(@D)
	$(BIN)/xct2particles "$$<" --voxel "$(VOXEL)" $(if $(LABELS),--labels "$(LABELS)") -o $$@
endef
$(foreach p,bottom $(if $(XCT_TOP),top),$(eval $(call piece_rule,$(p))))

$(OUT)/%/bond.mpts: $(PIECES) $(BIN)/build-bondline
	@mkdir -p $(@D)
	$(BIN)/build-bondline $(if $(XCT_TOP),--bottom $(OUT)/bottom.mpts --top $(OUT)/top.mpts,$(OUT)/bottom.mpts --plane "$(PLANE)") \
	    --slab "$(SLAB)" --turn-top $(TURN) --normal $(NORMAL) -o $@
endif
