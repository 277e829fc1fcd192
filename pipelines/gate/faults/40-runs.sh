# Runs: signals, write protection, checkpoints of other builds, bodies beside periodic and symmetry sides, linear systems.

scenes='$IN/scenes/4-periodic-bodies'
# A block at rest over a floor for seconds of computing.
rest="sed 's/\"4 us\"/\"100 us\"/; s/\"10 m\/s\", \"-1 m\/s\"/\"0 m\/s\", \"0 m\/s\"/' $scenes/pass-through.toml >rest.toml"
for signal in USR1 USR2 HUP XCPU; do
    fault "SIG$signal to a run" "a checkpoint (75)" "$rest; mpm-run rest.toml -q -o r & sleep 2; kill -$signal \$!; wait \$!; s=\$?; echo \$(cd r && ls | grep checkpoint); exit \$s"
done
fault "SIGHUP to a run under nohup" "goes on until SIGTERM (75)" "$rest; nohup mpm-run rest.toml -q -o r >/dev/null 2>&1 & sleep 2; kill -HUP \$!; sleep 1; kill -TERM \$!; wait \$!; s=\$?; echo; exit \$s"
fault "a write-protected output" "refused, mode 444 (1)" 'particles export $IN/bond.mpts -o a.csv; chmod 444 a.csv; particles export $IN/bond.mpts -o a.csv; s=$?; stat -c "mode %a" a.csv; exit $s'
fault "a write-protected final state" "refused, mode 444 (1)" "c=$scenes/box-middle.toml; "'mpm-run $c -q -o r; chmod 444 r/final.mpts; mpm-run $c -q -o r --overwrite; s=$?; stat -c "mode %a" r/final.mpts; exit $s'
fault "an output of mode 600 is replaced" "mode 600 (0)" 'for i in 1 2; do particles export $IN/bond.mpts -o a.csv; chmod 600 a.csv; done; particles export $IN/bond.mpts -o a.csv; stat -c "mode %a" a.csv'
if [ -n "${old:-}" ]; then
    fault "a checkpoint of an older build" "which build wrote it (3)" "$rest; timeout 2 $old/mpm-run rest.toml -q -o r; timeout 5 mpm-run rest.toml -q -o r --resume"
fi
for scheme in explicit implicit; do
    with="--set integrator.scheme=$scheme -o r"
    fault "a block through the floor, $scheme" "refused (2)" "mpm-run $scenes/pass-through.toml $with"
    # Its x velocity takes it five times over the periodic sides.
    fault "the same under a clamp, $scheme" "refused (2)" "sed 's/\[stop\]/[clamp]\nclosing_speed = \"1 um\/s\"/; s/time = /stop = /; /name = \"floor\"/i name = \"top\"\nvelocity = \"clamp\"\nbox = { min = [\"0 um\", \"10 um\", \"0 um\"], max = [\"8 um\", \"12 um\", \"1 um\"] }\n[[body]]\nmaterial = \"rigid\"' $scenes/pass-through.toml >c.toml; mpm-run c.toml $with"
    fault "a block through a mirror, $scheme" "refused (2)" "sed 's/y = \"open\"/y = \"symmetry\"/; s/\"10 m\/s\", \"-1 m\/s\"/\"10 m\/s\", \"2 m\/s\"/' $scenes/pass-through.toml >c.toml; mpm-run c.toml $with"
done
for place in middle across beyond; do
    fault "a box $place a period, implicit" "6.919 MPa (0)" "mpm-run $scenes/box-$place.toml -o r"
done
# A lid that shears 8 um of 1 Pa s at 10 m/s: 1.0e-4 W, however far it has gone.
fault "a lid that goes over five periods, explicit" "1.0e-4 W (0)" "sed 's/name = \"block\"/name = \"lid\"/; s/\"-1 m\/s\"/\"0 m\/s\"/; s/\"2 um\", \"5 um\"/\"0 um\", \"10 um\"/; s/\"4 um\", \"7 um\"/\"8 um\", \"12 um\"/; s/\"0 um\", \"9 um\"/\"0 um\", \"2 um\"/' $scenes/pass-through.toml >c.toml; mpm-run c.toml -q -o r && awk -F, 'END { printf \"%.1e W\\n\", \$10 }' r/history.csv"
fault "Newtonian liquid over a slit of one voxel" "sound (0)" 'p=$IN/turn4/presses; mpm-run $p/newt.toml --particles $p/slot1-14.5.mpts -q -o r && echo sound'
