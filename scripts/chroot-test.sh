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
unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/chroot.sh
source scripts/chroot.sh
need_chroot_tools chroot-test.sh

base=$(mktemp -d "${TMPDIR:-/tmp}/lancer-chroot.XXXXXXXX")
base=$(cd -- "$base" && pwd -P)
root=$base/root

clean_up() {
    local status=$?
    trap - EXIT
    if $keep; then
        close_chroots "$base"
        echo "Left for a look: $root"
    else
        remove_chroots "$base"
    fi
    exit "$status"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

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

timed "debootstrap $suite" make_chroot "$suite" "$root" git ca-certificates
clone_into "$root"
inside "$root" git -C /srv/lancer log -1 --format='Testing %h %s'

result=0
timed 'scripts/install-deps.sh' inside "$root" /srv/lancer/scripts/install-deps.sh || result=1
if $demo; then timed 'scripts/demo.sh --quick' inside "$root" /srv/lancer/scripts/demo.sh --quick || result=1; fi
timed 'scripts/test.sh' inside "$root" /srv/lancer/scripts/test.sh || result=1
timed 'scripts/test.sh again' inside "$root" /srv/lancer/scripts/test.sh || result=1

echo
du -sh --one-file-system "$root" | awk '{ print "Size of the system with build: " $1 }'
printf '%s\n' "${times[@]}"
exit "$result"
