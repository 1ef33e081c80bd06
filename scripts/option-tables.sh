#!/usr/bin/env bash
# Writes what `lancer options` knows: the tables of docs/ between "<!-- lancer options ... -->" and "<!-- end -->", and
# with --pages manual pages and completions (share/man, share/completions) and docs/cli.md.
set -euo pipefail
usage() { echo 'usage: scripts/option-tables.sh [LANCER] (build/release/lancer)'; }
lancer=''
while (($#)); do
    case $1 in
        -h | --help) usage; exit 0 ;;
        -*) echo "option-tables.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *) lancer=$(realpath -- "$1") ;;
    esac
    shift
done
unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
lancer=${lancer:-build/release/lancer}

# write_table FILE [--biases]
write_table() {
    local file=$1 table scratch
    shift
    table=$("$lancer" options "$@")
    scratch=$(mktemp)
    TABLE=$table awk -v mark="<!-- lancer options${1+ $1} -->" '
        $0 == mark { print; print ENVIRON["TABLE"]; skipping = 1 }
        $0 == "<!-- end -->" { skipping = 0 }
        !skipping { print }' "$file" >"$scratch"
    cat "$scratch" >"$file"
    rm -f "$scratch"
}
write_table docs/scene-format.md
write_table docs/architecture.md --biases
"$lancer" options --pages .
