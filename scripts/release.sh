#!/usr/bin/env bash
# Makes what a release is made of, of HEAD: an archive that runs from any folder, Debian packages for this system,
# their checksums, and the part of the changelog. The same bytes each time: of one commit, with the same compiler and
# libraries. See docs/installing.md.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/release.sh [--build FOLDER] [--output FOLDER]
  --output FOLDER  where all goes; must not exist (build/release-VERSION)
  --build FOLDER   pack a build that is there, of the preset "package", in place of building
What CHANGELOG.md has no version for is a snapshot: VERSION~DATE.COMMIT, which any package manager takes for older than
VERSION.
END
}
fail() {
    echo "release.sh: error: $1" >&2
    exit 1
}

folder='' output=''
while (($#)); do
    case $1 in
        --build | --output)
            (($# > 1)) || { echo "release.sh: error: $1 needs a folder" >&2; exit 2; }
            if [[ $1 == --build ]]; then folder=$(realpath -m -- "$2"); else output=$(realpath -m -- "$2"); fi
            shift
            ;;
        -h | --help) usage; exit 0 ;;
        *) echo "release.sh: error: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh

for tool in git cmake cpack dpkg-shlibdeps gzip sha256sum; do
    command -v "$tool" >/dev/null || fail "$tool is missing: scripts/install-deps.sh --package"
done
[[ -z $(git status --porcelain) ]] || fail 'the work tree has changes; commit or remove them: git status'

number=$(sed -n 's/^project(lancer VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
section=$number version=$number
if ! grep -q -F "## [$number]" CHANGELOG.md; then
    section=Unreleased
    version=$number~$(TZ=UTC git log -1 --format=%cd --date=format-local:%Y%m%d).$(git log -1 --format=%h --abbrev=7)
fi
output=${output:-$PWD/build/release-$version}
[[ ! -e $output ]] || fail "$output exists already"

# Debian's own packages of later releases count as newer: 1~deb12 < 1~deb13 < 1.
release=1~$(. /etc/os-release && echo "${ID/debian/deb}${VERSION_ID-}")
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
umask 022

if [[ -z $folder ]]; then
    build_preset package
    folder=$PWD/build/package
fi
[[ -f $folder/CPackConfig.cmake ]] || fail "$folder was not made with the preset \"package\""

parts=$output.part.$$
trap 'rm -rf -- "$parts"' EXIT
mkdir -p "$parts"
(cd "$folder" && cpack -B "$parts/work" -D CPACK_DEBIAN_PACKAGE_VERSION="$version" \
    -D CPACK_DEBIAN_PACKAGE_RELEASE="$release" -D CPACK_PACKAGE_FILE_NAME="lancer-$version-linux-$(uname -m)") \
    >"$parts/cpack.log" 2>&1 || {
    tail -n 20 "$parts/cpack.log" >&2
    fail 'cpack failed; the end of its output stands above'
}
mkdir "$parts/out"
mv "$parts"/work/lancer*.deb "$parts"/work/lancer*.tar.gz "$parts/out/"
awk -v section="## [$section]" '
    index($0, "## ") == 1 { within = index($0, section) == 1; if (within) next }
    within { print }' CHANGELOG.md | sed -e '/./,$!d' >"$parts/out/CHANGES.md"
[[ -s $parts/out/CHANGES.md ]] || fail "CHANGELOG.md has no section [$section]"
(cd "$parts/out" && sha256sum -- * >SHA256SUMS)
mkdir -p "$(dirname -- "$output")"
mv -T -n -- "$parts/out" "$output"
[[ ! -e $parts/out ]] || fail "$output exists already"
ls -l --time-style=+ "$output"
