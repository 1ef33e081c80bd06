#!/usr/bin/env bash
# Every relative link of the documentation leads to a file that is there, and every #anchor to a heading of it, by the
# rule of GitHub and GitLab: lower case, punctuation dropped, hyphens for blanks, -1 for the second of a name.
# usage: tests/docs/links.sh SOURCE
set -euo pipefail
source=$(cd -- "$1" && pwd)
cd -- "$source"
export LC_ALL=C
slug=$(<scripts/slug.awk)
pages=(README.md CONTRIBUTING.md CHANGELOG.md)
while IFS= read -r page; do pages+=("$page"); done < <(
    find docs scenes bench tests -name '*.md' | sort)

# Lines "anchor PAGE ANCHOR" and "link PAGE:LINE TARGET". What stands in fences and between back quotes is code.
read_page() {
    awk -v page="$1" "$slug"'
        /^ *(```|~~~)/ { fenced = !fenced; next }
        fenced { next }
        /^#+ / {
            text = $0; sub(/^#+ +/, "", text); sub(/ +#*$/, "", text)
            name = slug(text)
            print "anchor", page, name (count[name] ? "-" count[name] : "")
            count[name]++
        }
        {
            line = $0
            while (match(line, /<a (id|name)="[^"]+"/)) {
                text = substr(line, RSTART, RLENGTH)
                sub(/.*="/, "", text); sub(/"$/, "", text)
                print "anchor", page, text
                line = substr(line, RSTART + RLENGTH)
            }
            line = $0
            # A link whose text is code, [`--x`](page.md), stays one.
            gsub(/`[^`]*`/, "", line)
            while (match(line, /\]\([^) ]+( "[^"]*")?\)/)) {
                text = substr(line, RSTART + 2, RLENGTH - 3)
                sub(/ ".*/, "", text)
                print "link", page ":" NR, text
                line = substr(line, RSTART + RLENGTH)
            }
        }' "$1"
}

declare -A anchors=()
links=() failed=0 checked=0
while read -r kind where what; do
    if [[ $kind == anchor ]]; then anchors[$where#$what]=1; else links+=("$where $what"); fi
done < <(for page in "${pages[@]}"; do read_page "$page"; done)

fault() {
    failed=1
    echo "$1"
}
for link in "${links[@]}"; do
    where=${link%% *} target=${link#* }
    page=${where%:*}
    case $target in http://* | https://* | mailto:*) continue ;; esac
    checked=$((checked + 1))
    path=${target%%#*} anchor=
    [[ $target != *'#'* ]] || anchor=${target#*#}
    if [[ -z $path ]]; then
        path=$page
    elif [[ $path == /* ]]; then
        fault "$where: '$target' is absolute"
        continue
    else
        path=$(realpath -m --relative-to=. -- "$(dirname -- "$page")/$path")
    fi
    if [[ $path == ..* ]]; then
        fault "$where: '$target' leads out of the project"
    elif [[ ! -e $path ]]; then
        fault "$where: '$target': there is no $path"
    elif [[ -n $anchor && $path == *.md && -z ${anchors[$path#$anchor]-} ]]; then
        fault "$where: '$target': $path has no heading of this name"
    fi
done
((checked > 300)) || fault "only $checked links were found"
((failed)) || echo "$checked links of ${#pages[@]} pages resolve"
exit "$failed"
