// Grouping of the triangle hits of a batch for SIMD, and loading of their vectors.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/lanes/vec.h"
#include "geometry/hit.h"

namespace lancer {

// Indices of hits of a batch; the last group may repeat an index.
template <size_t n>
using SomeHits = std::array<size_t, n>;
using FourHits = SomeHits<double_lanes>;
using HitIndices = SomeHits<float_lanes>;

// Calls some(which) for groups of n hits of non-instanced triangles and placed(i) for each hit of an instanced
// triangle. Spheres, planes and misses are skipped.
template <size_t n, class Some, class Placed>
void for_triangles(std::span<const Hit> hits, const Some& some, const Placed& placed)
{
    SomeHits<n> which{};
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].kind != Kind::triangle) continue;
        if (hits[i].instance != Hit::no_instance) {
            placed(i);
            continue;
        }
        which[count++] = i;
        if (count == n) some(which), count = 0;
    }
    if (count == 0) return;
    std::fill(which.begin() + count, which.end(), which[0]);
    some(which);
}

// Transposes four vectors that are each followed by another number.
inline Vec3T<Float4> turned(const std::array<Float4, double_lanes>& v)
{
    const auto [x, y, z, behind] = transpose4x4(v);
    return {x, y, z};
}

}  // namespace lancer
