// The lists of parameters against the manual, and against what is built of them.
#include <gtest/gtest.h>

#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

#include "materials/material.h"
#include "scene/description/light.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

std::string text_of(double x)
{
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(x)).ptr;
    return "`" + std::string(digits.data(), end) + "`";
}

// Kinds, defaults and ranges as the tables of the manual write them.
std::string kind_of(const Color&) { return "colour"; }
std::string kind_of(float) { return "number"; }
std::string kind_of(double) { return "number"; }
std::string kind_of(int32_t) { return "integer"; }
std::string kind_of(bool) { return "string"; }
std::string kind_of(const std::string&) { return "string"; }
std::string kind_of(const Vec3d&) { return "vector"; }
std::string kind_of(const TextureUse&) { return "texture"; }
template <class T>
std::string kind_of(const std::optional<T>&)
{
    return std::is_same_v<T, bool> ? "boolean" : kind_of(T{});
}

std::string default_of(const Color& c) { return text_of(double{c.r}); }
std::string default_of(float x) { return text_of(double{x}); }
std::string default_of(const std::string&) { return "*required*"; }
template <class T>
std::string default_of(const std::optional<T>& x)
{
    if constexpr (std::is_same_v<T, float>)
        if (x) return text_of(double{*x});
    return "none";
}

std::string range_of(ParameterRange range, bool is_color)
{
    switch (range) {
        case ParameterRange::unit:
            return is_color ? "each 0 to 1" : "0 to 1";
        case ParameterRange::not_negative:
            return "0 or more";
        case ParameterRange::positive:
            return "greater than 0";
        case ParameterRange::quarter_turn:
            return "0 to 90";
        case ParameterRange::below_one:
            return "-0.999 to 0.999";
        case ParameterRange::nonzero_vector:
            return "not zero";
        case ParameterRange::finite:
        case ParameterRange::texture:
            return "";
        case ParameterRange::million:
            return "-1000000 to 1000000";
        case ParameterRange::name:
            return "a `[material.NAME]` or a preset";
        case ParameterRange::group:
            return "letters, digits, `_`, `-`";
        case ParameterRange::boolean:
            return "`true`, `false`";
        case ParameterRange::choice:
            break;
    }
    return "";
}

std::string listed(const std::vector<MaterialType>& types)
{
    if (types.empty()) return "all";
    if (types.size() + 1 == enum_names<MaterialType>.size() && types.back() != MaterialType::mix) return "all but mix";
    std::string text;
    for (const MaterialType type : types) text += (text.empty() ? "" : ", ") + std::string(name_of(type));
    return text;
}

// "`0.8`; mirror, glass `1`": what most types have stands first, without their names.
template <class Row>
std::string defaults(const Row& row)
{
    if (row.range == ParameterRange::group) return "none";
    std::vector<MaterialType> types = types_with(row.key);
    if (types.empty()) types = {MaterialType::lambert};
    std::vector<std::pair<std::string, std::vector<MaterialType>>> groups;
    for (const MaterialType type : types) {
        const MaterialDescription d = default_description(type);
        const std::string text = [&] {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(row.value_of(d))>, bool>)
                return row.range == ParameterRange::boolean ? std::string(row.value_of(d) ? "`true`" : "`false`")
                                                            : "`\"" + std::string(row.words[row.value_of(d)]) + "\"`";
            else
                return default_of(row.value_of(d));
        }();
        auto it = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == text; });
        if (it == groups.end()) it = groups.insert(it, {text, {}});
        it->second.push_back(type);
    }
    if (groups.size() == 1) return groups[0].first;
    const auto larger = [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); };
    std::rotate(groups.begin(), std::max_element(groups.begin(), groups.end(), larger), groups.end());
    const bool is_most = groups[0].second.size() > groups[1].second.size();
    std::string text;
    for (const auto& [value, of] : groups)
        text += (text.empty() ? (is_most ? "" : listed(of) + " ") : "; " + listed(of) + " ") + value;
    return text;
}

