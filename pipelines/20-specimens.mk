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

# The stack that a variable names, as a particle file; its voxel is the one that it states, unless told.
STATED = $(if $(VOXEL),--voxel $(call q,$(VOXEL))) $(if $(LABELS),--labels $(call q,$(LABELS)))
define stack_rule
$(1): private READS = $$(call q,$$($(2)))
$(1): $(BIN)/xct2particles FORCE
	$$(call made,$(BIN)/xct2particles $$(READS) $$(STATED) -o $$@)
endef
STACK_pf := XCT_PF
STACK_pva-pf := XCT_PVA_PF

# Options of build-bondline, a word each.
BOND_OPTIONS = $(foreach word,$(BOND),$(call q,$(word)))
EXPERIMENTS := $(ADHESIVES:%=$(OUT)/%/experiment.mpts)
BONDS := $(ADHESIVES:%=$(OUT)/%/bond.mpts)

ifndef OWN
$(EXPERIMENTS:experiment.mpts=specimen.tif): $(OUT)/%/specimen.tif: $(BIN)/synth-xct FORCE
	$(call made,$(BIN)/synth-xct --quiet --adhesive $* --size $(SIZE_$(SCALE)) --slab "$(SLAB_$(SCALE)_$*)" \
	    --voxel $(call q,$(or $(VOXEL),1.45 um)) --seed 1 -o $@)

$(EXPERIMENTS): %/experiment.mpts: %/specimen.tif $(BIN)/xct2particles FORCE
	$(call made,$(BIN)/xct2particles --quiet $< -o $@)
else
$(foreach a,$(ADHESIVES),$(eval $(call stack_rule,$(OUT)/$(a)/experiment.mpts,$(STACK_$(a)))))
endif

ifeq ($(XCT_BOTTOM),)
$(BONDS): %/bond.mpts: %/experiment.mpts $(BIN)/build-bondline FORCE
	$(call made,$(BIN)/build-bondline $(if $(OWN),,--quiet) $< --normal $(call q,$(NORMAL)) -o $@ $(BOND_OPTIONS))
else
# Undamaged wood, which is no experiment: two stacks, or one cut at PLANE.
EXPERIMENTS :=
TURN ?= 0
BOTTOM := $(OUT)/bottom.mpts
TOP := $(if $(XCT_TOP),$(OUT)/top.mpts)
$(eval $(call stack_rule,$(BOTTOM),XCT_BOTTOM))
$(if $(TOP),$(eval $(call stack_rule,$(TOP),XCT_TOP)))

$(BONDS): $(BOTTOM) $(TOP) $(BIN)/build-bondline FORCE
	$(call made,$(BIN)/build-bondline $(if $(TOP),--bottom $(BOTTOM) --top $(TOP),$(BOTTOM) --plane $(call q,$(PLANE))) \
	    --slab $(call q,$(SLAB)) --turn-top $(call q,$(TURN)) --normal $(call q,$(NORMAL)) -o $@ $(BOND_OPTIONS))
endif
