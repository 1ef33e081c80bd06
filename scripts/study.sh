#!/usr/bin/env bash
# Error against run time as pages.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/study.sh [STUDY.toml [FOLDER]]
  (nothing)   the ladder, the anchors and Whitted, each into build/study/NAME: half an hour
  STUDY.toml  this one alone, into FOLDER (build/study/NAME)
The anchors and the rooms need scenes from outside this repository (scripts/anchors.sh and scripts/rooms.sh say where)
and other renderers that are installed (bench/peers/README.md); what is missing is left out and said.
END
}

files=()
for argument in "$@"; do
    case $argument in
        -h | --help) usage; exit 0 ;;
        -*) echo "study.sh: error: unknown option '$argument'" >&2; usage >&2; exit 2 ;;
        *) files+=("$(realpath -m -- "$argument")") ;;
    esac
done
((${#files[@]} <= 2)) || { usage >&2; exit 2; }

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh
scripts/install-deps.sh
build_preset release --target lancer

# study FILE [FOLDER]
study() {
    local trusted=()
    if [[ $(realpath -- "$1") == "$PWD"/bench/studies/* ]]; then trusted=(--allow-peers); fi
    build/release/lancer study "$1" "${trusted[@]}" -o "${2:-build/study/$(basename "$1" .toml)}"
}

# The anchors' scenes, unless they are there.
anchor_scenes() {
    [[ -f build/anchors/cornell.toml && -f build/anchors/statues.toml ]] || scripts/anchors.sh --scenes-only
}

if ((${#files[@]})); then
    case ${files[0]} in
        *anchors.toml) anchor_scenes ;;
        *rooms.toml | *six.toml) scripts/rooms.sh ;;
    esac
    study "${files[@]}"
    exit
fi
study bench/studies/ladder.toml
study bench/studies/whitted.toml
if anchor_scenes; then
    study bench/studies/anchors.toml
else
    echo "study.sh: without the anchors, whose scenes are missing" >&2
fi
