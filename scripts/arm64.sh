#!/usr/bin/env bash
# Cross-compiles lancer for arm64 and compares its pictures, drawn in qemu, with those of this machine's build.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/arm64.sh [--folder FOLDER] [--package] [TEST...]
  --folder FOLDER  where to build (build/arm64): root/ becomes a Debian 12 for arm64 with all libraries, 2.5 GB
  --package        makes FOLDER/packages as well, as scripts/release.sh does: of HEAD, the work tree without changes
  TEST...          also builds and runs these test programs: core, geometry, materials, integrators
Needs root, debootstrap, qemu-user-static, g++-aarch64-linux-gnu and build/release/lancer. Building takes as long as here,
a picture in qemu ten times as long. scripts/package-test.sh --arch arm64 --packages FOLDER/packages tries the packages.
END
}
fail() { echo "arm64.sh: error: $1" >&2; exit 1; }

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
folder=$PWD/build/arm64 tests=() package=false
while (($#)); do
    case $1 in
        --folder)
            (($# > 1)) || { echo "arm64.sh: error: --folder needs a folder" >&2; exit 2; }
            folder=$(cd -- "$started_in" && realpath -m -- "$2")
            shift
            ;;
        --package) package=true ;;
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
need_chroot_tools arm64.sh
for tool in qemu-aarch64-static aarch64-linux-gnu-g++; do
    command -v "$tool" >/dev/null || fail "$tool is missing"
done
here=$PWD/build/release/lancer
[[ -x $here ]] || fail "no program $here: cmake --preset release && cmake --build --preset release"
run_programs_of arm64

root=$folder/root
mkdir -p "$folder"
trap 'close_chroots "$folder"' EXIT
if [[ ! -e $folder/toolchain.cmake ]]; then
    [[ ! -e $root ]] || fail "$root is of a run that was stopped: remove it"
    chroot_architecture=arm64
    make_chroot bookworm "$root" ca-certificates
    mkdir "$root/srv/lancer"
    cp -r scripts "$root/srv/lancer/"
    inside "$root" /srv/lancer/scripts/install-deps.sh --package >"$folder/packages.log" 2>&1 ||
        { tail -n 20 "$folder/packages.log" >&2; exit 1; }
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
set(ENV{PKG_CONFIG_LIBDIR} $root/usr/lib/aarch64-linux-gnu/pkgconfig:$root/usr/share/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} $root)
END
elif [[ ! -e $root/proc/self ]]; then
    open_chroot "$root"
fi
configure() {
    cmake --preset package -B "$folder/build" -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" -DLANCER_TESTS="$1" \
        >"$folder/cmake.log" 2>&1 || { tail -n 25 "$folder/cmake.log" >&2; exit 1; }
}
configure OFF
if $package; then targets=all; else targets=lancer; fi
cmake --build "$folder/build" -j "$(build_jobs)" --target "$targets"
there=(qemu-aarch64-static -L "$root" "$folder/build/lancer")
"${there[@]}" --version

# cpack asks dpkg which packages the libraries are from, so it runs in there, with both folders where they are here.
if $package; then
    for place in "$PWD" "$folder"; do
        mkdir -p "$root$place"
        mount --bind "$place" "$root$place"
    done
    inside "$root" git config --global --add safe.directory "$PWD"
    inside "$root" "$PWD/scripts/release.sh" --build "$folder/build" --output "$folder/packages"
    for place in "$folder" "$PWD"; do umount "$root$place"; done
fi

failed=0
if ((${#tests[@]})); then
    configure ON
    cmake --build "$folder/build" -j "$(build_jobs)" --target "${tests[@]/%/_tests}"
fi
# A test program is split over all cores: alone, the slowest runs for hours.
for test in "${tests[@]}"; do
    parts=()
    for ((part = 0; part < $(nproc); ++part)); do
        GTEST_TOTAL_SHARDS=$(nproc) GTEST_SHARD_INDEX=$part \
            qemu-aarch64-static -L "$root" "$folder/build/tests/${test}_tests" --gtest_brief=1 &
        parts+=($!)
    done
    for part in "${parts[@]}"; do wait "$part" || failed=1; done
done
for scene in cornell spheres still_life materials room bathroom atrium seed-a/presets seed-a/water; do
    how=("scenes/$scene.toml" --size 64x36 -s 4 --accel bvh8 -q)
    "$here" render "${how[@]}" -o "$folder/here.exr" >/dev/null
    "${there[@]}" render "${how[@]}" -o "$folder/there.exr" >/dev/null
    "$here" compare "$folder/there.exr" "$folder/here.exr" --fail-above 0 >"$folder/compare.txt" 2>&1 || failed=1
    printf '%-16s %s\n' "$scene" "$(grep differing_pixels "$folder/compare.txt")"
done
exit "$failed"
