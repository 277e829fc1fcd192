# Stage 2: one specimen and one bond file per adhesive.

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

$(OUT)/%/bond.mpts: $(OUT)/%/experiment.mpts $(BIN)/build-bondline
	$(BIN)/build-bondline $< --normal $(NORMAL) -o $@
