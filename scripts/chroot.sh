# shellcheck shell=bash
# Bare Debian systems in folders, for the scripts that try lancer on one; to be sourced. Needs root, debootstrap and
# the network. apt in there is configured as it is here.

# need_chroot_tools SCRIPT: ends the script unless all is there that a system in a folder needs.
need_chroot_tools() {
    local tool
    if ((EUID != 0)); then
        echo "$1: error: debootstrap, mount and chroot need root" >&2
        exit 1
    fi
    for tool in debootstrap git chroot findmnt; do
        command -v "$tool" >/dev/null || { echo "$1: error: $tool is missing" >&2; exit 1; }
    done
}

# This machine's first source of Debian packages, as apt itself understands it; Debian's own address without one.
debian_mirror() {
    local mirror
    # shellcheck disable=SC2016  # apt's own variables
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(ORIGIN) $(COMPONENT)' 2>/dev/null |
        awk '$2 == "Debian" && $3 == "main" && $1 !~ /security/ { print $1; exit }' || true)
    if [[ -z $mirror ]]; then
        mirror=$(sed -n -E 's/^URIs: *([^ ]+).*/\1/p; s/^deb( \[[^]]*\])? +([^ ]+).*/\2/p' \
            /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources} 2>/dev/null |
            grep -E '/debian/?$' | head -n 1 || true)
    fi
    echo "${mirror:-http://deb.debian.org/debian}"
}

# Configuration, not packages: how this machine reaches its mirror (settings, keys, certificates), with its own hooks
# left out, since they call programs that are not in there.
configure_apt_in() {
    local suite=$1 root=$2 file folder
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
}

# run_programs_of ARCHITECTURE: lets this machine run programs of another Debian architecture, by qemu.
run_programs_of() {
    local formats=/proc/sys/fs/binfmt_misc known
    [[ $1 != "$(dpkg --print-architecture)" ]] || return 0
    case $1 in
        arm64) known=qemu-aarch64 ;;
        *) echo "programs of $1 cannot be run here" >&2; return 1 ;;
    esac
    [[ -e $formats/register ]] || mount -t binfmt_misc binfmt_misc "$formats"
    [[ -e $formats/$known ]] || cat "/usr/lib/binfmt.d/$known.conf" >"$formats/register" || {
        echo "programs of $1 cannot be run here: qemu-user-static is missing, or the kernel has no binfmt_misc" >&2
        return 1
    }
}

# make_chroot SUITE ROOT PACKAGE...: a minimal Debian in the new folder ROOT, with these packages; of the architecture
# $chroot_architecture where that is set.
make_chroot() {
    local suite=$1 root=$2 log=$2.debootstrap.log packages architecture
    architecture=${chroot_architecture:-$(dpkg --print-architecture)}
    run_programs_of "$architecture"
    packages=$(IFS=, && echo "${*:3}")
    mkdir -p "$root"
    debootstrap --arch="$architecture" --variant=minbase --include="$packages" "$suite" "$root" "$(debian_mirror)" \
        >"$log" 2>&1 || {
        tail -n 20 "$log" >&2
        return 1
    }
    configure_apt_in "$suite" "$root"
    open_chroot "$root"
    inside "$root" update-ca-certificates >/dev/null 2>&1 || true
}

# open_chroot ROOT: mounts what programs in there need.
open_chroot() {
    mount -t proc proc "$1/proc"
    mkdir -p "$1/dev/shm"
    mount -t tmpfs -o mode=1777 tmpfs "$1/dev/shm"
    mkdir -p "$1/dev/pts"
    mount -t devpts -o ptmxmode=666 devpts "$1/dev/pts"  # terminals of its own
    ln -sf pts/ptmx "$1/dev/ptmx"
}

# inside ROOT COMMAND...: runs it in there.
inside() {
    local root=$1 variable proxies=()
    shift
    for variable in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
        if [[ -n ${!variable-} ]]; then proxies+=("$variable=${!variable}"); fi
    done
    chroot "$root" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        "${proxies[@]}" "$@" </dev/null
}

# Whatever is mounted below the folder, the deepest first.
mounts_inside() {
    findmnt -rn -o TARGET | awk -v base="$1/" 'index($0, base) == 1' | sort -r
}

# remove_chroots BASE: removes the folder BASE with the systems in it. Nothing is removed while anything is still
# mounted inside, and rm stays on the folder's own file system.
remove_chroots() {
    close_chroots "$1" && rm -rf --one-file-system -- "$1"
}

# close_chroots BASE: unmounts all below the folder; false, with a message, where that fails.
close_chroots() {
    local target
    while read -r target; do umount "$target" || umount -l "$target" || true; done < <(mounts_inside "$1")
    [[ -z $(mounts_inside "$1") ]] && return 0  # in a trap, return alone would give the status from before it
    echo "still mounted, left alone: $(mounts_inside "$1" | tr '\n' ' ')" >&2
    return 1
}

# clone_into ROOT: HEAD of the repository in the working folder becomes /srv/lancer in there. A bundle is one file with
# the history: nothing of this machine needs to be visible.
clone_into() {
    git bundle create -q "$1/srv/lancer.bundle" HEAD
    inside "$1" git -c advice.detachedHead=false clone -q /srv/lancer.bundle /srv/lancer
}
