#!/usr/bin/env bash
# For developers: tries the two commands of the README on a machine that has nothing. Makes a minimal Debian in a
# folder of its own, clones HEAD of this repository into it and runs there scripts/demo.sh --quick and scripts/test.sh.
# Needs root, debootstrap, git and the network. apt in there is configured as it is here.
# shellcheck disable=SC2317  # what traps and "timed" call is reachable
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/chroot-test.sh [--keep] [--no-demo] [SUITE]
  SUITE      bookworm (default) or trixie
  --keep     leave the folder for a look
  --no-demo  only scripts/test.sh
END
}

suite=bookworm
keep=false
demo=true
while (($#)); do
    case $1 in
        --keep) keep=true ;;
        --no-demo) demo=false ;;
        -h | --help) usage; exit 0 ;;
        bookworm | trixie) suite=$1 ;;
        *) echo "chroot-test.sh: error: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done
if ((EUID != 0)); then
    echo 'chroot-test.sh: error: debootstrap, mount and chroot need root' >&2
    exit 1
fi
for tool in debootstrap git chroot findmnt; do
    command -v "$tool" >/dev/null || { echo "chroot-test.sh: error: $tool is missing" >&2; exit 1; }
done

unset CDPATH
repository=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
base=$(mktemp -d "${TMPDIR:-/tmp}/lancer-chroot.XXXXXXXX")
base=$(cd -- "$base" && pwd -P)
root=$base/root
mkdir "$root"

# Whatever is mounted below the folder, the deepest first.
mounts_inside() {
    findmnt -rn -o TARGET | awk -v base="$base/" 'index($0, base) == 1' | sort -r
}

# Nothing is removed while anything is still mounted inside, and rm stays on the folder's own file system.
clean_up() {
    local status=$? target
    trap - EXIT
    while read -r target; do umount "$target" || umount -l "$target" || true; done < <(mounts_inside)
    if [[ -n $(mounts_inside) ]]; then
        echo "chroot-test.sh: still mounted, left alone: $(mounts_inside | tr '\n' ' ')" >&2
    elif $keep; then
        echo "Left for a look: $root"
    else
        rm -rf --one-file-system -- "$base"
    fi
    exit "$status"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

inside() {
    chroot "$root" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        "${proxies[@]}" "$@" </dev/null
}

timed() {
    local name=$1 start=$SECONDS status=0
    shift
    echo "== $name"
    "$@" || status=$?
    echo "== $name: $((SECONDS - start)) s, exit code $status"
    times+=("$name: $((SECONDS - start)) s, exit code $status")
    return "$status"
}
times=()

proxies=()
for variable in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    if [[ -n ${!variable-} ]]; then proxies+=("$variable=${!variable}"); fi
done

# This machine's first source of Debian packages, as apt itself understands it; Debian's own address without one.
# shellcheck disable=SC2016  # apt's own variables
mirror=$(apt-get indextargets --format '$(REPO_URI) $(ORIGIN) $(COMPONENT)' 2>/dev/null |
    awk '$2 == "Debian" && $3 == "main" && $1 !~ /security/ { print $1; exit }' || true)
if [[ -z $mirror ]]; then
    mirror=$(sed -n -E 's/^URIs: *([^ ]+).*/\1/p; s/^deb( \[[^]]*\])? +([^ ]+).*/\2/p' \
        /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources} 2>/dev/null |
        grep -E '/debian/?$' | head -n 1 || true)
fi
mirror=${mirror:-http://deb.debian.org/debian}

debootstrap_log=$base/debootstrap.log
bootstrap() {
    debootstrap --variant=minbase --include=git,ca-certificates "$suite" "$root" "$mirror" >"$debootstrap_log" 2>&1 || {
        tail -n 20 "$debootstrap_log" >&2
        return 1
    }
}
timed "debootstrap $suite" bootstrap

# Configuration, not packages: how this machine reaches its mirror (settings, keys, certificates), with its own hooks
# left out, since they call programs that are not in there.
for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/*; do
    if [[ -f $file ]] && grep -q -E 'Acquire|Proxy' "$file" && ! grep -q -E 'DPkg::|Invoke|IndexTargets' "$file"; then
        mkdir -p "$root$(dirname -- "$file")"
        cp -L -- "$file" "$root$file"
    fi
done
for folder in /etc/apt/auth.conf.d /etc/apt/keyrings /etc/apt/trusted.gpg.d /usr/local/share/ca-certificates; do
    if [[ -d $folder ]]; then
        mkdir -p "$root$folder"
        cp -rL -- "$folder/." "$root$folder/"
    fi
done
if [[ $suite == "$(. /etc/os-release && echo "${VERSION_CODENAME-}")" ]]; then
    rm -f "$root/etc/apt/sources.list"
    mkdir -p "$root/etc/apt/sources.list.d"
    if [[ -f /etc/apt/sources.list ]]; then cp -L /etc/apt/sources.list "$root/etc/apt/"; fi
    for file in /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
        if [[ -f $file ]]; then cp -L -- "$file" "$root/etc/apt/sources.list.d/"; fi
    done
fi  # else: what debootstrap wrote, with the same mirror
cp -L /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
cp -L /etc/hosts "$root/etc/hosts" 2>/dev/null || true

mount -t proc proc "$root/proc"
mkdir -p "$root/dev/shm"
mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
inside update-ca-certificates >/dev/null 2>&1 || true

# A bundle is one file with the history: nothing of this machine needs to be visible in there.
git -C "$repository" bundle create -q "$root/srv/lancer.bundle" HEAD
inside git -c advice.detachedHead=false clone -q /srv/lancer.bundle /srv/lancer
inside git -C /srv/lancer log -1 --format='Testing %h %s'

result=0
timed 'scripts/install-deps.sh' inside /srv/lancer/scripts/install-deps.sh || result=1
if $demo; then timed 'scripts/demo.sh --quick' inside /srv/lancer/scripts/demo.sh --quick || result=1; fi
timed 'scripts/test.sh' inside /srv/lancer/scripts/test.sh || result=1
timed 'scripts/test.sh again' inside /srv/lancer/scripts/test.sh || result=1

echo
du -sh --one-file-system "$root" | awk '{ print "Size of the system with build: " $1 }'
printf '%s\n' "${times[@]}"
exit "$result"
