#!/usr/bin/env bash
# Renders the seven scenes of which the student's path tracer left pictures, as it did, and compares. The pictures stand
# outside this repository.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/seed-pictures.sh [FOLDER] [--spp N] [-- OPTION...]
  FOLDER       pictures to compare with, NAME.png (seeds in the folder that LANCER_SHARED names, else ../shared)
  --spp N      as many samples per pixel for all but noeffects, which has one: a quick look
  OPTION...    more options of `lancer render`
Writes into build/seed-pictures/ and prints, in steps of 8 bits, the means and how far ours are from them, and how many
pixels differ by more than one step. Fails if a mean is more than 0.3 steps off (with --spp it only says so), or if
noeffects differs in 0.1 % of the pixels by more than one step.
END
}

fail() { echo "seed-pictures.sh: error: $1" >&2; exit "${2:-1}"; }

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
folder=${LANCER_SHARED:-../shared}/seeds spp=()
while (($#)); do
    case $1 in
        --spp) [[ ${2-} =~ ^[1-9][0-9]*$ ]] || fail '--spp needs a number' 2; spp=(--spp "$2"); shift 2 ;;
        -h | --help) usage; exit 0 ;;
        --) shift; break ;;
        -*) echo "seed-pictures.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        /*) folder=$1; shift ;;
        *) folder=$started_in/$1; shift ;;
    esac
done
[[ -d $folder ]] || fail "no folder '$folder' with pictures to compare with" 66
lancer=build/release/lancer
[[ -x $lancer ]] || fail "$lancer is missing; run: cmake --preset release && cmake --build --preset release"

out=build/seed-pictures
mkdir -p "$out"
failed=0
printf '%-14s %-24s %-24s %s\n' picture 'mean of theirs' 'ours minus theirs' 'beyond one step'
for name in noeffects antialiasing indirect softshadows miroir transparent fresnel; do
    samples=("${spp[@]}")
    [[ $name == noeffects ]] && samples=()
    "$lancer" render "scenes/seed-b/$name.toml" --legacy "${samples[@]}" -q -o "$out/$name.png" "$@" >/dev/null
    "$lancer" compare --steps "$out/$name.png" "$folder/$name.png" |
        awk -v name="$name" -v quick="${#spp[@]}" '
            $1 == "mean" { split($0, ours, " +") }
            $1 == "reference_mean" { split($0, theirs, " +") }
            $1 == "differing_pixels" { all = $4 }
            $1 == "beyond_one_step" { beyond = $2 }
            END {
                for (i = 2; i <= 4; ++i) {
                    d = ours[i] - theirs[i]
                    means = means sprintf("%-8.3f", theirs[i])
                    off = off sprintf("%-+8.3f", d)
                    if (d > 0.3 || d < -0.3) wrong = 1
                }
                if (quick) wrong = 0
                if (name == "noeffects" && beyond > 0.001 * all) wrong = 1
                printf "%-14s %s %s %d of %d%s\n", name, means, off, beyond, all, wrong ? "  FAILED" : ""
                exit wrong
            }' || failed=1
done
exit $failed
