#!/usr/bin/env bash
# Installs, with apt, the packages that building and testing lancer needs and that are missing.
# Known to be right for Debian 12, Debian 13 and Ubuntu 24.04. Touches nothing, the network included, if all are there.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/install-deps.sh [--list | --fuzz | --package | --site]
  --list     print the packages and install nothing
  --fuzz     also what scripts/fuzz.sh needs
  --package  also what scripts/release.sh needs
  --site     only what scripts/site.sh needs
LANCER_SKIP_DEPS=1 takes it as read that everything is installed.
END
}

packages=(
    g++ cmake ninja-build pkg-config                        # the build
    libembree-dev libtbb-dev                                # rays, threads
    libtinyobjloader-dev libtomlplusplus-dev                # scenes
    libopenimageio-dev libopenexr-dev libimath-dev libpng-dev libjpeg-dev # pictures
    libopencolorio-dev                                      # their colours
    zlib1g-dev liblzma-dev libzstd-dev                      # compressed meshes
    libcli11-dev nlohmann-json3-dev                         # command line, reports
    libmeshoptimizer-dev libdraco-dev                       # compressed glTF files
    libosd-dev                                              # subdivision by Catmull and Clark
    libglfw3-dev libimgui-dev libgl-dev                     # the window
    libgtest-dev libgmock-dev                               # tests
)

say() { printf '%s\n' "$*"; }
fail() {
    printf 'install-deps: error: %s\n' "$1" >&2
    shift
    if (($#)); then printf '  %s\n' "$@" >&2; fi
    exit 1
}

case ${1-} in
    '') ;;
    --fuzz) packages+=(clang libclang-rt-dev zlib1g-dev) ;;
    --package) packages+=(git dpkg-dev) ;;
    --site) packages=(mkdocs) ;;
    --list) printf '%s\n' "${packages[@]}"; exit 0 ;;
    -h | --help) usage; exit 0 ;;
    *) printf "install-deps: error: unknown option '%s'\n" "$1" >&2; usage >&2; exit 2 ;;
esac
[[ ${LANCER_SKIP_DEPS-} != 1 ]] || exit 0

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f='${Status}\n' "$package" 2>/dev/null) || status=
    [[ $status == *'install ok installed'* ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

if ! command -v apt-get >/dev/null; then
    fail 'this system has no apt-get.' \
        'Install what corresponds to these Debian packages, then run this again with LANCER_SKIP_DEPS=1:' \
        "${missing[*]}"
fi

as_root=()
if ((EUID != 0)); then
    command -v sudo >/dev/null || fail 'packages are missing; installing them needs root, and there is no sudo.' \
        'As root, run:' "apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT

apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive NEEDRESTART_SUSPEND=1 \
        apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" </dev/null >"$log" 2>&1
}

say "Installing ${#missing[@]} packages with apt (a minute or two if none is there): ${missing[*]}"
SECONDS=0

# By itself, apt-get update reports success even if it could not download anything.
for attempt in 1 2 3; do
    if apt_get update -o APT::Update::Error-Mode=any; then break; fi
    if ((attempt == 3)); then
        # One broken source among many need not matter: the installation decides.
        say 'warning: apt-get update had trouble; going on with the package lists there are:'
        tail -n 5 "$log"
    else
        say "apt-get update failed (attempt $attempt of 3), trying again"
        sleep $((attempt * 5))
    fi
done

if ! apt_get install -y --no-install-recommends \
    -o Dpkg::Options::=--force-confdef -o Dpkg::Options::=--force-confold "${missing[@]}"; then
    tail -n 25 "$log" >&2
    fail 'apt could not install what is missing (the end of its output stands above).' \
        "Missing: ${missing[*]}" \
        'Known to work: Debian 12, Debian 13, Ubuntu 24.04 (with its "universe" component).'
fi
say "Installed in $SECONDS s."
