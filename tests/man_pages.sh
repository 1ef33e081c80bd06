#!/usr/bin/env bash
# Manual pages give no warnings, neither of mandoc nor of groff; skipped (77) where neither is installed.
# usage: tests/man_pages.sh FOLDER (share/man)
set -euo pipefail
tried=77
faults=
if command -v mandoc >/dev/null; then
    tried=0
    faults=$(mandoc -Tlint "$1"/*.1 2>&1 || true)
fi
if command -v groff >/dev/null && command -v man >/dev/null; then
    tried=0
    for page in "$1"/*.1; do
        faults+=$(LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z "$page" 2>&1 >/dev/null || true)
    done
fi
if [[ -n $faults ]]; then
    echo "$faults"
    exit 1
fi
exit "$tried"
