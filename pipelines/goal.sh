#!/usr/bin/env bash
# Makes a goal of the pipeline: the bonds of the runs that it needs, then the plan of these runs, and, where they take no
# more than an hour and can close, or YES is set, all of it.
#
#   goal.sh GOAL MAKE...
# The terminal, where it asks, is its own; makes of runs are told of signals (told.sh).
set -euo pipefail
export LC_ALL=C
goal=$1
shift

# The command lines of runs to be made.
runs() { "$@" -n "$goal" | { grep "^$BIN/mpm-run " || true; } | sort -u; }

# The forecast of each, and a last line if there should be a yes.
plan() {
    local line
    export HOW="--threads $RUN_THREADS"
    while IFS= read -r line; do
        echo "run ${line##* -o }"
        eval "${line/--overwrite/--explain}"
    done | awk -v jobs="$AT_ONCE" '
        BEGIN {
            seconds["s"] = 1; seconds["min"] = 60; seconds["h"] = 3600; seconds["days"] = 86400
            bytes["kB"] = 1e3; bytes["MB"] = 1e6; bytes["GB"] = 1e9
        }
        function size(b) { return b < 1e9 ? sprintf("%.0f MB", b / 1e6) : sprintf("%.1f GB", b / 1e9) }
        function told(t) {
            return t < 120 ? sprintf("%.0f s", t) : t < 7200 ? sprintf("%.0f min", t / 60) : sprintf("%.1f h", t / 3600)
        }
        $1 == "run" && NF == 2 { run = $2 }
        $1 == "memory" { memory = $2 * bytes[$3]; if (memory > most) most = memory }
        $1 == "refused" { refused = $0 }
        $1 == "voids" && /gap will remain/ { stuck[run] = substr($0, match($0, /room/)) }
        $1 == "run" && $2 == "time" {
            time = $3 * seconds[$4]
            printf "  %-44s %9s %11s\n", run, told(time), size(memory)
            if (run in stuck) { print "    " stuck[run]; never = "a press without room for its adhesive never closes: take more wood on both sides of the bond line" }
            n++; all += time
            if (time > longest) longest = time
        }
        END {
            if (all / jobs > longest) longest = all / jobs
            printf "%d run%s, %d at a time: about %s, up to %s each\n", n, (n > 1 ? "s" : ""), jobs, told(longest), size(most)
            if (refused) print refused
            if (never) print never
            if (refused || never || longest > 3600) print "ask"
        }'
}

bonds=$(runs "$@" | sed -n 's/.* --particles \([^ ]*\) .*/\1/p' | sort -u)
if [ -n "$bonds" ]; then
    pipelines/told.sh "$@" $bonds ${bonds//bond.mpts/voids.txt}
    todo=$(runs "$@")
    # Cores that runs leave idle are theirs.
    [ -n "${RUN_THREADS:-}" ] || RUN_THREADS=$((AT_ONCE / $(wc -l <<<"$todo")))
    export RUN_THREADS=$((RUN_THREADS > 1 ? RUN_THREADS : 1))
    said=$([ -z "$todo" ] || plan <<<"$todo")
    [ -z "$said" ] || echo "${said%$'\n'ask}"
    if [[ $said == *$'\n'ask && -z ${YES:-} ]]; then
        answer=no
        [ ! -t 1 ] || { read -r -p "Start? [y/N] " answer </dev/tty; }
        if [[ $answer != [yY]* ]]; then
            echo "not started: YES=1 starts it; less are ERROR=no, fewer RUNS, a crop of the stack" >&2
            exit 2
        fi
    fi
fi
# Before the rest: of runs that wait for it, make starts the last ones first, and the first takes longest.
case $goal in all | runs | table2 | figures | report) pipelines/told.sh "$@" first-table ;; esac
exec pipelines/told.sh "$@" "$goal"
