#!/usr/bin/env bash
# Cross-compiles lancer for arm64 and compares its pictures, drawn in qemu, with those of this machine's build.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/arm64.sh [--folder FOLDER] [TEST...]
  --folder FOLDER  where to build (build/arm64): root/ has Debian 12's libraries for arm64, 400 MB
  TEST...          also builds and runs these test programs: core, geometry, materials, integrators
Needs root, debootstrap, qemu-user-static, g++-aarch64-linux-gnu and build/release/lancer. Building takes as long as here,
a picture in qemu ten times as long.
END
}
fail() { echo "arm64.sh: error: $1" >&2; exit 1; }

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
folder=$PWD/build/arm64 tests=()
while (($#)); do
    case $1 in
        --folder)
            (($# > 1)) || { echo "arm64.sh: error: --folder needs a folder" >&2; exit 2; }
            folder=$(cd -- "$started_in" && realpath -m -- "$2")
            shift
            ;;
        -h | --help) usage; exit 0 ;;
        core | geometry | materials | integrators) tests+=("$1") ;;
        *) echo "arm64.sh: error: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done
# shellcheck source=scripts/chroot.sh
source scripts/chroot.sh
# shellcheck source=scripts/common.sh
source scripts/common.sh
for tool in debootstrap qemu-aarch64-static aarch64-linux-gnu-g++; do
    command -v "$tool" >/dev/null || fail "$tool is missing"
done
here=$PWD/build/release/lancer
[[ -x $here ]] || fail "no program $here: cmake --preset release && cmake --build --preset release"

# Packages are unpacked and none is configured: the compiler wants their files, and no program in there runs.
root=$folder/root
if [[ ! -e $folder/toolchain.cmake ]]; then
    mkdir -p "$folder"
    packages=$(scripts/install-deps.sh --list | grep -E '^lib|^zlib|^nlohmann' |
        grep -v -E 'openimageio|opencolorio|meshoptimizer|draco|glfw|imgui|libgl-dev' | paste -s -d ,)
    debootstrap --foreign --arch=arm64 --variant=minbase --include="$packages,libc6-dev,libstdc++-12-dev" bookworm \
        "$root" "$(debian_mirror)" >"$folder/debootstrap.log" 2>&1 || { tail -n 20 "$folder/debootstrap.log" >&2; exit 1; }
    for package in "$root"/var/cache/apt/archives/*.deb; do dpkg-deb -x "$package" "$root"; done
    cat >"$folder/toolchain.cmake" <<END
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_SYSROOT $root)
set(CMAKE_FIND_ROOT_PATH $root)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(what LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_\${what} ONLY)
endforeach()
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L $root)
END
fi
without=(-DLANCER_WITH_OIIO=OFF -DLANCER_WITH_OCIO=OFF -DLANCER_WITH_GLTF_COMPRESSION=OFF -DLANCER_WITH_VIEW=OFF)
cmake -S . -B "$folder/build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
    "${without[@]}" >"$folder/cmake.log" 2>&1 || { tail -n 25 "$folder/cmake.log" >&2; exit 1; }
cmake --build "$folder/build" -j "$(build_jobs)" --target lancer "${tests[@]/%/_tests}"
there=(qemu-aarch64-static -L "$root" "$folder/build/lancer")
"${there[@]}" --version

failed=0
for test in "${tests[@]}"; do
    qemu-aarch64-static -L "$root" "$folder/build/tests/${test}_tests" --gtest_brief=1 || failed=1
done
for scene in cornell spheres still_life materials room bathroom atrium seed-a/presets seed-a/water; do
    how=("scenes/$scene.toml" --size 64x36 -s 4 --accel bvh8 -q)
    "$here" render "${how[@]}" -o "$folder/here.exr" >/dev/null
    "${there[@]}" render "${how[@]}" -o "$folder/there.exr" >/dev/null
    "$here" compare "$folder/there.exr" "$folder/here.exr" --fail-above 0 >"$folder/compare.txt" 2>&1 || failed=1
    printf '%-16s %s\n' "$scene" "$(grep differing_pixels "$folder/compare.txt")"
done
exit "$failed"
