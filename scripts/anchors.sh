#!/usr/bin/env bash
# Renders the two anchor scenes and compares each with its two independent references, by other renderers.
# The scenes stand outside this repository: LANCER_SHARED names the folder that holds scenes/anchors.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/anchors.sh [--spp N] [--scenes-only] [-- OPTION...]
  --spp N        samples per pixel (1024)
  --scenes-only  writes the scenes and renders nothing
  OPTION...      more options of `lancer render`
Writes scenes and pictures into build/anchors/ and prints, for each, the squared error against the two references
(unbiased: the references' own noise averages out) and the ratios of the means.
END
}

spp=1024 scenes_only=
while (($#)); do
    case $1 in
        --spp) spp=${2:?--spp needs a number}; shift 2 ;;
        --scenes-only) scenes_only=yes; shift ;;
        -h | --help) usage; exit 0 ;;
        --) shift; break ;;
        *) echo "anchors.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    esac
done

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
anchors=${LANCER_SHARED:-../shared}/scenes/anchors
if [[ ! -d $anchors ]]; then
    echo "anchors.sh: error: no folder '$anchors'; set LANCER_SHARED to the folder that holds scenes/anchors" >&2
    exit 66
fi
if [[ -z $scenes_only && ! -x build/release/lancer ]]; then
    echo "anchors.sh: error: build/release/lancer is missing; run: cmake --preset release && cmake --build --preset release" >&2
    exit 1
fi

out=build/anchors
mkdir -p "$out"
cp -f "$anchors"/*.obj "$anchors"/*.mtl "$out"
[[ -s $out/statues.obj ]] || xz -dc "$anchors/statues.obj.xz" >"$out/statues.obj"

cat >"$out/cornell.toml" <<'END'
version = 1
[render]
filter = "box"
max_depth = 8
size = [256, 256]
[camera]
position = [2.78, 2.73, -8]
target = [2.78, 2.73, 0]
fov = 39.3077
[[mesh]]
file = "cornell.obj"
END
cat >"$out/statues.toml" <<'END'
version = 1
[render]
filter = "box"
max_depth = 6
size = [256, 192]
[camera]
position = [0, 2.6, 7]
target = [0, 0.85, 0]
fov = 38
[[mesh]]
file = "statues.obj"
[[light]]
type = "environment"
radiance = 0.4
END

[[ -z $scenes_only ]] || exit 0
for scene in cornell statues; do
    echo "== $scene, $spp spp"
    build/release/lancer render "$out/$scene.toml" --spp "$spp" -o "$out/$scene.exr" -o "$out/$scene.png" --stats "$out/$scene.json" "$@"
    build/release/lancer compare "$out/$scene.exr" "$anchors/refs/${scene}_cycles_1024.exr" "$anchors/refs/${scene}_tungsten_1024.exr"
done
