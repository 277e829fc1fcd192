#!/usr/bin/env bash
# How deep does a thinner or thicker adhesive go? One specimen, several viscosities; the plan
# of each run is printed first, the table at the end.
#
#   sweep-viscosity.sh BOND.mpts CASE.toml OUT_FOLDER "100 cP" "1300 cP" "10000 cP"
set -euo pipefail
[ $# -ge 4 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
bond=$1 case=$2 out=$3
shift 3
mkdir -p "$out"

for viscosity in "$@"; do
    run="$out/${viscosity// /}"
    mpm-run "$case" --particles "$bond" --set "adhesive.viscosity=$viscosity" --explain > "$run.plan"
    mpm-run "$case" --particles "$bond" --set "adhesive.viscosity=$viscosity" -o "$run" --resume
done

first=1
for viscosity in "$@"; do
    run="$out/${viscosity// /}"
    wp-metrics "$run/final.mpts" | awk -v eta="$viscosity" -v first=$first \
        'NR == 1 && first { print "viscosity," $0 } NR > 1 { print eta "," $0 }'
    first=0
done > "$out/sweep.csv"
cat "$out/sweep.csv"
