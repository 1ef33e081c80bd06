// Meshes compressed by gzip, xz and zstd, as a user gives them.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/run_program.h"

namespace lancer {
namespace {

using namespace std::string_view_literals;

constexpr const char* block_text =
    "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nv 0 3 0\nv 2 3 0\nv 2 3 1\nv 0 3 1\n"
    "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
// That text, as gzip -9n, xz -9 and zstd -19 compress it.
constexpr std::string_view block_gzip =
    "\037\213\010\000\000\000\000\000\002\003\115\313\311\015\000\041\014\103\321\073\125\270\004\222\020\240\042"
    "\112\240\176\074\321\260\210\303\263\276\302\104\376\136\232\320\107\241\371\150\177\277\356\056\151\100\242"
    "\024\056\107\107\103\215\346\250\120\056\245\015\306\145\264\307\135\241\316\277\013\035\265\004\222\174\000"
    "\000\000"sv;
constexpr std::string_view block_xz =
    "\375\067\172\130\132\000\000\001\151\042\336\066\002\000\041\001\034\000\000\000\020\317\130\314\340\000\173"
    "\000\072\135\000\073\010\002\021\002\012\200\133\240\340\000\060\215\223\044\112\001\024\146\330\070\200\174"
    "\361\371\343\244\145\173\054\126\323\355\004\312\160\066\274\312\027\050\111\351\155\305\010\264\052\312\121"
    "\146\365\002\361\100\323\340\000\000\000\000\035\265\004\222\000\001\122\174\352\267\270\361\220\102\231\015"
    "\001\000\000\000\000\001\131\132"sv;
constexpr std::string_view block_zstd =
    "\050\265\057\375\004\150\375\001\000\122\304\012\015\320\035\003\064\000\100\204\024\341\100\136\036\003\040"
    "\333\171\345\070\255\100\343\367\254\060\337\166\343\271\255\120\323\263\254\040\024\057\310\274\020\307\361"
    "\006\007\000\227\222\366\346\145\120\000\024\330\231\057\050\272\161\275\060\351\341\133"sv;

class Compressed : public AppTest {
protected:
    Compressed()
    {
        write("block.obj", block_text);
        for (const auto& [ending, bytes] : kinds) write("block.obj." + ending, std::string(bytes));
    }
    static inline const std::vector<std::pair<std::string, std::string_view>> kinds{
        {"gz", block_gzip}, {"xz", block_xz}, {"zst", block_zstd}};
};

TEST_F(Compressed, MeshesHaveThePixelsOfWhatTheyHold)
{
    ASSERT_EQ(run({"render", "block.obj", "--size", "24x16", "-s", "2", "-q", "-o", "plain.exr"}).code, 0);
    for (const auto& [ending, bytes] : kinds) {
        // The picture has the name of the scene.
        std::filesystem::remove(file("block.exr"));
        const Said said = run({"render", "block.obj." + ending, "--size", "24x16", "-s", "2", "-q"});
        ASSERT_EQ(said.code, 0) << ending << said.err;
        EXPECT_TRUE(same_pixels(image("plain.exr"), image("block.exr"))) << ending;
        EXPECT_EQ(run({"check", "block.obj." + ending}).code, 0) << ending;
        expect_words(run({"info", "block.obj." + ending}).out, "12, drawn 12");
    }
}

// What goes by the bytes of a file needs no ending: one that a program saved under a plain name is read too.
TEST_F(Compressed, MeshesOfScenesNeedNoEnding)
{
    write("plain.obj", std::string(block_gzip));
    const std::string rest = "\"\n[[light]]\ntype = \"environment\"\nradiance = 1\n";
    for (const std::string mesh : {"block.obj", "plain.obj", "block.obj.zst"}) {
        write("s.toml", "[[mesh]]\nfile = \"" + mesh + rest);
        const Said said = run({"render", "s.toml", "--size", "24x16", "-s", "2", "-q", "-o", mesh + ".exr"});
        ASSERT_EQ(said.code, 0) << said.err;
        EXPECT_TRUE(same_pixels(image("block.obj.exr"), image(mesh + ".exr"))) << mesh;
    }
}

// Several streams one behind the other are one file, as `cat a.gz b.gz` makes it.
TEST_F(Compressed, StreamsOneBehindTheOtherAreOneFile)
{
    const std::string text = block_text;
    write("twice.obj", text + text);
    ASSERT_EQ(run({"render", "twice.obj", "--size", "24x16", "-s", "2", "-q", "-o", "plain.exr"}).code, 0);
    for (const auto& [ending, bytes] : kinds) {
        write("twice.obj." + ending, std::string(bytes) + std::string(bytes));
        ASSERT_EQ(run({"render", "twice.obj." + ending, "--size", "24x16", "-s", "2", "-q"}).code, 0);
        EXPECT_TRUE(same_pixels(image("plain.exr"), image("twice.exr"))) << ending;
    }
}

TEST_F(Compressed, DamagedFilesFailClearly)
{
    for (const auto& [ending, bytes] : kinds) {
        const std::string name = "bad.obj." + ending;
        for (const size_t length : {size_t{6}, bytes.size() / 2, bytes.size() - 1}) {
            write(name, std::string(bytes.substr(0, length)));
            const Said said = run({"render", name, "-o", "bad.exr"});
            EXPECT_EQ(said.code, 65) << name << " of " << length << " bytes: " << said.err;
            expect_words(said.err, name + ": error: the compressed data");
        }
        std::string flipped(bytes);
        flipped[bytes.size() / 2] ^= 0x55;
        write(name, flipped);
        EXPECT_EQ(run({"render", name, "-o", "bad.exr"}).code, 65) << name;
        EXPECT_FALSE(exists("bad.exr"));
    }
}

}  // namespace
}  // namespace lancer
