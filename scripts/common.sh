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

# copy_source SCRATCH: brings SCRATCH/source, a copy of what builds and draws, up to date and configures SCRATCH/build.
# Only what changed gets a new time, so that a second build compiles little. The output goes to SCRATCH/build.log; if
# cmake fails, its end is shown and the result is 1.
copy_source() {
    local scratch=$1
    mkdir -p "$scratch/source"
    git ls-files -z --cached --others --exclude-standard -- \
        CMakeLists.txt CMakePresets.json LICENSE cmake src share tests scenes bench/harness bench/report |
        while IFS= read -r -d '' file; do
            if cmp -s "$file" "$scratch/source/$file"; then continue; fi
            mkdir -p "$scratch/source/$(dirname "$file")"
            cp "$file" "$scratch/source/$file"
        done
    if ! (cd "$scratch/source" && cmake --preset release -B "$scratch/build" -DLANCER_WERROR=OFF) \
        >"$scratch/build.log" 2>&1; then
        tail -n 25 "$scratch/build.log"
        return 1
    fi
}

# patch_source SCRATCH PATCH [--reverse]: the copy lies within a repository and is none itself.
patch_source() {
    (cd "$1/source" && GIT_CEILING_DIRECTORIES=$1 git apply -p1 "${@:3}" "$2")
}
