#!/usr/bin/env bash
# Do the tests see the faults they are there for? Each tests/mutations/NAME.patch puts one fault into a scratch copy of
# the source; the test that it names must then fail, and must pass without it.
set -uo pipefail

usage() {
    cat <<'END'
usage: scripts/mutations.sh [NAME...]
  (nothing)  every patch of tests/mutations
  NAME       only these
A patch says in lines of its own before the first file:
  Fault: what is wrong with it
  Test: FOLDER/SUITE.NAME         the test that must fail, as ctest shows it
The last line is "N seen, N missed"; the exit code is 0 only if all were seen.
END
}

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=scripts/common.sh
source scripts/common.sh

patches=()
for argument in "$@"; do
    case $argument in
        -h | --help) usage; exit 0 ;;
        -*) echo "mutations.sh: error: unknown option '$argument'" >&2; usage >&2; exit 2 ;;
    esac
    name=$(basename "$argument" .patch)
    if [[ ! -f tests/mutations/$name.patch ]]; then
        echo "mutations.sh: error: there is no tests/mutations/$name.patch" >&2
        exit 2
    fi
    patches+=("$PWD/tests/mutations/$name.patch")
done
if ((${#patches[@]} == 0)); then patches=("$PWD"/tests/mutations/*.patch); fi

scratch=$PWD/build/mutations
log=$scratch/build.log
copy_source "$scratch" || exit 1

# passes FOLDER/SUITE.NAME: 0 if it passes, 1 if it fails, 2 if it could not be built or does not exist.
passes() {
    local folder=${1%%/*} test=${1#*/} out=$scratch/test.log
    cmake --build "$scratch/build" -j "$(build_jobs)" --target "${folder}_tests" >"$log" 2>&1 || return 2
    "$scratch/build/tests/${folder}_tests" --gtest_filter="$test" >"$out" 2>&1
    local status=$?
    grep -q '^\[==========\] Running [1-9]' "$out" || return 2
    ((status == 0)) && grep -q '^\[  PASSED  \] [1-9]' "$out" && return 0
    return 1
}

seen=0 missed=0
miss() {
    echo "MISSED  $1: $2"
    missed=$((missed + 1))
}
for file in "${patches[@]}"; do
    name=$(basename "$file" .patch)
    test=$(sed -n 's/^Test: *//p' "$file" | head -n 1)
    fault=$(sed -n 's/^Fault: *//p' "$file" | head -n 1)
    if [[ -z $test || -z $fault ]]; then
        miss "$name" "the patch says no 'Test:' or no 'Fault:'"
        continue
    fi
    passes "$test"
    case $? in
        1) miss "$name" "$test fails without the fault"; continue ;;
        2) miss "$name" "$test does not build or does not exist"; tail -n 5 "$log"; continue ;;
    esac
    if ! patch_source "$scratch" "$file" >"$scratch/patch.log" 2>&1; then
        miss "$name" "the patch does not fit the source any more"
        tail -n 5 "$scratch/patch.log"
        continue
    fi
    passes "$test"
    case $? in
        0) miss "$name" "$test passes although $fault" ;;
        1) echo "seen    $name: $fault"; seen=$((seen + 1)) ;;
        2) miss "$name" "with the fault it does not build"; tail -n 5 "$log" ;;
    esac
    patch_source "$scratch" "$file" --reverse
done
echo "$seen seen, $missed missed"
((missed == 0 && seen > 0))
