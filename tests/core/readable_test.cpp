#include "core/readable.h"

#include <gtest/gtest.h>

#include "core/names.h"

namespace lancer {
namespace {

TEST(Readable, Utf8StaysAndOtherEncodingsBecomeIt)
{
    EXPECT_EQ(readable("Wall_01"), "Wall_01");
    EXPECT_EQ(readable("Fen\xC3\xAAtre"), "Fen\xC3\xAAtre");
    // "Fenêtre", "Größe", "Straße" in Windows-1252.
    EXPECT_EQ(readable("Fen\xEAtre"), "Fen\xC3\xAAtre");
    EXPECT_EQ(readable("Gr\xF6\xDF"
                       "e"),
              "Gr\xC3\xB6\xC3\x9F"
              "e");
    EXPECT_EQ(readable("Stra\xDF"
                       "e"),
              "Stra\xC3\x9F"
              "e");
    // "floor" in Chinese, GB 2312; "material" in Japanese, Shift JIS.
    EXPECT_EQ(readable("\xB5\xD8\xB0\xE5_1"), "\xE5\x9C\xB0\xE6\x9D\xBF_1");
    EXPECT_EQ(readable("\x83\x7D\x83\x65\x83\x8A\x83\x41\x83\x8B"),
              "\xE3\x83\x9E\xE3\x83\x86\xE3\x83\xAA\xE3\x82\xA2\xE3\x83\xAB");
    EXPECT_EQ(readable("a\x81"), "a?");  // of none of them
}

TEST(Readable, ALongNameIsNotCutWithinACharacter)
{
    std::string name;
    for (int i = 0; i < 150; ++i) name += "\xC3\xA9";
    const std::string text = on_one_line("x" + name);
    EXPECT_EQ(text, "x" + name.substr(0, 198) + "...");
}

}  // namespace
}  // namespace lancer
