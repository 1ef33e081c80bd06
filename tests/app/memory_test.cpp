// --memory bounds pictures before they are read; --texture-limit makes them smaller, and says so.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "app/options/option_values.h"
#include "app/run_program.h"
#include "io/image_files.h"
#include "support/sanitized.h"

namespace lancer {
namespace {

// Bits from the lowest on, as deflate has them.
class Bits {
public:
    void add(uint32_t bits, int count)
    {
        for (int i = 0; i < count; ++i) {
            if (used_ == 0) bytes_ += '\0';
            bytes_.back() = static_cast<char>(bytes_.back() | (bits >> i & 1) << used_);
            used_ = (used_ + 1) % 8;
        }
    }
    // Huffman codes come with their highest bit first.
    void add_code(uint32_t code, int count)
    {
        for (int i = count - 1; i >= 0; --i) add(code >> i & 1, 1);
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    int used_ = 0;
};

// A PNG of side x side black pixels of three bytes, 158 times as small as they are.
std::string black_png(uint32_t side)
{
    const uint32_t size = side * (3 * side + 1), longest = 258;
    Bits bits;
    bits.add(3, 3);  // the last block, with fixed codes
    const auto zero = [&] { bits.add_code(0x30, 8); };
    zero();
    for (uint32_t i = 0; i < (size - 1) / longest; ++i) bits.add_code(0xc5, 8), bits.add_code(0, 5);
    for (uint32_t i = 0; i < (size - 1) % longest; ++i) zero();
    bits.add_code(0, 7);
    const std::string stream = "\x78\x01"s + bits.bytes() + pack_big((size % 65521) << 16 | 1);
    const std::string header = pack_big(side) + pack_big(side) + "\x08\x02\0\0\0"s;
    return "\x89PNG\r\n\x1a\n"s + png_chunk("IHDR", header) + png_chunk("IDAT", stream) + png_chunk("IEND", "");
}

class Memory : public AppTest {
protected:
    Memory()
    {
        write("wall.png", png(2, 2, 8, 2, "\0"s + top + "\0"s + bottom));
        write("walls.toml", walls("wall.png"));
    }
    static std::string walls(const std::string& picture)
    {
        return "version = 1\n[camera]\nposition = [0, 1, 5]\n[material.wall]\ntexture = \"" + picture +
               "\"\n[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"wall\"\n"
               "[[light]]\ntype = \"environment\"\nradiance = 1\n";
    }
    Said render_walls(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {"render", "walls.toml", "--size", "24x16", "-s", "4"});
        return run(arguments);
    }
};

TEST_F(Memory, PicturesBeyondItAreRefusedBeforeTheyAreRead)
{
    write("bomb.png", black_png(4096));
    write("walls.toml", walls("bomb.png"));
    for (const char* command : {"render", "check", "info", "pixel"}) {
        std::vector<std::string> arguments{command, "walls.toml", "--memory", "60M"};
        if (command == std::string("pixel")) arguments.insert(arguments.end(), {"0", "0"});
        const Said said = run(arguments);
        EXPECT_EQ(said.code, 71) << command << said.err;
        expect_words(said.err, "the pictures of this scene take");
        expect_words(said.err, "and --memory allows 60.0 MB");
        expect_words(said.err, "bomb.png', 4096 x 4096");
    }
    struct rusage usage = {};
    getrusage(RUSAGE_CHILDREN, &usage);
    if (!is_sanitized) {
        EXPECT_LT(usage.ru_maxrss, 100000) << "kilobytes, where the picture has 50000";
    }
    // With room it is a picture.
    const Said said = render_walls({"--memory", "1G", "-o", "a.exr"});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(image("a.exr").at(12, 15), (Color{}));
}

// A film that does not fit is refused before it is made.
TEST_F(Memory, ARenderBeyondItIsRefusedBeforeItsFirstSample)
{
    const std::vector<std::string> large{"render",      "scene.toml", "-s",    "2", "--size",
                                         "12000x10000", "-o",         "a.exr", "-q"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), large.begin(), large.end());
        return run(more);
    };
    const Said refused = with({"--memory", "2G", "--aov", "all"});
    EXPECT_EQ(refused.code, 71);
    expect_words(refused.err, "error: this render takes ");
    expect_words(refused.err, " GB, and --memory allows 2.00 GB:");
    expect_words(refused.err, "film: 120.0 million pixels of 192 bytes");
    EXPECT_FALSE(exists("a.exr"));
    expect_words(with({"--memory", "3G", "--denoise"}).err, "16411.2 MB denoiser");
    EXPECT_EQ(with({"--memory", "2G", "--crop", "0,0,60,50"}).code, 0);
}

TEST_F(Memory, APictureNeverDependsOnIt)
{
    for (const auto& [name, memory] :
         {std::pair("a.exr", "100%"), std::pair("b.exr", "3G"), std::pair("c.exr", "1.5G")}) {
        const Said said = render_walls({"--memory", memory, "-o", name});
        EXPECT_EQ(said.code, 0) << said.err;
        EXPECT_TRUE(same_pixels(image(name), image("a.exr")));
        EXPECT_EQ(metadata(name, "settings_hash"), metadata("a.exr", "settings_hash"));
    }
    EXPECT_EQ(render_walls({"--memory", "20", "-o", "d.exr"}).code, 71);
    EXPECT_FALSE(exists("d.exr"));
}

TEST_F(Memory, ATextureLimitIsASettingThatBiases)
{
    render_walls({"-o", "a.exr"});
    render_walls({"--texture-limit", "2", "-o", "b.exr"});
    render_walls({"--texture-limit", "1", "-o", "c.exr"});
    EXPECT_TRUE(same_pixels(image("a.exr"), image("b.exr")));
    EXPECT_FALSE(same_pixels(image("a.exr"), image("c.exr")));
    EXPECT_EQ(metadata("a.exr", "bias"), "none");
    EXPECT_EQ(metadata("c.exr", "bias"), "texture_limit=1");
    EXPECT_NE(metadata("a.exr", "settings_hash"), metadata("c.exr", "settings_hash"));
    // One texel is the mean: everything below the horizon has one colour, but for noise.
    const Image mean = image("c.exr");
    const double expected = (1 + linear_from_srgb(188 / 255.0)) / 4;
    EXPECT_NEAR(static_cast<double>(mean.at(12, 15).r), expected, 1e-2);
}

TEST(MemorySizes, AreWrittenWithUnits)
{
    const auto amount = [](const std::string& text) { return to_memory_size("--memory", text).amount; };
    EXPECT_EQ(amount("4G"), 4e9);
    EXPECT_EQ(amount("1.5g"), 1.5e9);
    EXPECT_EQ(amount("500M"), 5e8);
    EXPECT_EQ(amount("2T"), 2e12);
    EXPECT_EQ(amount("7k"), 7e3);
    EXPECT_EQ(amount("123"), 123);
    EXPECT_FALSE(to_memory_size("--memory", "4G").is_part);
    EXPECT_TRUE(to_memory_size("--memory", "80%").is_part);
    EXPECT_DOUBLE_EQ(amount("80%"), 0.8);
    for (const char* wrong : {"", "G", "0", "-1G", "4GB", "4 G", "nan", "inf", "101000%", "%"})
        EXPECT_THROW(amount(wrong), Error) << wrong;
}

}  // namespace
}  // namespace lancer
