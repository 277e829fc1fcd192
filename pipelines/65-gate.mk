# The gate: what a change is attacked with. The numbers are in docs/results/reliability.md.

# Advisories, licences and sources of the dependencies; says what it could not check.
.PHONY: deny
deny:
	@pipelines/gate/deny.sh

# Coverage-guided attack on every reader, FUZZ_SECONDS for each. ONLY="tiff npy" attacks those.
# Needs a C++ compiler.
FUZZ_SECONDS ?= 600
.PHONY: fuzz
fuzz:
	@pipelines/gate/fuzz.sh $(FUZZ_SECONDS) $(or $(ONLY),particle-file checkpoint case tiff npy mhd)

# Inputs that were once read wrongly: a table of what this build says of each, and of what the build
# in the folder BASE said. Needs ../shared/data/repro.
.PHONY: faults
faults: $(BINARIES)
	@pipelines/gate/faults.sh $(BIN) "$(BASE:%=%/target/release)" $(ONLY)

# Changes of the code that no test notices: a sample of MUTANTS changes of each crate, of which
# 95 % must be noticed. ONLY="mpm run" takes those crates. Needs cargo-mutants.
MUTANTS ?= 100
.PHONY: mutants
mutants:
	@pipelines/gate/mutants.sh $(MUTANTS) $(or $(ONLY),metrics physics particle-file voxels run mpm saddle-point implicit)

# Fingerprints of thirty small runs of both schemes with every option, to hold beside those of
# another build: make pins >before; ...; make pins | diff before -
.PHONY: pins
pins: $(BINARIES)
	@pipelines/gate/pins.sh $(BIN) out/pins
