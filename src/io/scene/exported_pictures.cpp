#include "io/scene/exported_pictures.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "materials/fresnel.h"
#include "materials/material.h"
#include "materials/thin_sheet.h"
#include "scene/environment/environment.h"
#include "scene/shading_normal.h"

namespace lancer {
namespace {

constexpr uint32_t cosines = 256, coat_roughnesses = 65;

float cosine_of(uint32_t column) { return static_cast<float>(column) / static_cast<float>(cosines - 1); }

// f(texture) for each that multiplies a parameter, and for maps of normals.
template <class F>
void for_each_texture_of(const Scene& scene, uint32_t id, const F& f)
{
    const auto see = [&](const auto& param) {
        if (param.texture != no_texture) f(param.texture);
    };
    std::visit([&](const auto& m) { for_each_textured_parameter(m, see); }, scene.materials[id]);
    for_each_textured_parameter(scene.emission[id], see);
    for_each_textured_parameter(scene.traits[id], see);
    if (!scene.mix_of.empty() && scene.mix_of[id] != Scene::none) see(scene.mixes[scene.mix_of[id]].weight);
    if (scene.traits[id].normal_map != no_texture) f(scene.traits[id].normal_map);
}

ExportedPicture picture_of(const std::string& name, const ImageTexture& image)
{
    return {name, image.width(), image.height(), !image.has_floats(),
            [&image](uint32_t x, uint32_t y) { return image.texel(x, y); }};
}

// The normals of the slopes at the texels of the heights, for tangents that are orthogonal.
ExportedPicture normals_of(const std::string& name, const Scene& scene, const MaterialTraits& traits)
{
    const auto& heights = std::get<ImageTexture>(scene.textures[traits.bump]);
    MaterialTraits bumps;
    bumps.bump = traits.bump, bumps.bump_scale = traits.bump_scale;
    const auto texel = [&scene, &heights, bumps](uint32_t x, uint32_t y) {
        const ImageUse& use = heights.use();
        const auto place = [](uint32_t i, uint32_t count, float factor, float shift) {
            return ((i + 0.5) / count - static_cast<double>(shift)) / static_cast<double>(factor);
        };
        const ShadingPoint point{.uv = {place(x, heights.width(), use.scale.x, use.offset.x),
                                        place(heights.height() - 1 - y, heights.height(), use.scale.y, use.offset.y)},
                                 .textures = scene.textures.data()};
        const Vec3 n = mapped_normal(bumps, point, Tangents{{1, 0, 0}, {0, 1, 0}}, {}, {0, 0, 1});
        return Color{0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z};
    };
    return {name, heights.width(), heights.height(), true, texel};
}

// Columns are cosines from 0 to 1, rows are roughnesses from 0, at the lower edge, to 1; one row if it is the same
// everywhere.
ExportedPicture coat_of(const std::string& name, const Plastic& plastic)
{
    const bool is_even = plastic.roughness.texture == no_texture;
    const uint32_t rows = is_even ? 1 : coat_roughnesses;
    const auto texel = [&plastic, is_even, rows](uint32_t x, uint32_t y) {
        Plastic here = plastic;
        here.base = {}, here.roughness.texture = no_texture;
        if (!is_even) here.roughness.value = static_cast<float>(rows - 1 - y) / static_cast<float>(rows - 1);
        const float through = here.at({}).coat().through(cosine_of(x));
        return Color{through, through, through};
    };
    return {name, cosines, rows, false, texel};
}

// What a clear rough sheet lets through or reflects over what a smooth one does, all scattering between its facets
// included.
double part_left(const Glass& glass, float cos, bool through)
{
    constexpr uint32_t side = 32;  // samples are stratified
    Glass clear = glass;
    clear.tint = Color{1, 1, 1};
    const GlassLobes multiple = clear.at({}).multiple;
    clear.losses.reset();
    const GlassBsdf once = clear.at({});
    const Vec3 wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
    double sum = 0;
    for (uint32_t i = 0; i < side * side; ++i) {
        const Vec2 v{(static_cast<float>(i % side) + 0.5f) / side, (static_cast<float>(i / side) + 0.5f) / side};
        const auto s = once.sample(wo, through ? 0x1.fffffep-1f : 0, v);
        if (s) sum += static_cast<double>(s->weight.g);
    }
    const double c = static_cast<double>(cos);
    const double smooth =
        part_of_sheet(fresnel_dielectric_double(c, (1 - c) * (1 + c), double{glass.ior}).reflectance, through);
    const float part = through ? multiple.part_through : 1 - multiple.part_through;
    const double further = multiple ? static_cast<double>(multiple.here.loss(cos) * part) : 0;
    return sum / (side * side) + (smooth > 0 ? further / smooth : 0);
}

// Columns as of a coat. The upper row is what is let through, the lower one what is reflected.
ExportedPicture sheet_of(const std::string& name, const Glass& glass)
{
    const auto texel = [&glass](uint32_t x, uint32_t y) {
        const float cos = std::max(cosine_of(x), 0.25f * cosine_of(1));
        const auto left = static_cast<float>(part_left(glass, cos, y == 0));
        return Color{left, left, left};
    };
    return {name, cosines, 2, false, texel};
}

}  // namespace

std::string ExportedPictures::file_of_texture(uint32_t texture)
{
    return "texture_" + std::to_string(texture) + ".exr";
}

ExportedPictures exported_pictures(const Scene& scene)
{
    ExportedPictures all;
    const size_t count = scene.materials.size();
    all.bumps.resize(count), all.coats.resize(count), all.sheets.resize(count);
    std::map<std::pair<uint32_t, float>, std::string> bumps;
    std::map<std::tuple<float, float, bool>, std::string> coats;
    for (uint32_t id = 0; id < count; ++id) {
        for_each_texture_of(scene, id, [&](uint32_t texture) {
            if (!all.textures.emplace(texture, all.textures.size()).second) return;
            if (const auto* image = std::get_if<ImageTexture>(&scene.textures[texture]))
                all.files.push_back(picture_of(ExportedPictures::file_of_texture(texture), *image));
        });
        const MaterialTraits& traits = scene.traits[id];
        if (traits.bump != no_texture && std::holds_alternative<ImageTexture>(scene.textures[traits.bump])) {
            const auto [entry, is_new] =
                bumps.try_emplace({traits.bump, traits.bump_scale}, "bumps_" + std::to_string(id) + ".exr");
            all.bumps[id] = entry->second;
            if (is_new) all.files.push_back(normals_of(entry->second, scene, traits));
        }
        if (const auto* plastic = std::get_if<Plastic>(&scene.materials[id])) {
            const bool is_even = plastic->roughness.texture == no_texture;
            const auto [entry, is_new] = coats.try_emplace(
                {plastic->ior, is_even ? plastic->roughness.value : 0, is_even}, "coat_" + std::to_string(id) + ".exr");
            all.coats[id] = entry->second;
            if (is_new) all.files.push_back(coat_of(entry->second, *plastic));
        }
        const auto* glass = std::get_if<Glass>(&scene.materials[id]);
        if (glass && glass->thin && glass->roughness.texture == no_texture && !glass->at({}).only_delta()) {
            all.sheets[id] = "sheet_" + std::to_string(id) + ".exr";
            all.files.push_back(sheet_of(all.sheets[id], *glass));
        }
    }
    if (scene.environment_map) {
        all.environment = "environment.exr";
        all.files.push_back({all.environment, scene.environment_map->width(), scene.environment_map->height(), false,
                             [map = scene.environment_map.get()](uint32_t x, uint32_t y) { return map->texel(x, y); }});
    }
    return all;
}

}  // namespace lancer
