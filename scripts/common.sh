# shellcheck shell=bash
# What the scripts share; to be sourced with the repository's root as working folder.

# A command that builds and tests run under: environment variables of the sanitizers.
run_under=(env)

# Compiler processes at a time: one for each CPU, but not more than memory allows (1.5 GB each).
build_jobs() {
    local jobs kib
    if [[ -n ${CMAKE_BUILD_PARALLEL_LEVEL-} ]]; then
        echo "$CMAKE_BUILD_PARALLEL_LEVEL"
        return
    fi
    jobs=$(nproc 2>/dev/null || echo 2)
    kib=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo 2>/dev/null || true)
    if [[ -n $kib ]] && ((jobs > kib / 1500000)); then jobs=$((kib / 1500000)); fi
    echo $((jobs > 0 ? jobs : 1))
}

# build_preset PRESET [--target TARGET] [-DOPTION...]: configures and builds. The output goes to build/PRESET/build.log;
# if something fails, its end is shown and the result is 1.
build_preset() {
    local preset=$1 log=build/$1/build.log start=$SECONDS
    local configure=() build=()
    shift
    while (($#)); do
        case $1 in
            --target) build+=(--target "$2"); shift ;;
            *) configure+=("$1") ;;
        esac
        shift
    done
    mkdir -p "build/$preset"
    echo "Building preset $preset (log: $log)"
    if ! cmake --preset "$preset" "${configure[@]}" >"$log" 2>&1 </dev/null; then
        tail -n 40 "$log"
        echo "Configuring preset $preset failed; the end of $log stands above."
        return 1
    fi
    if ! "${run_under[@]}" cmake --build --preset "$preset" -j "$(build_jobs)" "${build[@]}" >>"$log" 2>&1 </dev/null; then
        # The first errors say more than the last lines of a parallel build.
        if grep -q -E 'error: |undefined reference' "$log"; then
            grep -n -m 15 -A 4 -E 'error: |undefined reference' "$log"
            echo '...'
        fi
        tail -n 25 "$log"
        echo "Building preset $preset failed; the end of $log stands above."
        return 1
    fi
    echo "Built preset $preset in $((SECONDS - start)) s"
}
