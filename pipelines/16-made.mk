# How every target is made: its content and that of what it is made of decide, not their age (made.sh).
#
# A recipe is $(call made,COMMAND), with FORCE as a prerequisite. The target is made of the text of COMMAND, in which a comma
# is $(COMMA) and names are of `$$` where the rule is evaluated; of its other prerequisites; and of READS, what make has no
# rule for, as words of the shell. OUTPUTS are files that COMMAND writes beside it. FORCE has each rule looked at.

# Letters of make's flags: -n says what would be made, behind what it would make anew; -B makes all.
LETTERS = $(firstword -$(MAKEFLAGS))
DRY = $(findstring n,$(LETTERS))
OF = $(call q,$@) $(call q,$(1)) $(call q,$(OUTPUTS)) $(filter-out FORCE,$^) $(READS)
STALE = $(firstword $(findstring B,$(LETTERS)) $(if $(DRY),$(filter $(MADE),$^)) $(shell pipelines/made.sh stale $(OF)))
made = $(foreach why,$(STALE),$(eval MADE += $@)$(if $(DRY),$(if $(filter kept,$(why)),# not sound: )$(1),@pipelines/made.sh make $(OF)))

# Tools that are not built yet are taken for made, where make only says what it would do.
ifneq ($(and $(BUILT),$(DRY)),)
$(BINARIES) $(BIN)/study:
endif

export BIN V YES RUN_THREADS AT_ONCE
