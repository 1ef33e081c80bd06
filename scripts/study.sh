#!/usr/bin/env bash
# Error against run time: makes the page of a study; the teaching ladder takes about 20 minutes.
#   scripts/study.sh [STUDY.toml [FOLDER]]     (bench/studies/ladder.toml, build/study)
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh
scripts/install-deps.sh
build_preset release --target lancer
exec build/release/lancer study "${1:-bench/studies/ladder.toml}" -o "${2:-build/study}"
