#!/usr/bin/env bash
# Runs the command lines of the documentation as they stand: those in fences, and `lancer ...` in the text. Each page has
# a folder with the files that pages speak of (folder.sh), where its commands run in order; pictures are small
# (small_lancer.sh). Other programs that are not installed are replaced by ones that do nothing. What names no file, such
# as `lancer render --denoise`, is looked up in --help.
# usage: tests/docs/commands.sh SOURCE PROGRAM LIBRARY [PAGE...]
set -euo pipefail
unset CDPATH
source=$(cd -- "$1" && pwd)
PROGRAM=$(realpath -- "$2") LANCER_LIBRARY=$(realpath -- "$3")
export PROGRAM LANCER_LIBRARY
shift 3
cd -- "$source"
pages=("$@")
if ((!$#)); then
    pages=(README.md CONTRIBUTING.md)
    while IFS= read -r page; do pages+=("$page"); done < <(find docs -name '*.md' | LC_ALL=C sort)
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export PYTHONPATH=$source/python PYTHONDONTWRITEBYTECODE=1
# shellcheck source=tests/docs/folder.sh
source tests/docs/folder.sh

# Programs: lancer made small; those that pages start it by; and, of the others, what is not here.
mkdir "$scratch/bin" "$scratch/base"
cp tests/docs/small_lancer.sh "$scratch/bin/lancer"
program() {
    cat >"$scratch/bin/$1"
    chmod +x "$scratch/bin/$1"
}
# Two ranks, one after the other, as Slurm and Open MPI name them.
for name in srun mpirun; do
    program $name <<'END'
#!/usr/bin/env bash
while [[ ${1-} == -* ]]; do [[ $1 == *=* ]] || shift; shift; done
for rank in 0 1; do SLURM_PROCID=$rank SLURM_NTASKS=2 OMPI_COMM_WORLD_RANK=$rank OMPI_COMM_WORLD_SIZE=2 "$@"; done
END
done
program parallel <<'END'
#!/usr/bin/env bash
while [[ ${1-} == --* ]]; do shift 2; done
words=()
while [[ $1 != ::: ]]; do words+=("$1"); shift; done
shift
for value in "${@:1:2}"; do "${words[@]//\{\}/$value}"; done
END
program sbatch <<'END'
#!/usr/bin/env bash
cat >/dev/null
echo 1
END
program blender <<'END'
#!/bin/sh
for script; do :; done
exec test -s "$script"
END
for name in gnuplot oiiotool oidnDenoise convert ffmpeg; do
    if type -P "$name" >/dev/null; then continue; fi
    program "$name" <<'END'
#!/bin/sh
cat >/dev/null
for last; do :; done
: >"${last#file:}"
END
done
# What installs or reaches out is none of a test's business.
for name in apt apt-get dpkg sudo ssh scp git cmake ctest ninja man; do printf '#!/bin/sh\n' | program "$name"; done
python3 -c 'import numpy' 2>/dev/null || printf '#!/bin/sh\n' | program python3
export PATH=$scratch/bin:$PATH

base=$scratch/base
make_user_files "$source" "$base"
make_scenes "$base"
lancer_quietly() { (cd "$base" && "$PROGRAM" "$@" -q >/dev/null); }
for seed in 1 2 3; do
    lancer_quietly render scene.toml --size 32x18 -s 8 --seed $seed --aov variance,denoise -o $seed.exr
done
(cd "$base" && cp 1.exr a.exr && cp 1.exr picture.exr && cp 1.exr halves.exr && cp 2.exr reference.exr && cp 2.exr r1.exr && cp 3.exr r2.exr)
lancer_quietly render scene.toml --size 32x18 -s 8 --shard 1/1 -o part.lancer
lancer_quietly render scene.toml --size 32x18 -s 8 --shard 1/2 -o half.lancer
(cd "$base" && "$PROGRAM" merge half.lancer --allow-missing -o some.lancer >/dev/null 2>&1)
for option in '' render film view check info denoise merge verify slurm compare pixel study bench tune export options; do
    # shellcheck disable=SC2086
    "$PROGRAM" $option --help >"$scratch/help.${option:-all}" 2>&1
done

# A mention: its command and its options are there.
look_up() {
    local command=$2 word
    if [[ $command == -* || $command == COMMAND || $command == help ]]; then command=all; fi
    if [[ ! -e $scratch/help.$command ]]; then
        echo "lancer $command: there is no such command" >>"$FAULTS"
        return
    fi
    for word in "${@:2}"; do
        [[ $word == -* ]] || continue
        word=${word%%=*}
        grep -q -E -e "(^|[ ,])$word([ ,]|$)" "$scratch/help.$command" || echo "$*: $command has no option $word" >>"$FAULTS"
    done
}

# Studies take no options for that.
make_small() {
    sed -E 's/^(seeds = ).*/\12/; s/^(spp = ).*/\18/; s/^(reference_spp = ).*/\116/; s/^(options = .*--size )[0-9]+x[0-9]+/\132x18/'
}

run_page() {
    local page=$1 folder=$scratch/run/${1//\//_} blocks=$scratch/blocks/${1//\//_} block line
    mkdir -p "$blocks"
    export FAULTS=$blocks/faults TASK=1 TASKS=2 FRAME=1
    while read -r block line; do
        if [[ ! -d $folder ]]; then
            mkdir -p "$scratch/run"
            cp -r "$base" "$folder"
        fi
        : >"$FAULTS"
        case $block in
            *.save) tail -n +2 "$block" | make_small >"$folder/$(head -n 1 "$block")" ;;
            *.inline)
                read -r -a words <"$block"
                [[ ${words[*]} != "lancer checkpoint "* ]] || continue  # the first bytes of a file
                if [[ " ${words[*]:1} " =~ \ (SCENE|MESH|STUDY|PART\.\.\.|[^ -][^ ]*\.(toml|obj|ply|glb|exr|lancer))\  ]]; then
                    (cd "$folder" && bash "$block" >/dev/null 2>>"$FAULTS" </dev/null) || echo "fails" >>"$FAULTS"
                else
                    look_up "${words[@]}"
                fi
                ;;
            *.sh) (cd "$folder" && bash -e "$block" >/dev/null 2>"$block.log" </dev/null) ||
                { echo 'a command fails:' && tail -n 3 "$block.log"; } >>"$FAULTS" ;;
        esac
        echo "$block" >>"$blocks/count"
        if [[ -s $FAULTS ]]; then
            echo "$page:$line"
            sed 's/^/    /' "$FAULTS"
            touch "$scratch/failed"
        fi
    done < <(awk -v to="$blocks" -v page="$page" -f "$source/tests/docs/extract.awk" "$page")
    rm -rf "$folder"
}
# Two pages at a time: the longest first.
run_some() {
    local page
    for page in "$@"; do run_page "$page"; done
}
half=() other=()
for page in "${pages[@]}"; do
    case $page in docs/cookbook.md | docs/command-line.md | README.md | docs/farm.md) half+=("$page") ;; *) other+=("$page") ;; esac
done
run_some "${half[@]}" &
run_some "${other[@]}"
wait
count=$(cat "$scratch"/blocks/*/count 2>/dev/null | wc -l)
echo "$count commands and blocks of ${#pages[@]} pages"
(($# || count > 150)) || { echo 'fewer than there were'; exit 1; }
[[ ! -e $scratch/failed ]]
