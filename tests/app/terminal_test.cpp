// What files and names say never steers a terminal.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

using Terminal = AppTest;

// Control characters that are not line feeds or tabs, those of C1 in UTF-8 too.
bool steers(const std::string& text)
{
    for (size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7f) return true;
        if (c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0) return true;
    }
    return false;
}

TEST_F(Terminal, IsSteeredByNoFileAndNoName)
{
    const std::string evil =
        "a\x1b[31m\xc2\x9b"
        "2J\r\nb";
    write(evil + ".toml", std::string(small_scene) + "typo = 1\n[material.\"\\u001b]0;x\\u0007m\"]\nrougness = 1\n");
    write(evil + ".obj", "v 0 0 0\nmtllib \x1b[2J.mtl\nusemtl \x1b[1m\nf 1 2 \x1b[3m\n");
    Metadata header{{"lancer", std::string("\x1b[5m")},
                    {"scene", std::string("\xc2\x9b"
                                          "31m")}};
    write_exr(file("evil.exr"), make_image(4, 4), header);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"render", evil + ".toml"},
                                               {"check", evil + ".toml"},
                                               {"check", evil + ".obj"},
                                               {"info", evil + ".obj"},
                                               {"render", "gone" + evil},
                                               {"render", "scene.toml", "--" + evil},
                                               {"render", "scene.toml", "--camera", evil},
                                               {"render", "scene.toml", "-D", evil + "=1"},
                                               {"render", "scene.toml", "-o", evil},
                                               {"info", "evil.exr"},
                                               {"verify", "evil.exr"},
                                               {"compare", "evil.exr", evil + ".exr"},
                                               {"merge", evil + ".lancer", "-o", "a.exr"},
                                               {"denoise", evil, "-o", "a.exr"},
                                               {"study", evil}}) {
        const Said said = run(words);
        EXPECT_FALSE(steers(said.out)) << words[0] << ": " << said.out;
        EXPECT_FALSE(steers(said.err)) << words[0] << ": " << said.err;
        EXPECT_FALSE(said.out.empty() && said.err.empty()) << words[0];
    }
}

TEST_F(Terminal, AScriptGetsTheVeryNameOfAPicture)
{
    const std::string odd = "odd\x1b[31m.exr";
    const Said said = render({"-o", odd, "-q"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, odd + "\n");
    EXPECT_TRUE(exists(odd));
}

TEST_F(Terminal, PicturesMaySayNothing)
{
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png", "--no-metadata"}).code, 0);
    EXPECT_TRUE(read_exr_info(file("a.exr")).metadata.empty());
    expect_words(run({"info", "a.png"}).out, "size          24x16");
    EXPECT_EQ(run({"info", "a.png"}).out.find("seed"), std::string::npos);
    EXPECT_EQ(run({"verify", "a.exr"}).code, 65);
}

}  // namespace
}  // namespace lancer
