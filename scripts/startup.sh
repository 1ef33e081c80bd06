#!/usr/bin/env bash
# From the start of the program to its first ray: of shipped scenes without pictures, and of large meshes, of which it
# tells how much of the reading of their pictures is hidden behind that of the mesh. About a minute on two cores.
set -euo pipefail

usage() {
    cat <<'END2'
usage: scripts/startup.sh [-n RUNS] [MESH.obj...]
  -n RUNS   of each, taking turns (9)
  MESH.obj  instead of sponza and country-kitchen from the folder that LANCER_SHARED names, else ../shared
Prints milliseconds on the clock, of two threads: the least and the median of all runs. For meshes:
  whole     to the first ray
  mesh      the same, one pixel in place of each picture
  pictures  what a mesh of one triangle of each material takes longer with its pictures than with pixels
  hidden    mesh + pictures - whole
Environment: LANCER, the program (build/release/lancer).
END2
}

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
runs=9 meshes=()
while (($#)); do
    case $1 in
        -n) runs=${2:?-n needs a number}; shift ;;
        -h | --help) usage; exit 0 ;;
        -*) echo "startup.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *) meshes+=("$(cd -- "$started_in" && realpath -m -- "$1")") ;;
    esac
    shift
done
lancer=${LANCER:-build/release/lancer}
[[ -x $lancer ]] || { echo "startup.sh: error: $lancer is missing: cmake --build --preset release" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# first_ray NAME SCENE: a line of NAME, milliseconds until the program says how it draws, which it does before its first
# ray, its peak memory in MB, and whether it loaded the OpenImageIO module.
first_ray() {
    local line start=${EPOCHREALTIME/[.,]/} end='' module=opened
    while IFS= read -r line; do
        [[ $line != *'unused features:'* ]] || end=${EPOCHREALTIME/[.,]/}
        [[ $line != *'OpenImageIO module, not loaded'* ]] || module='not loaded'
    done < <("$lancer" render "$2" --size 16x9 -s 1 -t 2 -v -o "$folder/x.exr" --stats "$folder/x.json" 2>&1 >/dev/null)
    [[ $end ]] || { echo "startup.sh: error: $lancer cannot draw $2" >&2; exit 1; }
    awk -v name="$1" -v us=$((end - start)) -v module="$module" -v OFS='\t' -F'[:, ]+' '
        /"peak_bytes"/ { print name, us / 1000, $3 / 1e6, module }' "$folder/x.json"
}

# take_turns NAME SCENE [NAME SCENE]...: into FOLDER/times, after a round to warm up.
take_turns() {
    local run i
    for ((run = 0; run <= runs; ++run)); do
        ((run != 1)) || : >"$folder/times"
        for ((i = 1; i < $#; i += 2)); do first_ray "${@:i:2}" >>"$folder/times"; done
    done
}

# least_and_median TERM...: of the sums, run by run, of the times of these names; those after a minus are taken away.
least_and_median() {
    awk -F'\t' -v terms="$*" '
        BEGIN { n = split(terms, name, " "); for (i = 1; i <= n; ++i) sign[i] = sub(/^-/, "", name[i]) ? -1 : 1 }
        { for (i = 1; i <= n; ++i) if ($1 == name[i]) sum[++seen[i]] += sign[i] * $2 }
        END { for (r = 1; r <= seen[1]; ++r) print sum[r] }' "$folder/times" | sort -g |
        awk '{ x[NR] = $1 } END { printf "%8.1f %8.1f", x[1], (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2 }'
}

# with_a_pixel FILE.mtl: every picture replaced by pixel.tga, so that the mesh keeps what pictures need of it.
with_a_pixel() { sed -E 's/^([[:space:]]*(map_[a-z]*|bump|norm|disp|decal|refl))[[:space:]].*/\1 pixel.tga/I' "$1"; }

# one_of_each MESH: a triangle of each of its materials.
one_of_each() {
    printf '%s\n' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'vt 0 0' 'vt 1 0' 'vt 0 1'
    grep '^usemtl' "$1" | sort -u | sed 's,$,\nf 1/1 2/2 3/3,'
}

untextured=(cornell spheres shell still_life seed-a/start)
turns=()
for scene in "${untextured[@]}"; do turns+=("$scene" "scenes/$scene.toml"); done
take_turns "${turns[@]}"
echo "scene            least   median  peak MB  OpenImageIO"
for scene in "${untextured[@]}"; do
    printf '%-14s%s' "$scene" "$(least_and_median "$scene")"
    awk -F'\t' -v name="$scene" '$1 == name { line = sprintf(" %8.1f  %s", $3, $4) } END { print line }' "$folder/times"
done

shared=${LANCER_SHARED:-../shared}/scenes
if ((${#meshes[@]} == 0)) && [[ -d $shared ]]; then
    for name in sponza country-kitchen; do
        [[ -f $shared/$name/$name.obj.xz ]] || continue
        cp -r "$shared/$name" "$folder/$name"
        chmod -R u+w "$folder/$name"
        xz -d "$folder/$name/$name.obj.xz"
        meshes+=("$folder/$name/$name.obj")
    done
fi
((${#meshes[@]})) || exit 0
echo
echo "mesh                whole            mesh          pictures          hidden"
for mesh in "${meshes[@]}"; do
    name=$(basename "$mesh" .obj) work=$folder/work
    cp -r -L "$(dirname "$mesh")" "$work"
    chmod -R u+w "$work"
    library=$(sed -n 's/^mtllib *//p' "$mesh" | tr -d '\r' | head -n 1)
    with_a_pixel "$work/$library" >"$work/plain.mtl"
    # An uncompressed Targa file of true colour, 1 x 1: its header of 18 bytes and one BGR pixel.
    printf '\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\30\0\200\200\200' >"$work/pixel.tga"
    sed 's/^mtllib.*/mtllib plain.mtl/' "$mesh" >"$work/plain.obj"
    { echo "mtllib $library"; one_of_each "$mesh"; } >"$work/few.obj"
    sed 's/^mtllib.*/mtllib plain.mtl/' "$work/few.obj" >"$work/few-plain.obj"
    take_turns whole "$work/$name.obj" mesh "$work/plain.obj" few "$work/few.obj" few-plain "$work/few-plain.obj"
    printf '%-15s%s%s%s%s\n' "$name" "$(least_and_median whole)" "$(least_and_median mesh)" \
        "$(least_and_median few -few-plain)" "$(least_and_median mesh few -few-plain -whole)"
    rm -rf "$work"
done
