#!/usr/bin/env bash
# scripts/release.sh refuses a work tree with changes, and to replace what is there; skipped (77) where the source is no
# clone.
# usage: tests/release.sh SOURCE
set -euo pipefail
git -C "$1" rev-parse HEAD >/dev/null 2>&1 || exit 77
for tool in cpack dpkg-shlibdeps; do command -v "$tool" >/dev/null || exit 77; done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
git clone -q --shared -- "$1" "$scratch/clone"
cp "$1/scripts/release.sh" "$1/scripts/common.sh" "$scratch/clone/scripts/"
git -C "$scratch/clone" -c user.name=a -c user.email=a@localhost commit -qam 'As it is now' >/dev/null || true
failed=0

# expect WORDS ARGUMENT...: it fails, says so, and leaves nothing new beside the clone.
expect() {
    local words=$1 code=0
    shift
    "$scratch/clone/scripts/release.sh" "$@" >"$scratch/said" 2>&1 || code=$?
    if ((code != 1)) || ! grep -q -F -- "$words" "$scratch/said"; then
        failed=1
        echo "release.sh $*: exit code $code, says: $(head -n 3 "$scratch/said"); expected: $words"
    fi
}

mkdir "$scratch/there" "$scratch/empty"
touch "$scratch/there/file"
expect 'exists already' --output "$scratch/there" --build "$scratch/empty"
expect 'was not made with the preset' --output "$scratch/new" --build "$scratch/empty"
touch "$scratch/clone/new file"
expect 'has changes' --output "$scratch/new" --build "$scratch/empty"
rm "$scratch/clone/new file"
echo >>"$scratch/clone/README.md"
expect 'has changes' --output "$scratch/new" --build "$scratch/empty"
if [[ $(ls "$scratch") != $'clone\nempty\nsaid\nthere' || $(ls "$scratch/there") != file ]]; then
    failed=1
    echo "release.sh leaves: $(ls "$scratch" "$scratch/there")"
fi
exit "$failed"
