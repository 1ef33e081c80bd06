#!/usr/bin/env bash
# Builds and runs the benchmarks and makes one page of what they measured.
set -uo pipefail

usage() {
    cat <<'EOF'
usage: scripts/bench.sh [--full] [--mesh FILE]... [--out FOLDER] [--compare RUN] [--docs]
  (nothing)      the quick suite, about half an hour on two cores once it is built
  --full         everything: more meshes, more rays, larger scenes; takes hours
  --mesh FILE    a mesh (.obj) to measure besides; may be given several times
  --out FOLDER   where to (build/bench-run): index.html, tables.md and the files of the run in data/
  --compare RUN  an earlier run, a folder of .json files: are its ratios confirmed?
  --docs         put the tables into docs/benchmarks/last-run.md
Nothing else should run meanwhile: above a load of 2.5 the page calls a run not comparable. Figures and how to read
them: docs/benchmarks.md.
EOF
}

fail() { echo "bench.sh: error: $1" >&2; exit "${2:-1}"; }
fail_usage() { echo "bench.sh: error: $1" >&2; usage >&2; exit 2; }

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=scripts/common.sh
source scripts/common.sh

# from_start PATH: a path as seen from where the script was started.
from_start() { (cd -- "$started_in" && realpath -m -- "$1"); }

size=--quick out=build/bench-run earlier='' docs=0 meshes=()
while (($#)); do
    case $1 in
        --full) size=--full; shift ;;
        --docs) docs=1; shift ;;
        --mesh | --out | --compare)
            [[ -n ${2-} ]] || fail_usage "$1 needs a value"
            path=$(from_start "$2")
            case $1 in
                --mesh)
                    [[ -f $path ]] || fail "no file '$2'" 66
                    meshes+=(--mesh "$path")
                    ;;
                --out) out=$path ;;
                --compare)
                    [[ -e $path ]] || fail "no run '$2'" 66
                    earlier=$path
                    ;;
            esac
            shift 2
            ;;
        -h | --help) usage; exit 0 ;;
        *) fail_usage "unknown option '$1'" ;;
    esac
done

build_preset bench || exit 1
programs=build/bench/bench

# The run is written beside its place and moved there as a whole.
mkdir -p "$out" || exit 1
run=$out/run.tmp.$$
trap 'rm -rf "$run"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
mkdir -p "$run/data" || exit 1

# The load of building counts as well: wait until it has gone, but not for that of others.
calm_down() {
    local load waited=0
    while ((waited < 120)); do
        read -r load _ </proc/loadavg || return 0
        if awk -v load="$load" 'BEGIN { exit !(load <= 1.5) }'; then return 0; fi
        ((waited)) || echo "Waiting for the load ($load) to go down"
        sleep 5
        waited=$((waited + 5))
    done
}
calm_down

failed=()
# measure PROGRAM [OPTION...]
measure() {
    local name=$1 start=$SECONDS
    shift
    echo "== bench_$name"
    if "$programs/bench_$name" "$size" "$@" -o "$run/data/$name.json"; then
        echo "bench_$name took $((SECONDS - start)) s"
    else
        failed+=("bench_$name")
    fi
}
measure accel "${meshes[@]}"
measure limit
measure estimators
measure threads -t 64
measure features
measure scaling
measure render
measure agreement "${meshes[@]}"
measure watertight "${meshes[@]}"

page=("$programs/bench_page" "$run/data" -o "$run/index.html" --markdown "$run/tables.md")
[[ -n $earlier ]] && page+=(--compare "$earlier")
"${page[@]}" || fail "no page could be made"

rm -rf "$out/data"
for part in data tables.md index.html; do mv -f "$run/$part" "$out/$part" || exit 1; done
echo "Page: $out/index.html"

# The documentation shows the last run between these two lines.
put_into_docs() {
    local doc=docs/benchmarks/last-run.md
    awk -v tables="$out/tables.md" '
        /^<!-- the last run ends -->$/ { inside = 0 }
        !inside { print }
        /^<!-- the last run begins -->$/ {
            inside = 1
            print ""
            while ((getline line <tables) > 0) print line
        }' "$doc" >"$doc.tmp.$$" && mv "$doc.tmp.$$" "$doc"
}
if ((docs)); then put_into_docs || fail "docs/benchmarks/last-run.md could not be written"; fi

if ((${#failed[@]})); then fail "failed: ${failed[*]}; the page is without them"; fi
