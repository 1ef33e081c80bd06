#include "io/scene/background_tables.h"

#include <array>
#include <string>

#include "io/scene/light_group.h"

namespace lancer {
namespace {

constexpr NumberRule whole_turn{[](double x) { return x > 0 && x <= 360; }, "greater than 0 and at most 360"};

BackgroundPicture read_picture(const TomlTable& table, const AssetFolder& assets, bool is_ground)
{
    table.allow({"file", "projection", "rotate", "scale", "fov", "margin", "size"});
    BackgroundPicture picture;
    picture.where = table.where();
    // In the order of Projection.
    NameList projections{"latlong", "lachaud", "equidistant", "orthographic", "equisolid"};
    if (is_ground) projections.push_back("planar");
    if (const std::optional<size_t> p = table.choice("projection", projections, 0)) {
        picture.projection = static_cast<Projection>(*p);
        const auto needs = [&](const char* key, bool fits, const char* what) {
            if (!fits && table.has(key)) table.error(key, std::string(" needs ") + what);
        };
        const bool is_lens = is_fish_eye(picture.projection) && picture.projection != Projection::lachaud;
        needs("fov", is_lens, "the projection 'equidistant', 'orthographic' or 'equisolid'");
        needs("margin", is_fish_eye(picture.projection), "the projection of a fish-eye");
        needs("size", picture.projection == Projection::planar, "the projection 'planar'");
    }
    // Photographs for this projection were cropped so.
    if (picture.projection == Projection::lachaud) picture.margin = 15;
    picture.rotate_deg = table.number("rotate", any_number).value_or(picture.rotate_deg);
    picture.scale = table.color("scale", brightness).value_or(picture.scale);
    picture.fov_deg = table.number("fov", whole_turn).value_or(picture.fov_deg);
    if (picture.projection == Projection::orthographic && picture.fov_deg > 180)
        table.error("fov", " must be at most 180 with the projection 'orthographic'");
    picture.margin = table.number("margin", zero_or_more).value_or(picture.margin);
    picture.size = table.number("size", above_zero).value_or(picture.size);

    const std::optional<std::string> name = table.require("file") ? table.text("file") : std::nullopt;
    if (!name) return picture;
    const AssetFolder::Found found = assets.find(*name);
    picture.file = found.path;
    if (!found.problem.empty())
        table.error(table.where("file"), "picture " + in_quotes(*name) + " " + found.problem, found.kind);
    return picture;
}

std::optional<TomlTable> find_table(const TomlTable& background, std::string_view key)
{
    for (const auto& [name, table] : background.tables_within("background"))
        if (name == key) return table;
    return {};
}

}  // namespace

void read_background(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene)
{
    const std::optional<TomlTable> table = root.table("background");
    if (!table) return;
    table->allow({"sky", "ground", "fade", "up", "strength", "glow", "group"});
    BackgroundDescription b;
    b.where = table->where();
    b.group = read_group(*table).value_or("");
    if (const auto sky = find_table(*table, "sky")) {
        b.sky = SkyType::picture;
        b.sky_picture = read_picture(*sky, assets, false);
    } else if (table->holds_text("sky")) {
        const NameList names{"gradient", "night", "dawn", "dusk", "noon"};
        if (const auto i = table->choice("sky", names, 0))
            b.sky = std::array{SkyType::gradient, SkyType::night, SkyType::dawn, SkyType::dusk, SkyType::noon}[*i];
    } else {
        b.sky_color = table->color("sky", brightness).value_or(b.sky_color);
    }
    if (const auto ground = find_table(*table, "ground")) {
        b.ground = GroundType::picture;
        b.ground_picture = read_picture(*ground, assets, true);
    } else if (table->holds_text("ground")) {
        if (table->choice("ground", {"checker"}, 0)) b.ground = GroundType::checker;
    } else if (const auto color = table->color("ground", brightness)) {
        b.ground = GroundType::color;
        b.ground_color = *color;
    }
    b.fade = table->color("fade", brightness);
    const bool fades = b.ground == GroundType::checker ||
                       (b.ground == GroundType::picture && b.ground_picture.projection == Projection::planar);
    if (b.fade && !fades) table->error("fade", " needs a ground that is a checker or a planar picture");
    b.z_up = table->choice("up", {"y", "z"}, 0).value_or(0) == 1;
    b.strength = static_cast<float>(table->number("strength", brightness).value_or(b.strength));
    b.glow = table->boolean("glow").value_or(b.glow);
    scene.background = b;
}

}  // namespace lancer
