#!/usr/bin/env bash
# Installs what is missing, builds, renders a scene and says where the picture lies.
set -euo pipefail

usage() {
    cat <<'END'
usage: scripts/demo.sh [--quick]
  (nothing)  renders scenes/still_life.toml as it stands
  --quick    a small picture with few samples
The pictures are build/demo/still_life.png and .exr.
END
}

settings=()
for argument in "$@"; do
    case $argument in
        --quick) settings=(--size 480x270 --spp 64) ;;
        -h | --help) usage; exit 0 ;;
        *)
            echo "demo.sh: error: unknown option '$argument'" >&2
            usage >&2
            exit 2
            ;;
    esac
done

unset CDPATH
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh

scripts/install-deps.sh
# As the tests build it, so that nothing is compiled twice; a new compiler's new warnings shall not stop a demo.
if ! build_preset release --target lancer -DLANCER_WERROR=ON; then
    echo 'Trying again with warnings allowed.'
    build_preset release --target lancer -DLANCER_WERROR=OFF
fi

out=build/demo/still_life
mkdir -p build/demo
rm -f "$out.exr" "$out.png"
echo "Rendering scenes/still_life.toml"
start=$SECONDS
build/release/lancer render scenes/still_life.toml "${settings[@]}" -o "$out.exr" -o "$out.png" </dev/null
for picture in "$out.exr" "$out.png"; do
    if [[ ! -s $picture ]]; then
        echo "demo.sh: error: $picture was not written" >&2
        exit 1
    fi
done
echo "Rendered in $((SECONDS - start)) s"
echo "The picture: $PWD/$out.png"
echo "Unclipped, linear: $PWD/$out.exr"
