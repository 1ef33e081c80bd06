#!/usr/bin/env bash
# Renders every shipped scene with this build and with another build of lancer and compares all channels bit for bit.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/same-as.sh [--full] [--only WORD] OTHER_LANCER [OPTION...]
  OTHER_LANCER  the program of another commit, built on this machine by the same compiler
  OPTION...     options for that program alone, such as --set common=false
  --full        also sponza, country-kitchen and the anchor scenes of the folder that LANCER_SHARED names (../shared),
                and several of all sizes and sample counts
  --only WORD   only scenes whose path has WORD in it
Each scene is drawn by its own settings, by all integrators, with --legacy and with all AOVs. Metadata are not compared.
The last line is "N same, M differ"; the exit code is 0 only if none differ.
Environment: LANCER, this build's program (build/release/lancer).
END
}

unset CDPATH
full='' only='' other=''
while (($#)); do
    case $1 in
        --full) full=yes ;;
        --only) only=${2:?--only needs a word}; shift ;;
        -h | --help) usage; exit 0 ;;
        -*) echo "same-as.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *) other=$(realpath -- "$1"); shift; break ;;
    esac
    shift
done
options=("$@")
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
lancer=$(realpath -- "${LANCER:-build/release/lancer}")
for program in "$lancer" "$other"; do
    [[ -x $program ]] || { echo "same-as.sh: error: no program '$program'" >&2; usage >&2; exit 2; }
done
shared=${LANCER_SHARED:-../shared}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
same=0 differ=0

# compare NAME SCENE OPTION...: one picture by both programs.
compare() {
    local name=$1 scene=$2 said
    shift 2
    [[ $scene == *"$only"* ]] || return 0
    if ! "$lancer" render "$scene" -q -o "$folder/a.exr" "$@" >"$folder/log" 2>&1 ||
        ! "$other" render "$scene" -q -o "$folder/b.exr" "$@" ${options[@]+"${options[@]}"} >"$folder/log" 2>&1; then
        echo "$name: cannot be drawn: $(tail -n 1 "$folder/log")"
        differ=$((differ + 1))
        return
    fi
    said=$("$lancer" compare "$folder/a.exr" "$folder/b.exr" | grep '^differing_' | tr -s ' ' | tr '\n' ' ')
    if grep -q '^differing_pixels 0 of' <<<"$said" && ! grep -q 'differing_channels [1-9]' <<<"$said"; then
        same=$((same + 1))
    else
        differ=$((differ + 1))
        echo "$name: $said"
    fi
}

# draw SCENE: in all ways.
draw() {
    local scene=$1 integrator
    compare "$scene" "$scene" --size 96x64 -s 20
    compare "$scene, all AOVs" "$scene" --size 64x48 -s 4 --aov all
    compare "$scene, legacy" "$scene" --size 64x48 -s 4 --legacy
    for integrator in path direct whitted random-decision ao; do
        compare "$scene, $integrator" "$scene" --size 48x36 -s 4 --integrator "$integrator" --aov all
        compare "$scene, $integrator, legacy" "$scene" --size 48x36 -s 2 --integrator "$integrator" --legacy
    done
    [[ $full ]] || return 0
    compare "$scene, large" "$scene" --size 320x240 -s 16 --aov all
    compare "$scene, bvh8" "$scene" --size 96x64 -s 16 --accel bvh8
    compare "$scene, replicates" "$scene" --size 96x64 -s 32 --replicates 2
    compare "$scene, stop" "$scene" --size 96x64 -s 64 --set stop=true
}

while IFS= read -r scene; do draw "$scene"; done < <(find scenes -name '*.toml' | sort)

if [[ $full && -d $shared/scenes ]]; then
    export LANCER_SHARED=$shared
    scripts/anchors.sh --scenes-only >/dev/null
    draw build/anchors/cornell.toml
    draw build/anchors/statues.toml
    for mesh in sponza country-kitchen; do
        cp -r "$shared/scenes/$mesh" "$folder"
        [[ -s $folder/$mesh/$mesh.obj ]] || xz -dk "$folder/$mesh/$mesh.obj.xz"
        camera='position = [-2, 10, -35], target = [-2, 18, 30], fov = 75'
        [[ $mesh == sponza ]] || camera='position = [1.211, 1.805, 3.852], target = [0.773, 1.763, 2.954], fov = 60'
        cat >"$folder/$mesh/$mesh.toml" <<END
version = 1
camera = { $camera }
[[mesh]]
file = "$mesh.obj"
[[light]]
type = "environment"
radiance = [1, 1, 1]
[[light]]
type = "directional"
direction = [0.3, -1, 0.4]
irradiance = [5, 5, 4]
END
        draw "$folder/$mesh/$mesh.toml"
    done
elif [[ $full ]]; then
    echo "same-as.sh: no folder '$shared/scenes': sponza, country-kitchen and the anchor scenes are left out"
fi
echo "$same same, $differ differ"
((same > 0 && differ == 0))
