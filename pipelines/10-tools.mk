# Stage 1: the tools. Cargo decides what to rebuild.

.PHONY: FORCE
FORCE:

# What the first table is made by. The goals of the pipeline begin with these, the others are built behind that table.
FOREMOST_TOOLS := synth-xct xct2particles build-bondline mpm-run wp-metrics bond-figures particles
OTHER_BINARIES := $(filter-out $(FOREMOST_TOOLS:%=$(BIN)/%),$(BINARIES)) $(BIN)/study

# A build that fails leaves the tools of the last good one.
.PRECIOUS: $(BINARIES) $(OTHER_BINARIES)

# Sub-makes find the tools built.
BUILD = @[ -x $(BIN)/mpm-run ] || echo "building the tools, once: about six minutes of one core, three and a half of two" >&2; \
    $(CARGO) build --release
ifeq ($(BUILT),)
$(BINARIES) &: FORCE
	$(BUILD) --workspace
endif
.PHONY: foremost-tools
foremost-tools:
	$(BUILD) $(FOREMOST_TOOLS:%=-p %)

.PHONY: test
test:
	$(CARGO) fmt --all --check
	$(CARGO) clippy --release --workspace --all-targets --quiet -- -D warnings
	$(CARGO) clippy --release -p mpm-run --features double --quiet -- -D warnings
	$(CARGO) build --release --workspace
	$(CARGO) test --release --workspace
	$(SHARED_TESTS)

# Tests on volumes that are not in the repository say that they are ignored; where the folder is
# beside the repository, they run.
SHARED_TESTS = @echo "left out: five tests, for ../shared/data is absent"
ifneq ($(wildcard ../shared/data/*.tif),)
SHARED_TESTS = $(CARGO) test --release -p voxels -p wp-metrics -p tests -- --ignored shared_data
endif

# A tool prints its page and those of its subcommands, to which it refers: a file each.
PAGES = /^\.ie / { head = $$0; next } /^\.el / { head = head "\n" $$0; next } \
    /^\.TH / { page = "out/man/" $$2 ".1"; print head > page } { print > page }

.PHONY: man
man: $(BINARIES)
	@mkdir -p out/man && rm -f out/man/*.1
	@for tool in $(TOOLS); do $(BIN)/$$tool --generate man; done | awk '$(PAGES)'
	@echo "man pages in out/man"

# Without the tables of lines that backtraces are made with: 190 of 215 MB. DESTDIR is put before PREFIX, as packagers do.
INSTALLED = $(call q,$(DESTDIR)$(PREFIX))
.PHONY: install
install: $(BINARIES) man
	install -d $(INSTALLED)/bin $(INSTALLED)/share/man/man1 $(INSTALLED)/share/bash-completion/completions
	install -s $(BINARIES) $(INSTALLED)/bin
	install -m 644 out/man/*.1 $(INSTALLED)/share/man/man1
	@for tool in $(TOOLS); do \
	    $(BIN)/$$tool --generate bash > $(INSTALLED)/share/bash-completion/completions/$$tool; done
	@echo "$$(cd $(INSTALLED)/bin && du -cm $(TOOLS) | tail -n 1 | cut -f 1) MB in" $(INSTALLED)/bin
