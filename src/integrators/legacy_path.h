// The student's path tracer, one of the two programs that lancer grew from, with its faults: light sampling alone, so
// that light that comes through glass or off a mirror onto something diffuse is lost; five vertices at most; a light
// that is seen has its intensity in place of its radiance; shadow rays that stop a little early; glass by Schlick's
// approximation with the cosine of the side that the ray comes from; rays that start a fixed length along the shading
// normal, which is never turned towards the ray. Takes the place of Path where legacy is switched on.
#pragma once

#include <cmath>

#include "core/frame.h"
#include "core/warp.h"
#include "integrators/integrator_settings.h"
#include "integrators/transport.h"

namespace lancer {

struct LegacyPath {
    static constexpr const char* name = "path";
    static constexpr bool is_legacy = true;
    static constexpr uint32_t usual_depth = 5;
    static constexpr double offset = 0.01;      // units of the file, of every ray from its surface
    static constexpr float shadow_end = 0.99f;  // part of the way to a light, or of its square, that is looked at

    uint32_t max_depth = usual_depth;  // surface vertices, mirrors and glass included
    bool indirect = true, emitters = true, fresnel = true, soft_shadows = true;

    void take(const IntegratorSettings& settings)
    {
        max_depth = settings.max_depth ? settings.max_depth : usual_depth;
        indirect = settings.switches[Switch::indirect];
        emitters = settings.switches[Switch::emitters];
        fresnel = settings.switches[Switch::fresnel];
        soft_shadows = settings.switches[Switch::soft_shadows];
    }

    // State::specular says here that the ray came from the camera by way of mirrors alone: only such a ray sees lights.
    template <class V>
    void hit(const V& view, const State& s, const Surface& surface, const Sampler& sampler, Steps& steps) const
    {
        if (surface.light != Scene::none && s.specular) {
            if (emitters) steps.add(s.throughput * seen(view.scene, surface));
            return;
        }
        const Vertex vertex{s, surface, sampler, static_cast<float>(offset * view.scene.normalisation.scale)};
        if (sphere_of(view.scene, surface.light)) return diffuse(view, vertex, {1, 1, 1}, steps);
        // Most surfaces are diffuse and nothing else: of these Phong says no more than the colour.
        if (const Lambert* matt = lambert(view.scene, surface.material); matt && matt->albedo.texture == no_texture)
            return diffuse(view, vertex, matt->albedo.value * surface.vertex_color, steps);
        // The program had one kind of reflection for each object: here the largest part. Its textures were not
        // filtered.
        ShadingPoint point = view.scene.shading_point(surface);
        point.uv_width = 0;
        const Phong p = view.scene.phong(surface.material, point);
        if (p.refraction > std::max(p.diffusion, p.reflexion)) return glass(view, vertex, p, steps);
        if (p.reflexion > p.diffusion) return mirror(view, vertex, p, steps);
        diffuse(view, vertex, p.diffuse, steps);
    }
    template <class V>
    void miss(const V& view, const State& s, Steps& steps) const
    {
        if (s.specular && emitters) steps.add(s.throughput * view.environment(s.ray.dir));
    }

private:
    struct Vertex {
        const State& s;
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
    static const Lambert* lambert(const Scene& scene, uint32_t material)
    {
        if (!scene.mix_of.empty() && scene.mix_of[material] != Scene::none) return nullptr;
        return std::get_if<Lambert>(&scene.materials[material]);
    }
    // Of a sphere the intensity that would light as it does, in units of the file: 4 pi^2 R^2 times too much.
    static Color seen(const Scene& scene, const Surface& surface)
    {
        const Color e = scene.emission[surface.material].towards(surface.front, scene.shading_point(surface));
        const Sphere* sphere = sphere_of(scene, surface.light);
        if (!sphere) return e;
        const double r = sphere->radius / scene.normalisation.scale;
        return e * static_cast<float>(4 * pi_d * pi_d * r * r);
    }

    template <class V>
    void send(const V& view, const Vertex& v, Vec3 org, Vec3 wi, Color weight, bool sees_lights, Steps& steps) const
    {
        if (v.s.depth + 1 >= max_depth || is_black(weight)) return;
        steps.next_from(v.s, [&](State& next) {
            next.ray = {.org = org, .dir = wi};
            next.ray.key = view.ray_key(v.sampler, v.s.depth + 1, Dim::hole);
            next.throughput *= weight;
            next.specular = sees_lights;
            ++next.depth;
            return true;
        });
    }

    template <class V>
    void mirror(const V& view, const Vertex& v, const Phong& p, Steps& steps) const
    {
        const Vec3 d = v.s.ray.dir;
        send(view, v, v.origin(1), normalize(d - v.n() * (2 * dot(d, v.n()))), p.specular, v.s.specular, steps);
    }

