// The path tracer that --legacy reproduces, with its faults: light sampling alone, so that light through glass or
// mirrors onto diffuse surfaces is missing; at most five vertices; visible lights show their intensity instead of their
// radiance; shadow rays end slightly early; glass by Schlick's approximation with the cosine on the incident side; rays
// start at a fixed distance along the shading normal, which does not face the ray. It replaces Path where legacy is
// switched on.
#pragma once

#include <cmath>

#include "core/frame.h"
#include "core/warp.h"
#include "integrators/path/transport.h"

namespace lancer {

struct LegacyPath {
    static constexpr IntegratorKind kind = IntegratorKind::path;
    static constexpr bool is_legacy = true;
    static constexpr uint32_t usual_depth = 5;
    static constexpr double offset = 0.01;      // of ray origins from their surface, units of the file
    static constexpr float shadow_end = 0.99f;  // tested part of the distance to a light, or of its square

    uint32_t max_depth = usual_depth;  // surface vertices, specular ones included
    bool indirect = true, emitters = true, fresnel = true, soft_shadows = true;

    void take(const RenderSettings& settings)
    {
        max_depth = settings.max_depth ? settings.max_depth : usual_depth;
        indirect = settings.indirect;
        emitters = settings.emitters;
        fresnel = settings.fresnel;
        soft_shadows = settings.soft_shadows;
    }

    // A shadow ray to a sphere light.
    struct ToSphere {
        Vec3 wi, from_center{};
        float reach{}, geometry{};  // geometry: cosines over distance squared, pi and density; 0: no light arrives
    };

    // PathState::specular means here that the ray came from the camera by mirrors alone: only such rays see lights.
    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        if (surface.light != Scene::none && s.specular) {
            if (emitters) actions.add(s.throughput * seen(view.scene, surface));
            return;
        }
        const Vertex v{s, surface, sampler, static_cast<float>(offset * view.scene.normalisation.scale)};
        if (sphere_of(view.scene, surface.light)) return diffuse(view, v, {1, 1, 1}, actions);
        // Purely diffuse surfaces need only the colour.
        if (const std::optional<Color> albedo = view.plain_albedo(surface)) return diffuse(view, v, *albedo, actions);
        // The original had one kind of reflection per object: here the largest part. Its textures were not filtered.
        ShadingPoint point = view.scene.shading_point(surface);
        point.uv_width = 0;
        const Phong p = view.scene.phong(surface.material, point);
        if (p.refraction > std::max(p.diffusion, p.reflexion)) return glass(view, v, p, actions);
        if (p.reflexion > p.diffusion) return mirror(view, v, p, actions);
        diffuse(view, v, p.diffuse, actions);
    }
    template <class V>
    void miss(const V& view, const PathState& s, PathActions& actions) const
    {
        if (s.specular && emitters) actions.add(s.throughput * view.environment(s.ray.dir));
    }

private:
    struct Vertex {
        const PathState& s;
        const Surface& surface;
        const Sampler& sampler;
        float offset;  // scene units

        Vec3 n() const { return surface.ns_front; }
        Vec3 origin(float side) const { return surface.p + n() * (side * offset); }
    };

    static const Sphere* sphere_of(const Scene& scene, uint32_t light)
    {
        if (light == Scene::none) return nullptr;
        const auto* sphere = std::get_if<SphereLight>(&scene.lights.lights[light]);
        return sphere ? &scene.geometry.spheres[sphere->sphere] : nullptr;
    }
    // Intensity of a sphere light in units of the file: 4 pi^2 R^2 times too large.
    static Color seen(const Scene& scene, const Surface& surface)
    {
        const Color e = scene.emission[surface.material].towards(surface.front, scene.shading_point(surface));
        const Sphere* sphere = sphere_of(scene, surface.light);
        if (!sphere) return e;
        const double r = sphere->radius / scene.normalisation.scale;
        return e * static_cast<float>(4 * pi_d * pi_d * r * r);
    }

    template <class V>
    void send(const V& view, const Vertex& v, const Vec3& org, const Vec3& wi, const Color& weight, bool sees_lights,
              PathActions& actions) const
    {
        if (v.s.depth + 1 >= max_depth || is_black(weight)) return;
        actions.next_from(v.s, [&](PathState& next) {
            next.ray = {.org = org, .dir = wi};
            view.set_alpha_key(next.ray, v.sampler, v.s.depth + 1, Dim::alpha);
            next.throughput *= weight;
            next.specular = sees_lights;
            ++next.depth;
            return true;
        });
    }

    template <class V>
    void mirror(const V& view, const Vertex& v, const Phong& p, PathActions& actions) const
    {
        const Vec3 d = v.s.ray.dir;
        send(view, v, v.origin(1), normalize(d - v.n() * (2 * dot(d, v.n()))), p.specular, v.s.specular, actions);
    }

