#!/usr/bin/env bash
# Whether a target is what its command makes of its inputs, by their content and not their age; and how it is made.
#
#   made.sh stale TARGET COMMAND OUTPUTS INPUT...    says "stale" where it is not, "kept" where that was found not sound
#   made.sh make TARGET COMMAND OUTPUTS INPUT...     makes it
#
# An INPUT is a file or a folder of files; OUTPUTS are what COMMAND writes beside TARGET. The record of what a target was
# made of is .made/TARGET beside it: the command, and a line for each file with its checksum, how it looked and its name.
# There is none of a target that is not there. A file that looks as it did is not read again. What a particle file says it was made of counts too: data beside a header.
# COMMAND may use $HOW, options of mpm-run that change nothing of a result.
set -euo pipefail
export LC_ALL=C
mode=$1 target=$2 command=${3//[$'\n\t']/ } outputs=$4
shift 4
record=${target%/*}/.made/${target##*/}

# state RECORD: a line for each file that standard input names and that exists. One that was changed within the last two
# seconds may change again and look the same.
state() {
    local format=(-c $'%Z\t%i %s %y %z\t%n')
    [[ $OSTYPE == linux* ]] || format=(-f $'%c\t%i %z %Fm %Fc\t%N')
    sort -u | tr '\n' '\0' | { xargs -0 stat -L "${format[@]}" 2>/dev/null || true; } |
        awk -F '\t' -v OFS='\t' -v now="${EPOCHSECONDS:-$(date +%s)}" -v quote="'" '
            FILENAME != "-" { sum[$2, $3] = $1; next }
            now - $1 < 2 { $2 = "new" }
            $2 == "new" || !(($2, $3) in sum) {
                name = $3
                gsub(quote, quote "\\" quote quote, name)
                read = "cksum <" quote name quote
                read | getline sum[$2, $3]
                close(read)
            }
            { print sum[$2, $3], $2, $3 }' "$1" -
}

files() {
    local input
    for input; do
        if [ -d "$input" ]; then find -L "$input" -maxdepth 1 -type f; else printf '%s\n' "$input"; fi
    done
}

# What a particle file says it was made of by the tool that wrote it.
told() {
    [[ $target != *.mpts ]] || "$BIN/particles" info "$target" | awk '/^made by/ { files = "" }
        sub(/^  from +/, "") && sub(/ \(xxh3 [0-9a-f]+\)$/, "") { files = files $0 "\n" }
        END { printf "%s", files }'
}

content() { cut -f 1,3; }

# Whether the target is what the record says.
is_made() {
    [[ $known != /dev/null && -e $target && ${text%%$'\n'*} = "$command" ]] || return 1
    local now
    now=$({ files "$@"; cut -f 3 <<<"$lines"; } | state "$known")
    [ "$now" != "$lines" ] || return 0
    [ "$(content <<<"$now")" = "$(content <<<"$lines")" ] || return 1
    keep "$now" 2>/dev/null || true
}

# Whether the target, though of other inputs, is still the one of the record.
is_old() {
    [ -e "$target" ] && content <<<"$lines" | grep -qxF "$(state "$known" <<<"$target" | content)"
}

keep() { printf '%s\n' "$command" "$1" >"$record.$$" && mv "$record.$$" "$record"; }

# Whether the same was begun before and has not come to its end.
is_begun() {
    before=$(files "$@" | state "$known")
    begun=$(printf '%s\n' "$command"; content <<<"$before")
    [ -f "$record.begun" ] && [ "$begun" = "$(<"$record.begun")" ] && ! is_old
}

known=/dev/null text='' lines=''
if [ -f "$record" ]; then known=$record text=$(<"$record") lines=${text#*$'\n'}; fi
if [ "$mode" = stale ]; then
    is_made "$@" || { [ -e "$record.begun" ] && [ -e "$target" ] && is_begun "$@" && echo kept; } || echo stale
    exit
fi

mkdir -p "${record%/*}"
HOW="--threads ${RUN_THREADS:-1}${YES:+ --yes-really}"
# A run goes on where it was left; one that has ended not sound says so again, and stays.
if is_begun "$@"; then HOW+=" --resume"; fi
printf '%s\n' "$begun" >"$record.begun.$$" && mv "$record.begun.$$" "$record.begun"
[ -z "${V:-}" ] || printf '%s\n' "$command"
# Behind a pipe tools write lines and no bars, of which several would be on one terminal.
{ HOW=$HOW bash -euo pipefail -c "$command" 2>&1 >&3 | (trap '' INT TERM HUP; exec cat >&2); } 3>&1
if [ "$(files "$@" | state <(printf '\n%s\n' "$before") | content)" != "$(content <<<"$before")" ]; then
    echo "$target: what it is made of changed meanwhile; make it again" >&2
    exit 1
fi
lines=$({ files "$@"; told; printf '%s\n' "$target" $outputs; } | state <(printf '%s\n' "$before"))
# A make that is interrupted removes its target.
for output in "$target" $outputs; do
    [[ $lines$'\n' == *$'\t'"$output"$'\n'* ]] || { echo "$output was removed meanwhile; make it again" >&2; exit 1; }
done
keep "$lines"
rm -f "$record.begun"
