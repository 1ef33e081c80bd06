#!/usr/bin/env bash
# bench/peers without any other renderer: what it lists, and how it refuses. $1: the program lancer.
set -euo pipefail
unset CDPATH
peers=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)/bench/peers
export LANCER=$1
python=$(python3 -c 'import sys; print(sys.executable)') || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
printf 'version = 1\n[[sphere]]\n[[light]]\ntype = "environment"\nradiance = 1\n' >"$folder/scene.toml"
cd "$folder"

# expect CODE WORDS ARGUMENT...: how the program ends and what it says, on either way.
faults=0
program=run
expect() {
    local code=0 said
    said=$(PATH=$folder/bin "$python" "$peers/$program" "${@:3}" 2>&1) || code=$?
    if [[ $code != "$1" || $said != *"$2"* ]]; then
        echo "peers: $program ${*:3}: ended with $code instead of $1, and said (not '$2'): $said" >&2
        faults=$((faults + 1))
    fi
}
expect 0 "cycles   not installed: apt-get install blender" --list
expect 0 "cycles2  not installed: set LANCER_CYCLES2 to" --list
expect 0 "embree   not installed: apt-get install embree-tools" --list
expect 0 "povray   not installed: apt-get install povray" --list
expect 0 "usage: bench/peers/run" --help
expect 2 "no PEER and SCENE"
expect 2 "unknown peer 'yafaray'" yafaray scene.toml -o a.exr --spp 4
expect 2 "unknown peer 'yafaray'" --about yafaray
expect 69 "apt-get install blender" --about cycles
printf '#!/bin/sh\necho "Blender 9.8.7"\n' >"$folder/other"
chmod +x "$folder/other"
LANCER_CYCLES="$folder/other -x" expect 0 '{"peer": "cycles", "version": "9.8.7", "seeds": true' --about cycles
LANCER_CYCLES2="$folder/other -x" expect 0 '{"peer": "cycles2", "version": "9.8.7", "seeds": true' --about cycles2
expect 69 "set LANCER_CYCLES2 to" --about cycles2
LANCER_CYCLES="$folder/none" expect 69 "no command '$folder/none'" --about cycles
expect 2 "say -o NAME.exr" cycles scene.toml --spp 4
expect 2 "say -o NAME.exr" cycles scene.toml -o a.png --spp 4
expect 2 "either --spp N or --spps" cycles scene.toml -o a.exr
expect 2 "either --spp N or --spps" cycles scene.toml -o a_%d.exr --spp 4 --spps 4,8
expect 2 "must contain %d" cycles scene.toml -o a.exr --spps 4,8
expect 2 "--spp" cycles scene.toml -o a.exr --spp 0
expect 2 "--size" cycles scene.toml -o a.exr --spp 4 --size 12
expect 2 "--threads" cycles scene.toml -o a.exr --spp 4 --threads many
expect 66 "no scene 'none.toml'" cycles none.toml -o a.exr --spp 4
expect 69 "apt-get install blender" cycles scene.toml -o a.exr --spp 4
expect 69 "apt-get install embree-tools" embree scene.toml -o a.exr --spp 4
expect 69 "apt-get install povray" povray scene.toml -o a.exr --spp 4

# A command of that name is taken for the peer; what is wrong is then said before it is started.
ln -s "$(type -P false)" "$folder/bin/pathtracer"
expect 0 '"seeds": false, "squares": false}' --about embree
expect 65 "Embree's path tracer cannot render spheres" embree scene.toml -o a.exr --spp 4
printf 'version = 1\n[[sphere]]\nmaterial = "bronze"\n[[light]]\ntype = "environment"\nradiance = 1\n' >"$folder/more.toml"
expect 65 "which an exported scene cannot say" embree more.toml -o a.exr --spp 4
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/mesh.obj"
printf 'version = 1\n[[mesh]]\nfile = "mesh.obj"\n[[light]]\ntype = "environment"\nradiance = 1\n' >"$folder/mesh.toml"
expect 65 "another seed than 0" embree mesh.toml -o a.exr --spp 4 --seed 1
expect 1 "pathtracer ended with 1" embree mesh.toml -o a.exr --spp 4
LANCER=$folder/none expect 66 "no program" embree scene.toml -o a.exr --spp 4

