// The tables of options in docs/ are those that the program prints.
#include <gtest/gtest.h>

#include "app/options/option_values.h"
#include "app/run_program.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

class OptionTable : public AppTest {
protected:
    // What stands between a mark and the next end.
    static std::string table_of(const std::string& file, const std::string& mark)
    {
        const std::string text = read_bytes(LANCER_SOURCE_DIR "/docs/" + file);
        const size_t begin = text.find("<!-- " + mark + " -->\n");
        const size_t end = text.find("<!-- end -->", begin);
        if (begin == std::string::npos || end == std::string::npos) return "no " + mark;
        const size_t table = text.find('\n', begin) + 1;
        return text.substr(table, end - table);
    }
};

TEST_F(OptionTable, OfTheDocumentationIsThatOfTheProgram)
{
    EXPECT_EQ(table_of("scene-format.md", "lancer options"), run({"options"}).out)
        << "scripts/option-tables.sh writes it";
    EXPECT_EQ(table_of("architecture.md", "lancer options --biases"), run({"options", "--biases"}).out)
        << "scripts/option-tables.sh writes it";
}

TEST_F(OptionTable, HelpHasEveryOption)
{
    const std::string help = run({"render", "--help"}).out;
    for (const RenderOption& option : render_options()) {
        const std::string name =
            option.is_switch() ? std::string(option.name) + "=" + value_text({}, option) + ": " : option_name(option);
        EXPECT_NE(help.find(name), std::string::npos) << name;
    }
}

// Every option that the command line can give changes the settings that JSON and the hash tell of.
TEST_F(OptionTable, EveryOptionReachesSceneFilesTheCommandLineAndTheStatistics)
{
    const auto settings = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "scene.toml", "-q", "-o", "a.exr", "--stats", "s.json", "-D",
                                   "render.size=[8,8]", "-D", "render.spp=1"});
        const Said said = run(more);
        EXPECT_EQ(said.code, 0) << said.err;
        const std::string text = read_bytes(file("s.json"));
        const size_t begin = text.find("\"settings\""), end = text.find("\"phases\"");
        std::string json = text.substr(begin, end - begin);
        const size_t hash = json.find("\"hash\"");
        return json.substr(0, hash);
    };
    const std::string usual = settings({});
    for (const RenderOption& option : render_options()) {
        // A value that is not the default.
        std::string value = "2";
        if (option.is_switch()) value = value_text({}, option) == "true" ? "false" : "true";
        if (const auto* choice = std::get_if<ChoiceField>(&option.field)) value = choice->names.back();
        if (option.name == "isa") value = "sse2";
        const bool is_size = std::holds_alternative<SizeField>(option.field);
        const std::string flag = option_name(option);
        const std::string by_file =
            settings({"-D", "render." + std::string(option.name) + "=" + (is_size ? "[9,9]" : value)});
        const std::string by_flag = option.is_switch() ? settings({"--set", std::string(option.name) + "=" + value})
                                                       : settings({flag, is_size ? "9x9" : value});
        EXPECT_NE(by_file, usual) << option.name;
        EXPECT_EQ(by_file, by_flag) << option.name;
    }
}

}  // namespace
}  // namespace lancer
