#include "scene/lights/light.h"

#include "core/warp.h"
#include "scene/alpha_test.h"
#include "scene/environment/constant.h"
#include "scene/environment/environment.h"
#include "scene/lights/choice.h"
#include "scene/lights/sphere.h"
#include "scene/lights/triangle.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lancer {
namespace {

ShadingPoint point_at(const Scene& scene, UvSets uv)
{
    return {.uv = uv.first, .textures = scene.textures.data(), .second_uv = uv.second};
}
UvSets both(Vec2 uv) { return {uv, uv}; }

// Each samples as seen from `org`, the origin of the shadow ray.
template <class L>
requires is_delta_light<L> std::optional<LightSample> sample(const Scene&, const L& light, const Surface&, Vec3 org,
                                                             Vec2)
{
    return light.sample(org);
}

// Radiance of a point of a light towards one side. uv(): of the point; only called for textures.
template <class Uv>
Color radiance_at(const Scene& scene, uint32_t material, bool front, const Uv& uv)
{
    const Emission& emission = scene.emission[material];
    if (emission.radiance.texture == no_texture && !scene.traits[material].has_holes())
        return emission.plain_towards(front);
    const ShadingPoint point = point_at(scene, uv());
    return emission.towards(front, point) * opacity_at(scene, material, point);
}

std::optional<LightSample> sample(const Scene& scene, const TriangleLight& light, const Surface&, Vec3 org, Vec2 u)
{
    float density = 1;
    if (light.map != TriangleLight::no_map) {
        const EmissionMap::Place place = scene.lights.maps[light.map].sample(u);
        u = place.u, density = place.density;
    }
    const Vec2 uv = square_to_triangle(u);
    Vec3 p, p_error, n = light.n;
    float area = light.area;
    if (area > 0) {
        const PointOnTriangle<float> at = point_on_triangle(scene.geometry.meshes[light.mesh], light.triangle, uv);
        p = at.p, p_error = at.p_error;
    } else {
        const TrianglePoint at = triangle_point(scene, light.instance, light.mesh, light.triangle, uv);
        p = at.p, p_error = at.p_error, n = at.n, area = at.area;
    }
    // Constructed in place: copying it would stall on store forwarding.
    std::optional<LightSample> s;
    const SeenTriangle<float> seen(p, n, org);
    if (!(seen.d2 > 0)) return s;
    const MeshShading& shading = scene.shading[light.mesh];
    const Color radiance = radiance_at(scene, shading.material_of(light.triangle), seen.cos > 0,
                                       [&] { return texture_uvs(shading, light.triangle, uv); }) *
                           vertex_alpha(scene, light.mesh, light.triangle, uv);
    if (seen.cos == 0 || is_black(radiance)) return s;
    s.emplace();
    s->wi = seen.wi;
    s->point = p, s->p_error = p_error, s->n = n;
    s->radiance = radiance;
    s->pdf = seen.pdf(area) * density;
    return s;
}

// A sphere light as a point at its centre with the same power, for hard shadows: the radiance is that of the nearest
// point. The shadow ray ends there; from inside, at the centre.
std::optional<LightSample> sample_center(const Scene& scene, const Sphere& s, uint32_t material, Vec3 org)
{
    const Vec3d d = s.center - to_double(org);
    const double d2 = dot(d, d), r2 = s.radius * s.radius;
    if (!(d2 > 0)) return {};
    const Vec3d wi = d / std::sqrt(d2);
    const bool outside = d2 > r2;
    const Vec3 n = outside ? to_float(-wi) : Vec3{};
    const Vec3 point = to_float(outside ? s.center - wi * s.radius : s.center);
    const Color radiance =
        radiance_at(scene, material, outside, [&] { return both(sphere_uv(to_float(outside ? -wi : wi))); });
    if (is_black(radiance)) return {};
    return LightSample{.wi = to_float(wi),
                       .point = point,
                       .p_error = sphere_point_error(s, point),
                       .n = n,
                       .radiance = radiance * static_cast<float>(pi_d * r2 / d2),
                       .pdf = 1,
                       .delta = true};
}

// Uniform in the cone that the sphere subtends; from inside, uniform over the area.
std::optional<LightSample> sample(const Scene& scene, const SphereLight& light, const Surface&, Vec3 org, Vec2 u)
{
    const Sphere& s = scene.geometry.spheres[light.sphere];
    const uint32_t material = scene.sphere_material[light.sphere];
    if (!scene.soft_shadows) return sample_center(scene, s, material, org);
    const Vec3d p = to_double(org), to_center = s.center - p;
    const double d2 = dot(to_center, to_center), r2 = s.radius * s.radius;
    const auto sample_at = [&](const PointOnSphere<float>& on) {
        std::optional<LightSample> at(std::in_place);  // as above
        at->wi = on.wi;
        at->point = on.point;
        at->p_error = sphere_point_error(s, on.point);
        at->n = on.n;
        at->radiance = radiance_at(scene, material, true, [&] { return both(sphere_uv(on.n)); });
        at->pdf = on.pdf;
        return at;
    };
    if (d2 <= r2) {
        if (!scene.emission[material].both_sides) return {};
        const Vec3d n = to_double(square_to_sphere(u)), d = s.center + n * s.radius - p;
        const double l2 = dot(d, d), c = dot(d, n);
        if (!(l2 > 0) || !(c > 0)) return {};
        return sample_at({.wi = to_float(d / std::sqrt(l2)),
                          .point = to_float(s.center + n * s.radius),
                          .n = to_float(n),
                          .pdf = static_cast<float>(l2 * std::sqrt(l2) / (c * 4 * pi_d * r2))});
    }
    return sample_at(sphere_seen_from_outside(s.center, s.radius, to_center, u.x, sin_cos_2pi(u.y)));
}

LightSample sky_sample(const Scene& scene, const EnvironmentSample& s)
{
    const Color radiance = scene.background ? scene.radiance_from(s.wi) : s.radiance;
    return {.wi = s.wi, .infinite = true, .radiance = radiance, .pdf = s.pdf, .light = scene.environment_light};
}

// A constant environment: see ConstantEnvironmentSample.
std::optional<LightSample> sample(const Scene& scene, const EnvironmentLight&, const Surface& from, Vec3, Vec2 u)
{
    if (scene.environment_table) {
        const EnvironmentSample s = scene.environment_table->sample(u);
        if (!(s.pdf > 0)) return {};
        return sky_sample(scene, s);
    }
    const ConstantEnvironmentSample<float> s(from.ns, u.x, u.y);
    if (!(s.pdf > 0)) return {};
    return LightSample{.wi = s.wi, .infinite = true, .radiance = scene.environment, .pdf = s.pdf};
}

// Samples any kind of light. Not inlined: most lights are triangles and should not pay for the stack frame of the
// others.
[[gnu::noinline]] std::optional<LightSample> sample_other(const Scene& scene, const Light& any, const Surface& from,
                                                          Vec3 org, Vec2 u)
{
    return std::visit([&](const auto& light) { return sample(scene, light, from, org, u); }, any);
}

}  // namespace

