#!/usr/bin/env bash
# The stability matrix: stiff and extreme cases against references, as a table and a page in build/stability.
#   scripts/stability.sh [--tier A|B|C] [--only ID]... [--accel NAME]... [-o FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh
scripts/install-deps.sh
build_preset release --target stability --target lancer
exec build/release/tests/stability -o build/stability "$@"
