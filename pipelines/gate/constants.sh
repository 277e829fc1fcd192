#!/usr/bin/env bash
# constants.sh [WORD...]: what half and twice each constant of docs/methods.md changes: which tests
# of its crate fail, and by how much small runs of its scheme differ. Takes constants whose
# crate/file/NAME holds a word; a second call goes on where the first stopped.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=$PWD/out/constants
tree=$out/tree
target=$out/target
bin=$PWD/target/release
results=docs/results/constants.csv
commit=$(git rev-parse --short HEAD)
machine=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1 | tr ',' ' ')
export RAYON_NUM_THREADS=1
# What the compiler must know, and layouts of which no other value works.
fixed=' (SIDE|OPEN|FAR|LANES|WINDOW|UNIT|HALO|EDGE|FIRST|STRIDE|OFFSET|COUNT|TERMS|FACES|ENTRIES|TOGETHER|NODES|BATCH|NOTHING|LOW|BLOCK|COMMON|ACROSS) |mpm.* BYTES '

# The table of docs/methods.md, a constant a line: crate, file under src, name, value.
constants() {
    awk -F ' *\\| *' '/^## 4/ { crate = "filling" } /^## 5/ { exit } /^\| \*\*`mpm`/ { crate = "mpm" }
        /^\| \*\*`saddle-point`/ { crate = "saddle-point" }
        crate && /^\| `/ { gsub("`", ""); print crate, $3, $2, $4 }' docs/methods.md | grep -vE "$fixed"
}

# A copy of the committed tree in which constants are read at run time, so that one build serves
# all: `const NAME: T = V;` becomes a function, each use of NAME its call.
make_tree() {
    local new=$out/new crate file name value kept
    rm -rf "$new"
    mkdir -p "$new" "$tree"
    git archive HEAD | tar -x -C "$new"
    while read -r crate file name value; do
        kept="static V: std::sync::OnceLock<\4> = std::sync::OnceLock::new();"
        kept+=" V.get_or_init(|| crate::tuned::of(\"$crate/$file/$name\", \5)).clone()"
        sed -i -E "s~^( *)(pub(\([a-z]+\))? )?const $name: (.*) = (.*);\$~\1\2fn $name() -> \4 { $kept }~" \
            "$new/lib/$crate/src/$file"
    done < <(constants)
    while read -r crate file name value; do
        # One that is public is used by the crates after its own, too.
        find "$new/lib/$crate/src" $([ "$name" != NEARLY ] || echo "$new/lib/filling/src") -name '*.rs' -exec sed -i -E "s|\{$name\}|$value|
            /^ *(\/\/|(pub(\(.*\))? )?use )/!s/([^/])\b$name\b(\(\))?/\1$name()/g" {} +
    done < <(constants | sort -u -k1,1 -k3,3)
    for crate in filling saddle-point mpm; do
        cp pipelines/gate/tuned.rs "$new/lib/$crate/src/"
        sed -i '0,/^mod \|^pub mod /s//mod tuned;\n&/' "$new/lib/$crate/src/lib.rs"
    done
    # Files that did not change keep their times, so that little is built anew.
    (cd "$new" && find . -type f) | while read -r file; do
        cmp -s "$new/$file" "$tree/$file" || install -D "$new/$file" "$tree/$file"
    done
    (cd "$tree" && find . -type f) | while read -r file; do
        [ -f "$new/$file" ] || rm "$tree/$file"
    done
    rm -rf "$new"
}

# The tool, and the binaries of the tests of the crates.
build() {
    local crate
    cd "$tree"
    nice cargo build --release --quiet --target-dir "$target" -p mpm-run 2>"$out/build.log" ||
        { tail -n 20 "$out/build.log" >&2; exit 1; }
    for crate in filling saddle-point mpm; do
        nice cargo test --release --no-run --target-dir "$target" -p "$crate" 2>&1 |
            tee -a "$out/build.log" | sed -n "s|.*Executable.*(\.\./|$out/|; s|)$||p" >"$out/tests-$crate"
    done
    cd - >/dev/null
}

# What is tried for a constant: half and twice, but for what has no single scale.
tries() {
    case $1 in
        */BEYOND) echo 1.000001 1.000004 ;;
        */HAT) echo 0.03125,0.9375,0.03125 0.125,0.75,0.125 ;;
        */OWN_TWICE) echo 1,1,1,1 1,4,4,1 ;;
        */WEIGHTS) echo 0.28675,1.975 1.147,1.975 0.5735,0.9875 0.5735,3.95 ;;
        */SOUND_J) echo -0.35,1 -1.4,1 -0.7,0.5 -0.7,2 ;;
        *) echo x0.5 x2 ;;
    esac
}

# Names of the tests of a crate that fail.
failing() {
    local test status
    while read -r test; do
        status=0
        (cd "$tree/lib/$1" && ulimit -t 200 && nice "$test" </dev/null) >"$out/log" 2>&1 || status=$?
        sed -n 's/^test \(.*::\)\?\(.*\) \.\.\. FAILED.*/\2/p' "$out/log"
        [ "$status" -eq 0 ] || [ "$status" -eq 101 ] || echo "status-$status-of-$(basename "${test%-*}")"
    done <"$out/tests-$1"
}

