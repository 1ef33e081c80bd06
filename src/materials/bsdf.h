// The interface of all BSDFs. Directions are local: z is the shading normal on the side from which the path arrives. wo
// (back along the path) and wi (towards the light) both point away from the surface and are unit.
#pragma once

#include <concepts>
#include <optional>
#include <type_traits>

#include "core/color.h"
#include "core/vec.h"

namespace lancer {

// Spectrum: Color, or Vec3x8 with T = Float8.
template <class Spectrum, class T>
struct BsdfValueT {
    Spectrum f_cos;  // f * |cos(wi)|
    T pdf{};         // density with which sample() returns wi, per solid angle, without delta lobes
};
using BsdfValue = BsdfValueT<Color, float>;

struct BsdfSample {
    Vec3 wi;
    Color weight;   // f * |cos(wi)| / pdf
    float pdf = 0;  // per solid angle; for a delta lobe its selection probability
    bool delta = false;
    float eta = 1;  // transmission: index beyond the surface over index on wo's side. Radiance shrinks by eta^2
                    // (in weight already); energy does not.
};

// u selects the lobe, v the direction; each in [0, 1).
template <class B>
concept Bsdf = std::is_trivially_copyable_v<B> && requires(const B b, Vec3 wo, Vec3 wi, float u, Vec2 v)
{
    {
        b.eval(wo, wi)
        } -> std::same_as<BsdfValue>;
    {
        b.eval_diffuse(wo, wi)
        } -> std::same_as<Color>;  // the part of eval().f_cos that is Lambertian reflection
    {
        b.sample(wo, u, v)
        } -> std::same_as<std::optional<BsdfSample>>;
    {
        b.only_delta()
        } -> std::convertible_to<bool>;  // only delta lobes: light sampling is useless
    {
        b.transmits()
        } -> std::convertible_to<bool>;  // a non-delta lobe has wi.z < 0: lights behind the surface count
    {
        b.reflectance()
        } -> std::same_as<Color>;  // approximate albedo under uniform illumination, for denoisers
};

}  // namespace lancer
