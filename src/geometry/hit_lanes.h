// Eight hits in SIMD registers.
#pragma once

#include <cstddef>

#include "core/lanes/vec.h"
#include "geometry/hit.h"

namespace lancer {

static_assert(offsetof(Hit, primitive) == offsetof(Hit, t) + 12 && offsetof(Hit, leaf_hint) == offsetof(Hit, uv) + 12 &&
              offsetof(Hit, kind) == offsetof(Hit, uv) + 8);

struct HitLanes {
    Float8 t, u, v;
    UInt8 geometry, primitive, leaf_hint;
    Mask8 exist;  // lanes with a hit

    // Loads eight consecutive hits.
    explicit HitLanes(const Hit* hits)
    {
        const RowLanes where = transpose([&](size_t i) { return load4(&hits[i].t); });
        const RowLanes what = transpose([&](size_t i) { return load4(&hits[i].uv.x); });
        t = where.xyz.x, u = what.xyz.x, v = what.xyz.y;
        geometry = reinterpret_cast<UInt8>(where.xyz.z), primitive = reinterpret_cast<UInt8>(where.w);
        leaf_hint = reinterpret_cast<UInt8>(what.w);
        exist = (reinterpret_cast<UInt8>(what.xyz.z) & 255u) != static_cast<uint32_t>(Kind::none);
    }
};

}  // namespace lancer
