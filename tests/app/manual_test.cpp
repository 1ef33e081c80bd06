// Manual pages, completions and docs/cli.md are those of this program, and know every option that --help knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "app/manual/manual.h"
#include "app/options/file_kinds.h"
#include "app/options/option_values.h"
#include "app/paths.h"
#include "app/run_program.h"

namespace lancer {
namespace {

const std::string source = LANCER_SOURCE_DIR "/";

// The commands that the help lists.
std::vector<std::string> commands_of(const std::string& help)
{
    std::vector<std::string> names;
    std::istringstream lines(help);
    for (std::string line, lancer, name; std::getline(lines, line);) {
        std::istringstream words(line);
        words >> lancer >> name;
        if (line.starts_with("  lancer ") && std::islower(name[0]) && name != "help" &&
            name.find('.') == std::string::npos && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    return names;
}

// "-o" and "--output" of the lines of a help that begin with an option.
std::set<std::string> options_of(const std::string& help)
{
    std::set<std::string> names;
    std::istringstream lines(help);
    for (std::string line, first; std::getline(lines, line);) {
        if (!line.starts_with("  -")) continue;
        std::istringstream words(line);
        words >> first;
        for (const std::string& name : split(first, ','))
            if (!name.empty()) names.insert(name);
    }
    return names;
}

// The lines of the completion of fish that are for a command.
std::string fish_lines_of(const std::string& command, const std::string& text)
{
    const std::string begin = "complete -c lancer -n '__lancer_is ";
    std::string found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(begin)) continue;
        const size_t end = line.find('\'', begin.size());
        const std::vector<std::string> commands = split(line.substr(begin.size(), end - begin.size()), ' ');
        if (std::find(commands.begin(), commands.end(), command) != commands.end()) found += line + "\n";
    }
    return found;
}

// The text from one mark to the next.
std::string between(const std::string& text, const std::string& begin, const std::string& end)
{
    const size_t from = text.find(begin);
    if (from == std::string::npos) return "";
    return text.substr(from, text.find(end, from + begin.size()) - from);
}

class Manual : public AppTest {};

TEST_F(Manual, FilesOfTheRepositoryAreThoseThatTheProgramWrites)
{
    ASSERT_EQ(run({"options", "--pages", file("pages")}).code, 0);
    std::set<std::string> written;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(file("pages"))) {
        if (!entry.is_regular_file()) continue;
        const std::string name = std::filesystem::relative(entry.path(), file("pages"));
        written.insert(name);
        EXPECT_TRUE(read_bytes(source + name) == read_bytes(entry.path()))
            << name << ": scripts/option-tables.sh writes it";
    }
    for (const char* folder : {"share/man", "share/completions"})
        for (const auto& entry : std::filesystem::directory_iterator(source + folder))
            EXPECT_TRUE(written.contains(std::filesystem::relative(entry.path(), source))) << entry.path();
}

TEST_F(Manual, KnowsEveryOptionOfEveryHelp)
{
    const std::string reference = read_bytes(source + "docs/cli.md"),
                      bash = read_bytes(source + "share/completions/lancer.bash"),
                      zsh = read_bytes(source + "share/completions/_lancer"),
                      fish = read_bytes(source + "share/completions/lancer.fish"),
                      main_page = read_bytes(source + "share/man/lancer.1");
    const std::vector<std::string> commands = commands_of(run({"--help"}).out);
    EXPECT_EQ(commands.size(), 16u);
    for (const std::string& command : commands) {
        const std::string help = run({command, "--help"}).out;
        EXPECT_EQ(run({"help", command}).out, help);
        expect_words(main_page, ".BR lancer\\-" + command + " (1)");
        const std::string page = read_bytes(source + "share/man/lancer-" + command + ".1");
        std::string bash_words = between(between(bash, "_lancer_options()", "esac"), " " + command + ")", "\n");
        std::replace(bash_words.begin(), bash_words.end(), '\'', ' ');
        const std::string zsh_case = between(zsh, "        " + command + ")\n", ";;");
        const std::string fish_lines = fish_lines_of(command, fish);
        const std::string section = between(reference, "## lancer " + command + "\n", "\n## ");
        const std::set<std::string> options = options_of(help);
        EXPECT_GE(options.size(), 3u) << command;
        for (const std::string& name : options) {
            std::string roff;
            for (const char c : name) roff += c == '-' ? std::string("\\-") : std::string(1, c);
            EXPECT_NE(page.find("\\fB" + roff + "\\fR"), page.npos) << command << " " << name;
            EXPECT_NE(bash_words.find(" " + name + " "), bash.npos) << command << " " << name;
            EXPECT_TRUE(zsh_case.find(name + "[") != zsh.npos || zsh_case.find(name + "=[") != zsh.npos ||
                        zsh_case.find(name + "+[") != zsh.npos)
                << command << " " << name;
            const std::string flag =
                name.starts_with("--") ? " -l " + name.substr(2) + " " : " -s " + name.substr(1) + " ";
            EXPECT_NE(fish_lines.find(flag), fish.npos) << command << " " << name;
            EXPECT_NE(section.find("`" + name + "`"), section.npos) << command << " " << name;
        }
    }
}

TEST_F(Manual, CompletionsOfferTheScenesAndPicturesThatAreRead)
{
    for (const std::string& ending : split(std::string(files::scenes), ' '))
        EXPECT_TRUE(is_scene("a" + ending)) << ending;
    for (const std::string& ending : split(std::string(files::written_pictures), ' '))
        EXPECT_TRUE(format_of("a" + ending)) << ending;
    for (const std::string_view name : enum_names<PictureFormat>)
        EXPECT_NE((std::string(files::written_pictures) + " ").find("." + std::string(name) + " "), std::string::npos)
            << name;
}

TEST_F(Manual, OfAnUnknownCommandIsAMistake)
{
    const Said said = run({"help", "rendr"});
    EXPECT_EQ(said.code, 2);
    expect_words(said.err, "did you mean 'render'");
    EXPECT_EQ(run({"help", "render", "film"}).code, 2);
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
    EXPECT_EQ(run({"options", "--pages", "/dev/null/x"}).code, 1);
}

}  // namespace
}  // namespace lancer
