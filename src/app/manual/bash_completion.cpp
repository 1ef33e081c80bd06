// The completion of bash. It needs bash 4 and no package of helpers.
#include <map>

#include "app/commands/command_table.h"
#include "app/manual/listed_values.h"
#include "app/manual/manual.h"
#include "app/options/option_values.h"

namespace lancer {
namespace {

// The logic, which knows no option: tables follow it.
const char* const bash_logic = R"(# bash completion of lancer. Written by lancer options --pages.

# Words of COMP_WORDS, joined again where bash divided them at '='. Sets words, current (the last one, up to the
# cursor) and kept (what of it bash leaves in place).
_lancer_words() {
    local i part
    words=()
    for ((i = 0; i <= COMP_CWORD; i++)); do
        part=${COMP_WORDS[i]}
        if ((${#words[@]})) && [[ $part == =* || (i -gt 0 && ${COMP_WORDS[i - 1]} == =) ]]; then
            words[${#words[@]} - 1]+=$part
        else
            words+=("$part")
        fi
    done
    current=${words[${#words[@]} - 1]}
    part=${COMP_WORDS[COMP_CWORD]}
    if [[ $part == =* ]]; then kept=$current; else kept=${current%"$part"}; fi
}

# Offers words of $2 that go on from what follows the last comma or '=' of an option ($1: all before it).
_lancer_offer() {
    local word
    for word in $2; do
        if [[ $1$word == "$current"* ]]; then
            word=$1$word
            COMPREPLY+=("${word#"$kept"}")
        fi
    done
}

# Offers files below what is typed after $1 whose names end in one of $2 (all, if there is none), and folders.
_lancer_files() {
    local name ending typed=${current#"$1"}
    typed=${typed/#\~/$HOME}
    compopt -o filenames 2>/dev/null
    while IFS= read -r name; do
        ending=.${name##*.}
        if [[ -d $name || -z $2 || " $2 " == *" ${ending,,} "* ]]; then COMPREPLY+=("$name"); fi
    done < <(compgen -f -- "$typed")
}
_lancer_folders() {
    local name typed=${current#"$1"}
    compopt -o filenames 2>/dev/null
    while IFS= read -r name; do COMPREPLY+=("$name"); done < <(compgen -d -- "$typed")
}

# Offers what the tables say of a value. $1: what stands before it.
_lancer_value() {
    local before=$1
    if [[ -n $list ]]; then
        local typed=${current#"$before"}
        [[ $typed != *,* ]] || before+=${typed%,*},
        _lancer_offer "$before" "$list"
        compopt -o nospace 2>/dev/null
        return
    fi
    _lancer_offer "$before" "$values"
    [[ -z $files ]] || _lancer_files "$before" "${files#any}"
    [[ -z $folders ]] || _lancer_folders "$before"
}

_lancer() {
    local words current kept i first=2 name=render place=0 option='' only_arguments=''
    local values='' list='' files='' folders='' takes='' options='' arguments=0
    COMPREPLY=()
    _lancer_words
    local last=$((${#words[@]} - 1))
    if ((last == 1)) && [[ $current != -* ]]; then
        _lancer_offer '' "$_lancer_commands help"
        _lancer_files '' "$_lancer_scenes"
        return
    fi
    if ((last > 1)) && [[ ${words[1]} == help ]]; then
        ((last > 2)) || _lancer_offer '' "$_lancer_commands"
        return
    fi
    if ((last > 1)) && [[ " $_lancer_commands " == *" ${words[1]} "* ]]; then name=${words[1]}; else first=1; fi
    for ((i = first; i < last; i++)); do
        if [[ -n $only_arguments || ${words[i]} != -* || ${words[i]} == - ]]; then
            place=$((place + 1))
        elif [[ ${words[i]} == -- ]]; then
            only_arguments=yes
        elif [[ ${words[i]} != *=* ]]; then
            takes=
            _lancer_option "$name" "${words[i]}"
            if [[ -n $takes ]]; then
                if ((i + 1 == last)); then option=${words[i]}; else i=$((i + 1)); fi
            fi
        fi
    done
    values='' list='' files='' folders=''
    if [[ -n $option ]]; then
        _lancer_option "$name" "$option"
        _lancer_value ''
    elif [[ -z $only_arguments && $current == --*=* ]]; then
        _lancer_option "$name" "${current%%=*}"
        _lancer_value "${current%%=*}="
    elif [[ -z $only_arguments && $current == -* ]]; then
        _lancer_options "$name"
        _lancer_offer '' "$options"
    else
        _lancer_argument "$name" "$place"
        _lancer_value ''
    fi
}
complete -F _lancer lancer
)";

// "values='a b' takes=yes" as the logic reads it.
std::string bash_value(const ListedOption& option)
{
    const ListedValues values = values_of(option);
    std::string text = option.type.empty() ? "" : "takes=yes";
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) text += std::string(" ") + name + "='" + value + "'";
    };
    add("values", joined(values.words, " "));
    add("list", joined(option.list, " "));
    if (values.files) add("files", option.endings.empty() ? "any" : joined(option.endings, " "));
    if (values.folders) add("folders", "yes");
    return text;
}

// What takes a value alike in all commands that have it needs one line.
std::string option_table(std::span<const ListedCommand> commands)
{
    std::map<std::string, std::map<std::string, std::string>> names_by_value;  // names, then value: commands
    for (const ListedCommand& command : commands)
        for (const ListedOption& option : command.options) {
            if (option.is_argument || option.type.empty()) continue;
            std::string& where = names_by_value[joined(option.names, " ")][bash_value(option)];
            where += (where.empty() ? "" : "|") + command_name(command);
        }
    std::string text =
        "\n# What an option takes: _lancer_option COMMAND OPTION\n_lancer_option() {\n    case $1:$2 in\n";
    for (const auto& [names, by_value] : names_by_value)
        for (const auto& [value, where] : by_value) {
            std::string pattern;
            for (const std::string& name : split(names, ' '))
                if (by_value.size() == 1)
                    pattern += (pattern.empty() ? "*:" : " | *:") + name;
                else
                    for (const std::string& command : split(where, '|'))
                        pattern += (pattern.empty() ? "" : " | ") + command + ":" + name;
            text += "        " + pattern + ") " + value + " ;;\n";
        }
    return text + "    esac\n}\n";
}

}  // namespace

std::string bash_completion(std::span<const ListedCommand> commands)
{
    std::string names, scenes;
    std::string options = "\n_lancer_options() {\n    case $1 in\n";
    std::string arguments = "\n# _lancer_argument COMMAND PLACE, from 0 on\n_lancer_argument() {\n    case $1:$2 in\n";
    for (const ListedCommand& command : commands) {
        const std::string name = command_name(command);
        names += (names.empty() ? "" : " ") + name;
        std::string all;
        size_t place = 0;
        for (const ListedOption& option : command.options) {
            if (!option.is_argument) {
                all += (all.empty() ? "" : " ") + joined(option.names, " ");
                continue;
            }
            if (name == "render" && scenes.empty()) scenes = joined(option.endings, " ");
            const std::string at = option.is_repeatable ? "*" : std::to_string(place++);
            arguments += "        " + name + ":" + at + ") " + bash_value(option) + " ;;\n";
        }
        options += "        " + name + ") options='" + all + "' ;;\n";
    }
    return bash_logic + ("\n_lancer_commands='" + names + "'\n_lancer_scenes='" + scenes + "'\n") + options +
           "    esac\n}\n" + arguments + "    esac\n}\n" + option_table(commands);
}

}  // namespace lancer
