// A table of non-instanced flat triangles with all their shading data in one cache line each, for scenes so small that
// it stays in the cache. triangle_interaction() reads the same data from three tables.
#pragma once

#include <vector>

#include "core/lanes/row_table.h"
#include "geometry/hit_lanes.h"
#include "scene/triangle_interaction.h"

namespace lancer {

class FlatTable {
public:
    // Empty unless all geometry of the scene consists of few such triangles.
    static FlatTable of(const Scene& scene);

    bool empty() const { return records_.empty(); }
    struct Found {
        InteractionLanes place;
        UInt8 material;
        Mask8 shines;  // whether the material emits on any side
    };
    // Results of lanes without a hit are finite but meaningless.
    Found at(const HitLanes& hits) const
    {
        const UInt8 number = select(hits.exist, permute(first_, hits.geometry) + hits.primitive, UInt8{});
        const RowLanes a = rows(number, 0), b = rows(number, 1), c = rows(number, 2), n = rows(number, 3);
        const PointOnTriangle<Float8> at(a.xyz, b.xyz, c.xyz, hits.u, hits.v, b.w);
        return {{at.p, at.p_error, n.xyz, n.xyz, n.w}, reinterpret_cast<UInt8>(a.w), reinterpret_cast<Mask8>(c.w)};
    }

private:
    // Per triangle: its corners and the normal, one component of the normal behind each corner; then the material,
    // PointOnTriangle::rounding, a mask that tells whether it emits, and its area.
    struct alignas(64) Record : std::array<Row, 4> {};

    RowLanes rows(UInt8 records, size_t k) const
    {
        return transpose([&](size_t i) { return load4(&records_[records[i]][k].x); });
    }

    std::vector<Record> records_;
    UInt8 first_{};  // index of each mesh's first triangle
};

}  // namespace lancer
