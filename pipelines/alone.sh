#!/usr/bin/env bash
# Runs a command that works in a folder when no other one does: alone.sh FOLDER COMMAND...
# The lock is the system's and ends with its last holder, also a run that outlives a killed make. Without flock (macOS) there
# is none: there a second run into a folder is refused by mpm-run itself.
set -eu
folder=$1
shift
mkdir -p "$folder"
exec 9>"$folder/.lock"

# The makes and tools that have the lock open, this one and others that wait apart.
holders() {
    local fd pid line
    for fd in /proc/[0-9]*/fd/9; do
        pid=${fd#/proc/} pid=${pid%/fd/9}
        [[ $fd -ef $folder/.lock ]] && line=$(tr '\0' ' ' <"/proc/$pid/cmdline") || continue
        case $line in make\ * | */make\ * | "$BIN"/*) echo "  process $pid: ${line:0:150}" ;; esac
    done 2>/dev/null
}

if command -v flock >/dev/null && ! flock -n 9; then
    { echo "waiting for what is at work in $folder, until it ends or is ended:"; holders; } >&2
    until flock -n 9; do sleep 0.5; done
fi
exec "$@"
