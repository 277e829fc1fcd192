fault "a sound stack" "exit 0" 'xct2particles $IN/files/make-stale-a.tif --voxel "1.45 um" -o s.mpts'
