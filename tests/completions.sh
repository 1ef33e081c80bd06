#!/usr/bin/env bash
# Drives the completions as shells do: bash always, fish and zsh where they are installed.
# usage: tests/completions.sh FOLDER (share/completions)
set -euo pipefail
completions=$(cd -- "$1" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
touch a.toml a.obj ab.PNG a.exr a.txt a.lancer 'a blank.toml'
mkdir afolder
failed=0

# expect SHELL LINE WORD...: these and no others are offered at the end of the line, in any order.
expect() {
    local shell=$1 line=$2 wanted got
    shift 2
    wanted=$(printf '%s\n' "$@" | sort)
    got=$("complete_in_$shell" "$line" | sort)
    if [[ $got != "$wanted" ]]; then
        failed=1
        echo "$shell: '$line' offers: ${got//$'\n'/, }; expected: ${wanted//$'\n'/, }"
    fi
}

# shellcheck disable=SC1091  # written by the program
source "$completions/lancer.bash"
# shellcheck disable=SC2317  # expect() calls it
# Words as bash divides them: at blanks, and '=' is a word of its own.
complete_in_bash() {
    local word
    COMP_WORDS=()
    read -r -a COMP_WORDS <<<"${1//=/ = }"
    if [[ $1 == *' ' ]]; then COMP_WORDS+=(''); fi
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    COMPREPLY=()
    _lancer
    for word in "${COMPREPLY[@]}"; do echo "$word"; done
}
# shellcheck disable=SC2317
complete_in_fish() {
    fish --no-config -c "source '$completions/lancer.fish'; complete -C '$1'" | cut -f1
}

shells=(bash)
if command -v fish >/dev/null; then shells+=(fish); fi
for shell in "${shells[@]}"; do
    # fish completes whole words, bash what follows a '='; fish marks folders.
    option='' value='' slash=''
    if [[ $shell == fish ]]; then option=--integrator= value=nee= slash=/; fi
    expect "$shell" 'lancer re' render
    expect "$shell" 'lancer help ve' verify
    expect "$shell" 'lancer a' a.toml a.obj 'a blank.toml' "afolder$slash"
    expect "$shell" 'lancer render --integ' --integrator
    expect "$shell" 'lancer a.toml --integ' --integrator
    expect "$shell" 'lancer render --integrator ' path direct ao whitted random-decision
    expect "$shell" 'lancer render --integrator=wh' "${option}whitted"
    expect "$shell" 'lancer render a.toml --integrator ao -s 5 --max-d' --max-depth
    expect "$shell" 'lancer render a.toml --aov albedo,norm' albedo,normal
    expect "$shell" 'lancer render a.toml --set nee=f' "${value}false"
    expect "$shell" 'lancer render --resume a' auto a.lancer "afolder$slash"
    expect "$shell" 'lancer render --env a' ab.PNG a.exr "afolder$slash"
    expect "$shell" 'lancer merge a' a.lancer "afolder$slash"
    expect "$shell" 'lancer export a.toml -o a' "afolder$slash"
    expect "$shell" 'lancer check --integ' ''
done
expect bash 'lancer pixel a.toml ' ''
expect bash 'lancer render --size 9x9 -- --integ' ''

# zsh completes in a terminal alone: it offers one word here, which it writes behind the line.
if command -v zsh >/dev/null && [[ -c /dev/pts/ptmx ]]; then
    # shellcheck disable=SC2016  # zsh's own variables
    zsh=$(TERM=vt100 timeout 20 zsh -f -c '
        zmodload zsh/zpty
        zpty shell zsh -f -i
        zpty -w shell "fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -D; PS1=rea%{%}dy"
        zpty -r shell said "*ready*"
        zpty -w -n shell $'\''lancer ver\t a.exr --memory=1G --pix\t all --threads 2 #end'\''
        zpty -r shell said "*#end*"
        zpty -w -n shell $'\''\C-ulancer render --resume=au\t --filter=cen\t --env=ab\t #end'\''
        zpty -r shell more "*#end*"
        zpty -d shell
        print -r -- $said $more' zsh "$completions" | sed $'s/\e\\[[0-9;?]*[a-zA-Z]//g' | tr -cd '[:print:]') || zsh=timeout
    for word in 'verify  a.exr' ' --pixels=' '--resume=auto ' '--filter=centre ' '--env=ab.PNG '; do
        if [[ $zsh != *"$word"* ]]; then
            failed=1
            echo "zsh does not write '$word': $zsh"
        fi
    done
fi
exit "$failed"
