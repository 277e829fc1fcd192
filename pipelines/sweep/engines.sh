#!/usr/bin/env bash
# One small sweep by every engine that is installed here: its runs and the engine itself are killed on the
# way, three times, and started again. Says which engines were found, and whether the table of each is that
# of the sweep in one piece, byte for byte; ends with 1 where one is not.
#
#   engines.sh FOLDER_OF_TOOLS OUT_FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export PATH=$(cd "$1" && pwd):$PATH
rm -rf "$2"
mkdir -p "$2"
out=$(cd "$2" && pwd)
case=$here/../cases/pf-implicit.toml
jobs=$(nproc)

# 24 rows. The case has 2.5 MPa itself, so rows that leave the pressure empty are runs of others: 16 runs.
{
    echo "adhesive.viscosity,clamp.max_pressure,specimen.seed,integrator.cfl"
    for viscosity in "500 cP" "1300 cP" "5000 cP" "20 Pa s"; do
        for pressure in "1 MPa" "2.5 MPa" ""; do
            for seed in 1 2; do echo "$viscosity,$pressure,$seed,0.25"; done
        done
    done
} >"$out/table.csv"

planned() { bond-sweep plan -q "$out/table.csv" --case "$case" -o "$out/$1"; }
collected() { bond-sweep collect "$out/$1" -o "$out/$1.csv" --cost "$out/$1-cost.csv"; }
# Processes of ours that run a run of this sweep.
runs_of() { pgrep -f "^([^ ]*/)?bond-sweep run (--threads 1 )?$out/$1 " || true; }
# Sends a signal to those that standard input names, and counts them.
signal() { # signal, engine
    local pid
    while read -r pid; do kill -"$1" "$pid" 2>/dev/null && echo "$1 $pid" >>"$out/$2.signals"; done || true
}

by_xargs() { xargs -P "$jobs" -I{} bond-sweep run --threads 1 "$1" {} <"$1/runs.txt"; }
by_parallel() { parallel -j "$jobs" --will-cite bond-sweep run --threads 1 "$1" {} <"$1/runs.txt"; }
by_snakemake() {
    snakemake -s "$here/Snakefile" --config sweep="$1" -d "$1.snakemake" --cores "$jobs" --rerun-incomplete \
        --keep-going --nolock
}
export -f by_xargs by_parallel by_snakemake
export here jobs

# Kills the runs and then the engine, three times, and lets it come to its end.
killed_and_continued() {
    local engine=$1 round waited
    for round in 0.3 1 2; do
        setsid bash -c "by_$engine '$out/$engine'" >>"$out/$engine.log" 2>&1 &
        for waited in {1..300}; do
            [ -z "$(runs_of "$engine")" ] && kill -0 $! 2>/dev/null || break
            sleep 0.1
        done
        sleep $round
        runs_of "$engine" | signal KILL "$engine"
        kill -KILL -- -$! 2>/dev/null || true
        wait $! 2>/dev/null || true
        runs_of "$engine" | signal KILL "$engine"
    done
    "by_$engine" "$out/$engine" >>"$out/$engine.log" 2>&1 || true
}

array() {
    sbatch --parsable --array="1-$(wc -l <"$out/slurm/runs.txt")" --output="$out/slurm-%a.log" \
        "$here/slurm-array.sh" "$out/slurm"
}
ended() { while squeue -h -j "$1" 2>/dev/null | grep -q .; do sleep 1; done; }
# One run is told to stop, as at its time limit, and goes back into the queue by itself; one is killed,
# which is a task that failed: the array is started again, and does what lacks.
by_slurm() {
    local id
    id=$(array)
    until [ -n "$(runs_of slurm)" ]; do sleep 0.2; done
    sleep 1
    runs_of slurm | head -1 | signal TERM slurm
    runs_of slurm | tail -1 | signal KILL slurm
    ended "$id"
    ended "$(array)"
}

failed=0
outcome() { # engine, what was found of it
    if ! collected "$1" 2>>"$out/$1.log"; then
        echo "$1 ($2): not all rows ended, see $out/$1.log"
        failed=1
    elif cmp -s "$out/whole.csv" "$out/$1.csv"; then
        echo "$1 ($2): the same $(($(wc -l <"$out/$1.csv") - 1)) rows, byte for byte; $(wc -l <"$out/$1.signals") runs killed or stopped on the way"
    else
        echo "$1 ($2): another table, $out/$1.csv"
        failed=1
    fi
}

planned whole
by_xargs "$out/whole" >"$out/whole.log" 2>&1
collected whole
awk -F, 'NR > 1 && !seen[$2]++ { cpu += $4; if ($7 > most) most = $7; n++ }
    END { printf "in one piece: %d runs, %.0f CPU seconds, %.0f MB at most\n", n, cpu, most / 1e6 }' "$out/whole-cost.csv"

planned xargs
killed_and_continued xargs
outcome xargs "this is make sweep"
if command -v parallel >/dev/null; then
    planned parallel
    killed_and_continued parallel
    outcome parallel "$(parallel --version 2>/dev/null | head -1)"
else
    echo "GNU parallel: not installed"
fi
if command -v snakemake >/dev/null; then
    planned snakemake
    mkdir -p "$out/snakemake.snakemake"
    killed_and_continued snakemake
    outcome snakemake "Snakemake $(snakemake --version)"
else
    echo "Snakemake: not installed"
fi
if command -v sbatch >/dev/null && sinfo -h >/dev/null 2>&1; then
    planned slurm
    by_slurm >"$out/slurm.log" 2>&1
    outcome slurm "$(sinfo --version), $(sinfo -h -o %D | head -1) node"
else
    echo "Slurm: not installed, or no controller answers"
fi
exit $failed
