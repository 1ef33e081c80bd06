// Manual pages in the language of man(7), which both groff and mandoc read.
#include <algorithm>
#include <cctype>

#include "app/commands/command_table.h"
#include "app/manual/listed_values.h"
#include "app/manual/manual.h"
#include "app/options/option_values.h"
#include "app/version.h"

namespace lancer {
namespace {

// As it stands, also the signs that mean something to roff; '-' stays a minus sign that can be copied into a shell.
std::string roff_text(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result;
}

// Lines of at most 78 characters; a line that begins as a request does not count as one.
std::string roff_lines(const std::string& text)
{
    std::string result, line;
    const auto end_line = [&] {
        if (line.empty()) return;
        result += (line[0] == '.' || line[0] == '\'' ? "\\&" : "") + line + "\n";
        line.clear();
    };
    for (const std::string& word : split(text, ' ')) {
        const std::string shown = roff_text(word);
        if (!line.empty() && line.size() + 1 + shown.size() > 78) end_line();
        line += (line.empty() ? "" : " ") + shown;
        // A sentence ends with its line, or roff sets the space behind it wrongly.
        if (word.ends_with('.') && !word.ends_with("...")) end_line();
    }
    end_line();
    return result;
}

// What stands on several lines in the help: a list after its first line.
std::string roff_help(const std::string& help)
{
    std::string result;
    for (const std::string& line : split(help, '\n')) result += (result.empty() ? "" : ".br\n") + roff_lines(line);
    return result;
}

std::string in_capitals(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string page_head(const std::string& name, const std::string& description)
{
    return ".\\\" Written by lancer options --pages.\n.TH " + roff_text(in_capitals(name)) + " 1 " + version_date() +
           " \"lancer " + version_number() + "\" \"lancer manual\"\n.SH NAME\n" + roff_text(name) + " \\-\n" +
           roff_lines(description);
}

// "-o, --output FILE" as the tag of a paragraph.
std::string option_tag(const ListedOption& option)
{
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "\\fB" : "\\fR, \\fB") + roff_text(name);
    return ".TP\n" + names + "\\fR" +
           (option.type.empty() || option.is_argument ? "" : " \\fI" + roff_text(option.type) + "\\fR") + "\n" +
           roff_help(option.help);
}

std::string examples(const std::string& text) { return ".SH EXAMPLES\n.nf\n" + roff_text(text) + "\n.fi\n"; }

std::string footer_sections(const std::string& footer)
{
    std::string result, notes;
    for (const FooterPart& part : parts_of(footer)) {
        if (part.heading == "Exit codes") {
            result += ".SH EXIT STATUS\n";
            for (const std::string& line : split(part.text, ';')) {
                const std::string code = line.substr(std::min(line.find_first_not_of(' '), line.size()));
                const size_t blank = code.find(' ');
                result += ".TP\n\\fB" + code.substr(0, blank) + "\\fR\n" +
                          roff_lines(blank == std::string::npos ? "" : code.substr(blank + 1));
            }
        } else if (part.heading == "Signals") {
            result += ".SH SIGNALS\n" + roff_lines(part.text);
        } else if (part.heading == "Example") {
            notes += examples(part.text);
        } else {
            notes = ".SH NOTES\n" + roff_lines(part.text) + notes;
        }
    }
    return result + notes;
}

}  // namespace

std::string command_page(const ListedCommand& command)
{
    const std::string name = command_name(command);
    std::string summary;
    for (const Command& known : all_commands())
        if (known.name == name) summary = known.summary;
    std::string page = page_head("lancer-" + name, summary) + ".SH SYNOPSIS\n.B lancer " + roff_text(name) + "\n" +
                       roff_lines(synopsis_of(command)) + ".SH DESCRIPTION\n" + roff_lines(command.description);
    for (const OptionGroup& group : groups_of(command)) {
        const bool is_section = group.name == "Arguments" || group.name == "Options";
        page += is_section ? ".SH " + in_capitals(group.name) + "\n" : ".SS " + roff_text(group.name) + "\n";
        for (const ListedOption* option : group.options) page += option_tag(*option);
    }
    return page + footer_sections(command.footer) + ".SH SEE ALSO\n.BR lancer (1)\n";
}

std::string program_page(std::span<const ListedCommand> commands)
{
    std::string page = page_head("lancer", program_summary) +
                       ".SH SYNOPSIS\n.B lancer\n\\fICOMMAND\\fR [\\fIARGUMENT\\fR]...\n.br\n.B lancer\n\\fISCENE\\fR "
                       "[\\fIOPTION\\fR]...\n.br\n.B lancer help\n[\\fICOMMAND\\fR]\n.SH DESCRIPTION\n" +
                       roff_lines(
                           "lancer renders OBJ and PLY meshes and scenes in TOML by path tracing. Pictures have the "
                           "same bits on any number of threads. With a scene in place of a command it is lancer "
                           "render.") +
                       ".SH COMMANDS\n";
    for (const ListedCommand& command : commands) {
        const std::string name = command_name(command);
        for (const Command& known : all_commands())
            if (known.name == name)
                page += ".TP\n\\fBlancer " + roff_text(name) + "\\fR " + roff_text(std::string(known.arguments)) +
                        "\n" + roff_lines(std::string(known.summary));
    }
    page +=
        ".SH OPTIONS\n.TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint the commands and exit\n.TP\n\\fB\\-\\-version\\fR\n"
        "Print the versions of the program and its libraries and exit\n";
    page +=
        ".SH ENVIRONMENT\n.TP\n\\fBLANCER_THREADS\\fR\nThreads, where \\fB\\-\\-threads\\fR says none\n.TP\n"
        "\\fBNO_COLOR\\fR\nIf it is set, messages on a terminal have no colours\n.TP\n\\fBTMPDIR\\fR\n"
        "Where a picture is written that cannot be written under its name\n";
    page += footer_sections(program_footer) + ".SH SEE ALSO\n";
    for (size_t i = 0; i < commands.size(); ++i)
        page += ".BR lancer\\-" + command_name(commands[i]) + " (1)" + (i + 1 < commands.size() ? ",\n" : "\n");
    return page;
}

}  // namespace lancer