std::optional<LightSample> sample_light(const Scene& scene, const Surface& from, float pick, Vec2 u, bool through)
{
    if (scene.lights.pick.empty()) return {};
    const auto [id, probability] = choose_light(scene.lights, from.origin, from.ns, extend_precision(pick, u));
    if (!(probability > 0)) return {};
    return sample_chosen_light(scene, from, id, probability, u, through);
}

std::optional<LightSample> sample_chosen_light(const Scene& scene, const Surface& from, uint32_t id, Vec2 u,
                                               bool through)
{
    return sample_chosen_light(scene, from, id, scene.lights.pick.probability(id), u, through);
}

std::optional<LightSample> sample_chosen_light(const Scene& scene, const Surface& from, uint32_t id, float probability,
                                               Vec2 u, bool through)
{
    auto s = sample_given_light(scene, from, id, u, through);
    if (s) s->pdf *= probability;
    return s;
}

std::optional<LightSample> sample_extended_light(const Scene& scene, const Surface& from, float pick, Vec2 u)
{
    const LightTable& table = scene.lights;
    if (table.deltas == table.lights.size() || table.pick.empty()) return {};
    const auto [id, probability] = table.pick.sample_from(table.deltas, extend_precision(pick, u));
    if (!(probability > 0)) return {};
    auto s = sample_given_light(scene, from, id, u);
    if (s) s->pdf *= probability;
    return s;
}

std::optional<LightSample> sample_given_light(const Scene& scene, const Surface& from, uint32_t id, Vec2 u,
                                              bool through)
{
    const LightTable& table = scene.lights;
    // The common origin of all rays on a side, so that the density is that of pdf_light() for such a ray. From from.p
    // the two could even disagree on which side of a sphere they are.
    const auto sampled_from = [&](Vec3 side) {
        const Vec3 org = ray_origin(from, side);
        const Light& light = table.lights[id];
        const auto* const triangle = std::get_if<TriangleLight>(&light);
        return triangle ? sample(scene, *triangle, from, org, u) : sample_other(scene, light, from, org, u);
    };
    auto s = sampled_from(from.n);
    if (s && dot(s->wi, from.side) < 0 && through) {
        s = sampled_from(-from.n);
        if (s && dot(s->wi, from.side) >= 0) s.reset();
    } else if (s && dot(s->wi, from.side) <= 0) {
        s.reset();
    }
    if (s) s->light = id;
    return s;
}

