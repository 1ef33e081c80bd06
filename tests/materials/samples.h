// Parameter sets of every material, for the laws. A material without an overload here does not compile.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "materials/material.h"
#include "support/random.h"

namespace lancer {

template <class M>
struct Sample {
    std::string name;
    M material;
    bool lossless = false;   // albedo 1 in every direction
    bool transmits = false;  // light may go through
};

template <class M>
std::vector<Sample<M>> samples() = delete;

template <>
inline std::vector<Sample<Lambert>> samples<Lambert>()
{
    return {{"white", {{1, 1, 1}}, true}, {"coloured", {{0.8f, 0.3f, 0.05f}}}, {"black", {{0, 0, 0}}}};
}
template <>
inline std::vector<Sample<Mirror>> samples<Mirror>()
{
    return {{"white", {{1, 1, 1}}, true}, {"gold", {{0.9f, 0.7f, 0.2f}}}};
}
template <>
inline std::vector<Sample<Glass>> samples<Glass>()
{
    const Color white{1, 1, 1};
    return {{"crown", {white, 1.5f}, true, true},
            {"air bubble", {white, 1 / 1.33f}, true, true},
            {"nothing", {white, 1}, true, true},
            {"almost nothing", {white, 1.0001f}, true, true},
            {"diamond", {white, 2.42f}, true, true},
            {"germanium", {white, 4}, true, true},
            {"green", {{0.2f, 0.9f, 0.4f}, 1.6f}, false, true}};
}

struct Place {
    std::string name;
    ShadingPoint point;
    Vec3 wo;
};

// Both sides, from above to grazing.
inline std::vector<Place> places()
{
    std::vector<Place> all;
    double phi = 0.3;
    for (const bool front : {true, false})
        for (const double z : {1.0, 0.8, 0.5, 0.2, 0.02}) {
            const double r = std::sqrt(1 - z * z);
            phi += 2.1;
            all.push_back({std::string(front ? "front" : "back") + " cos " + std::to_string(z),
                           {.front = front},
                           to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), z})});
        }
    return all;
}

template <class M>
using BsdfOf = decltype(std::declval<M>().at(ShadingPoint{}));

// f(name, sample, place, bsdf) for every parameter set seen from everywhere.
template <class M, class F>
void for_each_bsdf(const F& f)
{
    for (const Sample<M>& s : samples<M>())
        for (const Place& p : places())
            f(std::string(M::name) + " " + s.name + ", " + p.name, s, p, s.material.at(p.point));
}

// u and v of the extremes of their range, and in between.
template <class F>
void for_each_extreme_number(const F& f)
{
    constexpr float last = 1 - 0x1p-24f;
    for (const float u : {0.0f, 0x1p-24f, 0.04f, 0.5f, last})
        for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, last})
            for (const float y : {0.0f, 0x1p-24f, 0.125f, 0.5f, 0.75f, last}) f(u, Vec2{x, y});
}

}  // namespace lancer
