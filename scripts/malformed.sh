#!/usr/bin/env bash
# Feeds malformed files to the program and asserts that it ends as its help says: never by a signal, a hang, endless
# memory or a report of a sanitizer. The files stand outside this repository.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/malformed.sh [--program PATH] FOLDER...
  --program PATH   the lancer to try (build/release/lancer); also one built with AddressSanitizer
Tries every .obj, .mtl, .png, .exr, .hdr and .tga below the folders: meshes are rendered and checked, materials put on
triangles, pictures on a square and, .exr and .hdr, around it; lancer info reads them as well. A run may take 10 seconds
and 2 GB. Prints each failure and at the end how many times each exit code was seen, then
"N files, M runs, F failed" with the longest time and the largest memory of a run.
END
}

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
program=$root/build/release/lancer
folders=()
while (($#)); do
    case $1 in
        --program) program=$(realpath -- "${2:?--program needs a path}"); shift ;;
        -h | --help) usage; exit 0 ;;
        -*) echo "malformed.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *) folders+=("$(realpath -- "$1")") ;;
    esac
    shift
done
if ((${#folders[@]} == 0)); then usage >&2; exit 2; fi
if [[ ! -x $program ]]; then echo "malformed.sh: error: no program '$program'" >&2; exit 66; fi

extensions='obj|mtl|png|exr|hdr|tga'
seconds=10
megabytes=2048
unset LANCER_THREADS
export LC_ALL=C
temporary=$(mktemp -d)
trap 'rm -rf -- "$temporary"' EXIT
cd -- "$temporary"

# AddressSanitizer reserves terabytes of addresses; it counts memory in use itself. Its default exit codes are the
# program's own.
report_code=99
if grep -q -a __asan_init "$program"; then
    limit_memory() { :; }
    export ASAN_OPTIONS=hard_rss_limit_mb=$megabytes:exitcode=$report_code:detect_stack_use_after_return=1
    export UBSAN_OPTIONS=print_stacktrace=1:exitcode=$report_code LSAN_OPTIONS=exitcode=$report_code
else
    limit_memory() { ulimit -v $((megabytes * 1024)); }
fi
measure=()
if [[ -x /usr/bin/time ]]; then measure=(/usr/bin/time -q -f %M -o memory.txt); fi

files=0 runs=0 failed=0 longest=0 largest=0
declare -A seen=()

# fail SUBJECT REASON ARGUMENT...
fail() {
    echo "FAILED $1: $2: lancer ${*:3}"
    grep -a -m 3 -E 'ERROR: |runtime error: |SUMMARY: ' log.txt || true
    failed=$((failed + 1))
}

# run SUBJECT ARGUMENT...: of lancer.
run() {
    local subject=$1 code=0 written=false start=${EPOCHREALTIME/./} took kilobytes=0
    shift
    rm -f picture.exr memory.txt
    (limit_memory && exec "${measure[@]}" timeout -k 1 "$seconds" "$program" "$@") >log.txt 2>&1 </dev/null || code=$?
    took=$((${EPOCHREALTIME/./} - start))
    if ((took > longest)); then longest=$took; fi
    if [[ -s memory.txt ]]; then kilobytes=$(tail -n 1 memory.txt); fi
    if ((kilobytes > largest)); then largest=$kilobytes; fi
    runs=$((runs + 1))
    seen[$code]=$((${seen[$code]-0} + 1))
    case $code in
        0 | 1 | 2 | 65 | 66) ;;
        124 | 137) fail "$subject" "not done after $seconds s, or killed" "$@"; return ;;
        "$report_code") fail "$subject" 'report of a sanitizer' "$@"; return ;;
        *) fail "$subject" "exit code $code" "$@"; return ;;
    esac
    if ((code != 0)) && ! grep -q -a 'error: ' log.txt; then
        fail "$subject" "exit code $code without a message" "$@"
    elif [[ $1 == render ]]; then
        if [[ -e picture.exr ]]; then written=true; fi
        if [[ $written == true && $code != 0 || $written == false && $code == 0 ]]; then
            fail "$subject" "exit code $code, picture written: $written" "$@"
        fi
    fi
}

render() { run "$1" render "$2" --size 16x16 -s 1 -t 2 -o picture.exr; }

try_mesh() {
    render "$1" "$1"
    run "$1" check "$1" -t 2
    run "$1" info "$1" -t 2
}

# A triangle for each of its first names, or one for a library that has none.
try_materials() {
    local name
    cp -- "$1" subject.mtl
    printf 'mtllib subject.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n' >triangle.obj
    sed -n 's/^[[:space:]]*newmtl[[:space:]]*//p' subject.mtl | tr -d '\0\r' | head -n 16 >names.txt
    [[ -s names.txt ]] || echo none >names.txt
    while IFS= read -r name || [[ -n $name ]]; do
        printf 'usemtl %s\nf 1/1 2/2 3/3\n' "$name"
    done <names.txt >>triangle.obj
    render "$1" triangle.obj
    run "$1" check triangle.obj -t 2
}

# A square with the picture on it, and with the picture around it.
try_picture() {
    local extension=${1##*.}
    local copy=subject.${extension,,}
    cp -- "$1" "$copy"
    printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n' >square.obj
    printf 'version = 1\n[[mesh]]\nfile = "square.obj"\nmaterial = "m"\n[[light]]\ntype = "environment"\n' >start.toml
    { cat start.toml; printf 'radiance = 1\n[material.m]\ntexture = "%s"\n' "$copy"; } >on.toml
    render "$1" on.toml
    if [[ $copy == *.exr || $copy == *.hdr ]]; then
        { cat start.toml; printf 'file = "%s"\n[material.m]\n' "$copy"; } >around.toml
        render "$1" around.toml
    fi
    run "$1" info "$copy"
    rm -f -- "$copy"
}

while IFS= read -r -d '' file; do
    files=$((files + 1))
    case ${file,,} in
        *.obj) try_mesh "$file" ;;
        *.mtl) try_materials "$file" ;;
        *) try_picture "$file" ;;
    esac
done < <(find "${folders[@]}" -type f -regextype posix-extended -iregex ".*\.($extensions)" -print0 | sort -z)

counts=
for code in "${!seen[@]}"; do counts+="${counts:+, }$code ${seen[$code]} times"; done
echo "exit codes: ${counts:-none}"
printf '%d files, %d runs, %d failed; at most %d.%02d s and %d kB\n' "$files" "$runs" "$failed" \
    $((longest / 1000000)) $((longest / 10000 % 100)) "$largest"
((runs > 0 && failed == 0))
