#!/usr/bin/env bash
# For developers: makes the packages of HEAD on a bare Debian and installs them on another that has nothing else: a
# render, the manual, completions, the window, the archive, removal. Needs root, debootstrap, git and the network.
# shellcheck disable=SC2016,SC2317  # scripts for other shells; what traps and "check" call is reachable
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/package-test.sh [--keep] [--packages FOLDER [--arch NAME]] [--ccache FOLDER] [SUITE]
  SUITE              bookworm (default) or trixie
  --packages FOLDER  try these, made by scripts/release.sh on that Debian, in place of building
  --arch NAME        these are for that architecture (arm64); qemu runs what is installed, ten times slower
  --ccache FOLDER    what a build of the same suite kept there, and where this one keeps it
  --keep             leave the folders for a look
END
}

suite=bookworm keep=false packages='' cache='' chroot_architecture=''
while (($#)); do
    case $1 in
        --keep) keep=true ;;
        --packages | --ccache | --arch)
            (($# > 1)) || { echo "package-test.sh: error: $1 needs an argument" >&2; exit 2; }
            case $1 in
                --packages) packages=$(realpath -- "$2") ;;
                --ccache) cache=$(realpath -m -- "$2") ;;
                --arch) chroot_architecture=$2 ;;
            esac
            shift
            ;;
        -h | --help) usage; exit 0 ;;
        bookworm | trixie) suite=$1 ;;
        *) echo "package-test.sh: error: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done

if [[ -n $chroot_architecture && -z $packages ]]; then
    echo 'package-test.sh: error: --arch needs --packages: scripts/arm64.sh --package makes them' >&2
    exit 2
fi

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/chroot.sh
source scripts/chroot.sh
need_chroot_tools package-test.sh

