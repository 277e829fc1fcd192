#!/usr/bin/env bash
# mutants.sh COUNT CRATE...: does a test fail when the code is changed? COUNT changes of each
# crate, always the same ones: the sample is by a hash of the change without its line number.
# A second call goes on where the first stopped and tries the survivors again.
set -euo pipefail
cd "$(dirname "$0")/../.."

count=$1
shift
out=out/mutants
table=$out/mutants.csv
least=95 # percent
mkdir -p "$out"
seed() { yes bondline; }

if ! cargo mutants --version >/dev/null 2>&1; then
    echo "mutants: cargo-mutants is needed (cargo install --locked cargo-mutants)" >&2
    exit 2
fi

# The names of the sample, one a line.
sample() {
    cargo mutants --list --colors never --package "$1" |
        sed -E 's/^([^:]+):([0-9]+):([0-9]+): (.*)$/\1: \4\t\2:\3/' |
        LC_ALL=C sort -t $'\t' -k1,1R -k2,2V --random-source=<(seed) |
        sed -n "1,${count}p" |
        sed -E 's/^([^:]+): (.*)\t([0-9:]+)$/\1:\3: \2/'
}

# Names of the sample in the files: the code, and with it the sample, may have changed since.
of_sample() { cat "${@:2}" 2>/dev/null | sort -u | grep -cFxf "$out/$1.sample" || true; }

failed=0
for crate in "$@"; do
    sample "$crate" >"$out/$crate.sample"
    arguments=()
    while IFS= read -r name; do
        arguments+=(--re "^$(sed 's/[][\.*^$+?(){}|]/\\&/g' <<<"$name")\$")
    done <"$out/$crate.sample"
    # Exit status 2 and 3 are survivors and timeouts, which the table tells.
    status=0
    CARGO_TARGET_DIR=${MUTANTS_TARGET:-$PWD/target} nice cargo mutants --package "$crate" \
        --profile mutants --jobs 1 --timeout 120 --build-timeout 600 --no-times --colors never \
        --iterate --output "$out/$crate" "${arguments[@]}" || status=$?
    [ "$status" -le 3 ] || exit "$status"
    o=$out/$crate/mutants.out
    # cargo-mutants puts what did not compile among the previously caught.
    cat "$o/unviable.txt" >>"$out/$crate.unviable"
    unviable=$(of_sample "$crate" "$out/$crate.unviable")
    caught=$(($(of_sample "$crate" "$o/caught.txt" "$o/previously_caught.txt" "$out/$crate.unviable") - unviable))
    timeouts=$(of_sample "$crate" "$o/timeout.txt")
    missed=$(of_sample "$crate" "$o/missed.txt")
    size=$(sort -u "$out/$crate.sample" | wc -l)
    if [ $((caught + timeouts + missed)) -lt $((size * 3 / 4)) ]; then
        echo "mutants: $crate stopped early; the next call goes on" >&2
        exit 1
    fi
    share=$(awk "BEGIN { printf \"%.1f\", 100 * ($caught + $timeouts) / ($caught + $timeouts + $missed) }")
    [ -f "$table" ] || echo "date,commit,crate,sample,caught,timeouts,missed,unviable,caught_percent" >"$table"
    echo "$(date -I),$(git log -1 --format=%h -- lib tools),$crate,$size,$caught,$timeouts,$missed,$unviable,$share" | tee -a "$table"
    awk "BEGIN { exit !($share < $least) }" && failed=1
done
exit "$failed"
