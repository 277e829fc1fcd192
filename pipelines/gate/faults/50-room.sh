# Presses whose adhesive has no room in the wood, or that were cut short.

crop='xct2particles $IN/turn4/crop.tif --voxel 1.45um --labels void=0,wood=128,adhesive=255 -q -o s.mpts'
case='$TOP/pipelines/cases/pf-implicit.toml'
short="$case --particles \$IN/turn4/presses/p40.mpts --set clamp.max_pressure='0.3 MPa' --set clamp.time_limit"
table='wp-metrics r/final.mpts --pressure -o r/wp.csv && bond-figures table2 --run pf:implicit=r/wp.csv -o t.csv'
last='{ tail -n 2 | grep -o -e "at least.*" -e "changes nothing" -e "--set \"[^\"]*\"" || echo nothing; }'
for scheme in implicit explicit; do
    set="--set integrator.scheme=$scheme --explain 2>/dev/null | grep -e 'gap will remain' || echo nothing"
    fault "the plan of a crop that cannot close, $scheme" "24.5 um" "$crop; build-bondline s.mpts -q -o b.mpts 2>/dev/null; mpm-run $case --particles b.mpts $set"
done
fault "the bond of it" "24.5 um" "$crop; build-bondline s.mpts -o b.mpts 2>&1 | $last"
fault "the advice on its run" "changes nothing" "$crop; build-bondline s.mpts -q -o b.mpts; mpm-run $case --particles b.mpts -q -o r; $table | $last"
fault "make of it, without YES=1" "not started (2)" "make -s -C \$BIN/../.. CARGO=true ERROR=no OUT=\$PWD/o XCT_PF=\$IN/turn4/crop.tif VOXEL=1.45um table2 </dev/null 2>&1 | grep -o 'not started' && exit 2"
fault "the advice on a press cut short at 5 us" "closes at 37.6 us: 70 us" "mpm-run $short='5 us' -q -o r; $table | $last"
fault "the share that has entered" "0.150, 1.47 um deep" "mpm-run $short='5 us' -q -o r; wp-metrics r/final.mpts | tail -n 1 | awk -F, '{ printf \"%.3f, %.2f um deep\\n\", \$12, \$13 }'"
