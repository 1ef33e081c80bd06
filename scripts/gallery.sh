#!/usr/bin/env bash
# Draws the pictures of docs/gallery.md, each on one thread, and says what each command was and what it cost.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/gallery.sh [--quick] [--out FOLDER] [--only PICTURE]... [PART...]
  --quick       half the size, a sixteenth of the samples
  --out FOLDER  where to (build/gallery); docs/pictures/gallery makes the documentation's pictures anew
  --only NAME   only this picture; may be given several times
  PART...       of rooms, crops, course, student, legacy, depth, faults (all but faults)
Prints the CPU seconds of rendering and the command of each picture. LANCER names the program (build/release/lancer).
`faults` builds the program six times in build/mutations, with each of the patches of tests/mutations that it draws.
END
}

fail() { echo "gallery.sh: error: $1" >&2; exit "${2:-1}"; }

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
quick=0 out=build/gallery only=() parts=()
while (($#)); do
    case $1 in
        --quick) quick=1; shift ;;
        --out)
            out=${2:?--out needs a folder}
            # Relative, since pictures remember the command that drew them.
            out=$(cd -- "$started_in" && realpath -m -- "$out")
            out=$(realpath -m --relative-base=. -- "$out")
            shift 2
            ;;
        --only) only+=("${2:?--only needs a name}"); shift 2 ;;
        -h | --help) usage; exit 0 ;;
        rooms | crops | course | student | legacy | depth | faults) parts+=("$1"); shift ;;
        *) echo "gallery.sh: error: unknown part '$1'" >&2; usage >&2; exit 2 ;;
    esac
