# Files that were replaced, lost or locked, and pipes that were taken for files.
PRESSED='synth-xct -q --adhesive pf --size 24x64x24 --seed 1 -o s.tif; xct2particles -q s.tif -o s.mpts 2>/dev/null; build-bondline -q s.mpts -o b.mpts 2>/dev/null; cp $BIN/../../pipelines/cases/pf-implicit.toml c.toml; mpm-run -q c.toml --particles b.mpts --set "clamp.stop=4 us" -o r 2>/dev/null'
PLANNED='printf "particles,clamp.stop\nb.mpts,4 us\n" >t.csv; bond-sweep plan -q t.csv --case c.toml -o s; bond-sweep run -q s $(cat s/runs.txt) 2>/dev/null'
KEPT='kept() { local was=$(cksum <"$1"); shift; "$@" >/dev/null 2>&1; echo "exit $?, $([ "$was" = "$(cksum <"$file")" ] && echo kept || echo replaced)"; }; file'
CLONE='cp -r $BIN/../../Makefile $BIN/../../pipelines $BIN/../../Cargo.toml .; mkdir target; ln -s $BIN target/release'
QUICK='make -s CARGO=true XCT_PF=s.tif ERROR=no OUT=o'

for file in final.mpts history.csv summary.json resolved.toml bondline-run.toml; do
    fault "wp-metrics --series r -o r/$file" "exit 2, kept" "$PRESSED; $KEPT=r/$file; kept \$file wp-metrics --series r -o \$file"
done
fault "wp-metrics --profile r/final.mpts" "exit 2, kept" "$PRESSED; $KEPT=r/final.mpts; kept \$file wp-metrics r/snapshots/0001.mpts -o w.csv --profile \$file"
for file in history.csv snapshots/0001.mpts; do
    fault "bond-report -o r/$file" "exit 2, kept" "$PRESSED; $KEPT=r/$file; kept \$file bond-report --run r -o \$file"
done
fault "bond-sweep collect -o t.csv, its table" "exit 2, kept" "$PRESSED; $PLANNED; $KEPT=t.csv; kept \$file bond-sweep collect s -o \$file"
fault "bond-sweep collect -o s/runs.txt" "exit 2, kept" "$PRESSED; $PLANNED; $KEPT=s/runs.txt; kept \$file bond-sweep collect s -o \$file"
fault "bond-sweep plan of another table into s" "exit 2, kept" "$PRESSED; $PLANNED; cp t.csv u.csv; echo b.mpts,5 us >>u.csv; $KEPT=s/plan.json; kept \$file bond-sweep plan u.csv --case c.toml -o s"
fault "make sweep SWEEP=out/sweep/mine.csv" "exit 2, kept" "$CLONE; mkdir -p out/sweep; $KEPT=out/sweep/mine.csv; printf 'specimen.size,clamp.stop\n24x64x24,4 us\n' >\$file; kept \$file make -s CARGO=true SWEEP=\$file sweep"
fault "bond-sweep plan with no room for a specimen" "exit status 1" "printf 'specimen.seed\n7\n' >t.csv; prlimit --fsize=4096 bond-sweep plan t.csv --case \$BIN/../../pipelines/cases/pf-implicit.toml -o s"
fault "make with a record whose target was removed" "status 0" "$CLONE; $PRESSED; $QUICK RUNS=implicit o/pf/bond.mpts >/dev/null 2>&1; rm o/pf/bond.mpts; sed -i '2,\${/bond.mpts\$/d}' o/pf/.made/bond.mpts; $QUICK RUNS=implicit o/pf/bond.mpts >/dev/null 2>&1; s=\$?; ls o/pf/bond.mpts; exit \$s"
fault "make, told to end by SIGTERM" "0 runs at work" "$CLONE; $PRESSED; $QUICK RUNS=flip SET='clamp.closing_speed=1 mm/s' YES=1 runs >/dev/null 2>&1 & until [ -e o/pf/flip/history.csv ]; do sleep 0.2; done; kill -TERM \$!; wait; sleep 6; left=; for p in /proc/[0-9]*; do [[ \$p/cwd -ef . && \$(readlink \$p/exe) == */mpm-run ]] && left+=\" \${p#/proc/}\"; done; [ -z \"\$left\" ] || kill -KILL \$left; wc -w <<<\"\$left\" | sed 's/\$/ runs at work/'"
fault "make install PREFIX='pre fix' DESTDIR=stage" "mpm-run 0.1.0" "make -s -C \$BIN/../.. CARGO=true BUILT=1 install DESTDIR=\$PWD/stage PREFIX='/x/pre fix' 2>&1 | tail -n 1; 'stage/x/pre fix/bin/mpm-run' --version"
fault "mpm-run - <case" "exit status 0" "$PRESSED; mpm-run -q - --particles b.mpts --set 'clamp.stop=4 us' -o p <c.toml"
fault "bond-sweep plan - <table" "exit status 0" "$PRESSED; $PLANNED; bond-sweep plan -q - --case c.toml -o p <t.csv; cmp s/runs.txt p/runs.txt"
fault "bond-report --table t=- <table" "exit status 0" "$PRESSED; wp-metrics r/final.mpts -o w.csv; bond-report -q --table t=- -o p.html <w.csv"
