// What triangles that were hit have in common several at a time: which of a batch go together, and their vectors in
// registers.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/lanes/vec.h"
#include "geometry/hit.h"

namespace lancer {

// Numbers of hits of a batch. The last ones of a batch may name one several times.
template <size_t n>
using SomeHits = std::array<size_t, n>;
using FourHits = SomeHits<double_lanes>;
using HitIndices = SomeHits<float_lanes>;

// some(which), n at a time, of the triangles that are drawn as they are, placed(i) of each one that an instance places.
// Spheres, planes and misses are left out.
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

// Of four vectors, each with something behind it: all x in one register, then all y, all z.
inline Vec3T<Float4> turned(std::array<Float4, double_lanes> v)
{
    _MM_TRANSPOSE4_PS(v[0], v[1], v[2], v[3]);
    return {v[0], v[1], v[2]};
}

}  // namespace lancer
