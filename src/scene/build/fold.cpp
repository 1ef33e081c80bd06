#include "scene/build/fold.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "materials/material.h"

namespace lancer {
namespace {

// f(param) for all that is looked up where a ray meets material `id`, but for bumps.
template <class F>
void for_params(Scene& scene, uint32_t id, const F& f)
{
    std::visit([&](auto& m) { for_each_textured_parameter(m, f); }, scene.materials[id]);
    for_each_textured_parameter(scene.emission[id], f);
    for_each_textured_parameter(scene.traits[id], f);
    if (!scene.mix_of.empty() && scene.mix_of[id] != Scene::none)
        for_each_textured_parameter(scene.mixes[scene.mix_of[id]], f);
}

std::optional<Color> value_of(const Texture& t)
{
    if (const auto* image = std::get_if<ImageTexture>(&t))
        return image->is_constant() ? std::optional(image->eval({}, {})) : std::nullopt;
    if (const auto* checker = std::get_if<Checker>(&t))
        return checker->even == checker->odd ? std::optional(checker->even) : std::nullopt;
    if (const auto* grid = std::get_if<Grid>(&t))
        return grid->band == grid->ground ? std::optional(grid->eval({}, {})) : std::nullopt;
    return {};
}

// As ShadingPoint::eval().
void fold(ColorParam& p, Color value)
{
    p.value = p.value * Color{std::max(0.0f, value.r), std::max(0.0f, value.g), std::max(0.0f, value.b)};
}
void fold(FloatParam& p, Color value) { p.value = p.value * value.r; }

// The part that a mix always is, if it is always the same and no mix itself.
uint32_t only_part(const Scene& scene, const Mix& mix)
{
    if (mix.weight.texture != no_texture || (mix.weight.value > 0 && mix.weight.value < 1)) return Scene::none;
    const uint32_t part = mix.weight.value >= 1 ? mix.second : mix.first;
    return scene.mix_of[part] == Scene::none ? part : Scene::none;
}

// Parts come before the mixes that are made of them.
void mark_texture_readers(Scene& scene)
{
    for (uint32_t id = 0; id < scene.materials.size(); ++id) {
        MaterialTraits& traits = scene.traits[id];
        traits.reads_uv = traits.needs_tangents();
        for_params(scene, id, [&](const auto& p) { traits.reads_uv = traits.reads_uv || p.texture != no_texture; });
        if (scene.mix_of.empty() || scene.mix_of[id] == Scene::none) continue;
        const Mix& mix = scene.mixes[scene.mix_of[id]];
        for (const uint32_t part : {mix.first, mix.second})
            traits.reads_uv = traits.reads_uv || scene.traits[part].reads_uv;
    }
}

}  // namespace

void share_texels(Scene& scene)
{
    const auto key = [](const ImageTexture& t) {
        const Color mean = t.mean();
        return std::tuple(t.width(), t.height(), t.bytes(), mean.r, mean.g, mean.b);
    };
    std::map<decltype(key(std::declval<ImageTexture>())), std::vector<const ImageTexture*>> known;
    for (Texture& t : scene.textures) {
        auto* const image = std::get_if<ImageTexture>(&t);
        if (!image) continue;
        std::vector<const ImageTexture*>& alike = known[key(*image)];
        const auto twin = std::find_if(alike.begin(), alike.end(), [&](const auto* o) { return image->share(*o); });
        if (twin == alike.end())
            alike.push_back(image);
        else
            scene.unused_features.add("duplicate textures with the same texels", 1, image->bytes());
    }
}

void fold_constants(Scene& scene)
{
    if (scene.legacy) return;  // whose integrators look at what a material is made of
    std::vector<std::optional<Color>> values;
    bool any = false;
    for (const Texture& t : scene.textures) any = values.emplace_back(value_of(t)).has_value() || any;
    if (any) {
        const auto fold_into = [&](auto& p) {
            if (p.texture == no_texture || !values[p.texture]) return;
            fold(p, *values[p.texture]);
            p.texture = no_texture;
        };
        // As ShadingPoint::part().
        const auto fold_part = [&](auto& p) {
            const bool is_folded = p.texture != no_texture && values[p.texture];
            fold_into(p);
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(p)>, ColorParam>)
                if (is_folded)
                    p.value = {std::min(1.0f, p.value.r), std::min(1.0f, p.value.g), std::min(1.0f, p.value.b)};
        };
        for (uint32_t id = 0; id < scene.materials.size(); ++id) {
            std::visit([&](auto& m) { for_each_textured_parameter(m, fold_part); }, scene.materials[id]);
            for_params(scene, id, fold_into);
            uint32_t& bump = scene.traits[id].bump;
            if (bump != no_texture && values[bump]) bump = no_texture;
        }
    }
    uint32_t plain = 0;
    for (uint32_t id = 0; id < scene.mix_of.size(); ++id) {
        if (scene.mix_of[id] == Scene::none) continue;
        const uint32_t part = only_part(scene, scene.mixes[scene.mix_of[id]]);
        if (part == Scene::none) continue;
        scene.materials[id] = scene.materials[part];
        scene.mix_of[id] = Scene::none;
        ++plain;
    }
    scene.unused_features.add("constant mixes", plain);
    if (!any && plain == 0) return;
    mark_texture_readers(scene);
    // A normal map tilts even where it is the same everywhere.
    std::vector<bool> is_read(values.size());
    for (const MaterialTraits& t : scene.traits)
        if (t.normal_map != no_texture) is_read[t.normal_map] = true;
    for (size_t i = 0; i < values.size(); ++i) {
        if (!values[i] || is_read[i]) continue;
        const auto* image = std::get_if<ImageTexture>(&scene.textures[i]);
        scene.unused_features.add("constant textures", 1, image ? image->bytes() : 0);
        scene.textures[i] = Checker{.even = *values[i], .odd = *values[i]};
    }
}

}  // namespace lancer
