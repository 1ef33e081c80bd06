// Views and functions that know less than the product's, for scenes that have no more: what the difference costs is
// what features cost that a scene does without. Each draws the same bits there; bench_features looks whether it does.
#pragma once

#include "integrators/view.h"
#include "render/kernel/kernel.h"
#include "scene/alpha_test.h"

namespace lancer::bench {

// ---- what the kernel calls out of line, as functions that may be exchanged: the kernel around them stays what it is

struct Calls {
    Surface (*surface_at)(const Scene&, const Ray&, const Hit&, RayCone,
                          const TriangleInteraction&) = lancer::surface_at;
    void (*triangle_interactions)(const Scene&, std::span<const Ray>, std::span<const Hit>,
                                  std::span<TriangleInteraction>) = lancer::triangle_interactions;
    std::optional<LightSample> (*sample_light)(const Scene&, const Surface&, uint32_t, Vec2,
                                               bool) = lancer::sample_chosen_light;
    float (*pdf_light)(const Scene&, Vec3, Vec3, Vec3, const Surface&) = lancer::pdf_light;
};

// Nothing is left out.
struct Everything : View {
    const Calls& calls;

    Surface surface_at(const Ray& ray, const Hit& hit, RayCone cone, const TriangleInteraction& place) const
    {
        return calls.surface_at(scene, ray, hit, cone, place);
    }
    void triangle_interactions(std::span<const Ray> rays, std::span<const Hit> hits,
                               std::span<TriangleInteraction> places) const
    {
        calls.triangle_interactions(scene, rays, hits, places);
    }
    std::optional<LightSample> sample_light(const Surface& from, const Sampler& sampler, uint32_t bounce, bool through,
                                            uint32_t cell) const
    {
        if (plan.light_choice.chooses()) return View::sample_light(from, sampler, bounce, through, cell);
        const Discrete& pick = scene.lights.pick;
        if (pick.empty()) return {};
        const Vec2 u = sampler.get2(bounce, Dim::light);
        if (!pick.can_remap()) return lancer::sample_light(scene, from, sampler.get1(bounce, Dim::light), u, through);
        const Discrete::Remapped s = pick.sample_remapped(u.x);
        return calls.sample_light(scene, from, s.index, {s.u, u.y}, through);
    }
    float pdf_light(Vec3 from, Vec3 normal, Vec3 wi, const Surface& at, uint32_t cell) const
    {
        if (plan.light_choice.chooses()) return View::pdf_light(from, normal, wi, at, cell);
        return calls.pdf_light(scene, from, normal, wi, at);
    }
    // For views in which nothing that shines has a texture.
    Color emission_of_one_colour(const Surface& s) const
    {
        const Emission& e = scene.emission[s.material];
        if (e.is_dark()) return {};
        return e.plain_towards(s.front);
    }
};

// ---- surfaces: surface_at() and triangle_interactions() as they are for flat triangles; of all else only the question
// whether it is there, and of that, what the bits of `without` name not even the question

enum Asked : unsigned {
    shapes = 1,  // spheres and planes
    instances = 2,
    vertex_normals = 4,
    vertex_colors = 8,
    textures = 16,
    maps = 32,  // bump and normal maps
    legacy = 64,
    all_of_them = 127
};

template <unsigned without>
[[gnu::noinline]] Surface surface_of(const Scene& scene, const Ray& ray, const Hit& hit, RayCone cone,
                                     const TriangleInteraction& placed)
{
    constexpr auto asks = [](Asked what) { return (without & what) == 0; };
    Surface s;
    const auto is_plain = [&] {
        if constexpr (asks(shapes))
            if (hit.kind != Kind::triangle) return false;
        const MeshShading& shading = scene.shading[hit.geometry];
        s.material = shading.material_of(hit.primitive);
        if constexpr (asks(vertex_colors))
            if (!shading.colors.empty()) return false;
        if constexpr (asks(textures))
            if (shading.uv_triangles.find(hit.primitive)) return false;
        if constexpr (asks(maps))
            if (scene.traits[s.material].tilts()) return false;
        return true;
    };
    if (!is_plain()) {
        s = lancer::surface_at(scene, ray, hit, cone, placed);
        return s;
    }
    s.t = hit.t;
    s.p = placed.p, s.p_error = placed.p_error, s.n = placed.n, s.ns = placed.ns, s.area = placed.area;
    s.light = Scene::none;
    const RankedBitset& emitters = scene.shading[hit.geometry].emitters;
    if (!emitters.empty() && emitters.has(hit.primitive)) {
        uint32_t first = scene.mesh_first_light[hit.geometry];
        if constexpr (asks(instances))
            if (hit.instance != Hit::no_instance) first = scene.instance_first_light[hit.instance];
        s.light = first + emitters.before(hit.primitive);
    }
    s.ns_front = s.ns;
    const Vec3 wo = -ray.dir;
    s.front = dot(s.n, wo) > 0;
    if (!s.front) s.n = -s.n, s.ns = -s.ns;
    s.origin = offset_origin(s.p, s.p_error, s.n, s.n);
    s.side = s.n;
    if constexpr (asks(legacy))
        if (scene.legacy) return s;
    if constexpr (asks(vertex_normals)) {
        if (s.ns == s.n) return s;
        s = lancer::surface_at(scene, ray, hit, cone, placed);
    }
    return s;
}

template <unsigned without>
[[gnu::noinline]] void places_of_hits(const Scene& scene, std::span<const Ray> rays, std::span<const Hit> hits,
                                      std::span<TriangleInteraction> places)
{
    const auto eight = [&](const HitIndices& which) {
        constexpr auto& interactions_of =
            (without & vertex_normals) == 0 ? lancer::interactions_of : flat_interactions_of;
        put(interactions_of(scene, hits, which), which, places);
    };
    const auto placed = [&](size_t i) {
        places[i] = triangle_interaction(scene, hits[i].instance, hits[i].geometry, hits[i].primitive, hits[i].uv,
                                         rays[i].time);
    };
    if constexpr ((without & instances) == 0) return for_triangles<float_lanes>(hits, eight, placed);
    HitIndices which{};
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i]) continue;
        which[count++] = i;
        if (count == which.size()) eight(which), count = 0;
    }
    if (count == 0) return;
    std::fill(which.begin() + count, which.end(), which[0]);
    eight(which);
}

