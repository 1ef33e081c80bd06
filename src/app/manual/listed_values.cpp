#include "app/manual/listed_values.h"

#include <algorithm>
#include <cctype>

#include "app/options/option_values.h"

namespace lancer {
namespace {

bool begins_as_word(const std::string& text)
{
    return !text.empty() && (std::islower(static_cast<unsigned char>(text[0])) || std::isdigit(text[0])) &&
           text.find(',') == std::string::npos;
}

OptionGroup& group_named(std::vector<OptionGroup>& groups, const std::string& name)
{
    for (OptionGroup& group : groups)
        if (group.name == name) return group;
    return groups.emplace_back(OptionGroup{name, {}});
}

}  // namespace

ListedValues values_of(const ListedOption& option)
{
    ListedValues values;
    for (const std::string& part : split(option.type, '|')) {
        if (begins_as_word(part))
            values.words.push_back(part);
        else if (part.starts_with("FILE") || part == "CONFIG")
            values.files = true;
        else if (part == "FOLDER")
            values.folders = true;
    }
    if (!option.list.empty()) values.words.clear();
    if (option.is_argument && !option.endings.empty()) values.files = true;
    return values;
}

std::string command_name(const ListedCommand& command) { return command.program.substr(command.program.find(' ') + 1); }

std::string argument_text(const ListedOption& argument)
{
    const std::string text = argument.names[0] + (argument.is_repeatable ? "..." : "");
    return argument.is_required ? text : "[" + text + "]";
}

std::string synopsis_of(const ListedCommand& command)
{
    std::string text = "[OPTION]...";
    for (const ListedOption& option : command.options)
        if (option.is_argument) text += " " + argument_text(option);
    return text;
}

std::vector<FooterPart> parts_of(const std::string& footer)
{
    std::vector<FooterPart> parts;
    size_t begin = 0;
    while (begin < footer.size()) {
        const bool is_example = footer.compare(begin, 7, "Example") == 0;
        size_t end = footer.find("\n\n", begin);
        if (is_example || end == std::string::npos) end = footer.size();
        std::string text = footer.substr(begin, end - begin);
        while (text.ends_with('\n')) text.pop_back();
        const size_t signals = text.find("\nSignals: ");
        for (std::string part :
             {text.substr(0, signals), signals == std::string::npos ? "" : text.substr(signals + 1)}) {
            if (part.empty()) continue;
            std::string heading;
            for (const char* known : {"Exit codes", "Signals", "Examples", "Example"})
                if (part.starts_with(std::string(known) + ":")) {
                    heading = known;
                    part = part.substr(heading.size() + 1);
                    part.erase(0, std::min(part.find_first_not_of(" \n"), part.size()));
                    break;
                }
            parts.push_back({heading == "Examples" ? "Example" : heading,
                             is_example ? replaced("  " + part, "\n  ", "\n").substr(2) : replaced(part, "\n", " ")});
        }
        begin = footer.find_first_not_of('\n', end);
    }
    return parts;
}

std::vector<OptionGroup> groups_of(const ListedCommand& command)
{
    std::vector<OptionGroup> groups;
    for (const ListedOption& option : command.options)
        if (option.is_argument) group_named(groups, "Arguments").options.push_back(&option);
    for (const ListedOption& option : command.options)
        if (!option.is_argument)
            group_named(groups, option.group.empty() ? "Options" : option.group).options.push_back(&option);
    return groups;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : std::string(separator)) + word;
    return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view by)
{
    for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

std::string first_line(const std::string& help)
{
    std::string line = help.substr(0, help.find('\n'));
    while (line.ends_with(':') || line.ends_with('.')) line.pop_back();
    return line;
}

}  // namespace lancer
