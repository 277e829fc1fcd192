# `make` of the build's own checkout, on small runs: another stack, another command.
M='make -s -C $BIN/../.. CARGO=true RUNS=implicit ERROR=no OUT=$PWD/o table2'
A='$IN/files/make-stale-a.tif' B='$IN/files/make-stale-b.tif'
SAY='grep ^pf,implicit o/table2.csv'
WOOD='$BIN/synth-xct --adhesive none --size 24x64x24 --seed 503 -o w.tif -q; W="XCT_BOTTOM=$PWD/w.tif VOXEL=1.45um"'
# The Makefile and the pipelines, to be changed.
COPY='cp -r $BIN/../../Makefile $BIN/../../pipelines .; mkdir target; ln -s $BIN target/release'

fault "make, then another stack older than out" "total WP 5.58" "cp $A a.tif; cp $B b.tif; touch -d 2025-01-01 *.tif; for s in a b; do $M XCT_PF=\$PWD/\$s.tif VOXEL='1.45 um' >/dev/null; done; $SAY"
fault "make, then an older file at the stack's place (cp -p)" "total WP 5.58" "cp $A a.tif; cp $B b.tif; touch -d 2025-01-01 b.tif; for s in a b; do cp -p \$s.tif s.tif; $M XCT_PF=\$PWD/s.tif VOXEL='1.45 um' >/dev/null; done; $SAY"
fault "make, then VOXEL=0.725 um" "total WP 2.57" "for v in 1.45 0.725; do $M XCT_PF=$A VOXEL=\"\$v um\" >/dev/null; done; $SAY"
fault "make, then SLAB=23.2 um TURN=180" "total WP 11.12" "$WOOD; for s in '11.6 um' '23.2 um'; do $M \$W 'PLANE=46.4 um' \"SLAB=\$s\" TURN=180 >/dev/null; done; $SAY"
fault "make, then RUNS narrowed" "one run in Table 2" "for r in 'implicit implicit-frictionless' implicit; do $M XCT_PF=$A VOXEL='1.45 um' \"RUNS=\$r\" >/dev/null; done; grep -c '^pf,implicit' o/table2.csv"
fault "make without VOXEL of a stack of 2 um" "total WP 7.10" "$M XCT_PF=\$IN/files/make-own-voxel-2um.tif >/dev/null; $SAY"
fault "make of a run that ends not sound (kept)" "final.mpts stays" "$COPY; cp \$IN/scenes/3-make/unsound/pf-implicit.toml pipelines/cases; \$BIN/synth-xct --adhesive pf --size 24x64x24 --seed 501 -o s.tif -q; make -s CARGO=true RUNS=implicit ERROR=no XCT_PF=s.tif OUT=o table2 >/dev/null 2>&1; ls o/pf/implicit | grep final || echo removed"
fault "make of s[1].tif beside s1.tif" "the stack is s[1].tif" "cp $B 's[1].tif'; cp $A s1.tif; $M XCT_PF=\"\$PWD/s[1].tif\" VOXEL='1.45 um' >/dev/null 2>&1; $SAY"
fault "make of a stack called a:b.tif" "total WP 5.58" "cp $B a:b.tif; $M XCT_PF=\$PWD/a:b.tif VOXEL='1.45 um' >/dev/null; $SAY"
fault "make OUT='a b'" "a sentence about OUT" "make -s -C \$BIN/../.. CARGO=true OUT='a b' table2 2>&1 | head -n 1"
fault "a sweep of one row" "exit 0" "$COPY; cp \$IN/files/sweep-one-row.csv t.csv; make -s CARGO=true SWEEP=t.csv sweep"
fault "a sweep with rows of commas alone" "1 row" "$COPY; cp \$IN/files/sweep-empty-rows.csv t.csv; bond-sweep plan t.csv --case pipelines/cases/pf-implicit.toml -o s"
