// Light sampling by way of large flat mirrors: a light is sampled as it is seen from the mirror image of the vertex.
// BSDF sampling finds the same light when its ray meets the mirror and then the light, and both are combined. Longer
// chains of mirrors, and the environment, are left to BSDF sampling.
#pragma once

#include <algorithm>

#include "integrators/path/light_sampling.h"

namespace lancer {

// The vertex as the mirror shows it.
inline Surface image_of(const PlanarMirror& m, const Surface& s)
{
    Surface image = s;
    image.p = m.image_at(s.p), image.origin = m.image_at(s.origin);
    image.n = m.image_of(s.n), image.ns = m.image_of(s.ns), image.side = m.image_of(s.side);
    return image;
}

// Index of the mirror that a number in [0, 1) selects: each is chosen as often.
inline uint32_t choose_mirror(const Scene& scene, float u)
{
    const auto count = static_cast<uint32_t>(scene.mirrors.size());
    return std::min(static_cast<uint32_t>(u * static_cast<float>(count)), count - 1);
}

// Requests a shadow ray by way of a mirror to a light that was sampled from the image of the surface. eval(wi) is the
// BSDF, wi local; set_key(ray) sets the ray's key.
template <class V, class Eval, class SetKey>
void request_mirrored(const V& view, uint32_t id, const Surface& surface, LightSample light, Color throughput,
                      DirectLight how, const Eval& eval, const SetKey& set_key, PathActions& actions)
{
    if (light.infinite && !light.delta) return;
    const PlanarMirror& mirror = view.scene.mirrors[id];
    const Vec3 from = mirror.image_at(surface.origin);
    if (!mirror.is_crossed(from, light.wi, light.infinite ? Ray{}.t_max : length(light.point - from))) return;
    light.pdf /= static_cast<float>(view.scene.mirrors.size());
    const Vec3 to_mirror = mirror.image_of(light.wi), wi = Frame(surface.ns).to_local(to_mirror);
    if (!sides_agree(surface, to_mirror, wi)) return;
    const BsdfValue f = eval(wi);
    if (is_black(f.f_cos)) return;
    const float weight = weight_of_light_sample(light.pdf, f.pdf, light.delta, how);
    Ray ray{.org = ray_origin(surface, to_mirror), .dir = to_mirror};
    set_key(ray);
    const Color radiance = sampled_light(throughput, f.f_cos, light.radiance, weight / light.pdf);
    actions.mirrored_shadow(ray, radiance, light, static_cast<uint8_t>(id + 1));
}

// Probability of sampling light by way of mirrors at a vertex that samples light. in: segment of the ray that met it.
// Most light that is found this way is found early; in rooms with two mirrors the error is the same at deeper vertices
// with 1/4 as with 1.
inline float mirror_rate(PathSegment in) { return in == PathSegment::view ? 1.0f : 0.25f; }

// Samples a light by way of one of the mirrors, with mirror_rate(). rate: probability of light sampling.
template <class V, class B>
void sample_mirrored(const V& view, const PathState& s, const Surface& surface, Vec3 wo, const B& bsdf,
                     const Sampler& sampler, DirectLight how, float rate, PathActions& actions)
{
    const Vec2 number = sampler.get2(s.depth, Dim::mirror);
    const float of_mirrors = mirror_rate(s.segment);
    if (!(number.y < of_mirrors)) return;
    const uint32_t id = choose_mirror(view.scene, number.x);
    auto light = view.sample_light_by_power(
        image_of(view.scene.mirrors[id], surface), [&] { return sampler.get1(s.depth, Dim::mirror); },
        sampler.get2(s.depth, Dim::mirrored_light), bsdf.transmits());
    if (!light) return;
    light->pdf *= rate * of_mirrors;
    request_mirrored(
        view, id, surface, *light, s.throughput, how, [&](Vec3 wi) { return bsdf.eval(wo, wi); },
        [&](Ray& ray) { view.set_alpha_key(ray, sampler, s.depth, Dim::shadow_alpha); }, actions);
}

// The path on its way to a mirror: light that comes by way of it is that at the end of the next ray.
inline PathState to_mirror(PathState s)
{
    ++s.depth, s.specular = false;
    return s;
}

// Keeps in n, the path that goes on from a mirror, what the density of sample_mirrored() at the vertex before depends
// on.
inline void follow_mirror(const PathState& s, const Surface& surface, DirectLight how, PathState& n)
{
    n.mirror_distance = 0;
    if (s.mirror == 0 || !s.light_sampled || !n.specular || !how.mirrors) return;
    n.mirror_distance = surface.t;
    n.normal = mirror_image(s.normal, surface.n);
    n.pdf = s.pdf / mirror_rate(s.segment == PathSegment::direct ? PathSegment::view : PathSegment::indirect);
}

}  // namespace lancer
