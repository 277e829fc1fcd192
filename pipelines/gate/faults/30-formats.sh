known='--labels void=0,wood=1,adhesive=2 -o s.mpts'
for name in res-72.009dpi.tif res-px-per-um-as-inch.tif nifti-default-1mm.nii.gz; do
    fault "$name states no size of a voxel" "give --voxel (2)" "cp \$IN/files/$name . && xct2particles $name $known"
done
fault "ImageJ's zunit" "1.45 um (0)" "xct2particles \$IN/files/imagej-zunit-mm.tif $known 2>&1 | grep -m 1 -e 'voxel edge' -e 'a voxel is'"
fault "--voxel '1.45 mm'" "is the unit right? (2)" "xct2particles \$IN/files/make-stale-a.tif --voxel 1.45mm $known"
known='--voxel 1.45um --labels void=0,wood=1,adhesive=2 -o s.mpts'
counts='grep -o -e "wood.*voxels" -e "^xct2.*"'
for name in sitk-int64.mha headersize-minus1.mhd ascii.mhd py2-long-shape.npy; do
    fault "$name" "wood 466 voxels (0)" "xct2particles \$IN/files/$name $known 2>&1 | $counts"
done
fault "a list of raw files" "wood 466 voxels (0)" 'cp $IN/files/hm.raw . && tail -c 840 hm.raw | split -a 1 -d -b 140 - p
    printf "NDims = 3\nDimSize = 14 10 6\nElementType = MET_UCHAR\nElementDataFile = p%%d 0 5 1\n" >a.mhd; '"xct2particles a.mhd $known 2>&1 | $counts"
fault "NRRD by bzip2" "wood 466 voxels (0)" '{ printf "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 14 10 6\nencoding: bzip2\n\n"; tail -c 840 $IN/files/hm.raw | bzip2; } >a.nrrd; '"xct2particles a.nrrd $known 2>&1 | $counts"
fault "NRRD as text" "wood 466 voxels (0)" '{ printf "NRRD0004\ntype: ushort\ndimension: 3\nsizes: 14 10 6\nencoding: ascii\n\n"; cat $IN/files/asc.raw; } >a.nrrd; '"xct2particles a.nrrd $known 2>&1 | $counts"
fault "a PNG of no bytes" "s00.png is empty (3)" "cp -r \$IN/files/zero-byte-first-png a && xct2particles a $known"
fault "TMPDIR that does not exist" "names TMPDIR (3)" "cp \$IN/files/nifti-default-1mm.nii.gz a.nii.gz && TMPDIR=/none xct2particles a.nii.gz $known"
fault "STK" "wood 466 voxels (0)" "xct2particles \$IN/files/stk-6-planes.stk $known 2>&1 | $counts"
fault "OME-TIFF of six files, by its folder" "wood 466 voxels (0)" "xct2particles \$IN/files/ome-multifile $known 2>&1 | $counts"
fault "OME-TIFF of six files, by one" "wood 466 voxels (0)" "xct2particles \$IN/files/ome-multifile/w_Z3.ome.tif $known 2>&1 | $counts"
fault "tiles that were left out" "3840, 255 and 1 voxels (0)" 'xct2particles $IN/files/sparse-tiles.tif --voxel 1.45um --histogram g.csv && cat g.csv | paste -sd " "'
fault "a mask of 0 and 255" "says so, and --labels void=0,wood=255 (2)" 'printf "NDims = 3\nDimSize = 2 2 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n\377\0\377\0" >a.mha; xct2particles a.mha --voxel 1.45um -o s.mpts'
fault "NaN among float labels" "the voxel, and that labels are whole numbers (2)" 'printf "NDims = 3\nDimSize = 2 1 1\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n\0\0\0\0\0\0\300\177" >a.mha; xct2particles a.mha --voxel 1.45um --labels void=0,wood=1 -o s.mpts'
fault "0.1 as a label" "labels are whole numbers (2)" "xct2particles \$IN/files/make-stale-a.tif --voxel 1.45um --labels void=0,wood=0.1,adhesive=2 -o s.mpts 2>&1 | head -1; exit 2"
for name in otsu-clean.tif otsu-one-zinger.tif; do
    fault "$name by --grey auto" "wood 466 voxels, or 465 beside the zinger (0)" "xct2particles \$IN/files/$name --voxel 1.45um --grey auto -o s.mpts 2>&1 | $counts"
