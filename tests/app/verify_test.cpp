// lancer verify: pixels of a picture traced again from its header.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

class Verify : public AppTest {
protected:
    // The picture with one bit of one value changed, in place of the old one.
    void flip_bit(const std::string& name, size_t pixel, const Metadata& metadata) const
    {
        Image changed = image(name);
        uint32_t bits = 0;
        std::memcpy(&bits, &changed.pixels[pixel].g, sizeof bits);
        bits ^= 1;
        std::memcpy(&changed.pixels[pixel].g, &bits, sizeof bits);
        write_exr(file(name), changed, metadata);
    }
};

TEST_F(Verify, FindsTheBitsOfEveryKindOfRender)
{
    const std::vector<std::vector<std::string>> ways{
        {},
        {"-s", "33", "--seed", "7", "--crop", "3,2,20,12", "--tile", "5"},
        {"--half"},
        {"--denoise", "--replicates", "2"},
        {"--background", "transparent", "-D", "camera.fov=25"},
        {"--background", "opaque-glass"},
        {"--integrator", "whitted", "--exr-compression", "piz"},
        {"--legacy", "--reproducible"},
        {"--set", "stop=true", "-s", "64"},
        {"--view", "left", "--sampler", "independent", "--set", "nee=false"},
        {"--time", "50ms"},
    };
    for (const auto& way : ways) {
        std::string shown;
        for (const std::string& word : way) shown += " " + word;
        SCOPED_TRACE(shown);
        auto arguments = way;
        arguments.insert(arguments.begin(), {"render", "scene.toml", "--size", "24x16", "-o", "a.exr"});
        ASSERT_EQ(run(arguments).code, 0);
        const Said all = run({"verify", "a.exr", "scene.toml", "--pixels", "all"});
        EXPECT_EQ(all.code, 0) << all.out << all.err;
        expect_words(all.out, "all have the same bits");
        const Said some = run({"verify", "a.exr", "--pixels", "20"});
        EXPECT_EQ(some.code, 0) << some.out << some.err;
        expect_words(some.out, "20 of ");
        expect_words(some.out, "1 % wrong pixels passes with a chance of 82 %");
    }
}

TEST_F(Verify, FindsAChangedBitSeedOrScene)
{
    ASSERT_EQ(render({"-o", "a.exr"}).code, 0);
    const Metadata true_header = read_exr_info(file("a.exr")).metadata;
    flip_bit("a.exr", 100, true_header);
    const Said bit = run({"verify", "a.exr", "--pixels", "all"});
    EXPECT_EQ(bit.code, 1);
    expect_words(bit.out, "pixel 4 4: ");
    expect_words(bit.out, "384 of 384 pixels traced again: 1 differ");

    ASSERT_EQ(render({"-o", "b.exr", "--seed", "5"}).code, 0);
    write_exr(file("b.exr"), image("b.exr"), true_header);
    EXPECT_EQ(run({"verify", "b.exr"}).code, 1) << "another seed than the header says";

    ASSERT_EQ(render({"-o", "c.exr"}).code, 0);
    std::string other = small_scene;
    other.replace(other.find("radius = 1"), 10, "radius = 2");
    write("other.toml", other);
    const Said scene = run({"verify", "c.exr", "other.toml"});
    EXPECT_EQ(scene.code, 1);
    expect_words(scene.out, "the scene is another one: hash ");
}

TEST_F(Verify, RefusesWhatCannotBeVerified)
{
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png"}).code, 0);
    const Said png = run({"verify", "a.png"});
    EXPECT_EQ(png.code, 65);
    expect_words(png.err, "8 bits do not tell");
    write_exr(file("bare.exr"), image("a.exr"));
    const Said bare = run({"verify", "bare.exr"});
    EXPECT_EQ(bare.code, 65);
    expect_words(bare.err, "its header does not say how it was made");
    Metadata header = read_exr_info(file("a.exr")).metadata;
    for (auto& [name, value] : header)
        if (name == "options") value = std::string("--size 24x16 --no-such-option 3");
    write_exr(file("odd.exr"), image("a.exr"), header);
    const Said odd = run({"verify", "odd.exr"});
    EXPECT_EQ(odd.code, 65);
    expect_words(odd.err, "no-such-option");
    ASSERT_EQ(render({"-o", "lossy.exr", "--exr-compression", "dwaa"}).code, 0);
    EXPECT_EQ(run({"verify", "lossy.exr"}).code, 65);
    EXPECT_EQ(run({"verify", "absent.exr"}).code, 66);
    EXPECT_EQ(run({"verify", "a.exr", "absent.toml"}).code, 66);
    ASSERT_EQ(render({"-o", "1.lancer", "--shard", "1/2"}).code, 0);
    ASSERT_EQ(run({"merge", "1.lancer", "-o", "part.exr", "--allow-missing"}).code, 0);
    const Said part = run({"verify", "part.exr"});
    EXPECT_EQ(part.code, 65);
    expect_words(part.err, "it is partial");
}

}  // namespace
}  // namespace lancer