template <unsigned without>
Calls surfaces_without()
{
    Calls calls;
    calls.surface_at = surface_of<without>, calls.triangle_interactions = places_of_hits<without>;
    return calls;
}

// ---- lights: flat triangles of one colour each, chosen by power; of all else only the question whether it is there,
// and of that, what the bits of `without` name not even the question

enum AskedLight : unsigned {
    other_lights = 1,     // spheres, points, directions, a sky
    placed_lights = 2,    // triangles of instances, or with normals that bend
    textured_lights = 4,  // of more than one colour
    lights_with_holes = 8,
    light_tree = 16,
    all_of_lights = 31
};

template <unsigned without>
[[gnu::noinline]] std::optional<LightSample> sample_light_of(const Scene& scene, const Surface& from, uint32_t id,
                                                             Vec2 u, bool through)
{
    constexpr auto asks = [](AskedLight what) { return (without & what) == 0; };
    const auto* const light = std::get_if<TriangleLight>(&scene.lights.lights[id]);
    if constexpr (asks(other_lights))
        if (!light) return lancer::sample_chosen_light(scene, from, id, u, through);
    if constexpr (asks(placed_lights))
        if (light->area == 0) return lancer::sample_chosen_light(scene, from, id, u, through);
    const uint32_t material = scene.shading[light->mesh].material_of(light->triangle);
    const Emission& emission = scene.emission[material];
    if constexpr (asks(textured_lights))
        if (emission.radiance.texture != no_texture) return lancer::sample_chosen_light(scene, from, id, u, through);
    if constexpr (asks(lights_with_holes))
        if (scene.traits[material].has_holes()) return lancer::sample_chosen_light(scene, from, id, u, through);
    const auto sampled_from = [&](Vec3 side) {
        const Vec3 org = ray_origin(from, side);
        std::optional<LightSample> s;
        const auto q = point_on_triangle(scene.geometry.meshes[light->mesh], light->triangle, square_to_triangle(u));
        const Vec3 d = q.p - org;
        const float d2 = dot(d, d);
        if (!(d2 > 0)) return s;
        const Vec3 wi = d / std::sqrt(d2);
        const float c = -dot(wi, light->n);
        const Color radiance = emission.plain_towards(c > 0);
        if (c == 0 || is_black(radiance)) return s;
        s.emplace();
        s->wi = wi;
        s->point = q.p, s->p_error = q.p_error, s->n = light->n;
        s->radiance = radiance;
        s->pdf = d2 / (std::abs(c) * light->area);
        return s;
    };
    auto s = sampled_from(from.n);
    if (s && dot(s->wi, from.side) < 0 && through) {
        s = sampled_from(-from.n);
        if (s && dot(s->wi, from.side) >= 0) s.reset();
    } else if (s && dot(s->wi, from.side) <= 0) {
        s.reset();
    }
    if (s) s->pdf *= scene.lights.pick.probability(id);
    return s;
}
template <unsigned without>
[[gnu::noinline]] float pdf_light_of(const Scene& scene, Vec3 from, Vec3 normal, Vec3 wi, const Surface& at)
{
    if (at.light == Scene::none) return 0;
    if constexpr ((without & light_tree) == 0)
        if (scene.lights.tree) return lancer::pdf_light(scene, from, normal, wi, at);
    if constexpr ((without & other_lights) == 0)
        if (!std::holds_alternative<TriangleLight>(scene.lights.lights[at.light]))
            return lancer::pdf_light(scene, from, normal, wi, at);
    const Vec3 d = at.p - from;
    const float c = std::abs(dot(wi, at.n));
    return c > 0 ? scene.lights.pick.probability(at.light) * dot(d, d) / (c * at.area) : 0;
}
template <unsigned without>
Calls lights_without()
{
    Calls calls;
    calls.sample_light = sample_light_of<without>, calls.pdf_light = pdf_light_of<without>;
    return calls;
}
// What is chosen without a tree.
struct NoLightTree : Everything {
    std::optional<LightSample> sample_light(const Surface& from, const Sampler& sampler, uint32_t bounce, bool through,
                                            uint32_t cell) const
    {
        if (plan.light_choice.chooses()) return View::sample_light(from, sampler, bounce, through, cell);
        const Discrete& pick = scene.lights.pick;
        if (pick.empty()) return {};
        const Vec2 u = sampler.get2(bounce, Dim::light);
        const Discrete::Remapped s = pick.sample_remapped(u.x);
        return calls.sample_light(scene, from, s.index, {s.u, u.y}, through);
    }
};
// No light of a scene is infinitely far away.
struct NoSky : Everything {
    Color environment(Vec3) const { return {}; }
    Color background(const Ray&, RayCone) const { return {}; }
    bool leaves_sky_to_cosine() const { return false; }
    float pdf_environment(Vec3, Vec3, uint32_t) const { return 0; }
};
// What shines has one colour.
struct PlainEmission : Everything {
    Color emission(const Surface& s) const { return emission_of_one_colour(s); }
};

