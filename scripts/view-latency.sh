#!/usr/bin/env bash
# How long the hand waits in lancer view: starts it on a display without a screen, orbits with a real mouse, and prints
# the median and the longest time from an input to the first image of what it asked for. Needs xvfb and xdotool.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/view-latency.sh SCENE [options of lancer view]
Environment: LANCER, the program (build/release/lancer); LANCER_VIEW_LOADS, seconds that loading may take (5); LANCER_LOG,
a file for all that the program says.
END
}

case ${1-} in
    -h | --help) usage; exit 0 ;;
    -*) echo "view-latency.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    '') usage >&2; exit 2 ;;
esac
lancer=${LANCER-$(dirname -- "${BASH_SOURCE[0]}")/../build/release/lancer}
exec {display}< <(exec Xvfb -displayfd 1 -screen 0 1700x800x24 -nolisten tcp 2>/dev/null)
server=$!
trap 'kill "$server" 2>/dev/null || true' EXIT
read -r number <&"$display"
export DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1
log=$(mktemp)
trap 'kill "$server" 2>/dev/null || true; rm -f "$log"' EXIT
"$lancer" view "$@" -v 2>"$log" &
view=$!
xdotool search --sync --onlyvisible --name '^lancer ' windowmove 0 0 windowfocus --sync
sleep "${LANCER_VIEW_LOADS-5}"
for turn in 1 2 3 4 5 6; do
    xdotool mousemove 300 300 mousedown 1
    for step in $(seq 1 20); do xdotool mousemove $((300 + 5 * step * (turn % 2 ? 1 : -1))) $((300 + turn)) sleep 0.03; done
    xdotool mouseup 1
    sleep 1.5
done
begin=$(date +%s%N)
xdotool key ctrl+q
wait "$view"
printf 'closed in %d ms\n' $((($(date +%s%N) - begin) / 1000000))
grep "from input" "$log"; cp "$log" "${LANCER_LOG-/dev/null}"
