#!/usr/bin/env bash
# Whether other programs read what the tools write: Python, R and Octave the particle file, VTK, tifffile and
# ImageJ what is exported. A program that is not installed is said; one that reads something else ends this
# with 1.
#
#   check.sh FOLDER_OF_TOOLS OUT_FOLDER
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
readers=$(cd "$here/../../readers" && pwd)
export PATH=$(cd "$1" && pwd):$PATH
rm -rf "$2"
mkdir -p "$2"
cd "$2" || exit 1

set -e
synth-xct -q --adhesive pf --size 24x48x24 --slab 11.6um --seed 3 -o specimen.tif
xct2particles -q specimen.tif -o specimen.mpts
build-bondline -q specimen.mpts -o bond.mpts
mpm-run -q "$here/../cases/pf-implicit.toml" --particles bond.mpts --set output.snapshots=0 --threads 1 -o run
cp run/final.mpts final.mpts
for format in tiff vti vtp npz; do particles export -q -f $format final.mpts -o "final.$format"; done
wp-metrics -q final.mpts specimen.mpts | awk -F, '$2 == "total" { print $10 }' >volumes.txt
set +e

failed=0
outcome() { # name, status, log
    case $2 in
    0) echo "$1: agrees" ;;
    77) echo "$1: skipped: not installed" ;;
    *)
        echo "$1: differs or fails, see $PWD/$3"
        failed=1
        ;;
    esac
}
check() { # name, program it needs, command...
    local name=$1 program=$2 log
    shift 2
    log=${name// /-}.log
    if ! command -v "$program" >/dev/null; then
        outcome "$name" 77
    else
        "$@" >"$log" 2>&1
        outcome "$name" $? "$log"
    fi
}
with() { python3 -c "import $1" 2>/dev/null || return 77; shift; "$@"; }
installed() {
    python3 -c "import numpy" 2>/dev/null || return 77
    # From a copy: pip leaves its builds where it finds the source.
    cp -r "$readers/python" source
    python3 -m pip install -q --no-deps --target site ./source || return 1
}

check "pip install" python3 installed
export PYTHONPATH=$PWD/site PYTHONDONTWRITEBYTECODE=1
[ -d site ] || PYTHONPATH=$readers/python
check "Python reader" python3 with numpy python3 "$here/check.py" particles
check "notebook" python3 with numpy python3 "$here/check.py" notebook "$readers/python/example.ipynb"
check "tifffile" python3 with tifffile python3 "$here/check.py" tiff
check "VTK" python3 with vtk python3 "$here/check.py" vtk
# Both print the sums of check.py, which has written its own.
check "R reader" Rscript bash -c "Rscript '$here/sums.R' '$readers/mpts.R' final.mpts | diff - sums.txt"
check "Octave reader" octave bash -c "octave -qf '$here/sums.m' '$readers' final.mpts | diff - sums.txt"
# Without a display ImageJ runs macros only as Fiji starts it.
for imagej in fiji-linux-x64 ImageJ-linux64 fiji; do command -v $imagej >/dev/null && break; done
check "ImageJ of Fiji" $imagej bash -c "$imagej --headless -macro '$here/size.ijm' '$PWD/final.tiff' | grep -Fx -f size.txt"
exit $failed
