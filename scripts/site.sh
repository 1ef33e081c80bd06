#!/usr/bin/env bash
# Builds the documentation as a static site with a search, by MkDocs, which is installed with apt where it is missing.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/site.sh [--output FOLDER]
  --output FOLDER  where to (build/site/html); what is there is replaced if it is an earlier site
The site is files alone: any server shows it, or python3 -m http.server -d build/site/html. Without a server the pages
work, and the search does not.
END
}
fail() { echo "site.sh: error: $1" >&2; exit 1; }

unset CDPATH
started_in=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
work=$PWD/build/site
output=$work/html
while (($#)); do
    case $1 in
        --output)
            (($# > 1)) || { echo "site.sh: error: --output needs a folder" >&2; exit 2; }
            output=$(cd -- "$started_in" && realpath -m -- "$2")
            shift
            ;;
        -h | --help) usage; exit 0 ;;
        *) echo "site.sh: error: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done
[[ ! -e $output || -e $output/sitemap.xml || -z $(ls -A "$output" 2>/dev/null) ]] || fail "$output holds something else than a site"
command -v mkdocs >/dev/null || scripts/install-deps.sh --site
command -v mkdocs >/dev/null || fail 'mkdocs is missing: scripts/install-deps.sh --site'

pages=(README.md CHANGELOG.md CONTRIBUTING.md scenes/README.md bench/peers/README.md)
while IFS= read -r page; do pages+=("$page"); done < <(find docs -name '*.md' | LC_ALL=C sort)
source=$work/source
rm -rf "$source"

# As they stand, but for what MkDocs does otherwise than GitHub: names of headings are said, a | in code of a table
# needs no \, and a link to a folder leads to its README.md or to a list of its files.
copy_page() {
    mkdir -p "$source/$(dirname "$1")"
    LC_ALL=C awk "$(<scripts/slug.awk)"'
        /^ *(```|~~~)/ { fenced = !fenced }
        fenced { print; next }
        /^#+ / {
            text = $0; sub(/^#+ +/, "", text)
            name = slug(text)
            print $0 " {#" name (count[name] ? "-" count[name] : "") "}"
            count[name]++
            next
        }
        /^\|/ {
            line = $0; out = ""
            while (match(line, /`[^`]*`/)) {
                code = substr(line, RSTART, RLENGTH)
                gsub(/\\\|/, "|", code)
                out = out substr(line, 1, RSTART - 1) code
                line = substr(line, RSTART + RLENGTH)
            }
            print out line
            next
        }
        { print }' "$1" >"$source/$1"
}
# What pages link to, pictures included.
links_of() { { grep -oE '\]\([^)# ]+' "$1" || true; } | cut -c 3- | grep -v '^[a-z]*:' || true; }

for page in "${pages[@]}"; do
    copy_page "$page"
    while IFS= read -r link; do
        [[ -n $link ]] || continue
        path=$(realpath -m --relative-to=. -- "$(dirname -- "$page")/$link")
        if [[ -d $path ]]; then
            if [[ -e $path/README.md ]]; then name=README.md; else name=files.md; fi
            sed -i "s#](${link%/}/\\{0,1\\})#](${link%/}/$name)#g" "$source/$page"
            if [[ $name == files.md && ! -e $source/$path/files.md ]]; then
                mkdir -p "$source/$path"
                {
                    printf '# %s {#%s}\n\n' "$path" files
                    for file in "$path"/*; do
                        [[ -f $file ]] || continue
                        [[ $file == *.md ]] || cp "$file" "$source/$path/"
                        printf -- '- [%s](%s)\n' "${file##*/}" "${file##*/}"
                    done
                } >"$source/$path/files.md"
            fi
        elif [[ -e $path && $path != *.md ]]; then
            mkdir -p "$source/$(dirname "$path")"
            cp "$path" "$source/$path"
        fi
    done < <(links_of "$page")
done

cat >"$source/site.css" <<'END'
.navbar.bg-primary { background-color: #24476b !important; }
img { border-radius: 3px; }
table { display: block; overflow-x: auto; font-size: 0.92em; }
td img { min-width: 9em; max-width: 100%; }
@media (prefers-color-scheme: dark) {
    :root { color-scheme: dark; }
    body, .card, .bg-light, .modal-content, .list-group-item { background-color: #16181c !important; color: #d5d8dd; }
    h1, h2, h3, h4, h5, h6, th, td, .modal-content { color: #e4e6ea; }
    a { color: #7db7f2; }
    .bs-sidebar { border-color: #333840; }
    .bs-sidebar .nav > li > a, .nav-link { color: #aab2bd; }
    .table td, .table th, .table-bordered, hr { border-color: #333840; }
    .table-striped tbody tr:nth-of-type(odd) { background-color: #1d2026; }
    pre, pre code, code, .hljs { background-color: #20242b !important; border-color: #333840; color: #cfd6df; }
    .hljs-string, .hljs-number, .hljs-literal { color: #9ecf8f; }
    .hljs-keyword, .hljs-attr, .hljs-built_in, .hljs-section { color: #8fb7e8; }
    .hljs-comment { color: #8b93a0; }
    img { background-color: transparent !important; border-color: #333840 !important; }
    input.form-control { background-color: #20242b; color: #e4e6ea; border-color: #333840; }
}
END
# Pages that are not named in `nav` would be built but found by links and search alone.
cat >"$work/mkdocs.yml" <<'END'
site_name: lancer
docs_dir: source
use_directory_urls: false
theme:
  name: mkdocs
  locale: en
  highlightjs: true
  color_mode: auto
  user_color_mode_toggle: true
extra_css: [site.css]
markdown_extensions:
  - attr_list
  - toc: {toc_depth: 3}
plugins: [search]
nav:
  - lancer: README.md
  - Use:
    - Cookbook: docs/cookbook.md
    - Command line: docs/command-line.md
    - All options: docs/cli.md
    - Scene files: docs/scene-format.md
    - Scenes: scenes/README.md
    - Gallery: docs/gallery.md
    - Channels: docs/aovs.md
    - The window: docs/view.md
    - Several machines: docs/farm.md
    - C and Python: docs/library.md
    - JSON: docs/json/README.md
    - Checkpoints: docs/checkpoint-format.md
    - Installing: docs/installing.md
  - Method:
    - Integrators: docs/integrators.md
    - Denoising: docs/denoising.md
    - Numerics: docs/numerics.md
    - Measuring: docs/measuring.md
    - Benchmarks: docs/benchmarks.md
    - Last run: docs/benchmarks/last-run.md
    - What was tried: docs/benchmarks/tried.md
    - Unused features: docs/benchmarks/features.md
    - Startup: docs/benchmarks/startup.md
    - Beside others: docs/beside-others.md
    - Their pictures of one scene: bench/peers/README.md
  - Source:
    - Architecture: docs/architecture.md
    - Contributing: CONTRIBUTING.md
END
for page in docs/details/*.md; do
    printf '    - "%s": %s\n' "$(sed -n '1s/^# //p' "$page")" "$page"
done >>"$work/mkdocs.yml"
echo '  - Changes: CHANGELOG.md' >>"$work/mkdocs.yml"
# A page that is new has its place in the last menu until it is given another above.
for page in "${pages[@]}"; do
    grep -q -F ": $page" "$work/mkdocs.yml" || printf '  - "%s": %s\n' "$(sed -n '1s/^# //p' "$page")" "$page" >>"$work/mkdocs.yml"
done

mkdocs build --quiet --strict --clean -f "$work/mkdocs.yml" -d "$output"
echo "The site: $output/index.html"
