#!/usr/bin/env bash
# Stands for lancer where commands of the documentation run: the same command with small pictures, few samples and short
# times. Never fails, so that a block goes on; a line in $FAULTS says what went wrong. $PROGRAM: lancer itself.
set -u
words=("$@")
width=32 height=18
fault() { printf 'lancer %s\n    %s\n' "${words[*]}" "$1" >>"$FAULTS"; }
# stand_for WORD BEFORE: words in capitals stand for what a reader has.
stand_for() {
    case $1 in
        SCENE) echo scene.toml ;;
        MESH) echo mesh.obj ;;
        FILE) case $2 in -o) echo file.exr ;; --checkpoint | --resume) echo file.lancer ;; *) echo scene.toml ;; esac ;;
        X | Y) echo 3 ;;
        '[SAMPLE]') echo 0 ;;
        '[SCENE]') echo scene.toml ;;
        PICTURE) echo a.exr ;;
        REFERENCE) echo reference.exr ;;
        STUDY | STUDY.toml) echo study.toml ;;
        PART...) echo part.lancer ;;
        FOLDER) echo "folder.$$" ;;
        N) echo 2 ;;
        K/N) echo 1/2 ;;
        /shared/*) echo "${1#/}" ;;
        /usr/share/lancer/*) echo "${1#/usr/share/lancer/}" ;;
        *) echo "$1" ;;
    esac
}
least() { echo $(($1 < $2 ? $1 : $2)); }

command=${1-}
case $command in
    '' | -*) exec "$PROGRAM" "$@" ;;
    *.toml | *.obj | *.ply | *.glb | *.gltf | SCENE) command=render ;;
esac
# Of a crop the part of the picture that it is, of 1280x720 unless a size is given.
given_width=1280 given_height=720
for ((i = 1; i <= $#; ++i)); do
    if [[ ${!i} == --size ]]; then
        next=$((i + 1)) size=${!next}
        given_width=${size%x*} given_height=${size#*x}
    fi
done

args=() has_spp=0 has_time=0
while (($#)); do
    case $1 in
        -s | --spp) args+=("$1" "$(least "$2" 8)"); has_spp=1; shift ;;
        --size) shift ;;
        --turntable) args+=("$1" "$(least "$2" 2)"); shift ;;
        --frames) args+=("$1" "${2%-*}-$(least "${2#*-}" $((${2%-*} + 1)))"); shift ;;
        --time)
            has_time=1
            case $command in bench) args+=(--time 1s) ;; *) args+=(--time 0.1s) ;; esac
            shift
            ;;
        --quick) args+=(--time 1s); has_time=1 ;;
        --crop)
            IFS=, read -r x0 y0 x1 y1 <<<"$2"
            x0=$((x0 * width / given_width)) y0=$((y0 * height / given_height))
            args+=(--crop "$x0,$y0,$(least $((x1 * width / given_width + 1)) $width),$(least $((y1 * height / given_height + 1)) $height)")
            shift
            ;;
        *) args+=("$(stand_for "$1" "${args[*]: -1}")") ;;
    esac
    shift
done
case $command in
    render | film) args+=(--size "${width}x$height"); ((has_spp)) || args+=(-s 8) ;;
    tune) args+=(--size "${width}x$height" -s 2); ((has_time)) || args+=(--time 0.1s) ;;
    bench) ((has_time)) || args+=(--time 1s) ;;
esac
# The log goes where a reader sees none of it; results stay, for redirections.
log=$(mktemp)
code=0
env -u DISPLAY -u WAYLAND_DISPLAY "$PROGRAM" "${args[@]}" 2>"$log" </dev/null || code=$?
case $command:$code in
    *:0) ;;
    compare:1) ;;  # these pictures differ by more than those of the page
    bench:1) grep -q 'rounds' "$log" || fault "$(grep -m 1 error "$log")" ;;
    view:1) grep -q -i 'display\|lancer_view' "$log" || fault "$(cat "$log")" ;;  # the rest of the command was understood
    *) fault "exit code $code: $(grep -m 3 'error\|warning' "$log" || tail -n 2 "$log")" ;;
esac
rm -f "$log"
exit 0
