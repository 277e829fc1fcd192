#!/usr/bin/env bash
# Inputs that were once read wrongly, by this build and by an older one: a row of a table for each.
#   faults.sh BIN [OLDER_BIN] [ONLY...]
# Each file of faults/ holds rows `fault NAME RIGHT COMMAND`: COMMAND is bash, run in an empty folder with the tools
# on PATH and the inputs in $IN; the last line that it prints is shown with its exit status. Without ../shared/data
# there are no inputs, and the table is left out with a sentence.
set -u
here=$(cd "$(dirname "$0")" && pwd)
new=$(cd "$1" && pwd)
old=${2:+$(cd "$2" && pwd)}
shift $(($# < 2 ? $# : 2))
IN=$(cd "$here/../../../shared/data/repro" 2>/dev/null && pwd) || {
    echo "left out: the inputs of ../shared/data/repro are absent"
    exit 0
}
export IN
TOP=$(cd "$here/../.." && pwd)
export TOP

# shown BIN COMMAND: the last line and the exit status of COMMAND with the tools of BIN.
shown() {
    local folder status
    folder=$(mktemp -d)
    (cd "$folder" && BIN=$1 PATH="$1:$PATH" timeout 600 bash -c "$2") >"$folder.out" 2>&1
    status=$?
    tail -n 1 "$folder.out" | cut -c 1-160 | tr '|' '/' | sed "s| *$| ($status)|"
    rm -rf "$folder" "$folder.out"
}

fault() {
    echo "| $1 | $2 | ${old:+$(shown "$old" "$3") | }$(shown "$new" "$3") |"
}

echo "| case | right | ${old:+before | }now |"
echo "|---|---|---|${old:+---|}"
for file in "$here"/faults/*.sh; do
    case " ${*:-$(basename "$file" .sh)} " in
    *" $(basename "$file" .sh) "*) . "$file" ;;
    esac
done
