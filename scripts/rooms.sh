#!/usr/bin/env bash
# Writes the scenes of bench/studies/rooms.toml and six.toml that stand outside this repository, each under two skies:
# LANCER_SHARED names the folder that holds scenes/sponza, scenes/country-kitchen and scenes/env (../shared).
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/rooms.sh
Writes build/rooms/{sponza,kitchen}-{sun,studio}.toml and what they need.
END
}

if (($#)); then
    case $1 in
        -h | --help) usage; exit 0 ;;
        *) echo "rooms.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    esac
fi
unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
shared=${LANCER_SHARED:-../shared}/scenes
for folder in sponza country-kitchen env; do
    if [[ ! -d $shared/$folder ]]; then
        echo "rooms.sh: error: no folder '$shared/$folder'; set LANCER_SHARED to the folder that holds scenes/$folder" >&2
        exit 66
    fi
done

out=build/rooms
mkdir -p "$out"
cp -f "$shared"/env/{kloppenheim,studio_small}_05_1k.hdr "$out"
for name in sponza country-kitchen; do
    mkdir -p "$out/$name"
    cp -rf --no-preserve=mode "$shared/$name"/*.mtl "$shared/$name/textures" "$out/$name"
    [[ -s $out/$name/$name.obj ]] || xz -dc "$shared/$name/$name.obj.xz" >"$out/$name/$name.obj"
done

# scene NAME LIGHT SKY SCALE MESH CAMERA: SCALE makes the mean of the picture about 0.3, since relative errors with
# their 0.01 would take dark pictures for exact.
scene() {
    cat >"$out/$1-$2.toml" <<END
version = 1
[render]
filter = "box"
max_depth = 8
size = [256, 144]
[camera]
$6
[[mesh]]
file = "$5/$5.obj"
[[light]]
type = "environment"
file = "$3_05_1k.hdr"
scale = $4
END
}
camera='position = [-2, 10, -35]
target = [-2, 18, 30]
fov = 75'
scene sponza sun kloppenheim 8 sponza "$camera"
scene sponza studio studio_small 300 sponza "$camera"
camera='position = [1.211, 1.805, 3.852]
target = [0.773, 1.763, 2.954]
fov = 60'
scene kitchen sun kloppenheim 30 country-kitchen "$camera"
scene kitchen studio studio_small 300 country-kitchen "$camera"
