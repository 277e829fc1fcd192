# Long studies; their results are committed under docs/results/.

# verify        every verification scene by every method that applies, against closed forms
# stability     stiff and extreme cases by both schemes: all end well, are refused or stop with a reason
# options       what the options of the explicit scheme that are not the paper's change
# load-control  the implicit scheme's clamp at a pressure limit: 5 pressures x 5 viscosities x 8 scenes at two
#               Courant numbers; fails where a step breaks its Courant number or the closing is out of order
# steps         what the length of a step and the size of a cell change in presses by the implicit scheme; fails where a run does.
#               The piece of acer needs ../shared
# crash         runs killed, or denied the disk, at every call by which they change their folder, and two runs
#               into one: all end as the run in one piece, or are refused. Needs `strace` and `prlimit`
# leave-out     what a scene pays for what it does not use: instructions of the stages of both schemes; fails where a stage
#               that a scene does without has some. Needs `valgrind`
#
# ONLY="slit channel" takes what has one of the words in its name and writes to out/results.
STUDY = @$(BIN)/study $@ $(if $(ONLY),out/results,docs/results) $(ONLY)
# bench         what both schemes cost per liquid cell, point and step, at several sizes and numbers of threads;
#               beside an older build: make bench BASE=/path/to/its/target/release
# experiments   squeeze flows that others measured predicted blind, permeabilities beside published ones, cells of species beside
#               measured ones, presses of a measured section of spruce; what needs ../shared is left out without it
.PHONY: verify stability options load-control steps leave-out crash bench experiments
export BASE
verify stability options load-control steps leave-out crash bench experiments: $(BINARIES)
	$(STUDY)

# Error against CPU time over schemes, settings and precision. Also writes the errors that `mpm-run --explain`
# quotes, which is compiled in: build again after it.
.PHONY: tradeoff
tradeoff: $(BINARIES)
	@$(CARGO) build --release --quiet -p mpm-run --features double --target-dir target/double
	$(STUDY)

# Every page that a study writes, of one build, one after the other.
.PHONY: pages
pages:
	+@for page in verify stability options load-control steps leave-out crash experiments bench tradeoff; do $(MAKE) $$page; done

# Speed of the kernels alone and of the linear solver.
.PHONY: kernels
kernels:
	$(CARGO) run --release --quiet -p mpm --example mpm_bench
	$(CARGO) run --release --quiet -p saddle-point --example solver_bench -- 1e-3 32,48,48,12 64,56,64,12

# 50 000 forged particle files and checkpoints with right checksums: none panics, hangs or floods.
COUNT ?= 50000
.PHONY: forge
forge:
	@$(CARGO) test --release --quiet -p attack --test seeded --no-run
	ulimit -v 4000000; ATTACKS=$(COUNT) $(CARGO) test --release --quiet -p attack --test seeded -- \
	    --nocapture $(patsubst %,mutated_%s,$(subst -,_,$(or $(ONLY),particle-file checkpoint)))
