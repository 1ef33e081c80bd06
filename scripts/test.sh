#!/usr/bin/env bash
# Installs what is missing, builds, runs the tests. The last line is always "N passed, N failed".
set -uo pipefail

usage() {
    cat <<'END'
usage: scripts/test.sh [--slow]
  (nothing)  release build with warnings as errors, benchmarks too, and all its tests
  --slow     the same, then the tests under AddressSanitizer + UBSan and under ThreadSanitizer; each way to leave
             parts out, a build without x86 intrinsics, one that compiles each file alone, and one by clang
             where it is installed, is built and draws the same picture; each fuzz target runs for a minute
The last line is "N passed, N failed"; the exit code is 0 only if something passed and nothing failed.
END
}

slow=false
for argument in "$@"; do
    case $argument in
        --slow) slow=true ;;
        -h | --help) usage; exit 0 ;;
        *)
            echo "test.sh: error: unknown option '$argument'" >&2
            usage >&2
            exit 2
            ;;
    esac
done

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=scripts/common.sh
source scripts/common.sh

passed=0
failed=0

finish() {
    if ((passed == 0 && failed == 0)); then
        echo 'No test ran.'
        failed=1
    fi
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
}

# Of ctest's log: what each failed test printed, not more than 60 lines of each.
show_failures() {
    awk '/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { shown = /\*\*\*/ && !/\*\*\*Skipped/ ? 60 : 0 }
         /^ +Start +[0-9]+: / { shown = 0 }
         /^[0-9]+% tests passed, / { shown = 1000 }
         shown > 0 { print; if (--shown == 0) print "  ..." }' "$1"
}

# test_preset PRESET: runs the tests of a built preset and adds to the counts.
test_preset() {
    local preset=$1 log=$PWD/build/$1/test.log report=$PWD/build/$1/test.xml start=$SECONDS
    local status=0 cases good skipped bad
    rm -f "$report"
    echo "Testing preset $preset (log: build/$preset/test.log)"
    "${run_under[@]}" ctest --preset "$preset" -j 2 --output-junit "$report" >"$log" 2>&1 </dev/null || status=$?
    if [[ ! -f $report ]]; then
        tail -n 25 "$log"
        echo "ctest ended with $status and left no report."
        failed=$((failed + 1))
        return
    fi
    # What tests print is escaped in the report, so that only true elements match.
    cases=$(grep -c '^[[:space:]]*<testcase ' "$report" || true)
    good=$(grep -c '^[[:space:]]*<testcase .* status="run"' "$report" || true)
    # Left out by the test itself or by its author; a missing program is "notrun" too, but with another reason.
    skipped=$(grep -c -E '<skipped message="SKIP_|^[[:space:]]*<testcase .* status="disabled"' "$report" || true)
    bad=$((cases - good - skipped))
    if ((status != 0 || bad > 0)); then show_failures "$log"; fi
    if ((status != 0 && bad == 0)); then
        echo "ctest ended with $status."
        bad=1
    elif ((cases == 0)); then
        echo "No test in preset $preset."
        bad=1
    fi
    echo "Preset $preset: $good passed, $bad failed, $skipped skipped in $((SECONDS - start)) s"
    passed=$((passed + good))
    failed=$((failed + bad))
}

# run PRESET [-DOPTION...]: builds and tests; a build that fails counts as one failed test.
run() {
    if build_preset "$@"; then
        test_preset "$1"
    else
        failed=$((failed + 1))
    fi
}

# build_variant FOLDER TARGET -DOPTION...: variants of one compiler share a folder, so that little is compiled twice. The
# program must draw the pixels of the release build; counts as one test.
build_variant() {
    local folder=$PWD/build/$1 target=$2 status=0
    shift 2
    echo "Building $* (log: $folder/build.log)"
    mkdir -p "$folder"
    { cmake --preset release -B "$folder" -DLANCER_WERROR=ON "$@" &&
        cmake --build "$folder" -j "$(build_jobs)" --target "$target" &&
        "$folder/lancer" render scenes/spheres.toml -q --size 48x27 -s 4 -o "$folder/variant.exr" &&
        "$folder/lancer" compare "$folder/variant.exr" build/whole.exr --metric rmse --fail-above 0; } >"$folder/build.log" 2>&1 </dev/null || status=$?
    if ((status == 0)); then passed=$((passed + 1))
    else tail -n 25 "$folder/build.log"; failed=$((failed + 1)); fi
}

# Every combination of the parts that a build may do without, one without x86 intrinsics, and one of each file alone, in
# which an include that is missing shows. The folder remembers options: each variant says them all.
build_variants() {
    local i part options
    local parts=(OIIO DISPLAY_SERVER CLASSIC)
    local usual=(-DLANCER_TESTS=OFF -DLANCER_BENCH=OFF -DLANCER_UNITY=ON -DLANCER_PORTABLE_LANES=OFF)
    build/release/lancer render scenes/spheres.toml -q --size 48x27 -s 4 -o build/whole.exr || return
    for ((i = 0; i < (1 << ${#parts[@]}) - 1; ++i)); do
        options=()
        for part in "${!parts[@]}"; do
            if (((i >> part) & 1)); then options+=("-DLANCER_WITH_${parts[part]}=ON")
            else options+=("-DLANCER_WITH_${parts[part]}=OFF"); fi
        done
        build_variant parts lancer "${usual[@]}" "${options[@]}"
    done
    options=()
    for part in "${parts[@]}"; do options+=("-DLANCER_WITH_$part=ON"); done
    build_variant parts lancer "${usual[@]}" "${options[@]}" -DLANCER_PORTABLE_LANES=ON
    build_variant parts all "${options[@]}" -DLANCER_TESTS=ON -DLANCER_BENCH=ON -DLANCER_UNITY=OFF -DLANCER_PORTABLE_LANES=OFF
    if command -v clang++ >/dev/null; then build_variant clang all "${options[@]}" -DLANCER_BENCH=ON -DCMAKE_CXX_COMPILER=clang++; fi
}

# Each target of scripts/fuzz.sh counts as one test.
run_fuzz() {
    local log=$PWD/build/fuzz.log good bad
    mkdir -p build
    echo 'Fuzzing (log: build/fuzz.log)'
    scripts/fuzz.sh --seconds 60 --jobs 2 >"$log" 2>&1 </dev/null
    read -r good bad < <(sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' "$log" | tail -n 1)
    if [[ ${bad:-1} != 0 ]]; then tail -n 60 "$log"; fi
    passed=$((passed + ${good:-0}))
    failed=$((failed + ${bad:-1}))
}

if ! scripts/install-deps.sh; then
    failed=1
    finish
fi

run release -DLANCER_WERROR=ON -DLANCER_BENCH=ON

if $slow; then
    run_under=(env UBSAN_OPTIONS=print_stacktrace=1)
    run asan -DLANCER_WERROR=OFF
    # The libraries from packages are not instrumented: what goes on inside them cannot be judged. Address space
    # randomisation is off where that is allowed: ThreadSanitizer of g++ 12 and 13 fails on 32 random bits.
    run_under=(env TSAN_OPTIONS="ignore_noninstrumented_modules=1 ${TSAN_OPTIONS-}")
    if setarch -R true 2>/dev/null; then run_under+=(setarch -R); fi
    run tsan -DLANCER_WERROR=OFF
    run_under=(env)
    build_variants
    run_fuzz
fi
finish
