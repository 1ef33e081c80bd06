#!/usr/bin/env bash
# How the time of the classic integrators grows with the depth, on twelve thin bubbles of glass one behind the other.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/depth-table.sh [--size WxH] [--spp N] [--depths "N ..."] [-- OPTION...]
  --size WxH      size of the pictures (300x200)
  --spp N         samples per pixel (4)
  --depths "..."  values of --max-depth, ascending ("2 3 4 5 6 7 8 9")
  OPTION...       more options of `lancer render`, such as --legacy
Prints a table in Markdown: the CPU seconds of rendering, their growth from row to row, and rays per camera ray. The
scene and the figures are left in build/depth-table/. LANCER names the program (build/release/lancer).
END
}

size=300x200 spp=4 depths='2 3 4 5 6 7 8 9'
while (($#)); do
    case $1 in
        --size) size=${2:?--size needs WxH}; shift 2 ;;
        --spp) spp=${2:?--spp needs a number}; shift 2 ;;
        --depths) depths=${2:?--depths needs numbers}; shift 2 ;;
        -h | --help) usage; exit 0 ;;
        --) shift; break ;;
        *) echo "depth-table.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    esac
done

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
lancer=${LANCER:-build/release/lancer}
if [[ ! -x $lancer ]]; then
    echo "depth-table.sh: error: no program '$lancer'; build it, or set LANCER to its path" >&2
    exit 1
fi
out=build/depth-table
mkdir -p "$out"

# Half of what meets the glass is reflected, half goes through, so that all branches are worth following.
awk 'BEGIN {
    print "version = 1\n"
    print "[camera]\nposition = [0, 0, 14]\ntarget = [0, 0, 0]\nfov = 30\n"
    print "[material.wall]\nbase_color = [0.8, 0.7, 0.5]\n"
    glass = "type = \"interface\"\nbase_color = [0.95, 0.95, 1]\nspecular = 1\nshininess = 80\ndiffusion = 0.01\n" \
            "reflexion = 0.5\nrefraction = 0.5\n"
    print "[material.glass]\n" glass "ior = 1.5\n"
    print "[material.air]\n" glass "ior = 1\noutside_ior = 1.5\n"
    print "[[plane]]\npoint = [0, 0, -12]\nnormal = [0, 0, 1]\nmaterial = \"wall\"\n"
    print "[[light]]\ntype = \"directional\"\ndirection = [-1, -2, -1]\nirradiance = 2\n"
    print "[[light]]\ntype = \"environment\"\nradiance = [0.2, 0.3, 0.4]\n"
    for (i = 0; i < 12; ++i) {
        center = sprintf("[%.3f, %.3f, %.3f]", 2.4 * cos(i * 2.4), 1.6 * sin(i * 2.4), 4 - 0.8 * i)
        printf "[[sphere]]\ncenter = %s\nradius = 1.5\nmaterial = \"glass\"\n\n", center
        printf "[[sphere]]\ncenter = %s\nradius = 1.48\nmaterial = \"air\"\n\n", center
    }
}' >"$out/bubbles.toml"

# measure INTEGRATOR DEPTH [OPTION...]: CPU seconds of the phase `render`, and rays per camera ray.
measure() {
    local stats=$out/$1-$2.json
    "$lancer" render "$out/bubbles.toml" --integrator "$1" --max-depth "$2" --size "$size" --spp "$spp" --quiet \
        --stats "$stats" -o "$out/$1-$2.png" "${@:3}" >/dev/null
    awk -F'[:, ]+' '
        /"name": "render"/ { rendering = 1 }
        rendering && /"cpu_s"/ { seconds = $3; rendering = 0 }
        /"(camera|all)": \{/ { kind = $2 }
        kind && /"count"/ { count[kind] = $3; kind = "" }
        END { printf "%.4f %.2f\n", seconds, count["\"all\""] / count["\"camera\""] }' "$stats"
}

echo '| max depth | whitted, s | growth | rays per camera ray | random-decision, s | growth | rays per camera ray |'
echo '|---|---|---|---|---|---|---|'
before_tree='' before_walk=''
for depth in $depths; do
    read -r tree tree_rays < <(measure whitted "$depth" "$@")
    read -r walk walk_rays < <(measure random-decision "$depth" "$@")
    growth() { if [[ -n $1 ]]; then awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", b / a }'; fi; }
    echo "| $depth | $tree | $(growth "$before_tree" "$tree") | $tree_rays | $walk | $(growth "$before_walk" "$walk") | $walk_rays |"
    before_tree=$tree before_walk=$walk
done
