#!/usr/bin/env bash
# fuzz.sh SECONDS TARGET...: coverage-guided attacks by libFuzzer, one target after the other.
# Seeds and finds come from tests/attack, the corpus grows in out/fuzz/corpus over all calls; an
# input that made a reader panic, take 20 s or 2 GB is kept in out/fuzz/finds. Every target
# adds a line to docs/results/fuzz.csv. Ends with a failure if there was a find.
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds=$1
shift
out=$PWD/out/fuzz
table=docs/results/fuzz.csv
host=$(rustc -vV | sed -n 's/^host: //p')
# What cargo-fuzz passes to the compiler, but without a sanitizer, which needs nightly. Only with
# --target do build scripts stay without it.
coverage="-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters
    -Cllvm-args=-sanitizer-coverage-pc-table -Cllvm-args=-sanitizer-coverage-trace-compares
    --cfg fuzzing -Ccodegen-units=1 -Cdebug-assertions"

cargo run --release --quiet -p attack --example seeds -- "$out/seeds"
(cd tests/fuzz && RUSTFLAGS=$(tr -s ' \n' ' ' <<<"$coverage") cargo build --release --quiet --target "$host")
bin=$(cd tests/fuzz && pwd)/target/$host/release

# In memory where that can be: the readers read files.
TMPDIR=$(mktemp -d --tmpdir="$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
export TMPDIR RAYON_NUM_THREADS=1
trap 'rm -rf "$TMPDIR"' EXIT

commit=$(git log -1 --format=%h -- lib tools tests)$(git diff --quiet HEAD -- lib tools tests || echo "+")
machine=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1 | tr ',' ' ')
[ -f "$table" ] || echo "date,commit,machine,target,seconds,executions,edges,features,inputs_kept,peak_rss_mb,slowest_s,found" >"$table"
failed=0
for target in "$@"; do
    mkdir -p "$out/corpus/$target" "$out/finds"
    status=0
    TARGET=$target nice "$bin/fuzz" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=32768 \
        -print_final_stats=1 -artifact_prefix="$out/finds/$target-" \
        "$out/corpus/$target" "$out/seeds/$target" >"$out/$target.log" 2>&1 || status=$?
    stat() { sed -n "s/^stat::$1: *//p" "$out/$target.log" | tail -n 1; }
    last() { sed -nE "s/^#.* $1: ([0-9]+).*/\\1/p" "$out/$target.log" | tail -n 1; }
    found=no
    if [ "$status" -ne 0 ]; then
        found=$(sed -nE 's/.*(panicked at [^:]+:[0-9]+).*/\1/p; s/.*ERROR: libFuzzer: ([a-z-]+).*/\1/p' "$out/$target.log" | head -n 1 | sed "s|$PWD/||")
        found=${found:-exit $status}
        failed=1
        echo "$target: $found; the input is $(sed -nE 's/.*Test unit written to (.*)/\1/p' "$out/$target.log" | tail -n 1)"
    fi
    echo "$(date -I),$commit,$machine,$target,$seconds,$(stat number_of_executed_units),$(last cov),$(last ft),$(find "$out/corpus/$target" -type f | wc -l),$(stat peak_rss_mb),$(stat slowest_unit_time_sec),$found" | tee -a "$table"
done
exit "$failed"
