// The scenes of the folder scenes/: without a warning, each shows something, and the large one is large.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/run_program.h"

namespace lancer {
namespace {

const std::string shipped = LANCER_SOURCE_DIR "/scenes/";

std::vector<std::string> shipped_scenes()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shipped))
        if (entry.path().extension() == ".toml")
            names.push_back(std::filesystem::relative(entry.path(), shipped).replace_extension().string());
    std::sort(names.begin(), names.end());
    return names;
}

class Shipped : public AppTest, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Shipped, testing::ValuesIn(shipped_scenes()), [](const auto& tested) {
    std::string name = tested.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == '-'; }, '_');
    return name;
});

TEST_P(Shipped, HasNoProblemsAndIsSeen)
{
    const std::string scene = shipped + GetParam() + ".toml";
    const Said checked = run({"check", "--strict", scene});
    EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
    const Said rendered = run({"render", scene, "--size", "48x32", "-s", "1", "-q", "-o", "a.exr"});
    ASSERT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(rendered.err, "");
    const Image picture = image("a.exr");
    const auto lit = std::count_if(picture.pixels.begin(), picture.pixels.end(), [](Color c) { return !is_black(c); });
    EXPECT_GT(lit, static_cast<std::ptrdiff_t>(picture.pixels.size() / 2));
}

TEST_F(AppTest, TheForestIsOfMillionsOfTriangles)
{
    const Said said = run({"info", shipped + "forest.toml"});
    ASSERT_EQ(said.code, 0) << said.err;
    const std::string word = "drawn ";
    const size_t at = said.out.find(word);
    ASSERT_NE(at, std::string::npos) << said.out;
    EXPECT_GE(std::stoll(said.out.substr(at + word.size())), 10'000'000);
}

}  // namespace
}  // namespace lancer
