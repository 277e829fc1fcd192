#!/usr/bin/env bash
# Runs a command that works in a folder when no other one does: alone.sh FOLDER COMMAND...
# The lock is the system's and ends with its last holder, also a run that outlives a killed make. Without flock (macOS) there
# is none: there a second run into a folder is refused by mpm-run itself.
set -eu
folder=$1
shift
mkdir -p "$folder"
exec 9>"$folder/.lock"
if command -v flock >/dev/null && ! flock -n 9; then
    echo "waiting for what is at work in $folder" >&2
    flock 9
fi
exec "$@"