done
((${#parts[@]})) || parts=(rooms crops course student legacy depth)
lancer=${LANCER:-build/release/lancer}
[[ -x $lancer ]] || fail "no program '$lancer'; build it, or set LANCER to its path"
mkdir -p "$out"
figures=$out/figures-$$.json
trap 'rm -f "$figures"' EXIT

wanted() { ((${#only[@]} == 0)) || [[ " ${only[*]} " == *" $1 "* ]]; }

# draw PICTURE WxH SPP SCENE [OPTION...]: a PNG, or what `ending` says
ending=png
draw() {
    local picture=$1 size=$2 spp=$3 scene=$4 seconds
    wanted "$picture" || return 0
    if ((quick)); then
        size=$((${size%x*} / 2))x$((${size#*x} / 2))
        spp=$((spp < 16 ? 1 : spp / 16))
    fi
    local command=(render "scenes/$scene.toml" --size "$size" -s "$spp" "${@:5}")
    "$lancer" "${command[@]}" -t 1 -q --stats "$figures" -o "$out/$picture.$ending" >/dev/null </dev/null
    seconds=$(awk -F'[:, ]+' '
        /"name": "render"/ { rendering = 1 }
        rendering && /"cpu_s"/ { printf $3 < 1 ? "%.2f" : "%.1f", $3; exit }' "$figures")
    printf '%-28s %7s s  lancer %s\n' "$picture" "$seconds" "${command[*]}"
}

draw_rooms() {
    local name ending=jpg
    for name in room bathroom atrium still_life still_life_textured forest; do
        draw "own-${name//_/-}" 400x225 16 "$name" --denoise
    done
    draw own-environment 400x225 32 environment --denoise
    draw own-materials 400x225 32 materials --denoise
}

# crop NAME SCENE X,Y: 240x160 pixels of a picture in high definition; noisy, denoised, and with many samples
crop() {
    local x=${3%,*} y=${3#*,} ending=jpg
    local part=("$2" --crop "$x,$y,$((x + 240)),$((y + 160))")
    ((quick)) && part=("$2" --crop "$((x / 2)),$((y / 2)),$((x / 2 + 120)),$((y / 2 + 80))")
    draw "crop-$1-8" 1920x1080 8 "${part[@]}"
    draw "crop-$1-denoised" 1920x1080 8 "${part[@]}" --denoise
    draw "crop-$1-256" 1920x1080 256 "${part[@]}"
}

draw_crops() {
    crop blinds room 100,430
    crop books room 1680,300
    crop crochet still_life_textured 940,720
    crop glass still_life_textured 1400,500
    crop caustic still_life 960,740
    crop leaves forest 640,560
}

# The course's scenes with the numbers of their lights as the course meant them: colours that do not fade.
as_course=(--legacy -D light.0.irradiance=1)
two_lamps=("${as_course[@]}" -D light.1.intensity=1)
full_sky=(-D background.strength=1)

draw_course() {
    local name
    for name in start three-spheres bubble noon copper glow; do draw "$name" 360x240 64 "seed-a/$name"; done
    for name in floor night triangle pyramids water presets; do draw "$name" 360x240 64 "seed-a/$name"; done
    draw sunset 360x240 32 seed-a/sunset
    for name in fisheye ground textured-triangle; do draw "$name" 360x240 32 "seed-a-$name"; done
    for name in water-pyramids buildings; do draw "$name" 360x240 16 "seed-a/$name"; done
    draw random-decision 360x240 64 seed-a/random-decision
    for name in bubble-from-inside bubbles; do
        draw "$name" 360x240 32 "seed-a/$name" --integrator random-decision
    done
    draw nested 360x240 32 seed-a/nested
    draw interreflections 360x240 128 seed-a/interreflections
}

draw_student() {
    local name
    draw noeffects 240x240 1 seed-b/noeffects
    draw antialiasing 240x240 32 seed-b/antialiasing
    for name in indirect softshadows miroir fresnel; do draw "$name" 240x240 128 "seed-b/$name"; done
    draw room-three-spheres 240x240 64 seed-b/three-spheres
    draw caustic 320x240 256 seed-b/caustic
    draw mesh 240x240 1 seed-b-mesh
    draw texturesdirect 240x240 1 seed-b-texturesdirect
    draw textures 240x240 128 seed-b-textures
}

draw_legacy() {
    local name
    for name in three-spheres bubble; do draw "$name-legacy" 360x240 16 "seed-a/$name" "${two_lamps[@]}"; done
    draw water-legacy 360x240 16 seed-a/water "${as_course[@]}"
    draw presets-legacy 360x240 16 seed-a/presets "${two_lamps[@]}" "${full_sky[@]}"
    draw buildings-legacy 360x240 16 seed-a/buildings "${as_course[@]}" "${full_sky[@]}"
    for name in fresnel miroir; do draw "$name-legacy" 240x240 32 "seed-b/$name" --legacy; done
    draw caustic-legacy 320x240 64 seed-b/caustic --legacy
}

# The course counts what follows the first surface: its depth 1 is --max-depth 2.
draw_depth() {
    local depth
    for depth in 1 2 3 4 5 6 8 12; do
        draw "depth-$depth" 240x160 4 seed-a/bubbles "${as_course[@]}" "${full_sky[@]}" \
            --max-depth $((depth + 1))
    done
}

# with_fault PATCH PICTURE ...: draws with the program of a source that has the fault.
with_fault() {
    local patch=$PWD/tests/mutations/$1.patch scratch=$PWD/build/mutations
    wanted "$2" || return 0
    patch_source "$scratch" "$patch"
    if cmake --build "$scratch/build" -j "$(build_jobs)" --target lancer >"$scratch/build.log" 2>&1; then
        lancer=$scratch/build/lancer draw "${@:2}"
    else
        tail -n 25 "$scratch/build.log"
        echo "gallery.sh: error: with $1 the program does not build" >&2
        failed=1
    fi
    patch_source "$scratch" "$patch" --reverse
}

draw_faults() {
    local scratch=$PWD/build/mutations failed=0
    # shellcheck source=scripts/common.sh
    source scripts/common.sh
    copy_source "$scratch" || fail "the copy of the source cannot be built"
    with_fault index_on_leaving fault-index 360x240 16 seed-a/bubble "${two_lamps[@]}"
    with_fault bubble_too_white fault-white-bubble 360x240 16 seed-a/bubble "${two_lamps[@]}"
    with_fault glow_cones fault-glow 360x240 16 seed-a/glow
    with_fault plane_missed fault-plane 360x240 16 seed-a/buildings "${as_course[@]}" "${full_sky[@]}"
    with_fault shadow_lighter fault-shadow-lighter 360x240 16 seed-a/presets "${two_lamps[@]}" "${full_sky[@]}"
    with_fault shadow_coefficients fault-shadow-parts 360x240 16 seed-a/presets "${two_lamps[@]}" "${full_sky[@]}"
    return $failed
}

for part in "${parts[@]}"; do "draw_$part"; done
