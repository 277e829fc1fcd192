# The user's own stacks, and what of a command line is refused before anything is made.

STACKS := XCT_PF XCT_PVA_PF XCT_BOTTOM XCT_TOP
# A `$` in them is one.
$(foreach v,$(STACKS) SWEEP SWEEP_CASE SET,$(eval override $(v) := $$(value $(v))))
OWN := $(if $(strip $(foreach v,$(STACKS),$($(v)))),yes)

# One word for the shell.
q = '$(subst ','\'',$(1))'

# What nothing here reads is a slip; compilers, shells and threads read their own.
READ = $(shell grep -ohE '\$$.[A-Z][A-Z0-9_]*|[A-Z][A-Z0-9_]*=' Makefile pipelines/*.mk | sed 's/^\$$.//; s/=$$//')
GIVEN := $(foreach v,$(.VARIABLES),$(if $(filter line,$(origin $(v))),$(v)))
SLIP := $(firstword $(if $(GIVEN),$(filter-out CARGO% RUST% RAYON% CC CXX CFLAGS SHELL PATH TMPDIR $(READ),$(GIVEN))))
NEAR = $(sort $(filter $(shell printf %.3s $(call q,$(SLIP)) | tr a-z A-Z)%,$(shell grep -oE '[A-Z][A-Z0-9_]+=' Makefile)))
$(if $(SLIP),$(error make has no variable $(SLIP)=$(if $(NEAR),$(COMMA) but $(NEAR)): make help lists all))

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
EMPTY :=
MARKED = $(subst ','\'',$(foreach word,$(SET),$(if $(findstring =,$(word)),@@)$(word)))
SETS = $(if $(SET),--set '$(subst $(EMPTY) @@,' --set ',$(subst ^@@,,^$(MARKED)))')
