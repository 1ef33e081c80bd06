#!/usr/bin/env bash
# Error against run time as pages.
#   scripts/study.sh                        the ladder, the anchors and Whitted, each into build/study/NAME: half an hour
#   scripts/study.sh STUDY.toml [FOLDER]    one study (build/study/NAME)
# The anchors and the rooms need scenes from outside this repository (scripts/anchors.sh and scripts/rooms.sh say where)
# and other renderers that are installed (bench/peers/README.md); what is missing is left out and said.
set -euo pipefail
cd "$(dirname "$0")/.."
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

if (($#)); then
    case $1 in
        *anchors.toml) anchor_scenes ;;
        *rooms.toml) scripts/rooms.sh ;;
    esac
    study "$@"
    exit
fi
study bench/studies/ladder.toml
study bench/studies/whitted.toml
if anchor_scenes; then
    study bench/studies/anchors.toml
else
    echo "study.sh: without the anchors, whose scenes are missing" >&2
fi
