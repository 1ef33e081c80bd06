#!/usr/bin/env bash
# Builds the fuzz targets of tests/fuzz with clang and runs them. The last line is always "N passed, N failed".
set -uo pipefail

usage() {
    cat <<'END'
usage: scripts/fuzz.sh [--seconds N] [--jobs N] [TARGET...]
  --seconds N  how long each target runs (60)
  --jobs N     how many run at a time (1)
  TARGET       png, obj, ... (all of tests/fuzz)
A target fails by a crash, a report of a sanitizer, an input that takes a second, or 1 GB of memory. The input is kept in
build/fuzz/crashes/TARGET and tried again by every run; build/fuzz/targets/fuzz_TARGET FILE runs it alone. Inputs that
reach more of the code stay in build/fuzz/corpus/TARGET, numbers of executions in build/fuzz/executions.txt.
END
}

seconds=60 jobs=1 targets=()
unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=scripts/common.sh
source scripts/common.sh
while (($#)); do
    case $1 in
        --seconds) seconds=${2:?--seconds needs a number}; shift ;;
        --jobs) jobs=${2:?--jobs needs a number}; shift ;;
        -h | --help) usage; exit 0 ;;
        -*) echo "fuzz.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *)
            if [[ ! -f tests/fuzz/$1.cpp ]]; then echo "fuzz.sh: error: no target '$1'" >&2; exit 2; fi
            targets+=("$1")
            ;;
    esac
    shift
done
if ((${#targets[@]} == 0)); then
    for source in tests/fuzz/*.cpp; do targets+=("$(basename "$source" .cpp)"); done
fi

megabytes=1024
# Short inputs run faster and reach the same code; these readers need longer ones.
declare -A longest=([checkpoint]=8192 [gltf]=4096 [exr]=4096 [oiio]=4096 [png]=2048 [jpeg]=2048 [scene]=2048 [study_json]=3072)
# Freed memory is kept for a while, to find its use: a little of it is enough. Short stacks of allocations and no filling
# of fresh memory make twice as many executions.
export ASAN_OPTIONS="quarantine_size_mb=16:malloc_context_size=4:max_malloc_fill_size=0:${ASAN_OPTIONS-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS-}"

# fuzz TARGET SECONDS: until they are over or something fails; the output goes to build/fuzz/TARGET.log.
fuzz() {
    local target=$1 crashes=build/fuzz/crashes/$1
    local options=(-timeout=1 "-rss_limit_mb=$megabytes" "-max_len=${longest[$1]-1024}" -close_fd_mask=1
        -print_final_stats=1 "-artifact_prefix=$crashes/" "-max_total_time=$2")
    if [[ -f tests/fuzz/dictionaries/$target.dict ]]; then options+=("-dict=tests/fuzz/dictionaries/$target.dict"); fi
    "build/fuzz/targets/fuzz_$target" "${options[@]}" "build/fuzz/corpus/$target" "$crashes" "tests/fuzz/corpus/$target" \
        >>"build/fuzz/$target.log" 2>&1 </dev/null
}

# Where other programs take the processor an input may seem slow: it is one if it takes a second again, alone.
drop_chance_timeouts() {
    local input again dropped=1
    for input in "build/fuzz/crashes/$1"/timeout-*; do
        [[ -f $input ]] || continue
        for ((again = 0; again < 3; ++again)); do
            if "build/fuzz/targets/fuzz_$1" -timeout=1 -close_fd_mask=1 "$input" >/dev/null 2>&1 </dev/null; then
                rm -f -- "$input"
                dropped=0
                break
            fi
        done
    done
    return $dropped
}

run_target() {
    local end=$((SECONDS + seconds)) left
    mkdir -p "build/fuzz/corpus/$1" "build/fuzz/crashes/$1"
    : >"build/fuzz/$1.log"
    for ((left = seconds; left > 0; left = end - SECONDS)); do
        if fuzz "$1" "$left" || ! drop_chance_timeouts "$1"; then break; fi
    done
}

# Of the log of a target: the sum (+) or the largest (>) of a figure over its runs.
figure() {
    awk -v name="stat::$2:" -v how="$3" '$1 == name { x = how == "+" ? x + $2 : $2 > x ? $2 : x } END { print x + 0 }' \
        "build/fuzz/$1.log"
}

# How many more edges were reached than by the inputs that there were.
new_coverage() {
    awk '{ for (i = 2; i < NF; ++i) if ($i == "cov:") { if (first == "" && $2 == "INITED") first = $(i + 1); last = $(i + 1) } }
         END { print last - (first == "" ? last : first) }' "build/fuzz/$1.log"
}

# add_executions TARGET N: to those of all runs. Prints their sum.
add_executions() {
    local file=build/fuzz/executions.txt before
    touch "$file"
    before=$(awk -v t="$1" '$1 == t { print $2 }' "$file")
    { grep -v "^$1 " "$file"; echo "$1 $((${before:-0} + $2))"; } | sort >"$file.new"
    mv "$file.new" "$file"
    echo $((${before:-0} + $2))
}

passed=0 failed=0
finish() {
    echo "$passed passed, $failed failed"
    exit $((failed > 0 || passed == 0))
}

if ! scripts/install-deps.sh --fuzz || ! build_preset fuzz; then
    failed=1
    finish
fi

running=0
for target in "${targets[@]}"; do
    if ((running >= jobs)); then wait -n; else running=$((running + 1)); fi
    run_target "$target" &
done
wait

format='%-16s %12s %14s %9s %8s %9s %8s\n'
# shellcheck disable=SC2059
printf "$format" target executions 'of all runs' 'new edges' crashes 'slowest s' 'peak MB'
for target in "${targets[@]}"; do
    executions=$(figure "$target" number_of_executed_units +)
    crashes=$(find "build/fuzz/crashes/$target" -type f | wc -l)
    # shellcheck disable=SC2059
    printf "$format" "$target" "$executions" "$(add_executions "$target" "$executions")" "$(new_coverage "$target")" \
        "$crashes" "$(figure "$target" slowest_unit_time_sec '>')" "$(figure "$target" peak_rss_mb '>')"
    if ((crashes == 0 && executions > 0)); then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        grep -a -m 3 -E 'ERROR: |runtime error: |SUMMARY: ' "build/fuzz/$target.log" || tail -n 5 "build/fuzz/$target.log"
    fi
done
awk '{ sum += $2 } END { print "executions of all runs: " sum }' build/fuzz/executions.txt
finish
