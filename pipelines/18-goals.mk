# Goals are made behind the foremost tools by a make of their own (BUILT), alone in the folder of their results (goal.sh).

# Not where make only says what it would do (-n, -q, -t).
SAYS = $(strip $(foreach letter,n q t,$(findstring $(letter),$(LETTERS))))
INNER = $(MAKE) -s BUILT=$(if $(filter $(GOALS),$@),foremost,1) --no-print-directory $(SIDE_BY_SIDE)
GOALS := all runs table2 figures report species
.PHONY: $(GOALS)
species: OUT := out/species

define goal_rule
$(1): $(2) FORCE
	+@$$(if $$(SAYS),,pipelines/alone.sh $$(OUT) pipelines/goal.sh $$@) $$(INNER) $$(if $$(SAYS),$$@)
endef
$(eval $(call goal_rule,$(GOALS),foremost-tools))
$(foreach folder,$(sort $(OUT) out),$(eval $(call goal_rule,$(folder)/%,$(BINARIES))))