std::optional<LightSample> sample_given_light_from(const Scene& scene, Vec3 place, uint32_t id, Vec2 u)
{
    std::optional<LightSample> s;
    if (std::holds_alternative<EnvironmentLight>(scene.lights.lights[id]) && !scene.environment_table)
        s = LightSample{.wi = square_to_sphere(u), .infinite = true, .radiance = scene.environment, .pdf = pdf_sphere};
    else
        s = sample_other(scene, scene.lights.lights[id], Surface{}, place, u);
    if (s) s->light = id;
    return s;
}

std::optional<LightSample> sample_light_from(const Scene& scene, Vec3 place, float pick, Vec2 u)
{
    if (scene.lights.pick.empty()) return {};
    const auto [id, probability] = choose_light(scene.lights, place, {}, extend_precision(pick, u));
    if (!(probability > 0)) return {};
    auto s = sample_given_light_from(scene, place, id, u);
    if (s) s->pdf *= probability;
    return s;
}

std::optional<Vec3> middle_of_light(const Scene& scene, uint32_t id)
{
    return std::visit(
        [&]<class L>(const L& light) -> std::optional<Vec3> {
            if constexpr (std::is_same_v<L, SphereLight>) {
                return to_float(scene.geometry.spheres[light.sphere].center);
            } else if constexpr (std::is_same_v<L, TriangleLight>) {
                return triangle_point(scene, light.instance, light.mesh, light.triangle, {1 / 3.0f, 1 / 3.0f}).p;
            } else {
                if constexpr (requires { light.position; }) return light.position;
                return {};
            }
        },
        scene.lights.lights[id]);
}

std::optional<LightSample> sample_sky(const Scene& scene, const Surface& from, Vec3 wi, bool through)
{
    const float side = dot(wi, from.side);
    if (through ? side == 0 : side <= 0) return {};
    if (scene.environment_table) return sky_sample(scene, scene.environment_table->at(wi));
    const float pdf = pdf_constant_environment(from.ns, wi);
    return LightSample{
        .wi = wi, .infinite = true, .radiance = scene.environment, .pdf = pdf, .light = scene.environment_light};
}

float pdf_light(const Scene& scene, Vec3 from, Vec3 normal, Vec3 wi, const Surface& at)
{
    if (at.light == Scene::none) return 0;
    return pdf_light(scene, from, wi, at, probability_of(scene.lights, at.light, from, normal));
}

float pdf_light(const Scene& scene, Vec3 from, Vec3 wi, const Surface& at, float choice)
{
    if (const auto* triangle = std::get_if<TriangleLight>(&scene.lights.lights[at.light])) {
        const Vec3 d = at.p - from;
        const float c = std::abs(dot(wi, at.n));
        if (triangle->map != TriangleLight::no_map)
            choice *= scene.lights.maps[triangle->map].density(triangle_to_square(at.on_triangle));
        return c > 0 ? choice * dot(d, d) / (c * at.area) : 0;
    }
    // Sampled at its centre: light sampling covers all of it, as for every light that rays cannot hit.
    if (!scene.soft_shadows) return std::numeric_limits<float>::infinity();
    const auto& light = std::get<SphereLight>(scene.lights.lights[at.light]);
    const Sphere& s = scene.geometry.spheres[light.sphere];
    const Vec3d to_center = s.center - to_double(from);
    const double d2 = dot(to_center, to_center), r2 = s.radius * s.radius;
    // From outside only the near side is sampled; rays hit the far side through holes in the near one.
    if (d2 > r2 && !at.front && scene.geometry.alpha_test.spheres) return 0;
    if (d2 > r2) return choice * static_cast<float>(pdf_cone(one_minus_cos(r2 / d2)));
    const Vec3d d = to_double(at.p) - to_double(from);
    const double c = std::abs(dot(to_double(wi), to_double(at.n)));
    return c > 0 ? choice * static_cast<float>(dot(d, d) / (c * 4 * pi_d * r2)) : 0;
}

float pdf_environment(const Scene& scene, Vec3 normal, Vec3 wi)
{
    if (scene.environment_light == Scene::none) return 0;
    return pdf_environment(scene, normal, wi, scene.lights.pick.probability(scene.environment_light));
}

float pdf_environment(const Scene& scene, Vec3 normal, Vec3 wi, float choice)
{
    if (scene.environment_table) return choice * scene.environment_table->pdf(wi);
    return choice * (scene.scatters && normal == Vec3{} ? pdf_sphere : pdf_constant_environment(normal, wi));
}

}  // namespace lancer