base=$(mktemp -d "${TMPDIR:-/tmp}/lancer-packages.XXXXXXXX")
base=$(cd -- "$base" && pwd -P)
clean_up() {
    local status=$?
    trap - EXIT
    if $keep; then
        close_chroots "$base"
        echo "Left for a look: $base"
    else
        remove_chroots "$base"
    fi
    exit "$status"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# In both systems, with low priority: others may work on this machine.
apt_in() {
    inside "$1" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 "${@:2}" >"$base/apt.log" 2>&1 || {
        tail -n 15 "$base/apt.log" >&2
        return 1
    }
}

# Builds in a system of its own, twice packed: the second time must give the same bytes.
build_packages() {
    local root=$base/builder
    make_chroot "$suite" "$root" git ca-certificates
    clone_into "$root"
    inside "$root" /srv/lancer/scripts/install-deps.sh --package
    if [[ -n $cache ]]; then
        apt_in "$root" install -y --no-install-recommends ccache
        mkdir -p "$cache" "$root/root/.cache/ccache"
        mount --bind "$cache" "$root/root/.cache/ccache"
    fi
    inside "$root" nice -n 10 /srv/lancer/scripts/release.sh --output /srv/packages
    inside "$root" nice -n 10 /srv/lancer/scripts/release.sh --output /srv/again --build /srv/lancer/build/package
    cmp "$root/srv/packages/SHA256SUMS" "$root/srv/again/SHA256SUMS"
    cp -r "$root/srv/packages" "$base/packages"
    packages=$base/packages
}

failed=0
# check NAME COMMAND...: what must succeed.
check() {
    local name=$1 start=$SECONDS
    shift
    if "$@" >"$base/check.log" 2>&1; then
        echo "ok: $name ($((SECONDS - start)) s)"
    else
        failed=1
        echo "FAILED: $name"
        tail -n 15 "$base/check.log" | sed 's/^/    /'
    fi
}
# Runs a script in the bare system, in a folder of its own that is empty.
shell() {
    inside "$base/bare" bash -euc 'cd "$(mktemp -d)"; '"$1"
}

if [[ -z $packages ]]; then
    echo "Building packages on a bare $suite"
    build_packages
fi
ls -l --time-style=+ "$packages"

root=$base/bare
make_chroot "$suite" "$root" ca-certificates
mkdir "$root/srv/try"
cp "$packages"/* "$root/srv/try/"
cp tests/completions.sh "$root/srv/try/"
check 'checksums' shell 'cd /srv/try; sha256sum -c SHA256SUMS'
apt_in "$root" update
before=$(inside "$root" dpkg-query -W -f '.' | wc -c)
deb() { (cd "$packages" && printf '/srv/try/%s' "$1"_*.deb); }
check 'apt install, no recommended packages' apt_in "$root" install -y --no-install-recommends "$(deb lancer)"
((failed == 0)) || exit 1
# shellcheck disable=SC2012
echo "    $(($(inside "$root" dpkg-query -W -f '.' | wc -c) - before)) packages; lancer takes $(
    inside "$root" dpkg-query -W -f '${Installed-Size}' lancer) KiB"
check 'at most 8 MB' test "$(inside "$root" dpkg-query -W -f '${Installed-Size}' lancer)" -le 7812
check 'scenes and documents' apt_in "$root" install -y --no-install-recommends "$(deb lancer-scenes)" "$(deb lancer-doc)"
check 'a render from an empty folder' shell '
    lancer /usr/share/lancer/scenes/still_life.toml --size 96x54 -s 8 -q -o a.png
    [[ $(ls) == a.png && $(head -c 4 a.png | tail -c 3) == PNG ]]'
check 'a scene with textures' shell '
    lancer render /usr/share/lancer/scenes/still_life_textured.toml --size 96x54 -s 2 -q -o a.exr
    lancer verify a.exr'
check 'no library of a module is there' shell '
    if ldd /usr/bin/lancer | grep -E "OpenImageIO|OpenColorIO|glfw|libGL|not found"; then exit 1; fi
    if ls /usr/lib/*/libOpenImageIO.so.*; then exit 1; fi'
check 'what needs one says so' shell '
    lancer /usr/share/lancer/scenes/cornell.toml --size 32x32 -s 1 -q -o a.ppm
    lancer compare a.ppm a.ppm 2>said && exit 1
    grep -q "lancer_oiio.so: error: cannot be opened: libOpenImageIO" said
    lancer view /usr/share/lancer/scenes/cornell.toml 2>said && exit 1
    grep -q "lancer_view.so, " said'

apt_in "$root" install -y --no-install-recommends man-db bash-completion zsh fish
check 'man lancer-render' shell 'man lancer-render | col -b | grep -q -e "--integrator path|direct"; man -w lancer lancer-view'
check 'bash finds the completion' shell '
    source /usr/share/bash-completion/bash_completion
    _comp_load lancer 2>/dev/null || _completion_loader lancer || true
    complete -p lancer | grep -q _lancer'
check 'completions of bash, zsh and fish' shell '
    ln -s /usr/share/bash-completion/completions/lancer lancer.bash
    ln -s /usr/share/fish/vendor_completions.d/lancer.fish .
    ln -s /usr/share/zsh/vendor-completions/_lancer .
    bash /srv/try/completions.sh .'
check 'zsh and fish find them' shell '
    zsh -f -c "autoload -Uz compinit; compinit -u -D; (( \$+_comps[lancer] ))"
    fish -c "complete -C \"lancer render --integ\"" | grep -q -e --integrator'

recommended=$(inside "$root" dpkg-query -W -f '${Recommends}' lancer | sed -E 's/\([^)]*\)//g; s/,/ /g')
# shellcheck disable=SC2086  # a list
check 'recommended packages' apt_in "$root" install -y --no-install-recommends $recommended
check 'a picture that OpenImageIO reads' shell '
    lancer /usr/share/lancer/scenes/cornell.toml --size 32x32 -s 1 -q -o a.ppm -o a.png
    lancer compare a.ppm a.png --fail-above 0.001'
check 'the window' apt_in "$root" install -y --no-install-recommends "$(deb lancer-view)"
apt_in "$root" install -y --no-install-recommends xvfb xdotool libgl1-mesa-dri
check 'lancer view under Xvfb' shell '
    exec 3<>display
    Xvfb -displayfd 3 -screen 0 800x600x24 3>display 2>/dev/null &
    xvfb=$!
    trap "kill $xvfb" EXIT
    for ((i = 0; i < 100; i++)); do [[ ! -s display ]] || break; sleep 0.1; done
    export DISPLAY=:$(tr -d "\n" <display) LIBGL_ALWAYS_SOFTWARE=1
    lancer view /usr/share/lancer/scenes/spheres.toml --size 160x90 -s 2 -o view.png &
    view=$!
    find_window() { xdotool search --onlyvisible --name "^lancer " "$@"; }
    for ((i = 0; i < 300; i++)); do ! find_window >/dev/null || break; sleep 0.1; done
    find_window windowmove 0 0 windowfocus --sync
    for ((i = 0; i < 100; i++)); do [[ ! -s view.png ]] || break; xdotool key ctrl+r; sleep 0.3; done
    xdotool key ctrl+q
    wait $view
    [[ $(head -c 4 view.png | tail -c 3) == PNG ]]'

apt_in "$root" install -y --no-install-recommends gcc libc6-dev pkg-config python3-numpy
check 'the library' apt_in "$root" install -y --no-install-recommends "$(deb lancer-dev)"
check 'a C program' shell '
    printf "%s\n" "#include <lancer.h>" "#include <stdio.h>" "int main(void) { return puts(lancer_version()) < 0; }" >use.c
    gcc use.c -o use $(pkg-config --cflags --libs lancer)
    [[ $(./use) == $(lancer --version | sed -n "1s/lancer //p") ]]'
check 'Python' shell '
    python3 -c "import lancer; assert lancer.render(\"/usr/share/lancer/scenes/still_life_textured.toml\", spp=1, size=(16, 9))[\"color\"].shape == (9, 16, 3)"'

check 'purge' apt_in "$root" purge -y lancer lancer-view lancer-dev lancer-scenes lancer-doc
check 'nothing is left' shell '
    # man itself keeps pages that were read.
    left=$(find / -xdev -iname "*lancer*" -not -path "/srv/*" -not -path "/tmp/*" -not -path "/var/cache/man/*")
    echo "$left"
    [[ -z $left ]]'
check 'the archive runs from any folder' shell '
    mkdir "any folder"
    tar -xzf /srv/try/lancer-*.tar.gz -C "any folder"
    "any folder"/lancer-*/bin/lancer "any folder"/lancer-*/share/lancer/scenes/cornell.toml --size 32x32 -s 1 -q -o a.ppm -o a.png
    "any folder"/lancer-*/bin/lancer compare a.ppm a.png --fail-above 0.001'

if ((failed)); then
    echo "Packages on $suite: something failed"
else
    echo "Packages on $suite: all is well"
fi
exit "$failed"
