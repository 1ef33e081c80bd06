#include "app/commands/command_table.h"
#include "app/manual/listed_values.h"
#include "app/manual/manual.h"

namespace lancer {
namespace {

// A word in single quotes, of which '\'' stands for one.
std::string zsh_quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

// What _arguments must not take for its own signs.
std::string zsh_text(std::string text)
{
    for (const char* sign : {"\\", "[", "]", ":"}) text = replaced(text, sign, std::string("\\") + sign);
    return text;
}

// What may follow, as the last part of a specification of _arguments.
std::string zsh_action(const ListedOption& option)
{
    const ListedValues values = values_of(option);
    if (!option.list.empty()) return "_sequence -s , compadd - " + joined(option.list, " ");
    if (values.folders) return "_directories";
    if (!values.files) return values.words.empty() ? " " : "(" + joined(values.words, " ") + ")";
    std::string endings;
    for (const std::string& ending : option.endings) endings += (endings.empty() ? "" : "|") + ending.substr(1);
    const std::string pattern = endings.empty() ? "" : " -g \"*.(#i)(" + endings + ")(-.)\"";
    if (values.words.empty()) return "_files" + pattern;
    // The blank in front: called with these arguments alone.
    return " _lancer_words_or_files \"" + joined(values.words, " ") + "\"" + pattern;
}

std::string zsh_option(const ListedOption& option)
{
    std::string value;
    if (!option.type.empty()) value = ":" + zsh_text(option.type) + ":" + zsh_action(option);
    const std::string help = "[" + zsh_text(first_line(option.help)) + "]";
    const std::string repeat =
        option.is_repeatable || option.names.size() == 1 ? "" : "(" + joined(option.names, " ") + ")";
    std::string text;
    for (const std::string& name : option.names) {
        // A long option takes its value behind '=', too.
        const std::string sign = option.type.empty() ? "" : name.starts_with("--") ? "=" : "+";
        text +=
            "            " + zsh_quoted((option.is_repeatable ? "*" : repeat) + name + sign + help + value) + " \\\n";
    }
    return text;
}

std::string zsh_argument(const ListedOption& argument)
{
    const std::string name = zsh_text(first_line(argument.help));
    const std::string place = argument.is_repeatable ? "*:" : argument.is_required ? ":" : "::";
    return "            " + zsh_quoted(place + name + ":" + zsh_action(argument)) + " \\\n";
}

const char* const zsh_head = R"zsh(#compdef lancer
# zsh completion of lancer. Written by lancer options --pages.

# _lancer_words_or_files WORDS [option of _files]...
_lancer_words_or_files() {
    local offered=(${=1})
    shift
    compadd -a offered
    _files "$@"
}

_lancer() {
    local curcontext=$curcontext name=render
    local -a commands=(
)zsh";

const char* const zsh_choice = R"zsh(        'help:print the options of a command'
    )
    if ((CURRENT == 2)); then
        if [[ $PREFIX == -* ]]; then
            _arguments '--help[print the commands]' '--version[print versions]'
        else
            _describe -t commands command commands
            _files -g "*.(#i)(SCENES)(-.)"
        fi
        return
    fi
    if [[ $words[2] == help ]]; then
        ((CURRENT > 3)) || _describe -t commands command commands
        return
    fi
    if ((${commands[(I)$words[2]:*]})); then
        name=$words[2]
        shift words
        ((CURRENT--))
    fi
    case $name in
)zsh";

}  // namespace

std::string zsh_completion(std::span<const ListedCommand> commands)
{
    std::string table, cases, scenes;
    for (const Command& command : all_commands())
        table += "        " + zsh_quoted(std::string(command.name) + ":" + std::string(command.summary)) + "\n";
    for (const ListedCommand& command : commands) {
        cases += "        " + command_name(command) + ")\n            _arguments -S \\\n";
        for (const ListedOption& option : command.options) {
            cases += option.is_argument ? zsh_argument(option) : zsh_option(option);
            if (option.is_argument && scenes.empty())
                scenes = replaced(joined(option.endings, "|").substr(1), "|.", "|");
        }
        cases.resize(cases.size() - 3);  // the last one goes on no more
        cases += "\n            ;;\n";
    }
    return zsh_head + table + replaced(zsh_choice, "SCENES", scenes) + cases + "    esac\n}\n\n_lancer \"$@\"\n";
}

}  // namespace lancer