done
acer='$TOP/pipelines/examples/acer/bondline-acer-64x192x128.tif --voxel 1.45um'
fault "wood and void exchanged" "they look exchanged (2)" "xct2particles $acer --labels void=128,wood=0,adhesive=255 -o s.mpts"
bond='$IN/turn4/crop.tif --voxel 1.45um'
fault "words of exchanged labels at a crop near a thick bond line" "0 (1)" "xct2particles $bond --labels void=0,wood=128,adhesive=255 -o s.mpts 2>&1 | grep -c exchanged"
fault "the same, wood and void exchanged" "they look exchanged (2)" "xct2particles $bond --labels void=128,wood=0,adhesive=255 -o s.mpts"
fault "the same, wood and adhesive exchanged" "a warning (0)" "xct2particles $bond --labels void=0,wood=255,adhesive=128 -o s.mpts 2>&1 | grep -e exchanged -e 'bond area' | head -1"
corners='for (i = 0; i < 70 * 70 * 8; i++) printf "%c", (i + 1) % 70 % 14 < 4 && (int(i / 70) + 1) % 70 % 14 < 4 ? 2 : 1'
fault "thin walls of which corners are left" "no word of exchanged phases (0)" "LC_ALL=C awk 'BEGIN { $corners }' >a.raw; xct2particles a.raw --dims 70x70x8 --type u8 --voxel 1um --labels void=1,wood=2 -o s.mpts"
# Void, wood and adhesive of means 60, 130, 200, and noise with a deviation of 20.
noisy='for (i = 0; i < 96000; i++) { y = int(i / 40) % 60; v = y >= 26 && y < 34 ? 200 : y % 38 >= 8 && y % 38 < 14 ? 60 : 130
    for (k = 0; k < 12; k++) v += 20 * (rand() - 0.5); printf("%c", v < 1 ? 1 : (v > 255 ? 255 : int(v))) }'
for more in "" " --denoise"; do
    fault "noise of 29 % of the contrast$more" "EP of 16 um in its interval (0)" "LC_ALL=C awk 'BEGIN { $noisy }' >a.raw; xct2particles a.raw --dims 40x60x40 --type u8 --voxel 2um --grey auto$more -o s.mpts 2>&1 | grep -e 'in doubt' -e '^adhesive' -e error | sed 's/.*\(in doubt\).*\(EP\)/\1: \2/' | head -1"
done
fault "a preview alone" "a PNG (0)" "xct2particles $acer --preview look.png 2>/dev/null; head -c 4 look.png | tail -c 3"
fault "one voxel of noise, --despeckle 1" "1 voxels of adhesive (0)" '{ printf "NDims = 3\nDimSize = 9 9 9\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"; head -c 400 /dev/zero | tr "\0" "\1"; printf "\2"; head -c 328 /dev/zero; } >a.mha; xct2particles a.mha --voxel 1.45um --labels void=0,wood=1,adhesive=2 --despeckle 1 -o s.mpts 2>&1 | grep -o -e "[0-9]* voxels of adhesive" -e "error.*"'
fault "32-bit BMP" "wood 1 voxels (0)" '{ printf "BM\76\0\0\0\0\0\0\0\66\0\0\0\50\0\0\0\2\0\0\0\1\0\0\0\1\0\40\0\0\0\0\0"; head -c 20 /dev/zero; printf "\0\0\0\377\1\1\1\377"; } >a.bmp; xct2particles a.bmp --voxel 1.45um --labels void=0:0:0,wood=1:1:1 -o s.mpts 2>&1 | '"$counts"
