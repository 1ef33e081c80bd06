#include "core/names.h"

#include <gtest/gtest.h>

namespace lancer {
namespace {

const std::vector<std::string> camera_keys{"type", "position", "target", "up", "fov", "aperture", "focus"};

TEST(EditDistance, CountsEachKindOfSlipOnce)
{
    EXPECT_EQ(edit_distance("glass", "glass"), 0u);
    EXPECT_EQ(edit_distance("galss", "glass"), 1u) << "swapped";
    EXPECT_EQ(edit_distance("glas", "glass"), 1u) << "missing";
    EXPECT_EQ(edit_distance("glasss", "glass"), 1u) << "one too many";
    EXPECT_EQ(edit_distance("gloss", "glass"), 1u) << "another";
    EXPECT_EQ(edit_distance("GLASS", "glass"), 0u) << "case";
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(EditDistance, IsSymmetric)
{
    for (const char* a : {"", "up", "pu", "target", "tragte"}) {
        for (const char* b : {"", "up", "pu", "target", "tragte"}) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
    }
}

TEST(Nearest, FindsATypo)
{
    EXPECT_EQ(nearest("positon", camera_keys), "position");
    EXPECT_EQ(nearest("FOV", camera_keys), "fov");
    EXPECT_EQ(nearest("focal", camera_keys), std::nullopt);
    EXPECT_EQ(nearest("fcous", camera_keys), "focus");
    EXPECT_EQ(nearest("aparture", camera_keys), "aperture");
}

TEST(Nearest, IsSilentWhenNothingIsNear)
{
    EXPECT_EQ(nearest("roughness", camera_keys), std::nullopt);
    EXPECT_EQ(nearest("x", camera_keys), std::nullopt);
    EXPECT_EQ(nearest("", camera_keys), std::nullopt);
    EXPECT_EQ(nearest("x", std::vector<std::string>{"y"}), std::nullopt) << "no letter in common";
    EXPECT_EQ(nearest("x", std::vector<std::string>{}), std::nullopt);
    EXPECT_EQ(nearest(std::string(1000, 'a'), std::vector<std::string>{std::string(1001, 'a')}), std::nullopt);
}

TEST(Nearest, TakesTheClosestAndOfEqualsTheFirst)
{
    EXPECT_EQ(nearest("golden", std::vector<std::string>{"golder1", "golden1"}), "golden1");
    EXPECT_EQ(nearest("red", std::vector<std::string>{"red1", "red2"}), "red1");
}

TEST(Suggestion, NamesTheNearestAndTheKnown)
{
    const std::vector<std::string> known{"glass", "gold"};
    EXPECT_EQ(suggestion("galss", known), "; did you mean 'glass'? known: glass, gold");
    EXPECT_EQ(suggestion("wood", known), "; known: glass, gold");
    EXPECT_EQ(suggestion("wood", std::vector<std::string>{}), "");
}

TEST(Suggestion, CutsALongList)
{
    std::vector<std::string> known;
    for (int i = 0; i < 1000; ++i) known.push_back("m" + std::to_string(i));
    const std::string text = suggestion("something", known);
    EXPECT_NE(text.find("m19 and 980 more"), std::string::npos) << text;
}

TEST(InQuotes, StaysOnOneShortLine)
{
    EXPECT_EQ(in_quotes("a"), "'a'");
    EXPECT_EQ(in_quotes("a\n\x1b[31mb"), "'a??[31mb'");
    EXPECT_EQ(in_quotes(std::string(300, 'a')), "'" + std::string(200, 'a') + "...'");
}

}  // namespace
}  // namespace lancer
