#!/usr/bin/env bash
# Penetration of the adhesive in a segmented stack, without any simulation:
# metrics, map over the bond plane and depth profile, in one pass over the stack.
#
#   measure-an-experiment.sh STACK.tif "1.45 um" OUT_FOLDER
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
stack=$1 voxel=$2 out=$3
mkdir -p "$out"

xct2particles "$stack" --voxel "$voxel" -o - |
    wp-metrics - --map "$out/map.csv" --profile "$out/depth.csv" -o "$out/wp.csv"

bond-figures map --map "experiment=$out/map.csv" -o "$out/map.svg"
cat "$out/wp.csv"
