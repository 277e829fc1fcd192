# Figures and tables of something else than what they seem to be of.
T='$IN/turn4'
known='-q --voxel "1 um" --labels void=0,wood=1,adhesive=2'
grey='-q --voxel "1.45 um" --labels void=0,wood=128,adhesive=255'
# Runs r1 and r2 of two stacks, by the implicit scheme.
RUNS="for s in a b; do xct2particles \$IN/files/make-stale-\$s.tif --voxel '1.45 um' -q -o s\$s.mpts; build-bondline -q s\$s.mpts -o b\$s.mpts; done
    press() { mpm-run \$TOP/pipelines/cases/pf-implicit.toml --particles b\$1.mpts -q --overwrite -o \$2; }; press a r1"
SWEEP='printf "row,clamp.closing_speed_m_s,status,wp_um,pressure_pa,time_s\n1,1e-6,sound,5,2.5e6,30\n2,1e-3,sound,6,2.5e6,3e-2\n3,1,sound,7,2e6,1.45e-5\n" >t.csv'

fault "speeds of 1 um/s to 1 m/s on an axis" "10⁻⁶ (0)" "$SWEEP; bond-figures response t.csv -o r.svg -q; grep -o -m 1 '10⁻⁶' r.svg"
fault "a pressure at its limit" "the three strokes of one bar (0)" "$SWEEP; bond-figures response t.csv --result pressure_pa -o r.svg -q; grep -o 'stroke-width=.11' r.svg | wc -l"
fault "two parameters of a sweep" "two lines in the key (0)" "printf 'row,mu_Pa_s,v_m_s,status,wp_um\n1,1,1,sound,5\n2,2,1,sound,6\n3,1,2,sound,7\n4,2,2,sound,8\n' >t.csv; bond-figures response t.csv -o r.svg -q; grep -c '^mu (Pa s) [12]' r.svg"
for table in "map:wp-metrics -q r1/final.mpts -o - --map r1/t.csv >/dev/null:--map" \
    "shear:shear-stats -q r1/final.mpts -o r1/t.csv:" \
    "penetration:wp-metrics -q --series r1 -o r1/t.csv:"; do
    IFS=: read -r figure make option <<<"$table"
    fault "bond-figures $figure of a run that was made again" "run wp-metrics or shear-stats again (3)" "$RUNS; $make; press b r1; bond-figures $figure $option r1/t.csv -o f.svg"
done
fault "bond-report of a run that was made again" "run wp-metrics again (3)" "$RUNS; wp-metrics -q r1/final.mpts -o r1/wp.csv; press b r1; bond-report --run r1 -o r.html"
fault "states of two runs in a series" "of another run (2)" "$RUNS; press b r2; wp-metrics -q --series r1 r2"
fault "shear rates of two runs" "of another run (2)" "$RUNS; press b r2; shear-stats r1/final.mpts r2/final.mpts"
fault "a .pvd of two runs" "of another run (2)" "$RUNS; press b r2; particles export r1/final.mpts r2/final.mpts -o a.pvd"
fault "shear rates of a state given twice" "one row (0)" "$RUNS; shear-stats r1/final.mpts r1/final.mpts | tail -n +2 | wc -l"
fault "--compare of a specimen of another shape" "16 and 20 columns (2)" "for f in sym bigger; do xct2particles $T/\$f.npy $known -o \$f.mpts; done; wp-metrics sym.mpts --compare bigger.mpts"
along="xct2particles $T/normal-x.npy $grey -o nx.mpts; build-bondline -q nx.mpts --normal x -o bx.mpts"
fault "--normal y of a bond across x" "leave out --normal (2)" "$along; wp-metrics bx.mpts --normal y"
fault "--compare of a bond across x" "Dice of a slab, 0 (0)" "$along; wp-metrics bx.mpts --compare nx.mpts | tail -n 1 | cut -d , -f 2,5,12"
for case in "cell15.npy:--periodic:9.60e-12, 0.800" "cell30.npy:--periodic:9.60e-12, 0.800" "s1_3.npy::2.78e-14, 0.333"; do
    IFS=: read -r file sides right <<<"$case"
    fault "permeability of $file" "$right (0)" "wp-metrics $T/$file --voxel '1 um' --labels void=0,wood=1 --permeability z $sides | tail -n 1 | cut -d , -f 3,5"
done
fault "porosity of solid wood" "0.000000 (0)" "printf 'NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n\1\1\1\1\1\1\1\1' >a.mha; wp-metrics a.mha --voxel 1um --labels void=0,wood=1 --permeability z | tail -n 1 | cut -d , -f 5"
fault "Chinese text in a PNG" "a warning that names it (0)" "$SWEEP; mv t.csv 木.csv; printf 'file,diameter_um,volume_fraction,up_to_fraction\na,1,0.5,0.5\na,2,0.5,1\n' >p.csv; bond-figures pores 木=p.csv -o p.png"
fault "a folder with A.MPTS" "2 files (0)" "mkdir f; for n in a.mpts B.MPTS; do xct2particles $T/normal-x.npy $grey -o f/\$n; done; wp-metrics -q f --normal x | grep -c total"
fault "two runs of one label" "two labels (0)" "mkdir a b; for f in a b; do printf 'time_s,closing_speed_m_s,pressure_top_Pa\n1e-6,1,1e6\n2e-6,1,2e6\n' >\$f/h.csv; done; bond-figures pressure --run F=a/h.csv --run F=b/h.csv -q -o p.svg; grep -c '^F (./h.csv)' p.svg"