// The rows of so many cells in a section of the manual, each without its last cell, by what stands in its first ones.
std::map<std::string, std::string> manual_rows(const std::string& section, size_t columns, size_t keys)
{
    std::ifstream manual(LANCER_SOURCE_DIR "/docs/scene-format.md");
    std::map<std::string, std::string> rows;
    bool is_inside = false;
    std::string above;
    for (std::string line; std::getline(manual, line);) {
        if (line.starts_with("## ")) is_inside = line == section;
        if (!is_inside || !line.starts_with("| ")) continue;
        std::vector<std::string> cells;
        std::istringstream row(line.substr(2));
        for (std::string cell; std::getline(row, cell, '|');) {
            while (cell.starts_with(" ")) cell.erase(0, 1);
            while (cell.ends_with(" ")) cell.pop_back();
            cells.push_back(cell);
        }
        if (cells.size() != columns) continue;
        if (keys == 2) above = cells[0] = cells[0].empty() ? above : cells[0];
        std::string key, rest;
        for (size_t i = 0; i + 1 < cells.size(); ++i) (i < keys ? key : rest) += cells[i] + " | ";
        rows[key] = rest;
    }
    return rows;
}

TEST(Parameters, OfMaterialsAreWhatTheManualSays)
{
    std::map<std::string, std::string> manual = manual_rows("## `[material.NAME]`", 6, 1);
    const auto expect = [&](std::string_view key, const std::string& row) {
        const std::string name = "`" + std::string(key) + "` | ";
        EXPECT_EQ(manual[name], row) << name << row;
        manual.erase(name);
    };
    for_each_material_parameter([&](const auto& row) {
        const MaterialDescription d;
        const auto& field = row.value_of(d);
        using Field = std::remove_cvref_t<decltype(field)>;
        const std::string types = listed(types_with(row.key)) + " | ";
        std::string range = range_of(row.range, kind_of(field) == "colour");
        if (row.range == ParameterRange::choice)
            range = "`\"" + std::string(row.words[0]) + "\"`, `\"" + std::string(row.words[1]) + "\"`";
        if (row.role == TextureRole::heights) range = row.key == "bump_texture" ? "a picture or waves" : "a picture";
        const std::string kind = row.range == ParameterRange::boolean ? "boolean" : kind_of(field);
        expect(row.key, kind + " | " + (std::is_same_v<Field, TextureUse> ? "none" : defaults(row)) + " | " + range +
                            " | " + types);
        if constexpr (has_map<decltype(row)>) expect(row.map_key, "texture | none |  | " + types);
    });
    for (const char* own : {"key", "`type`", "`preset`", "`metal`"}) manual.erase(std::string(own) + " | ");
    for (const auto& [key, row] : manual) ADD_FAILURE() << "not in the list: " << key << row;
}

TEST(Parameters, OfLightsAreWhatTheManualSays)
{
    const std::map<std::string, std::string> manual = manual_rows("## `[[light]]`", 7, 2);
    for (size_t i = 0; i < enum_names<LightType>.size(); ++i)
        for_each_parameter_of(static_cast<LightType>(i), [&](const auto& row) {
            const std::string key =
                "`\"" + std::string(enum_names<LightType>[i]) + "\"` | `" + std::string(row.key) + "` | ";
            ASSERT_TRUE(manual.count(key)) << key;
            const LightDescription d;
            const std::string kind = kind_of(d.*row.field) + " | ";
            const std::string said = manual.at(key), range = range_of(row.range, false) + " | ";
            EXPECT_TRUE(said.starts_with(kind) && said.ends_with(range) && said.find("*required*") != std::string::npos)
                << key << said;
        });
}

// What holds a texture can be given one, so that no fold or export goes past it.
TEST(Parameters, ThatTakeATextureHaveAKeyForIt)
{
    for_each_material_type([&]<class M> {
        M material{};
        for_each_parameter(material, [&]<class T>(std::string_view key, const T&) {
            for_each_material_parameter([&](const auto& row) {
                if (row.key == key) {
                    EXPECT_EQ(is_textured<T>, has_map<decltype(row)>) << key;
                }
            });
        });
    });
}

}  // namespace
}  // namespace lancer
