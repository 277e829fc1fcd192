#!/usr/bin/env bash
# pins.sh BIN OUT: fingerprints of small runs of both schemes with every option, by the tools in
# BIN, one line each: name, exit status, sum of the final state, hash of the history. A change
# that only moves code leaves every line as it is. ONLY=word runs those whose names contain it.
set -euo pipefail
bin=$(cd "$1" && pwd)
out=$2
here=$(cd "$(dirname "$0")" && pwd)
export RAYON_NUM_THREADS=1
mkdir -p "$out"
bond=$out/bond.mpts
if [ ! -f "$bond" ]; then
    "$bin/synth-xct" --quiet --adhesive pf --size 24x56x24 --slab "14.5 um" --voxel "1.45 um" --seed 1 -o - |
        "$bin/xct2particles" --quiet - --voxel "1.45 um" -o - | "$bin/build-bondline" --quiet - -o "$bond"
fi

# pin NAME CASE [KEY=VALUE ...]
pin() {
    local name=$1 case=$2 status=0 arguments=()
    shift 2
    [[ $name == *${ONLY:-}* ]] || return 0
    local run=$out/$name
    rm -rf "$run"
    [[ $case == wood-* ]] && arguments+=(--particles "$bond")
    for set in "$@"; do arguments+=(--set "$set"); done
    "$bin/mpm-run" --quiet "$here/pins/$case.toml" "${arguments[@]}" -o "$run" 2>"$run.err" || status=$?
    # A case that is refused pins nothing.
    [ $status != 2 ] || { cat "$run.err" >&2; exit 1; }
    local sum=-
    [ -f "$run/final.mpts" ] && sum=$("$bin/particles" sum "$run/final.mpts" | cut -d' ' -f1)
    echo "$name $status $sum $(sha256sum "$run/history.csv" 2>/dev/null | cut -c1-16)"
}

explicit() { pin "explicit-$1" "wood-explicit" "${@:2}"; }
implicit() { pin "implicit-$1" "wood-implicit" "${@:2}"; }

slip=(contact.law=partial-slip contact.influence_length="0.01 cell")
newton=adhesive.viscosity="1300 cP"
table=adhesive.viscosity_table='[["1 1/s","210000 cP"],["39.8107 1/s","1700 cP"],["501.187 1/s","1000 cP"]]'
update=integrator.velocity_update

explicit xpic5 "$newton" "${slip[@]}" $update=xpic integrator.order=5
explicit flip "$newton" "${slip[@]}" $update=flip
explicit pic "$newton" "${slip[@]}" $update=pic
explicit apic "$newton" "${slip[@]}" $update=apic
explicit fmpm2 "$newton" "${slip[@]}" $update=fmpm integrator.order=2
explicit linear "$newton" "${slip[@]}" $update=flip grid.shape=linear clamp.stop="1.4 us"
explicit bspline "$newton" "${slip[@]}" $update=xpic integrator.order=5 grid.shape=bspline2
explicit frictionless "$newton" contact.law=frictionless $update=flip
explicit stick "$newton" contact.law=stick $update=xpic integrator.order=3
explicit cell-mean "$newton" "${slip[@]}" $update=xpic integrator.order=5 integrator.pressure=cell-mean
explicit density "$newton" "${slip[@]}" $update=flip integrator.density_projection="0.04 cell"
explicit separation "$newton" "${slip[@]}" contact.separation="0.4 cell" $update=flip
explicit table "$table" "${slip[@]}" $update=flip
explicit load "$newton" "${slip[@]}" $update=flip clamp.max_pressure="0.02 MPa"
pin explicit-channel channel $update=xpic integrator.order=5 integrator.scheme=explicit
pin explicit-apic-channel channel $update=apic integrator.scheme=explicit
pin explicit-drop drop $update=flip integrator.scheme=explicit
pin explicit-slit slit $update=flip integrator.scheme=explicit stop.time="6 us"

implicit closed "$newton" "${slip[@]}" clamp.stop=closed
implicit frictionless "$newton" contact.law=frictionless
implicit stick "$newton" contact.law=stick
implicit cfl1 "$newton" "${slip[@]}" integrator.cfl=1.0
implicit tolerance "$newton" "${slip[@]}" integrator.tolerance=1e-7
implicit table "$table" "${slip[@]}"
implicit rheometer "$table" "${slip[@]}" adhesive.shear_rate=rheometer
implicit load "$newton" "${slip[@]}" clamp.max_pressure="0.1 MPa" clamp.stop=closed
implicit cavitation "$newton" "${slip[@]}" adhesive.cavitation_pressure="0.01 MPa"
pin implicit-channel channel
pin implicit-drop drop
pin implicit-slit slit
