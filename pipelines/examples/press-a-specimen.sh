#!/usr/bin/env bash
# From a stack to a pressed bond line and its comparison with the experiment in that stack.
#
#   press-a-specimen.sh STACK.tif "1.45 um" CASE.toml OUT_FOLDER [more arguments of mpm-run]
set -euo pipefail
[ $# -ge 4 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
stack=$1 voxel=$2 case=$3 out=$4
shift 4
mkdir -p "$out"

xct2particles "$stack" --voxel "$voxel" -o "$out/experiment.mpts"
build-bondline "$out/experiment.mpts" -o - |
    mpm-run "$case" --particles - -o "$out/run" --overwrite "$@"

wp-metrics "$out/run/final.mpts" --compare "$out/experiment.mpts" -o "$out/wp.csv"
shear-stats "$out"/run/snapshots/*.mpts "$out/run/final.mpts" -o "$out/shear.csv"
bond-figures pressure --run "run=$out/run" -o "$out/pressure.svg"
bond-figures slice "$out/run/final.mpts" -o "$out/final.png"
cat "$out/wp.csv"
