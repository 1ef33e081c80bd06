// A TOML text that is changed keeps its comments and its order, and says what it is meant to.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/input_text.h"
#include "io/scene/definition.h"
#include "io/toml_edit.h"
#include "io/toml_file.h"

namespace lancer {
namespace {

constexpr const char* room = R"(# A room.
version = 1

[camera]            # at the door
position = [0, 1, 5]  # metres
target = [
    0, 0.5, # a list of many lines
    0,
]

[camera.high]
fov = 30

# lamps
[[light]]
type = "point"  # höher: ü
intensity = 3
[[light]]
type = "sphere"

[material."white paint"]
base_color = 0.8
[material.glass]
type = "glass" # of the window
)";

// What -D KEY=VALUE makes of a text.
TomlValue defined(const std::string& text, const std::vector<std::string>& definitions)
{
    Diagnostics none;
    TomlValue tree = *parse_toml(text, "", none);
    TomlProblems problems({""});
    for (const std::string& d : definitions) {
        const Definition definition = parse_definition(d);
        define(tree, definition, parse_toml_value(definition.value), problems);
    }
    return tree;
}

std::string edited(const std::string& text, const std::vector<std::string>& definitions)
{
    return edited_toml_text(text, defined(text, definitions)).value_or("impossible");
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(TomlEdit, ValuesAreReplacedWhereTheyStand)
{
    EXPECT_EQ(edited(room, {"camera.position=[1, 2, 3]"}), replaced(room, "[0, 1, 5]", "[1, 2, 3]"));
    EXPECT_EQ(edited(room, {"light.0.intensity=4.5"}), replaced(room, "intensity = 3", "intensity = 4.5"));
    EXPECT_EQ(edited(room, {"light.0.type=spot"}), replaced(room, "\"point\"  # h", "\"spot\"  # h"));
    EXPECT_EQ(edited(room, {"camera.target=[1, 2, 3]"}),
              replaced(room, "[\n    0, 0.5, # a list of many lines\n    0,\n]", "[1, 2, 3]"));
    EXPECT_EQ(edited(room, {"material.\"white paint\".base_color=[1, 0.5, 0]"}), replaced(room, "0.8", "[1, 0.5, 0]"));
}

TEST(TomlEdit, NewKeysFollowThoseOfTheirTable)
{
    EXPECT_EQ(edited(room, {"camera.fov=40"}), replaced(room, "    0,\n]\n", "    0,\n]\nfov = 40\n"));
    EXPECT_EQ(edited(room, {"light.1.radius=0.5"}),
              replaced(room, "type = \"sphere\"\n", "type = \"sphere\"\nradius = 0.5\n"));
    EXPECT_EQ(edited(room, {"material.glass.ior=1.4"}), room + std::string("ior = 1.4\n"));
    EXPECT_EQ(edited("[a]", {"a.b=1"}), "[a]\nb = 1\n");
    EXPECT_EQ(edited("[a.b]\nc = 1\n", {"a.d=2"}), "[a.b]\nc = 1\n\n[a]\nd = 2\n");
    EXPECT_EQ(edited("a = {b = 1} # c\n", {"a.d=2"}), "a = {b = 1, d = 2} # c\n");
}

TEST(TomlEdit, NewTablesComeLastAndNewOnesOfAListWhereTheyBelong)
{
    EXPECT_EQ(edited(room, {"render.spp=8"}), room + std::string("\n[render]\nspp = 8\n"));
    TomlValue tree = defined(room, {});
    auto& lights = std::get<TomlValue::Array>(std::get<TomlValue::Table>(tree.data)[2].value.data);
    TomlValue sun = lights[0];
    std::get<TomlValue::Table>(sun.data)[0].value.data = std::string("sun");
    lights.push_back(sun);
    EXPECT_EQ(edited_toml_text(room, tree), room + std::string("\n[[light]]\ntype = \"sun\"\nintensity = 3\n"));
    lights.pop_back();
    lights.insert(lights.begin(), sun);
    EXPECT_EQ(edited_toml_text(room, tree),
              replaced(room, "[[light]]", "[[light]]\ntype = \"sun\"\nintensity = 3\n\n[[light]]"));
}

TEST(TomlEdit, KeysAreTakenAway)
{
    TomlValue tree = defined(room, {});
    auto& camera = std::get<TomlValue::Table>(std::get<TomlValue::Table>(tree.data)[1].value.data);
    camera.erase(camera.begin());
    EXPECT_EQ(edited_toml_text(room, tree), replaced(room, "position = [0, 1, 5]  # metres\n", ""));
}

// It rather gives up than to say something else.
TEST(TomlEdit, WhatHasNoPlaceInTheTextIsNotSaidThere)
{
    TomlValue tree = defined(room, {});
    auto& root = std::get<TomlValue::Table>(tree.data);
    root.pop_back();
    EXPECT_FALSE(edited_toml_text(room, tree)) << "a table is gone";
    EXPECT_FALSE(edited_toml_text("no TOML = =", tree));
}

TEST(TomlEdit, NothingToSayLeavesEveryByte)
{
    const std::filesystem::path scenes = LANCER_SOURCE_DIR "/scenes";
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
        if (entry.path().extension() != ".toml") continue;
        const std::string text = read_input_text(entry.path().string());
        EXPECT_EQ(edited_toml_text(text, defined(text, {})), text) << entry.path();
        // One line is another, or one more.
        const auto changed = edited_toml_text(text, defined(text, {"render.seed=12345"}));
        ASSERT_TRUE(changed) << entry.path();
        EXPECT_NE(changed->find("seed = 12345"), changed->npos);
        EXPECT_LT(changed->size(), text.size() + 40);
        ++count;
    }
    EXPECT_GT(count, 15);
}

}  // namespace
}  // namespace lancer