    template <class V>
    void glass(const V& view, const Vertex& v, const Phong& p, PathActions& actions) const
    {
        const Vec3 d = v.s.ray.dir;
        const bool leaves = dot(d, v.n()) > 0;
        const float side = leaves ? -1 : 1;
        const Vec3 n = v.n() * side;
        const float from = leaves ? p.inside_ior : p.outside_ior, to = leaves ? p.outside_ior : p.inside_ior;
        const float cos = -dot(d, n), ratio = from / to, cos2_t = 1 - ratio * ratio * (1 - cos * cos);
        const auto reflects = [&] {
            if (cos2_t < 0) return true;
            if (!fresnel) return false;
            const float root = (from - to) / (from + to), k0 = root * root, grazing = 1 - cos, g2 = grazing * grazing;
            return v.sampler.get1(v.s.depth, Dim::bsdf) < k0 + (1 - k0) * g2 * g2 * grazing;
        };
        if (reflects()) return send(view, v, v.origin(side), normalize(d + n * (2 * cos)), p.specular, false, actions);
        const Vec3 refracted = (d + n * cos) * ratio - n * std::sqrt(cos2_t);
        send(view, v, v.origin(-side), normalize(refracted), p.diffuse, false, actions);
    }

    template <class V>
    void diffuse(const V& view, const Vertex& v, const Color& albedo, PathActions& actions) const
    {
        light(view, v, albedo, actions);
        if (!indirect) return;
        const Vec3 wi = Frame(v.n()).to_world(square_to_cosine_hemisphere(v.sampler.get2(v.s.depth, Dim::bsdf)));
        send(view, v, v.origin(1), wi, albedo, false, actions);
    }

    // The original had one light, a sphere. Of several, one is selected by power; lights that are no spheres work as
    // without legacy.
    template <class V>
    void light(const V& view, const Vertex& v, const Color& albedo, PathActions& actions) const
    {
        const Scene& scene = view.scene;
        const Discrete& pick = scene.lights.pick;
        if (pick.empty()) return;
        const float u = pick.size() > 1 ? v.sampler.get1(v.s.depth, Dim::light) : 0;
        const Vec2 on_light = v.sampler.get2(v.s.depth, Dim::light);
        const uint32_t id = pick.size() > 1 ? pick.sample(extend_precision(u, on_light)) : 0;
        if (const Sphere* sphere = sphere_of(scene, id)) {
            auto to = soft_shadows ? to_its_half(*sphere, v.surface.p, v.n(), on_light)
                                   : to_its_center(*sphere, v.surface.p, v.n());
            if (pick.size() > 1) to.geometry /= pick.probability(id);
            return shadow(view, v, albedo, *sphere, to, actions);
        }
        const auto sample = sample_light(scene, v.surface, u, on_light);
        if (!sample) return;
        const float cos = std::max(0.0f, dot(v.n(), sample->wi));
        send_shadow(view, v, albedo, sample->radiance * (cos / (pi * sample->pdf)), actions,
                    [&](Ray& ray) { ray = shadow_ray(v.surface, *sample); });
    }
    template <class V>
    static void shadow(const V& view, const Vertex& v, const Color& albedo, const Sphere& sphere, const ToSphere& to,
                       PathActions& actions)
    {
        if (!(to.geometry > 0)) return;
        const Scene& scene = view.scene;
        const Emission& e = scene.emission[scene.sphere_material[&sphere - scene.geometry.spheres.data()]];
        ShadingPoint place{.textures = scene.textures.data()};
        if (e.radiance.texture != no_texture) place.second_uv = sphere_uv(to.from_center), place.uv = place.second_uv;
        send_shadow(view, v, albedo, e.towards(true, place) * to.geometry, actions,
                    [&](Ray& ray) { ray.org = v.origin(1), ray.dir = to.wi, ray.t_max = to.reach; });
    }
    // aim(ray) sets its direction.
    template <class V, class Aim>
    static void send_shadow(const V& view, const Vertex& v, const Color& albedo, const Color& arriving,
                            PathActions& actions, const Aim& aim)
    {
        const Color radiance = v.s.throughput * albedo * arriving;
        if (is_black(radiance)) return;
        actions.shadow_from(
            [&](Ray& ray) {
                aim(ray);
                view.set_alpha_key(ray, v.sampler, v.s.depth, Dim::shadow_alpha);
            },
            radiance);
    }
    // To a point of the half that faces the surface, cosine-weighted around the middle of that half. p, n: the point
    // and its normal.
    static ToSphere to_its_half(const Sphere& sphere, Vec3 p, Vec3 n, Vec2 u)
    {
        const auto radius = static_cast<float>(sphere.radius);
        const Vec3 h = square_to_cosine_hemisphere(u), axis = p - to_float(sphere.center);
        const Vec3 from_center = Frame(normalize(axis)).to_world(h);
        const Vec3 d = from_center * radius - axis;
        const float d2 = dot(d, d);
        const Vec3 wi = d * (1 / std::sqrt(d2));
        const float cos = dot(n, wi), cos_light = -dot(from_center, wi);
        const bool arrives = cos > 0 && cos_light > 0 && h.z > 0;
        return {wi, from_center, std::sqrt(shadow_end * d2),
                arrives ? cos * cos_light * radius * radius / (d2 * h.z) : 0};
    }
    // As from a point at the centre, with the intensity that illuminates distant points as the sphere would.
    static ToSphere to_its_center(const Sphere& sphere, Vec3 p, Vec3 n)
    {
        const Vec3 d = to_float(sphere.center) - p;
        const auto radius = static_cast<float>(sphere.radius);
        const float d2 = dot(d, d), distance = std::sqrt(d2);
        const Vec3 wi = d / distance;
        // Up to the sphere; a point on the sphere itself need not be in front of it.
        const float reach = std::max(0.0f, shadow_end * (distance - radius));
        return {wi, -wi, reach, reach > 0 ? std::max(0.0f, dot(n, wi)) * radius * radius / d2 : 0};
    }
};

}  // namespace lancer
