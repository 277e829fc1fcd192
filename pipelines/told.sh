#!/usr/bin/env bash
# Runs a command as a group of processes that is told what this process is told: told.sh COMMAND...
# make hands SIGTERM to its own children alone, and a shell that ends by it leaves what it has started at work.
set -m
"$@" <&0 &
group=$! signalled=
# How a job ended is not told a second time.
exec 2>/dev/null
for signal in INT TERM HUP QUIT USR1 USR2 XCPU; do trap "signalled=yes; kill -$signal -- -$group" $signal; done
# SIGCONT has no trap of its own: bash loses a signal that comes with it.
trap 'kill -STOP -- -$group; kill -STOP $$; kill -CONT -- -$group' TSTP
# What reads this sees the pipe close without a line where this process is killed.
exec 8> >(set -m; { read -r || kill -KILL -- -$group; } <&0 &)
while wait $group; status=$?; kill -0 $group; do :; done
# A run writes its checkpoint within five seconds.
for ((i = 0; i < 60; i++)); do
    [ -n "$signalled" ] && kill -0 -- -$group || break
    sleep 0.1
done
echo >&8
exit $status
