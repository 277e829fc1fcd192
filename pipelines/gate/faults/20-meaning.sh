# Stacks and specimens that mean something else than they seem to.
labels='--voxel 1.45um --labels void=0,wood=1,adhesive=2'
colours='--voxel 1.45um --labels void=0:0:0,wood=139:90:43,adhesive=255:165:0'
# counts ARGUMENTS: void, wood and adhesive voxels in a line, or the sentence of a refusal.
counts() {
    echo "xct2particles $* -o o.mpts 2>log || { s=\$?; tail -n 1 log; exit \$s; }
        awk '/^(void|wood|adhesive) /{printf \"%s \", \$2} /missing/{printf \"(gap) \"} END{print \"\"}' log"
}
refused='a refusal that names two slices (2 or 3)'
fault "palettes in another order, PNG" "$refused" "$(counts '$IN/files/pal-png' $labels)"
fault "palettes in another order, TIFF" "$refused" "$(counts '$IN/files/pal-tif' $labels)"
fault "palettes as Pillow's quantize makes them" "$refused" "$(counts '$IN/files/pal-auto' $labels)"
fault "palettes in another order, PNG, by colour" "228 466 146 (0)" "$(counts '$IN/files/pal-png' $colours)"
fault "palettes in another order, TIFF, by colour" "228 466 146 (0)" "$(counts '$IN/files/pal-tif' $colours)"
fault "MinIsWhite in some slices" "$refused" \
    "$(counts '$IN/files/mixed-photometric' --voxel 1.45um --labels void=0,wood=1)"
fault "MinIsWhite in some slices, by colour" "228 612 0 (0)" \
    "$(counts '$IN/files/mixed-photometric' --voxel 1.45um --labels void=0:0:0,wood=255:255:255)"
for threads in 1 4; do
    fault "interlaced PNG of 1 bit, $threads threads" "5758 5762 0 (0)" \
        "$(counts '$IN/files/interlaced-1bit' --voxel 1.45um --labels void=0,wood=1 --threads $threads)"
done
fault "STK, six planes behind one directory" "228 466 146 (0), or a refusal (3)" "$(counts '$IN/files/stk-6-planes.stk' $labels)"
fault "tifffile's older shape" "228 466 146 (0)" "$(counts '$IN/files/tifffile-old-shape.tif' $labels)"
fault "one plane told of, six there" "a refusal (3)" \
    "sed 's/shape=(6, 10, 14)/shape=(1, 10, 14)/' \$IN/files/tifffile-old-shape.tif >a.tif; $(counts a.tif $labels)"
six='i=0; mkdir s; for f in $IN/files/conflicted-copy/s_00[0-5].tif; do cp "$f" s/s_00$i.tif; i=$((i+1)); done'
fault "links that lead nowhere (git-annex)" "$refused" "$six; ln -sf none s/s_004.tif; $(counts s $labels)"
fault "a copy among the slices" "$refused" "$(counts '$IN/files/conflicted-copy' $labels)"
fault "a preview of the same size" "$refused" "$(counts '$IN/files/spr-preview' $labels)"
fault "two series" "$refused" "$six; for i in 0 1 2; do cp s/s_00\$i.tif s/t_00\$i.tif; done; $(counts s $labels)"
fault "each slice by two endings" "$refused" "$six; for i in 0 1 2 3 4 5; do cp s/s_00\$i.tif s/s_00\$i.tiff; done; $(counts s $labels)"
# order NAMES: whether six slices with these names, in this order, make the file that they make with their own.
order() {
    echo "$six; xct2particles s $labels -q -o right.mpts; mkdir t; i=0
        for n in $*; do cp s/s_00\$i.tif t/\$n.tif; i=\$((i+1)); done
        xct2particles t $labels -q -o found.mpts || exit
        [ \"\$(particles sum right.mpts | cut -c 1-16)\" = \"\$(particles sum found.mpts | cut -c 1-16)\" ] && echo right || echo wrong"
}
fault "negative numbers" "right (0)" "$(order z-2 z-1 z0 z1 z2 z3)"
fault "decimal numbers" "right (0)" "$(order z-0.5 z-0.25 z0 z0.25 z0.5 z0.75)"
fault "unevenly padded numbers" "right (0)" "$(order s8 s09 s010 s0011 s12 s013)"
fault "a bond along x measured across y" "a refusal that names x (2)" 'wp-metrics $IN/files/bond-along-x.tif --voxel 1.45um'
fault "a bond along x built across y" "a refusal that names x (2)" \
    'xct2particles $IN/files/bond-along-x.tif --voxel 1.45um -q -o s.mpts && build-bondline s.mpts -o b.mpts'
fault "a bond along x measured across x" "13.148270 (0)" \
    'wp-metrics $IN/files/bond-along-x.tif --voxel 1.45um --normal x 2>/dev/null | tail -n 1 | cut -d , -f 5'
fault "a plane through the wood" "a warning (0)" \
    'wp-metrics $IN/files/bond-along-x.tif --voxel 1.45um --normal x --reference plane=20um 2>&1 >/dev/null | grep parts'