    template <class V>
    void glass(const V& view, const Vertex& v, const Phong& p, Steps& steps) const
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
        if (reflects()) return send(view, v, v.origin(side), normalize(d + n * (2 * cos)), p.specular, false, steps);
        const Vec3 refracted = (d + n * cos) * ratio - n * std::sqrt(cos2_t);
        send(view, v, v.origin(-side), normalize(refracted), p.diffuse, false, steps);
    }

    template <class V>
    void diffuse(const V& view, const Vertex& v, Color albedo, Steps& steps) const
    {
        light(view, v, albedo, steps);
        if (!indirect) return;
        const Vec3 wi = Frame(v.n()).to_world(square_to_cosine_hemisphere(v.sampler.get2(v.s.depth, Dim::bsdf)));
        send(view, v, v.origin(1), wi, albedo, false, steps);
    }

    // It knew one light, and that a sphere. Of several one is drawn by its power; those that are no spheres light as
    // they do without legacy.
    template <class V>
    void light(const V& view, const Vertex& v, Color albedo, Steps& steps) const
    {
        const Scene& scene = view.scene;
        const Discrete& pick = scene.lights.pick;
        if (pick.empty()) return;
        const float u = pick.size() > 1 ? v.sampler.get1(v.s.depth, Dim::light) : 0;
        const Vec2 on_light = v.sampler.get2(v.s.depth, Dim::light);
        const uint32_t id = pick.size() > 1 ? pick.sample(lengthened(u, on_light.x)) : 0;
        Ray ray;
        Color radiance;
        if (const Sphere* sphere = sphere_of(scene, id)) {
            const Emission& e =
                scene.emission[scene.sphere_material[std::get<SphereLight>(scene.lights.lights[id]).sphere]];
            float geometry = 0;
            Vec3 from_center;
            ray = soft_shadows ? to_sphere(v, *sphere, on_light, geometry, from_center)
                               : to_center(v, *sphere, geometry, from_center);
            if (!(geometry > 0)) return;
            ShadingPoint place{.textures = scene.textures.data()};
            if (e.radiance.texture != no_texture) place.uv = sphere_uv(from_center);
            if (pick.size() > 1) geometry /= pick.probability(id);
            radiance = e.towards(true, place) * geometry;
        } else {
            const auto sample = sample_light(scene, v.surface, u, on_light);
            if (!sample) return;
            ray = shadow_ray(v.surface, *sample);
            radiance = sample->radiance * (std::max(0.0f, dot(v.n(), sample->wi)) / (pi * sample->pdf));
        }
        radiance *= v.s.throughput * albedo;
        if (is_black(radiance)) return;
        ray.key = view.ray_key(v.sampler, v.s.depth, Dim::shadow_hole);
        steps.shadow(ray, radiance);
    }

    // A ray to a point of the half that faces the surface, drawn by the cosine from the middle of that half. geometry:
    // cosines over distance squared, pi and density.
    static Ray to_sphere(const Vertex& v, const Sphere& sphere, Vec2 u, float& geometry, Vec3& from_center)
    {
        const Vec3 center = to_float(sphere.center), h = square_to_cosine_hemisphere(u);
        const auto radius = static_cast<float>(sphere.radius);
        const Vec3 axis = v.surface.p - center;
        from_center = Frame(axis * (1 / length(axis))).to_world(h);
        const Vec3 d = from_center * radius - axis;
        const float d2 = dot(d, d);
        const Vec3 wi = d * (1 / std::sqrt(d2));
        const float cos = dot(v.n(), wi), cos_light = -dot(from_center, wi);
        if (cos > 0 && cos_light > 0 && h.z > 0) geometry = cos * cos_light * radius * radius / (d2 * h.z);
        return {.org = v.origin(1), .dir = wi, .t_max = std::sqrt(shadow_end * d2)};
    }
    // As from a point at the center, of the intensity that lights places far away as the sphere would.
    static Ray to_center(const Vertex& v, const Sphere& sphere, float& geometry, Vec3& from_center)
    {
        const Vec3 d = to_float(sphere.center) - v.surface.p;
        const auto radius = static_cast<float>(sphere.radius);
        const float d2 = dot(d, d), distance = std::sqrt(d2);
        const Vec3 wi = d / distance;
        from_center = -wi;
        // Up to the sphere, which a place on the sphere itself need not be in front of.
        const float reach = std::max(0.0f, shadow_end * (distance - radius));
        if (reach > 0) geometry = std::max(0.0f, dot(v.n(), wi)) * radius * radius / d2;
        return {.org = v.origin(1), .dir = wi, .t_max = reach};
    }
};

}  // namespace lancer
