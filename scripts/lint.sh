#!/usr/bin/env bash
# Style and suspicious code: clang-format over src, tests and bench, clang-tidy over src. Not part of the tests, since
# both tools change their mind from version to version. Formatting is judged by version 14.
set -uo pipefail
unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=scripts/common.sh
source scripts/common.sh

usage() {
    cat <<'END'
usage: scripts/lint.sh [--format-only | --fix-format]
  --format-only  clang-format alone
  --fix-format   let clang-format write what it would have
END
}

mode=${1-}
case $mode in
    '' | --format-only | --fix-format) ;;
    -h | --help) usage; exit 0 ;;
    *) echo "lint.sh: error: unknown option '$mode'" >&2; usage >&2; exit 2 ;;
esac

# tool NAME VERSION...: the first of these versions that is there, else whatever has the name.
tool() {
    local name=$1 version
    shift
    for version in "$@"; do command -v "$name-$version" && return; done
    command -v "$name" || {
        echo "lint.sh: error: $name is missing: apt-get install $name-$1 (or $name)" >&2
        return 1
    }
}

format=$(tool clang-format 14) || exit 1
folders=()
for folder in src tests bench; do [[ -d $folder ]] && folders+=("$folder"); done
mapfile -t sources < <(find "${folders[@]}" -name '*.h' -o -name '*.cpp' | sort)
if [[ $mode == --fix-format ]]; then
    "$format" -i "${sources[@]}"
    exit
fi

status=0
"$format" --version
"$format" --dry-run -Werror "${sources[@]}" || status=1
((status == 0)) || echo 'Formatting differs: scripts/lint.sh --fix-format'
if [[ $mode == --format-only ]]; then exit "$status"; fi

# Version 14 cannot read all of C++20: ranges, for one.
tidy=$(tool clang-tidy 16 19 14) || exit 1
cmake --preset lint >/dev/null || exit 1
"$tidy" --version | sed -n 's/^ *\(.*version.*\)/clang-tidy: \1/p'
# What g++ alone understands in the recorded command lines is not this tool's business.
find src -name '*.cpp' | sort |
    xargs -P "$(build_jobs)" -n 1 "$tidy" -p build/lint --quiet --warnings-as-errors='*' \
        --extra-arg=-Wno-unknown-warning-option 2> >(grep -v -E '^[0-9]+ warnings? ' >&2) || status=1
if ((status == 0)); then echo 'lint: nothing to say'; fi
exit "$status"
