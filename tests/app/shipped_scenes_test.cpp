// The scenes of the folder scenes/: without a warning, each shows something, and the large one is large.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/run_program.h"
#include "integrators/integrator.h"

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

class Shipped : public AppTest, public testing::WithParamInterface<std::string> {
protected:
    // Each sample brings light or none, so no mean of them is negative, nor is a mean square of differences.
    void expect_no_negative_value(const std::string& picture) const
    {
        const std::vector<ExrInfo::Channel> channels = read_exr_info(picture).channels;
        ASSERT_EQ(channels.size(), 7u);
        for (const ExrInfo::Channel& c : channels)
            for (const float value : read_exr_channel(picture, c.name)) ASSERT_GE(value, 0) << c.name;
    }
};
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
    const Said rendered =
        run({"render", scene, "--size", "48x32", "-s", "4", "-q", "--aov", "albedo,variance", "-o", "a.exr"});
    ASSERT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(rendered.err, "");
    const Image picture = image("a.exr");
    const auto lit = std::count_if(picture.pixels.begin(), picture.pixels.end(), [](Color c) { return !is_black(c); });
    EXPECT_GT(lit, static_cast<std::ptrdiff_t>(picture.pixels.size() / 2));
    expect_no_negative_value(file("a.exr"));
}

TEST_P(Shipped, HasNoNegativeValueWithFewOrManySamples)
{
    for (const char* spp : {"1", "16"}) {
        const Said said = run({"render", shipped + GetParam() + ".toml", "--size", "48x32", "-s", spp, "-q", "--aov",
                               "albedo,variance", "-o", "a.exr"});
        ASSERT_EQ(said.code, 0) << said.err;
        expect_no_negative_value(file("a.exr"));
    }
}

// What the camera sees first does not depend on how light is followed: not one bit of albedo, normal and the rest. A
// medium that scatters is seen where no surface is behind it, by integrators that follow what it scatters.
TEST_P(Shipped, LooksTheSameToEveryIntegrator)
{
    const auto channels = [&](std::string_view integrator) {
        const Said said = run({"render", shipped + GetParam() + ".toml", "--size", "30x20", "-s", "2", "-q", "--aov",
                               "albedo,flat,normal,position,depth,uv,material,mask", "--integrator",
                               std::string(integrator), "-o", "a.exr"});
        EXPECT_EQ(said.code, 0) << said.err;
        std::vector<std::vector<float>> all;
        if (said.err.find("this integrator follows no light that media scatter") != std::string::npos) return all;
        for (const ExrInfo::Channel& c : read_exr_info(file("a.exr")).channels)
            if (c.name.find('.') != std::string::npos) all.push_back(read_exr_channel(file("a.exr"), c.name));
        return all;
    };
    const auto& names = enum_names<IntegratorKind>;
    const auto first = channels(names[0]);
    ASSERT_EQ(first.size(), 17u);
    for (size_t i = 1; i < names.size(); ++i) {
        const auto other = channels(names[i]);
        if (other.empty()) continue;
        ASSERT_EQ(other.size(), first.size());
        for (size_t k = 0; k < first.size(); ++k)
            EXPECT_EQ(std::memcmp(first[k].data(), other[k].data(), first[k].size() * sizeof(float)), 0)
                << names[i] << ", channel " << k;
    }
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
