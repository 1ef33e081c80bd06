#!/usr/bin/env bash
# Renders meshes and scenes with what lancer adds by itself, small, and puts the pictures side by side into one PNG.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/contact-sheet.sh FILE_OR_FOLDER... -o SHEET.png [-- OPTION...]
  FILE_OR_FOLDER  meshes or scenes; of a folder every .obj in it
  OPTION...       options of lancer render, such as --view top
Pictures stand in the order of their files, eight in a row; one that could not be drawn is left dark.
Environment: LANCER (build/release/lancer), SIZE (160x120), SPP (32), COLUMNS_OF_SHEET (8).
END
}

lancer=${LANCER:-$(dirname "$0")/../build/release/lancer}
size=${SIZE:-160x120} spp=${SPP:-32}
inputs=() options=() sheet=''
while (($#)); do
    case $1 in
        -h | --help) usage; exit 0 ;;
        -o) sheet=${2:?-o needs a file}; shift ;;
        --) shift; options=("$@"); break ;;
        -*) echo "contact-sheet.sh: error: unknown option '$1'" >&2; usage >&2; exit 2 ;;
        *) inputs+=("$1") ;;
    esac
    shift
done
[[ ${#inputs[@]} -gt 0 && -n $sheet ]] || { usage >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
count=0
for input in "${inputs[@]}"; do
    while IFS= read -r -d '' file; do
        count=$((count + 1))
        name=$(printf '%s/%05d.ppm' "$work" "$count")
        echo "$file" >&2
        "$lancer" render "$file" --size "$size" -s "$spp" -q "${options[@]}" -o "$name" >/dev/null 2>"$name.log" ||
            { echo "contact-sheet.sh: warning: $file: $(head -1 "$name.log")" >&2; : >"$name"; }
    done < <(if [[ -d $input ]]; then find "$input" -iname '*.obj' -print0 | sort -z; else printf '%s\0' "$input"; fi)
done

python3 - "$sheet" "$size" "${COLUMNS_OF_SHEET:-8}" "$work"/*.ppm <<'END'
import struct, sys, zlib

sheet, size, columns, files = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4:]
width, height = map(int, size.split("x"))
gap = 2
columns = min(columns, len(files))
rows = -(-len(files) // columns)
across, down = columns * (width + gap) - gap, rows * (height + gap) - gap
pixels = bytearray(b"\x20" * (across * down * 3))
for i, file in enumerate(files):
    with open(file, "rb") as f:
        picture = f.read()[-width * height * 3:]
    if not picture:
        continue
    x, y = i % columns * (width + gap), i // columns * (height + gap)
    for row in range(height):
        at = ((y + row) * across + x) * 3
        pixels[at:at + width * 3] = picture[row * width * 3:(row + 1) * width * 3]

def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

lines = b"".join(b"\0" + bytes(pixels[y * across * 3:(y + 1) * across * 3]) for y in range(down))
with open(sheet, "wb") as f:
    f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", across, down, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))
END
echo "$sheet"
