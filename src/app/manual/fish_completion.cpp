#include <algorithm>
#include <utility>
#include <vector>

#include "app/commands/command_table.h"
#include "app/manual/listed_values.h"
#include "app/manual/manual.h"

namespace lancer {
namespace {

const char* const fish_logic = R"(# fish completion of lancer. Written by lancer options --pages.

# The command on the line; render where a scene stands in its place; nothing if there is none yet.
function __lancer_command
    set -l words (commandline -opc)
    set -e words[1]
    test (count $words) -gt 0; or return
    if contains -- $words[1] $__lancer_commands help
        echo $words[1]
    else
        echo render
    end
end
function __lancer_is
    set -l command (__lancer_command)
    test -n "$command"; and contains -- $command $argv
end
function __lancer_has_none
    test -z (__lancer_command)
end

# Files whose names end in one of these, and folders.
function __lancer_files
    for file in (__fish_complete_path (commandline -ct | string replace -r '^-[^=]*=' ''))
        set -l name (string split -m 1 \t -- $file)[1]
        if string match -q '*/' -- $name; or contains -- (string lower -- (string match -r '\.[^.]*$' -- $name)) $argv
            echo $file
        end
    end
end

# What goes on from the last comma.
function __lancer_list
    set -l before (commandline -ct | string replace -r '^--[^=]*=' '' | string replace -r '[^,]*$' '')
    for word in $argv
        echo $before$word
    end
end

complete -c lancer -f
)";

std::string fish_quoted(const std::string& text)
{
    return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

// What may follow, as options of `complete`.
std::string fish_value(const ListedOption& option)
{
    const ListedValues values = values_of(option);
    std::string words = joined(values.words, " ");
    if (!option.list.empty()) return " -x -a \"(__lancer_list " + joined(option.list, " ") + ")\"";
    if (values.folders) return " -x -a '(__fish_complete_directories)'";
    if (values.files && option.endings.empty()) return " -r -F" + (words.empty() ? "" : " -a '" + words + "'");
    if (values.files) words += (words.empty() ? "" : " ") + ("(__lancer_files " + joined(option.endings, " ") + ")");
    return " -x" + (words.empty() ? "" : " -a '" + words + "'");
}

// What follows the condition.
std::string fish_offer(const ListedOption& option)
{
    std::string text;
    if (option.is_argument) return " -k" + fish_value(option).substr(3) + "\n";
    for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    return text + (option.type.empty() ? "" : fish_value(option)) + " -d " + fish_quoted(first_line(option.help)) +
           "\n";
}

}  // namespace

std::string fish_completion(std::span<const ListedCommand> commands)
{
    std::string names, first;
    std::vector<std::pair<std::string, std::string>> offers;  // each once, and the commands that have it
    for (const ListedCommand& command : commands) {
        const std::string name = command_name(command);
        names += " " + name;
        for (const Command& known : all_commands())
            if (known.name == name)
                first += "complete -c lancer -n __lancer_has_none -a " + name + " -d " +
                         fish_quoted(std::string(known.summary)) + "\n";
        for (const ListedOption& option : command.options)
            if (!option.is_argument || !option.endings.empty()) {
                const std::string offer = fish_offer(option);
                const auto same =
                    std::find_if(offers.begin(), offers.end(), [&](const auto& o) { return o.first == offer; });
                if (same == offers.end())
                    offers.emplace_back(offer, name);
                else if (!same->second.ends_with(name))  // two arguments may take the same
                    same->second += " " + name;
            }
    }
    std::string lines;
    for (const auto& [offer, commands_with_it] : offers)
        lines += "complete -c lancer -n '__lancer_is " + commands_with_it + "'" + offer;
    std::string scenes;
    for (const ListedOption& option : commands[0].options)
        if (option.is_argument) scenes = joined(option.endings, " ");
    return "set -g __lancer_commands" + names + "\n" + fish_logic + first +
           "complete -c lancer -n __lancer_has_none -a help -d 'print the options of a command'\n"
           "complete -c lancer -n __lancer_has_none -a '(__lancer_files " +
           scenes +
           ")'\ncomplete -c lancer -n __lancer_has_none -s h -l help -d 'Print the commands and exit'\n"
           "complete -c lancer -n __lancer_has_none -l version -d 'Print versions and exit'\n"
           "complete -c lancer -n '__lancer_is help' -a '$__lancer_commands'\n" +
           lines;
}

}  // namespace lancer
