#!/usr/bin/env bash
# A sweep on this machine: plan, the runs side by side with one thread each, table, costs, figure.
# Killed anywhere, it goes on when it is started again.
#
#   local.sh TABLE.csv CASE.toml RESULT_COLUMN JOBS
#
# No figure where RESULT_COLUMN is empty.
set -euo pipefail
table=$1 case=$2 response=$3 jobs=$4
PATH=$PWD/target/release:$PATH
[ -n "$table" ] || { echo "make sweep: a table is needed, as in make sweep SWEEP=table.csv" >&2; exit 2; }
name=out/sweep/$(basename "$table" .csv)
mkdir -p out/sweep
for made in "$name.csv" "$name-cost.csv" "$name.svg"; do
    if [ "$table" -ef "$made" ] || [[ -e $made && ! -e $made.provenance.json ]]; then
        echo "make sweep: '$made' is no result of a sweep and would be replaced by one: move it, or give the table another name" >&2
        exit 2
    fi
done

bond-sweep plan "$table" --case "$case" -o "$name"
# What keeps a run from its end is said by itself; collect says which rows lack.
xargs -P "$jobs" -I{} bond-sweep run --threads 1 "$name" {} <"$name/runs.txt" || true
bond-sweep collect "$name" -o "$name.csv" --cost "$name-cost.csv"
echo "$name.csv, $name-cost.csv"
[ -z "$response" ] || bond-figures response "$name.csv" --result "$response" -o "$name.svg"
