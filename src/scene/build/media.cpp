#include "scene/build/media.h"

#include <algorithm>
#include <limits>

#include "core/names.h"
#include "materials/albedo_table.h"
#include "materials/material.h"
#include "materials/subsurface.h"
#include "scene/surface.h"

namespace lancer {

bool follows_scattering(IntegratorKind kind) { return !is_classic(kind) && kind != IntegratorKind::ao; }

bool has_inside(const MaterialDescription& m)
{
    return m.subsurface_color || !is_black(m.absorption) || !is_black(m.scattering);
}

bool matters(const Medium& m) { return m.priority || m.scatters() || !is_black(m.absorption); }

namespace {

// Of the medium inside, or nothing. A material that lists what a medium is must say its index.
std::optional<float> medium_ior(const Material& bsdf, bool has_priority)
{
    return std::visit(
        [&]<class M>(const M& m) -> std::optional<float> {
            constexpr bool has_medium =
                index_of_key(M::parameters, "absorption") < std::tuple_size_v<decltype(M::parameters)>;
            if constexpr (has_medium) return m.medium_ior(has_priority);
            return {};
        },
        bsdf);
}

Color per_scene_unit(Color sigma, const Scene& scene)
{
    const auto of = [&](float x) {
        return std::min(x / static_cast<float>(scene.normalisation.scale), std::numeric_limits<float>::max());
    };
    return {of(sigma.r), of(sigma.g), of(sigma.b)};
}

// What the description says of the inside, in its words.
const char* word_of_inside(const MaterialDescription& m)
{
    return m.priority               ? "a 'priority'"
           : m.subsurface_color     ? "a 'subsurface_color'"
           : is_black(m.absorption) ? "'scattering'"
                                    : "'absorption'";
}

// The surface of such a body is nothing but the border of what is inside.
bool is_bare(const MaterialDescription& m, float ior)
{
    return m.type == MaterialType::glass && ior == 1 && m.base_color == Color{1, 1, 1} && !m.base_color_map &&
           is_black(m.emission);
}

void set_coefficients(Medium& medium, Color scattering, Color absorption, float anisotropy, IntegratorKind kind,
                      Scene& scene)
{
    medium.absorption = per_scene_unit(absorption, scene);
    medium.phase.g = anisotropy;
    if (is_black(scattering)) return;
    if (follows_scattering(kind))
        medium.scattering = per_scene_unit(scattering, scene);
    else
        scene.ignores_scattering = true;
}

}  // namespace

uint16_t add_medium(const MaterialDescription& m, const Material& bsdf, IntegratorKind kind, Scene& scene,
                    Diagnostics& diagnostics)
{
    const std::optional<float> ior = medium_ior(bsdf, m.priority.has_value());
    const auto refuse = [&](const std::string& why) {
        diagnostics.error(m.where, "material " + in_quotes(m.name) + " has " + word_of_inside(m) + " and " + why);
    };
    const bool fills = m.priority || has_inside(m);
    if (m.thin.value_or(false) && fills)
        diagnostics.error(m.where, "material " + in_quotes(m.name) + " is thin and has " + word_of_inside(m) +
                                       ": a sheet has no inside");
    if (!ior) return no_medium;
    if (m.subsurface_color && !(is_black(m.absorption) && is_black(m.scattering)))
        diagnostics.error(m.where, "material " + in_quotes(m.name) +
                                       " has a 'subsurface_color', which says what is inside, and 'absorption' or "
                                       "'scattering', which say it again");
    Medium medium{.ior = *ior, .priority = m.priority};
    medium.is_bare = fills && is_bare(m, *ior);
    if (m.subsurface_color) {
        const Subsurface inside(*m.subsurface_color, m.subsurface_radius, m.scattering_anisotropy,
                                mean_transmittance(1 / double{*ior}));
        set_coefficients(medium, inside.scattering, inside.absorption, m.scattering_anisotropy, kind, scene);
    } else {
        set_coefficients(medium, m.scattering, m.absorption, m.scattering_anisotropy, kind, scene);
    }
    if (fills && (m.opacity < 1 || m.opacity_map))
        refuse("an opacity: what goes through a hole would neither enter nor leave");
    if (medium.priority && !is_black(m.emission)) refuse("emission: it would shine where its surface is not there");
    if (scene.media.size() == no_medium) {
        diagnostics.error(m.where, "more than 65535 transparent materials");
        return no_medium;
    }
    scene.media.push_back(medium);
    return static_cast<uint16_t>(scene.media.size() - 1);
}

void add_fog(const FogDescription& fog, const std::vector<LightDescription>& lights, IntegratorKind kind, Scene& scene,
             Diagnostics& diagnostics)
{
    if (scene.media.size() == no_medium) return;  // an error that has been told
    Medium medium;
    set_coefficients(medium, fog.scattering, fog.absorption, fog.anisotropy, kind, scene);
    scene.fog.medium = static_cast<uint16_t>(scene.media.size());
    scene.media.push_back(medium);
    const auto to_scene = [&](Vec3d p) { return to_float(scene.normalisation.to_scene(p)); };
    if (fog.low) scene.fog.low = to_scene(*fog.low);
    if (fog.high) scene.fog.high = to_scene(*fog.high);
    if (fog.height) {
        const Vec3 top = to_scene({0, *fog.height, *fog.height});
        (fog.z_up ? scene.fog.high.z : scene.fog.high.y) = fog.z_up ? top.z : top.y;
    }
    Bounds box = scene.bounds;
    if (fog.low || fog.high || fog.height) return;
    if (box.empty()) {
        diagnostics.warning(fog.where,
                            "[fog] has no end, as the scene has no mesh or sphere whose box it could fill: "
                            "'min' and 'max' give it one");
        return;
    }
    for (const LightDescription& l : lights)
        for_each_parameter_of(l.type, [&](const auto& row) {
            if (row.key == "position") box.grow(scene.normalisation.to_scene(l.position));
        });
    scene.fog.low = to_float(box.lower), scene.fog.high = to_float(box.upper);
}

void finish_media(Scene& scene, Diagnostics& diagnostics)
{
    if (!scene.legacy && std::any_of(scene.media.begin(), scene.media.end(), matters)) {
        // Flights are short beside the scene: a way through all of it has more than these on the mean.
        constexpr float many = 16;
        const auto extent = static_cast<float>(scene.bounds.extent() > 0 ? scene.bounds.extent() : 1);
        for (Medium& m : scene.media) {
            const Color sigma = m.extinction();
            m.is_dense = (sigma.r + sigma.g + sigma.b) / 3 * extent > many;
            scene.scatters |= m.scatters();
            scene.passes_bare |= m.is_bare;
        }
        // Its brightness was 4 % off where a body had 2e5 free paths across, 20 % at 2e6.
        constexpr float too_many = 2e5f;
        for (size_t id = 0; id < scene.traits.size(); ++id) {
            const uint16_t inside = scene.traits[id].medium;
            if (inside == no_medium || !scene.media[inside].scatters()) continue;
            if (max_component(scene.media[inside].extinction()) * extent > too_many)
                diagnostics.warning({scene.file}, "material " + in_quotes(scene.material_names[id]) +
                                                      ": light goes less than 1/200000 of the scene's extent between "
                                                      "two scatterings, and its brightness comes out wrong");
        }
        return;
    }
    scene.media.clear();
    scene.camera_media = {};
    scene.fog = {};
    for (MaterialTraits& traits : scene.traits) traits.medium = no_medium;
}

namespace {

// The box of all that has surfaces of a medium; nothing if it is not known, or has no end.
std::optional<Bounds> bounds_of_medium(const Scene& scene, uint16_t medium)
{
    Bounds box;
    const auto is_of = [&](uint32_t material) { return scene.traits[material].medium == medium; };
    for (const uint32_t material : scene.plane_material)
        if (is_of(material)) return {};
    for (size_t i = 0; i < scene.geometry.spheres.size(); ++i)
        if (is_of(scene.sphere_material[i]))
            for_each_place(scene.geometry.spheres[i], scene.geometry.motion.spheres, i,
                           [&](const Sphere& s) { box.grow(bounds(s)); });
    for (size_t i = 0; i < scene.shading.size(); ++i) {
        const Mesh& mesh = scene.geometry.meshes[i];
        if (!scene.shading[i].uses(is_of)) continue;
        if (mesh.instanced) return {};
        for (size_t v = 0; v < mesh.vertices(); ++v) box.grow(to_double(mesh.vertex(v)));
    }
    return box;
}

bool overlaps(const Bounds& a, const Bounds& b)
{
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
           a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

// Of a light with a place; nothing of those infinitely far away.
std::optional<Bounds> bounds_of_light(const Scene& scene, const Light& any)
{
    return std::visit(
        [&]<class L>(const L& light) -> std::optional<Bounds> {
            Bounds box;
            if constexpr (is_delta_light<L>) {
                if (const auto b = light.bounds()) return b->box;
                return {};
            } else if constexpr (std::is_same_v<L, SphereLight>) {
                return bounds(scene.geometry.spheres[light.sphere]);
            } else if constexpr (std::is_same_v<L, TriangleLight>) {
                for (const Vec2 corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}})
                    box.grow(to_double(triangle_point(scene, light.instance, light.mesh, light.triangle, corner).p));
                return box;
            } else {
                return {};
            }
        },
        any);
}

}  // namespace

void mark_dark_media(Scene& scene)
{
    if (!scene.scatters || scene.straight_shadows) return;
    for (uint16_t id = 0; id < scene.media.size(); ++id) {
        Medium& medium = scene.media[id];
        // Of two bodies that overlap, one may be inside of the surface of another: priorities are left alone.
        if (!medium.scatters() || medium.is_bare || medium.priority || id == scene.fog.medium) continue;
        const std::optional<Bounds> box = bounds_of_medium(scene, id);
        if (!box || box->empty()) continue;
        medium.is_dark = std::none_of(scene.lights.lights.begin(), scene.lights.lights.end(), [&](const Light& light) {
            const auto at = bounds_of_light(scene, light);
            return at && overlaps(*box, *at);
        });
        medium.is_dense |= medium.is_dark;
    }
}

}  // namespace lancer
