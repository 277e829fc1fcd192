# Undamaged wood of four species, one piece cut and bonded again: Table 2 of the species. Three pieces of each, for small ones
# differ; the first one's runs again in cells of one voxel, for their errors (30-runs.mk). A few minutes.

SPECIES ?= hybrid-poplar beech birch spruce
SPECIES_SEEDS ?= 1 2 3
# Voxels of 1.45 um along x, y and z, as small as those of plain `make`; where to cut; adhesive; turn of the top piece, 90 for
# plywood.
SPECIES_SIZE ?= 40x96x40
SPECIES_PLANE ?= 69.6 um
SPECIES_SLAB ?= 14.5 um
# A bond line of 2.9 um is left, a cell: a thinner film between faces as flat as a cut's is resolved by neither size of cells.
SPECIES_TRAVEL ?= 11.6 um
SPECIES_TURN ?= 0
SPECIES_OUT := out/species

define species_bond
$(SPECIES_OUT)/$(1)-$(2)/bond.mpts: $(BIN)/synth-xct $(BIN)/xct2particles $(BIN)/build-bondline FORCE
	$$(call made,$(BIN)/synth-xct --quiet --adhesive none --species $(1) --size $(SPECIES_SIZE) --voxel "1.45 um" --seed $(2) -o $$(@D)/wood.tif && \
	    $(BIN)/xct2particles --quiet $$(@D)/wood.tif -o $$(@D)/wood.mpts && \
	    $(BIN)/build-bondline $$(@D)/wood.mpts --plane "$(SPECIES_PLANE)" --slab "$(SPECIES_SLAB)" --turn-top $(SPECIES_TURN) -o $$@)
endef
$(foreach s,$(SPECIES),$(foreach n,$(SPECIES_SEEDS),$(eval $(call species_bond,$(s),$(n)))))

# Species and seed, adhesive, name of the folder, options of the cells.
define species_run
$(SPECIES_OUT)/$(1)/$(2)$(3)/final.mpts: pipelines/cases/$(2)-implicit.toml $(SPECIES_OUT)/$(1)/bond.mpts $(BIN)/mpm-run FORCE
	$$(call made,$(BIN)/mpm-run $$< --particles $(SPECIES_OUT)/$(1)/bond.mpts --set clamp.travel="$(SPECIES_TRAVEL)" $(4) $$$$HOW --overwrite -o $$(@D))
endef
SPECIES_FIRST := $(firstword $(SPECIES_SEEDS))
SPECIES_FINER := --set grid.cell="1 voxel" --set contact.influence_length="0.02 cell"
SPECIES_BONDS := $(foreach s,$(SPECIES),$(foreach n,$(SPECIES_SEEDS),$(s)-$(n)))
SPECIES_FIRSTS := $(SPECIES:%=%-$(SPECIES_FIRST))
$(foreach b,$(SPECIES_BONDS),$(foreach a,pf pva-pf,$(eval $(call species_run,$(b),$(a),,))))
$(foreach b,$(SPECIES_FIRSTS),$(foreach a,pf pva-pf,$(eval $(call species_run,$(b),$(a),-finer,$(SPECIES_FINER)))))

define species_wp
$(SPECIES_OUT)/$(1)/$(2)/wp.csv: $(SPECIES_OUT)/$(1)/$(2)/final.mpts $(3) $(BIN)/wp-metrics FORCE
	$$(call made,$(BIN)/wp-metrics $$< $(3:%=--finer %) -o $$@)
endef
$(foreach b,$(SPECIES_BONDS),$(foreach a,pf pva-pf,$(eval $(call species_wp,$(b),$(a),$(if $(filter $(b),$(SPECIES_FIRSTS)),$(SPECIES_OUT)/$(b)/$(a)-finer/final.mpts)))))

# The first piece's run is called "implicit": the others' differences are then from it, with its error.
species_case = $(if $(filter $(1),$(SPECIES_FIRST)),implicit,piece $(1))
$(SPECIES_OUT)/table2.csv: private OUTPUTS = $(SPECIES_OUT)/table2.txt $(SPECIES_OUT)/errors.csv
$(SPECIES_OUT)/table2.csv: $(foreach b,$(SPECIES_BONDS),$(foreach a,pf pva-pf,$(SPECIES_OUT)/$(b)/$(a)/wp.csv)) $(BIN)/bond-figures FORCE
	$(call made,$(BIN)/bond-figures table2 --errors $(SPECIES_OUT)/errors.csv -o $@ $(foreach s,$(SPECIES),$(foreach a,pf pva-pf,$(foreach \
	    n,$(SPECIES_SEEDS),--run "$(s) $(a):$(call species_case,$(n))=$(SPECIES_OUT)/$(s)-$(n)/$(a)/wp.csv"))) >$(SPECIES_OUT)/table2.txt)

.PHONY: species
species: $(SPECIES_OUT)/table2.csv
	@cat $(SPECIES_OUT)/table2.txt $(if $(V),$< $(SPECIES_OUT)/errors.csv)
