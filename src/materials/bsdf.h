// The interface of every BSDF. Directions are local: z is the shading normal, turned to the side the path arrives
// from; wo (where the light goes, back along the path) and wi (where it comes from) both point away from the surface
// and are unit.
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
    T pdf{};         // of sample() giving wi, per solid angle; delta lobes do not count
};
using BsdfValue = BsdfValueT<Color, float>;

struct BsdfSample {
    Vec3 wi;
    Color weight;   // f * |cos(wi)| / pdf
    float pdf = 0;  // per solid angle; for a delta lobe the probability of choosing it
    bool delta = false;
    float eta = 1;  // transmission: index beyond the surface over index on wo's side. Radiance shrinks by eta^2
                    // (in weight already); energy does not.
};

// u chooses the lobe, v the direction; each in [0, 1).
template <class B>
concept Bsdf = std::is_trivially_copyable_v<B> && requires(const B b, Vec3 wo, Vec3 wi, float u, Vec2 v)
{
    {
        b.eval(wo, wi)
        } -> std::same_as<BsdfValue>;
    {
        b.sample(wo, u, v)
        } -> std::same_as<std::optional<BsdfSample>>;
    {
        b.only_delta()
        } -> std::convertible_to<bool>;  // no smooth lobe: sampling lights is in vain
    {
        b.transmits()
        } -> std::convertible_to<bool>;  // some smooth lobe has wi.z < 0: lights behind the surface count
    {
        b.reflectance()
        }
        -> std::same_as<Color>;  // about the part of even light that is sent back or on: the albedo that denoisers want
};

}  // namespace lancer