// ---- what the kernel has inlined

// Mixes of materials are not asked about.
struct NoMixes : Everything {
    template <class F>
    auto with_bsdf(const Surface& s, const Sampler&, uint32_t, F&& f) const
    {
        return std::visit([&](const auto& material) { return f(bsdf_at(material, s)); }, scene.materials[s.material]);
    }
};
// Lambert is all there is.
struct OnlyLambert : Everything {
    template <class F>
    auto with_bsdf(const Surface& s, const Sampler&, uint32_t, F&& f) const
    {
        return f(bsdf_at(*std::get_if<Lambert>(&scene.materials[s.material]), s));
    }
};
// The same of all materials, but Lambert has a colour each, and no texture; is_white: nor have vertices colours.
template <bool is_white>
struct NoTextures : Everything {
    template <class F>
    auto with_bsdf(const Surface& s, const Sampler& sampler, uint32_t bounce, F&& f) const
    {
        uint32_t id = s.material;
        if (!scene.mix_of.empty() && scene.mix_of[id] != Scene::none)
            id = scene.scattering_material(id, scene.shading_point(s), sampler.get1(bounce, Dim::mix));
        return std::visit(
            [&]<class M>(const M& material) {
                if constexpr (!std::is_same_v<M, Lambert>)
                    return f(bsdf_at(material, s));
                else if constexpr (!is_white)
                    return f(LambertBsdf{material.albedo.value * s.vertex_color});
                else if (material.albedo.texture == no_texture)
                    return f(LambertBsdf{material.albedo.value});
                else
                    return f(LambertBsdf{scene.shading_point(s).eval(material.albedo)});
            },
            scene.materials[id]);
    }
    Color emission(const Surface& s) const
    {
        if constexpr (is_white) return View::emission(s);
        return emission_of_one_colour(s);
    }
};
struct NoCutOuts : Everything {
    static void set_alpha_key(const Ray&, const Sampler&, uint32_t, Dim) {}
};
struct NoMedia : Everything {
    static constexpr bool has_media() { return false; }
};
// Cameras are pinholes.
struct NoLens : Everything {};
inline Ray camera_ray(const NoLens&, const Camera& camera, const Filter& filter, const SampleId& id,
                      const Sampler& numbers)
{
    return camera.middle_ray(on_film(id, filter.sample(numbers.get2(0, Dim::pixel))));
}
// The filter is a box.
struct NoWideFilter : Everything {};
inline Ray camera_ray(const NoWideFilter&, const Camera& camera, const Filter&, const SampleId& id,
                      const Sampler& numbers)
{
    const Vec2 u = numbers.get2(0, Dim::pixel);
    return camera.ray(on_film(id, {u.x - 0.5f, u.y - 0.5f}), numbers.get2(0, Dim::lens));
}

}  // namespace lancer::bench
