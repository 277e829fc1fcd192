# The user's own stacks, and what of a command line is refused before anything is made.

COMMA := ,
STACKS := XCT_PF XCT_PVA_PF XCT_BOTTOM XCT_TOP
# A `$` in them is one.
$(foreach v,$(STACKS) SWEEP SWEEP_CASE SET DESTDIR $(if $(filter file,$(origin PREFIX)),,PREFIX),$(eval override $(v) := $$(value $(v))))
OWN := $(if $(strip $(foreach v,$(STACKS),$($(v)))),yes)

# One word for the shell.
q = '$(subst ','\'',$(1))'

# What nothing here names with a `=` or gives a default is a slip; compilers, shells and threads read their own.
READ = $(shell grep -ohE '[A-Z][A-Z0-9_]*( [?])?=' Makefile pipelines/*.mk | sed 's/[ ?=]*$$//')
GIVEN := $(foreach v,$(.VARIABLES),$(if $(filter line,$(origin $(v))),$(v)))
SLIP := $(firstword $(if $(GIVEN),$(filter-out CARGO% RUST% RAYON% CC CXX CFLAGS SHELL PATH TMPDIR $(READ),$(GIVEN))))
NEAR = $(sort $(filter $(shell printf %.3s $(call q,$(SLIP)) | tr a-z A-Z)%,$(shell grep -oE '[A-Z][A-Z0-9_]+=' Makefile)))
$(if $(SLIP),$(error make has no variable $(SLIP)=$(if $(NEAR),$(COMMA) but $(NEAR)): make help lists all))

# Values that there are; what belongs to another kind of specimen.
CASES := $(patsubst pf-%.toml,%,$(notdir $(wildcard pipelines/cases/pf-*.toml)))
$(foreach v,PAPER ERROR,$(if $(filter-out yes no,$($(v))),$(error $(v)=$($(v)): yes and no are accepted)))
$(foreach v,JOBS RUN_THREADS,$(if $($(v)),$(if $(shell printf %s $(call q,$($(v))) | grep -xE '[1-9][0-9]{0,3}'),,\
    $(error $(v)=$($(v)): a whole number from 1 to 9999 is needed))))
$(if $(findstring :$(SCALE):,:quick:small:medium:full:),,$(error SCALE=$(SCALE): quick$(COMMA) small$(COMMA) medium and full are there))
$(foreach r,$(filter-out $(CASES),$(RUNS)),$(error RUNS: there is no run '$(r)' but $(CASES)))
$(if $(filter line,$(origin RUNS)),$(if $(strip $(RUNS)),,$(error RUNS= names no run: there are $(CASES))))
alone = $(foreach v,$(1),$(if $(and $(filter line,$(origin $(v))),$($(v))),$(error $(v)= is for $(2) alone: leave it out)))
$(call alone,$(if $(OWN),SCALE,LABELS),$(if $(OWN),synthetic specimens,your own stacks))
$(call alone,$(if $(XCT_BOTTOM)$(XCT_TOP),,SLAB PLANE TURN),undamaged wood (XCT_BOTTOM=))

# In the names of stacks, which only the tools see, anything may be; the results are make's own.
AWKWARD := $(shell [ -z "$$(printf %s $(call q,$(value OUT)) | LC_ALL=C tr -d 'A-Za-z0-9._/+@^\200-\377-')" ] || echo yes)
$(if $(or $(AWKWARD),$(filter -%,$(OUT)),$(if $(OUT),,empty)),$(error OUT='$(value OUT)': the name of the folder of results is made of letters, digits and . _ / + @ ^ -, the last not first))
override OUT := $(patsubst %/,%,$(OUT))

$(if $(XCT_TOP),$(if $(XCT_BOTTOM),,$(error XCT_TOP needs XCT_BOTTOM)))
ifneq ($(XCT_BOTTOM),)
$(if $(XCT_PF)$(XCT_PVA_PF),$(error XCT_BOTTOM is undamaged wood, XCT_PF and XCT_PVA_PF are bonded specimens: give one kind))
$(if $(SLAB),,$(error undamaged wood holds no adhesive: give SLAB="55.1 um"))
$(if $(XCT_TOP)$(PLANE),,$(error give XCT_TOP=, or PLANE= to cut XCT_BOTTOM at))
$(if $(XCT_TOP),$(if $(PLANE),$(error PLANE cuts one stack: leave out XCT_TOP or PLANE)))
endif
$(if $(findstring grid.cell=,$(SET)),$(error SET holds for finer runs too: give CELL="1 voxel" in place of grid.cell))

# SET="key=value ..." as options of mpm-run: a word with a `=` begins a key, others go on with its value.
$(if $(strip $(SET)),$(if $(filter =%,$(SET) $(if $(findstring =,$(firstword $(SET))),,=)),\
    $(error SET='$(SET)': KEY=VALUE is needed$(COMMA) without a blank before the =)))
EMPTY :=
MARKED = $(subst ','\'',$(foreach word,$(SET),$(if $(findstring =,$(word)),@@)$(word)))
SETS = $(if $(SET),--set '$(subst $(EMPTY) @@,' --set ',$(subst ^@@,,^$(MARKED)))')