program=anchors
expect 0 "usage: bench/peers/anchors" --help
expect 2 "unknown peer 'yafaray'" yafaray
expect 2 "--seeds" --seeds 1
expect 2 "--error" --error 2
expect 2 "--scene" --scene room
expect 69 "apt-get install blender"
LANCER=$folder/none expect 66 "no program"
program=materials
expect 0 "usage: bench/peers/materials" --help
expect 0 "glass_thin_tinted" --list
expect 2 "unknown scene 'sand'" sand
expect 2 "--seeds: at least 2" --seeds 1
LANCER=$folder/none expect 66 "no program"
expect 69 "apt-get install blender" --out "$folder/materials" lambert
# Each of its scenes can be said to a peer.
for scene in "$folder"/materials/*.toml; do
    "$LANCER" export "$scene" -o "$folder/exported" || faults=$((faults + 1))
done
program=run
expect 65 "cannot render textures" embree "$folder/materials/plastic_texture.toml" -o a.exr --spp 4

# chroot, as far as it needs no root.
for words in "" "make" "run /srv" "burn /srv true"; do
    code=0
    # shellcheck disable=SC2086
    "$peers/chroot" $words >/dev/null 2>&1 || code=$?
    [[ $code == 2 ]] || { echo "peers: chroot $words: ended with $code instead of 2" >&2; faults=$((faults + 1)); }
done

program=baked
expect 0 "usage: bench/peers/baked" --help
expect 2 "unrecognized arguments: sphere" sphere
expect 69 "apt-get install blender" --out "$folder/baked"

# A grid of two triangles, read by lancer alone where there is nothing else.
program=loaders
expect 0 "usage: bench/peers/loaders" --help
expect 2 "--turns" --turns none
expect 2 "unrecognized arguments: mesh.obj" mesh.obj
LANCER=$folder/none expect 69 "$folder/none is missing" --turns 1
for words in "| OBJ | lancer |" "| PLY | lancer |" "| GLB | lancer |" "tinygltf is left out" "there is no blender"; do
    expect 0 "$words" --side 1 --turns 1
done
program=run

# Corners of every form, also side by side.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.5\nvn 0 0 1\nvn 0 1 0\nusemtl m2\nf 1/1/2 2/1/1 3/1/2\nusemtl m0\nf 1//1 2//1 3//2\nf 1 2 3\nusemtl m1\nf 3 2 1\nusemtl m3\nf 1/1 2//2 3\n' >"$folder/forms.obj"
"$python" - "$peers" "$folder/forms.obj" <<'END' || faults=$((faults + 1))
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import scene
mesh, none = scene.Mesh(sys.argv[2]), scene.NO_NORMAL
assert list(mesh.positions) == [0, 0, 0, 1, 0, 0, 0, 1, 0] and list(mesh.uvs) == [0, 0.5]
assert list(mesh.normals) == [0, 0, 1, 0, 1, 0] and list(mesh.material) == [2, 0, 0, 1, 3]
assert list(mesh.corners) == [0, 1, 2, 0, 1, 2, 0, 1, 2, 2, 1, 0, 0, 1, 2], mesh.corners
assert list(mesh.normal_corners) == [1, 0, 1, 0, 0, 1] + 6 * [none] + [none, 1, none], mesh.normal_corners
assert list(mesh.uv_corners) == [0, 0, 0] + 9 * [none] + [0, none, none], mesh.uv_corners
END

# An error that falls as 1/spp passes a tenth of that of one sample with ten, between 8 and 16.
"$python" - "$peers/anchors" <<'END' || faults=$((faults + 1))
import math, runpy, sys
samples_to = runpy.run_path(sys.argv[1])["samples_to"]
found = samples_to(0.1, {1 << k: [0.5 / (1 << k), 1.5 / (1 << k)] for k in range(5)}, range(2))
assert math.isclose(found, 10), found
END
((faults == 0))
