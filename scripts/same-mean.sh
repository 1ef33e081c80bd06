#!/usr/bin/env bash
# Draws scenes with each estimator switched over, and tests whether the mean of the picture is that of plain path
# tracing: with bounces and one light sample at each vertex, chosen by power.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/same-mean.sh [--size WxH] [--spp N] [SCENE...]
  --size  of the pictures (96x54)
  --spp   samples per pixel (256); plain path tracing gets four times as many
  SCENE   scene files; without any, ten of scenes/
A row for each scene and estimator: the verdict of lancer compare, and the smallest bias that it would have found.
With 95 % certainty one row in twenty may differ by chance: such a row is drawn again with other random numbers.
The last line is "N same, M differ"; the exit code is 0 only if none differ.
Environment: LANCER, the program (build/release/lancer).
END
}

unset CDPATH
here=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
size=96x54 spp=256 scenes=()
while (($#)); do
    case $1 in
        --size) size=${2:?--size needs a value}; shift ;;
        --spp) spp=${2:?--spp needs a value}; shift ;;
        -h | --help) usage; exit 0 ;;
        -*) echo "same-mean.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *) scenes+=("$(cd "$here" && realpath -- "$1")") ;;
    esac
    shift
done
((${#scenes[@]})) || for name in cornell room bathroom atrium forest still_life still_life_textured materials spheres \
    environment; do scenes+=("scenes/$name.toml"); done
lancer=${LANCER:-build/release/lancer}
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT

plain=split=false,roulette=false,learned_nee=false,mis_compensation=false,mirror_nee=false,light_tree=false
# draw SCENE NAME SPP SEED SETTINGS
draw() {
    "$lancer" render "$1" -q --size "$size" -s "$3" --seed "$4" --sampler independent --filter box --aov variance \
        ${5:+--set "$5"} -o "$folder/$2.exr" >/dev/null 2>&1
}
verdict() { "$lancer" compare "$folder/it.exr" "$folder/plain.exr" | sed -n 's/^verdict: //p'; }

same=0 differ=0
for scene in "${scenes[@]}"; do
    draw "$scene" plain $((4 * spp)) 1 "$plain"
    # The default, and each estimator alone beside plain path tracing.
    for estimator in default split roulette learned_nee mis_compensation mirror_nee light_tree; do
        settings=''
        [[ $estimator == default ]] || settings=${plain/$estimator=false/$estimator=true}
        draw "$scene" it "$spp" 2 "$settings"
        said=$(verdict)
        if [[ $said == differ* ]]; then draw "$scene" it "$spp" 3 "$settings"; said="$(verdict), at a second look"; fi
        if [[ $said == differ* ]]; then differ=$((differ + 1)); else same=$((same + 1)); fi
        printf '%-22s %-17s %s\n' "$(basename "$scene" .toml)" "$estimator" "$said"
    done
done
echo "$same same, $differ differ"
((differ == 0))
