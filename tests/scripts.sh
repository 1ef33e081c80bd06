#!/usr/bin/env bash
# Every script tells what it does and does nothing else when asked, and refuses an option that it does not know with 2,
# before it builds, installs or writes anything; from another folder, by a path with a blank.
# usage: tests/scripts.sh SOURCE
set -euo pipefail
source=$(cd -- "$1" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin" "$scratch/empty"
ln -s "$source" "$scratch/a link"
failed=0

# Whatever does the work of scripts is replaced by a program that notes that it was called.
for tool in apt-get cmake ctest cpack ninja debootstrap chroot mount dpkg-query git clang-format clang-format-14 lancer \
    Xvfb xdotool python3; do
    printf '#!/bin/sh\necho "%s $*" >>"%s/calls"\nexit 1\n' "$tool" "$scratch" >"$scratch/bin/$tool"
    chmod +x "$scratch/bin/$tool"
done
export PATH=$scratch/bin:$PATH LANCER=$scratch/bin/lancer

fault() {
    failed=1
    echo "$1"
}
# run SCRIPT ARGUMENT: sets code; what it said stands in out and err. Nothing else may have happened.
run() {
    : >"$scratch/calls"
    code=0
    (cd "$scratch/empty" && timeout 10 "$scratch/a link/scripts/$1" "$2") \
        >"$scratch/out" 2>"$scratch/err" </dev/null || code=$?
    [[ ! -s $scratch/calls ]] || fault "$1 $2 calls: $(head -n 3 "$scratch/calls")"
    [[ -z $(ls -A "$scratch/empty") ]] || fault "$1 $2 writes $(ls "$scratch/empty")"
}

count=0
for path in "$source"/scripts/*.sh; do
    name=$(basename "$path")
    # What others source is no program.
    if [[ $(head -n 1 "$path") != '#!'* ]]; then
        [[ ! -x $path ]] || fault "$name: can be run, but names no interpreter"
        continue
    fi
    count=$((count + 1))
    [[ -x $path ]] || fault "$name: cannot be run"
    for option in --help -h; do
        run "$name" "$option"
        ((code == 0)) || fault "$name $option: exit code $code: $(head -n 3 "$scratch/err")"
        [[ $(head -n 1 "$scratch/out") == "usage: scripts/$name"* ]] || fault "$name $option says: $(head -n 1 "$scratch/out")"
        [[ ! -s $scratch/err ]] || fault "$name $option complains: $(head -n 3 "$scratch/err")"
    done
    run "$name" --no-such-option
    ((code == 2)) || fault "$name --no-such-option: exit code $code"
    grep -q -e --no-such-option "$scratch/err" || fault "$name does not name the option that it refuses"
    [[ ! -s $scratch/out ]] || fault "$name --no-such-option goes on: $(head -n 3 "$scratch/out")"
done
((count > 20)) || fault "only $count scripts were found"
exit "$failed"