# run NAME CASE [KEY=VALUE ...]: name, exit status, sum of the final state, steps, iterations per step,
# volume, mean pressure, weighted penetration, CPU seconds.
run() {
    local name=$1 case=$2 run=$out/runs/$1 status=0 arguments=() sum=- wp=0
    shift 2
    [[ $case != wood-* ]] || arguments+=(--particles "$out/bond.mpts")
    for set in "$@"; do arguments+=(--set "$set"); done
    rm -rf "$run"
    (ulimit -t 100 && nice "$target/release/mpm-run" --quiet "pipelines/gate/pins/$case.toml" \
        "${arguments[@]}" -o "$run" 2>"$run.err") || status=$?
    mkdir -p "$run" && touch "$run/history.csv"
    if [ -f "$run/final.mpts" ]; then
        sum=$("$bin/particles" sum "$run/final.mpts" | cut -d' ' -f1)
        [[ $case != wood-* ]] || wp=$("$bin/wp-metrics" "$run/final.mpts" | awk -F, '{ s += $5 } END { print s }')
    fi
    awk -F, -v name="$name" -v status="$status" -v sum="$sum" -v wp="$wp" \
        -v cpu="$(sed -n 's/.*"cpu_s": \(.*\),/\1/p' "$run/summary.json" 2>/dev/null)" '
        NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
        { p += $column["pressure_top_Pa"]; n += $column["solver_iterations"]; steps = $1
          volume = $column["adhesive_volume_m3"] }
        END { rows = NR > 1 ? NR - 1 : 1; print name, status, sum, steps + 0, n / rows, volume + 0, p / rows, wp, cpu + 0 }
    ' "$run/history.csv"
}

slip=(contact.law=partial-slip contact.influence_length="0.01 cell")
newton=adhesive.viscosity="1300 cP"
table=adhesive.viscosity_table='[["1 1/s","210000 cP"],["39.8107 1/s","1700 cP"],["501.187 1/s","1000 cP"]]'
runs_of_filling() {
    run closed wood-implicit "$newton" "${slip[@]}" clamp.stop=closed
    run load wood-implicit "$newton" "${slip[@]}" clamp.max_pressure="0.1 MPa" clamp.stop=closed
    run table wood-implicit "$table" "${slip[@]}"
    run thin wood-implicit adhesive.viscosity="1 cP" "${slip[@]}"
    run channel channel
    run slit slit
}
runs_of_saddle-point() { runs_of_filling; }
runs_of_mpm() {
    local project=()
    [[ $CONSTANT != mpm/density/* ]] || project=(integrator.density_projection="0.04 cell")
    run wood wood-explicit "$newton" "${slip[@]}" integrator.velocity_update=flip "${project[@]}"
    run channel channel integrator.velocity_update=xpic integrator.order=5 integrator.scheme=explicit
    run slit slit integrator.velocity_update=flip integrator.scheme=explicit stop.time="6 us" "${project[@]}"
}

# compare STANDARD CHANGED: runs that differ, by how many percent in what; "bits" where by less than
# 0.05 %, and only the bits of a pressure that is rounding.
compare() {
    awk 'BEGIN { split("- - - steps iterations volume pressure penetration", what) }
        NR == FNR { standard[$1] = $0; next }
        { split(standard[$1], old); if ($3 == old[3] && $2 == old[2]) next
          said = $2 == old[2] ? "" : " exit status " $2
          for (i = 4; i <= 8 && $2 == old[2]; i++) {
              if (i == 6 ? old[i] == 0 : old[i] * old[i] < 1) continue
              change = 100 * ($i / old[i] - 1); limit = i == 6 ? 0.005 : 0.05
              if (change * change >= limit * limit) said = said sprintf(" %s %+.*f", what[i], i == 6 ? 3 : 1, change) }
          printf "%s%s%s", found++ ? "; " : "", $1, said == "" ? " bits" : said }' "$1" "$2"
}

mkdir -p "$out/runs"
[ -f "$results" ] || echo "date,commit,machine,constant,value,failing,changed,runs_cpu_s" >"$results"
make_tree
build
rm -f "$out"/standard-*
[ -f "$out/bond.mpts" ] ||
    "$bin/synth-xct" --quiet --adhesive pf --size 24x56x24 --slab "14.5 um" --voxel "1.45 um" --seed 1 -o - |
    "$bin/xct2particles" --quiet - --voxel "1.45 um" -o - | "$bin/build-bondline" --quiet - -o "$out/bond.mpts"
while read -r crate file name _; do
    key=$crate/$file/$name
    [ $# -eq 0 ] || grep -qE "$(IFS='|' && echo "$*")" <<<"$key" || continue
    group=${crate}-$(cut -d/ -f1 <<<"$file")
    [[ $group == mpm-density ]] || group=$crate
    if [ ! -f "$out/standard-$group" ]; then
        CONSTANT=$crate/$file/- "runs_of_$crate" >"$out/standard-$group"
    fi
    for value in $(tries "$key"); do
        ! grep -qF ",$commit,$machine,$key,\"$value\"," "$results" || continue
        export CONSTANT=$key=$value
        "runs_of_$crate" >"$out/changed"
        failed=$(failing "$crate" | sort -u | tr '\n' ' ')
        cpu=$(awk '{ cpu += $9 } END { print cpu }' "$out/changed")
        echo "$(date -I),$commit,$machine,$key,\"$value\",${failed% },$(compare "$out/standard-$group" "$out/changed"),$cpu" |
            tee -a "$results"
    done
done < <(constants)
