# bondline: from XCT stack to penetration metrics.
#
#   make                          the paper's six runs and their implicit counterparts on two
#                                 small synthetic specimens; ends with Table 2, figures and a report
#   make SCALE=small|medium|full  the same on larger specimens
#   make ERROR=no                 without the errors of Table 2, which take finer implicit runs
#   make PAPER=yes                the paper's values, of another specimen, below ours in Table 2
#   make RUNS="implicit flip"     only these of xpic, flip, frictionless, implicit, implicit-frictionless
#   make JOBS=2 RUN_THREADS=1     so many runs side by side, on so many threads each
#   make SET="adhesive.viscosity=500 cP clamp.max_pressure=1 MPa"   with keys of the cases changed
#   make CELL="1 voxel" SET="contact.influence_length=0.02 cell"   in cells of one voxel, with the same influence length
#   make BOND="--crop-to-fit --drop-islands"   bonds built with these options of build-bondline
#   make YES=1                    starts runs of more than an hour, or that can never close, unasked; V=1 shows commands and CSV
#   make XCT_PF=a.tif XCT_PVA_PF=b.tif [VOXEL="1.45 um"] [LABELS=void=0,wood=1,adhesive=2]
#                                 your own stacks, implicit runs alone unless RUNS says more
#   make XCT_BOTTOM=a.tif [XCT_TOP=b.tif | PLANE="139.2 um"] SLAB="55.1 um" VOXEL=... [TURN=90]
#                                 the same on undamaged wood: two stacks, or one cut at PLANE
#   make species                  four species of undamaged wood, PF and PVA-PF: their Table 2
#   make press                    a press of the acer piece with and without cure, loss of water, air, menisci
#   make sweep SWEEP=table.csv    a table of parameters, a row a run, to a table of results and a figure
#   make engines                  a small sweep by GNU parallel, Snakemake and Slurm, where installed
#   make interop                  what other programs read of the tools' files, where installed
#   make test                     formatting, clippy, all tests
#   make verify                   long studies: both schemes against closed forms
#   make tradeoff stability options   error against run time; extreme cases; explicit options
#   make load-control             the implicit clamp at its pressure limit, 400 presses
#   make steps                    errors by length of step and size of cell: bonds of seven woods, three drives
#   make experiments              squeeze flows that others measured, predicted blind; published permeabilities and lumens
#   make leave-out                what a scene pays for features it does not use
#   make crash                    runs killed at every write, continued: all end the same
#   make forge                    50 000 forged particle files and checkpoints
#   make faults                   inputs that were once read wrongly; BASE=folder: beside an older build
#   make fuzz                     coverage-guided attack on six readers, FUZZ_SECONDS (600) each
#   make mutants                  changes of the code that no test notices, MUTANTS (100) a crate
#   make deny                     advisories, licences and sources of the dependencies
#   make pins                     fingerprints of thirty small runs, to compare builds by
#   make bench                    cost per cell and step, memory; BASE=folder: beside an older build
#   make pages                    all that docs/results has from studies, of one build
#   make kernels                  speed of the explicit kernels and of the linear solver alone
#   make report                   one page for a browser with tables, figures, runs and the bond in 3D
#   make book                     the documents as one book to browse and search; needs mdbook
#   make figures                  every figure of the paper; FORMATS="svg png pdf" FIGURE_WIDTH="84 mm" FIGURE_DPI=300
#   make dist                     an archive of the tools for machines without a toolchain
#   make install PREFIX="/opt/bond line" [DESTDIR=stage]   tools, man pages and completions
#   make man clean help

# Specimens and bond files on the way are kept: they are looked at and used again.
.SECONDARY:
.SUFFIXES:
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c

SCALE ?= quick
NORMAL ?= y
CARGO ?= cargo
JOBS := $(or $(JOBS),$(shell nproc 2>/dev/null || getconf _NPROCESSORS_ONLN))
# Runs share the cores side by side, unless make was told by -j how many may.
SIDE_BY_SIDE = $(if $(filter -j%,$(MAKEFLAGS)),,-j$(JOBS))
AT_ONCE = $(or $(patsubst -j%,%,$(firstword $(filter -j%,$(MAKEFLAGS)) $(JOBS))),$(JOBS))
PREFIX ?= $(HOME)/.local
DESTDIR ?=

BIN := target/release
TOOLS := xct2particles build-bondline mpm-run wp-metrics shear-stats synth-xct bond-figures bond-report bond-sweep particles
BINARIES := $(TOOLS:%=$(BIN)/%)

OUT := out/$(if $(XCT_BOTTOM),wood,$(if $(XCT_PF)$(XCT_PVA_PF),xct,$(SCALE)))

.PHONY: all
all:

include pipelines/10-tools.mk
include pipelines/15-inputs.mk
include pipelines/16-made.mk
ifneq ($(BUILT),)
include pipelines/20-specimens.mk
include pipelines/30-runs.mk
include pipelines/40-metrics.mk
include pipelines/50-figures.mk
include pipelines/55-species.mk
include pipelines/57-report.mk
else
include pipelines/18-goals.mk
endif
include pipelines/56-press.mk
include pipelines/60-studies.mk
include pipelines/65-gate.mk
include pipelines/70-sweep.mk
include pipelines/75-interop.mk
include pipelines/80-book.mk
include pipelines/85-dist.mk

.PHONY: help
help:
	@sed -n '3,/^$$/s/^# \{0,1\}//p' $(firstword $(MAKEFILE_LIST))

.PHONY: clean
clean:
	rm -rf out
