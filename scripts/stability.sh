#!/usr/bin/env bash
# The stability matrix: stiff and extreme cases against references, as a table and a page in build/stability.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/stability.sh [--tier A|B|C] [--only ID]... [--accel NAME]... [-o FOLDER]
  --tier   how much is run: A a minute (the default), B an hour, C all of it
  --only   a row, "P4", or a group, "P"; without it the run is noted in FOLDER/log.csv
  --accel  only this accelerator where rays matter: embree, embree-fast, bvh2, bvh8
  -o       where stability.html, .md and .json go (build/stability)
The last line is "N passed, N failed"; the exit code is 0 only if all passed.
END
}

folder=(-o build/stability) value=''
for argument in "$@"; do
    if [[ -n $value ]]; then value=''; continue; fi
    case $argument in
        -h | --help) usage; exit 0 ;;
        -o | --output) folder=() value=$argument ;;
        --tier | --only | --accel) value=$argument ;;
        -o* | --output=*) folder=() ;;
        --tier=* | --only=* | --accel=*) ;;
        *) echo "stability.sh: error: unknown argument '$argument'" >&2; usage >&2; exit 2 ;;
    esac
done

unset CDPATH
here=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh
scripts/install-deps.sh
build_preset release --target stability --target lancer
program=$PWD/build/release/tests/stability
if ((${#folder[@]})); then exec "$program" "${folder[@]}" "$@"; fi
cd "$here" # a folder that the user names is where the user is
exec "$program" "$@"
