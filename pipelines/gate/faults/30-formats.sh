known='--labels void=0,wood=1,adhesive=2 -o s.mpts'
for name in res-72.009dpi.tif res-px-per-um-as-inch.tif nifti-default-1mm.nii.gz; do
    fault "$name states no size of a voxel" "give --voxel (2)" "xct2particles \$IN/files/$name $known"
done
fault "ImageJ's zunit" "1.45 um (0)" "xct2particles \$IN/files/imagej-zunit-mm.tif $known 2>&1 | grep -m 1 -e 'voxel edge' -e 'a voxel is'"
fault "--voxel '1.45 mm'" "a warning (0)" "xct2particles \$IN/files/make-stale-a.tif --voxel 1.45mm $known 2>&1 | grep -e 'unit right'"
