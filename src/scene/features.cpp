#include "scene/features.h"

#include "scene/scene.h"

namespace lancer {
namespace {

// Materials in use, with the parts of mixes.
std::vector<bool> used_materials(const Scene& scene)
{
    std::vector<bool> used(scene.traits.size());
    for (const uint32_t m : scene.sphere_material) used[m] = true;
    for (const uint32_t m : scene.plane_material) used[m] = true;
    for (const MeshShading& mesh : scene.shading) {
        if (mesh.face_material.empty()) used[mesh.material] = true;
        for (size_t i = 0; i < mesh.face_material.size(); ++i) used[mesh.face_material[i]] = true;
    }
    // Parts come before the mixes that are made of them.
    for (size_t id = scene.mix_of.size(); id-- > 0;) {
        if (!used[id] || scene.mix_of[id] == Scene::none) continue;
        const Mix& mix = scene.mixes[scene.mix_of[id]];
        used[mix.first] = used[mix.second] = true;
    }
    return used;
}

void add_material(const Scene& scene, uint32_t id, Features& f)
{
    const bool is_mix = !scene.mix_of.empty() && scene.mix_of[id] != Scene::none;
    const MaterialType type = scene.type_of(id);
    f.add(feature_of(is_mix ? MaterialType::mix : type));
    const MaterialTraits& traits = scene.traits[id];
    f.add(Feature::textures, traits.reads_uv);
    f.add(Feature::bump_maps, traits.bump != no_texture);
    f.add(Feature::normal_maps, traits.normal_map != no_texture);
    f.add(Feature::cut_outs, traits.has_holes());
    f.add(Feature::textured_lights, scene.emission[id].radiance.texture != no_texture);
}

void add_light(const Light& light, Features& f)
{
    std::visit(
        [&]<class L>(const L& l) {
            if constexpr (std::is_same_v<L, TriangleLight>) {
                f.add(Feature::triangle_lights);
                f.add(Feature::shaped_triangle_lights, !(l.area > 0));
            } else if constexpr (!std::is_same_v<L, EnvironmentLight>) {
                f.add(feature_of(L::type));
            }
        },
        light);
}

}  // namespace

std::string name_of(Feature feature)
{
    constexpr std::array before{"spheres",        "planes",   "instances", "motion",      "vertex normals",
                                "vertex colours", "textures", "bump maps", "normal maps", "opacity"};
    constexpr std::array after{"triangle lights",
                               "smooth or instanced triangle lights",
                               "constant environment",
                               "sky map",
                               "background",
                               "textured lights",
                               "light tree",
                               "terminator",
                               "legacy"};
    constexpr auto place = [](Feature f) { return static_cast<size_t>(f); };
    static_assert(before.size() == place(Feature::materials));
    static_assert(place(Feature::media) + 2 == place(Feature::lights));
    static_assert(place(Feature::triangle_lights) + after.size() == place(Feature::count));
    if (feature < Feature::materials) return before[place(feature)];
    if (feature == feature_of(MaterialType::mix)) return "mixes";
    if (feature < Feature::media)
        return std::string(enum_names<MaterialType>[place(feature) - place(Feature::materials)]);
    if (feature == Feature::media) return "media";
    if (feature == Feature::scattering) return "scattering";
    if (feature < Feature::triangle_lights)
        return std::string(enum_names<LightType>[place(feature) - place(Feature::lights)]) + " lights";
    return after[place(feature) - place(Feature::triangle_lights)];
}

Features features_of(const Scene& scene)
{
    Features f;
    f.add(Feature::spheres, !scene.geometry.spheres.empty());
    f.add(Feature::planes, !scene.geometry.planes.empty());
    f.add(Feature::instances, !scene.geometry.instances.empty());
    f.add(Feature::motion, scene.geometry.motion.moves());
    for (const MeshShading& mesh : scene.shading) {
        f.add(Feature::vertex_normals, !mesh.normals.empty());
        f.add(Feature::vertex_colors, !mesh.colors.empty());
    }
    const std::vector<bool> used = used_materials(scene);
    for (uint32_t id = 0; id < used.size(); ++id)
        if (used[id]) add_material(scene, id, f);
    f.add(Feature::cut_outs, scene.geometry.alpha_test.passes_through != nullptr);
    f.add(Feature::media, !scene.media.empty());
    f.add(Feature::scattering, scene.scatters);
    for (const Light& light : scene.lights.lights) add_light(light, f);
    f.add(Feature::constant_sky, !is_black(scene.environment));
    f.add(Feature::sky_map, scene.environment_map != nullptr);
    f.add(Feature::background, scene.background || scene.glow);
    f.add(Feature::light_tree, scene.lights.tree != nullptr);
    f.add(Feature::terminator, scene.terminator_fix);
    f.add(Feature::legacy, scene.legacy);
    return f;
}

}  // namespace lancer
