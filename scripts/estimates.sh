#!/usr/bin/env bash
# What estimates of the error are worth: renders scenes at 96x54 against two references of 4096 samples each, and prints
# how far the estimates were from the error that there was. References and logs stay in FOLDER, and what is there is not
# drawn again. About an hour on two cores.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/estimates.sh [PART... [-o FOLDER]]     (all of them, build/estimates)
  halves      estimate over error of six scenes, four seeds each, at 16 to 256 samples
  replicates  how often the interval of --replicates 8 held the error of 64 samples, of eighteen seeds each
  stop        the error that --error 0.02 stopped at, of three scenes, twenty seeds each
  denoised    how often the interval of --denoise --replicates 8 held the error of the denoised picture, of six scenes,
              six seeds each, at 16, 32 and 64 samples
  stop-denoised  the error that --error 0.05 --denoise stopped at, of the same scenes, ten seeds each
Environment: LANCER, the program (build/release/lancer).
END
}

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
parts=() folder=build/estimates
while (($#)); do
    case $1 in
        halves | replicates | stop | denoised | stop-denoised) parts+=("$1") ;;
        -o) folder=$(cd -- "$started_in" && realpath -m -- "${2:?-o needs a folder}"); shift ;;
        -h | --help) usage; exit 0 ;;
        *) echo "estimates.sh: error: unknown part '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done
((${#parts[@]})) || parts=(halves replicates stop denoised stop-denoised)
lancer=${LANCER:-build/release/lancer}
[[ -x $lancer ]] || { echo "estimates.sh: error: $lancer is missing: cmake --build --preset release" >&2; exit 1; }
mkdir -p "$folder"

render() {
    local scene=$1
    shift
    "$lancer" render "scenes/$scene.toml" --size 96x54 -q "$@" >/dev/null
}

# logged NAME SCENE OPTIONS...: FOLDER/NAME.csv, the log of such a render.
logged() {
    local name=$1 scene=$2 half
    shift 2
    for half in 1 2; do
        local reference=$folder/$scene-$half.exr
        [[ -f $reference ]] || render "$scene" -s 4096 --seed "90$half" -o "$reference"
    done
    [[ -f $folder/$name.csv ]] && return
    # The log grows with the picture: it has its name when it is whole.
    render "$scene" --reference "$folder/$scene-1.exr" --reference2 "$folder/$scene-2.exr" \
        --error-log "$folder/$name.part" --stats "$folder/$name.json" -o "$folder/$name.exr" "$@"
    rm "$folder/$name.exr"
    mv "$folder/$name.part" "$folder/$name.csv"
}

# Fields of a log: 1 spp, 10 relmse_unbiased, 13 estimated_error, 14 and 15 its interval.
halves() {
    local scene seed
    echo "scene         spp   estimate over error, of four seeds"
    for scene in still_life spheres cornell materials environment forest; do
        for seed in 1 2 3 4; do logged "halves-$scene-$seed" "$scene" -s 256 --seed "$seed"; done
        awk -F, -v scene="$scene" 'FNR > 1 && $1 >= 16 { row[$1] = row[$1] sprintf("  %.3f", $13 / sqrt($10)) }
            END { for (n = 16; n <= 256; n *= 2) printf "%-12s %4d %s\n", scene, n, row[n] }' \
            "$folder/halves-$scene"-?.csv
    done
}

replicates() {
    local scene seed
    echo "scene         held   of   estimate over error: mean, least, most"
    for scene in still_life spheres cornell materials environment forest; do
        for seed in {11..28}; do
            logged "replicates-$scene-$seed" "$scene" -s 64 --replicates 8 --seed "$seed"
        done
        awk -F, -v scene="$scene" '$1 == 64 {
                error = sqrt($10); held += $14 <= error && error <= $15
                x = $13 / error; sum += x; if (!n++ || x < least) least = x; if (x > most) most = x
            } END { printf "%-12s %5d %4d   %.3f  %.3f  %.3f\n", scene, held, n, sum / n, least, most }' \
            "$folder/replicates-$scene"-??.csv
    done
}

stop() {
    local scene seed
    echo "scene        <= 0.025   of   error: least, median, most"
    for scene in cornell still_life spheres; do
        for seed in {101..120}; do logged "stop-$scene-$seed" "$scene" --error 0.02 --seed "$seed"; done
        for seed in {101..120}; do tail -n 1 "$folder/stop-$scene-$seed.csv"; done |
            awk -F, '{ print sqrt($10) }' | sort -g |
            awk -v scene="$scene" '{ x[NR] = $1; held += $1 <= 0.025 }
                END { printf "%-12s %8d %4d   %.4f  %.4f  %.4f\n", scene, held, NR, x[1], (x[10] + x[11]) / 2, x[NR] }'
    done
}

# told NAME: error, low and high end of its interval, as the figures of the render tell them of the denoised picture.
told() {
    tr -d ' \n' <"$folder/$1.json" | sed -E 's/.*"denoised":\{"error":([^,]*),"interval":\[([^,]*),([^]]*)\].*/\1 \2 \3/'
}

readonly denoised_scenes=(cornell still_life_textured materials forest room bathroom)

denoised() {
    local scene seed spp name
    echo "scene                 spp   held   of   told over error: mean, least, most"
    for scene in "${denoised_scenes[@]}"; do
        for spp in 16 32 64; do
            for seed in {31..36}; do
                name=denoised-$scene-$spp-$seed
                logged "$name" "$scene" -s "$spp" --replicates 8 --denoise --seed "$seed"
                echo "$(tail -n 1 "$folder/$name.csv" | cut -d, -f 10) $(told "$name")"
            done | awk -v scene="$scene" -v spp="$spp" '{
                    error = sqrt($1); held += $3 <= error && error <= $4
                    x = $2 / error; sum += x; if (!n++ || x < least) least = x; if (x > most) most = x
                } END { printf "%-20s %4d %6d %4d   %.3f  %.3f  %.3f\n", scene, spp, held, n, sum / n, least, most }'
        done
    done
}

stop-denoised() {
    local scene seed name
    echo "scene                 <= 0.06   of   error: least, most; samples: least, most"
    for scene in "${denoised_scenes[@]}"; do
        for seed in {201..210}; do
            name=stop-denoised-$scene-$seed
            logged "$name" "$scene" --error 0.05 --denoise --seed "$seed"
            tail -n 1 "$folder/$name.csv" | cut -d, -f 1,10
        done | awk -F, -v scene="$scene" '{
                error = sqrt($2); held += error <= 0.06
                if (!n++ || error < least) least = error; if (error > most) most = error
                if (n == 1 || $1 < few) few = $1; if ($1 > many) many = $1
            } END { printf "%-20s %8d %4d   %.4f  %.4f  %6.0f  %6.0f\n", scene, held, n, least, most, few, many }'
    done
}

for part in "${parts[@]}"; do "$part"; done
