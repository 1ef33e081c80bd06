#include "app/commands/command_table.h"
#include "app/manual/listed_values.h"
#include "app/manual/manual.h"
#include "app/options/option_values.h"

namespace lancer {
namespace {

std::string in_table(const std::string& text)
{
    return replaced(replaced(replaced(text, "|", "\\|"), "<", "\\<"), "\n", "<br>");
}

std::string option_row(const ListedOption& option)
{
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "`" : ", `") + name + "`";
    const bool has_value = !option.type.empty() && !option.is_argument;
    return "| " + names + (has_value ? " `" + replaced(option.type, "|", "\\|") + "`" : "") + " | " +
           in_table(option.help) + " |\n";
}

}  // namespace

std::string markdown_reference(std::span<const ListedCommand> commands)
{
    std::string text =
        "# All options\n\nEvery option of every command, as `lancer COMMAND --help` and `man lancer-COMMAND` have "
        "them. "
        "The program\nitself wrote this page (`scripts/option-tables.sh`). [command-line.md](command-line.md) explains "
        "what belongs together.\n";
    for (const ListedCommand& command : commands) {
        text += "\n## " + command.program + "\n\n" + command.description + "\n\n```\n" + command.program + " " +
                synopsis_of(command) + "\n```\n";
        for (const OptionGroup& group : groups_of(command)) {
            text += "\n| " + group.name + " | |\n|---|---|\n";
            for (const ListedOption* option : group.options) text += option_row(*option);
        }
        for (const FooterPart& part : parts_of(command.footer)) {
            if (part.heading == "Example")
                text += "\n```\n" + part.text + "\n```\n";
            else
                text += "\n" + (part.heading.empty() ? "" : part.heading + ": ") + part.text + "\n";
        }
    }
    return text;
}

}  // namespace lancer
