#!/usr/bin/env bash
# Writes the tables of docs/ that `lancer options` prints: what stands between "<!-- lancer options ... -->" and
# "<!-- end -->".
# usage: scripts/option-tables.sh [LANCER]
set -euo pipefail
unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

lancer=${1-build/release/lancer}
[[ $# -le 1 ]] || { echo 'usage: scripts/option-tables.sh [LANCER]' >&2; exit 2; }

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
