// All there is to know of triangles that are drawn as they are and have no normals of their own: a line of memory each,
// where there are so few of them that all stay in the caches. triangle_interaction() gathers the same from three
// tables.
#pragma once

#include <vector>

#include "core/lanes/row_table.h"
#include "geometry/hit_lanes.h"
#include "scene/triangle_interaction.h"

namespace lancer {

class FlatTable {
public:
    // Empty, unless all that rays of the scene can hit are so few such triangles.
    static FlatTable of(const Scene& scene);

    bool empty() const { return records_.empty(); }
    struct Found {
        InteractionLanes place;
        UInt8 material;
        Mask8 shines;  // whether any of its sides does
    };
    // Of lanes without a hit: anything finite.
    Found at(const HitLanes& hits) const
    {
        const UInt8 number = select(hits.exist, permute(first_, hits.geometry) + hits.primitive, UInt8{});
        const RowLanes a = rows(number, 0), b = rows(number, 1), c = rows(number, 2), n = rows(number, 3);
        const PointOnTriangle<Float8> at(a.xyz, b.xyz, c.xyz, hits.u, hits.v, b.w);
        return {{at.p, at.p_error, n.xyz, n.xyz, n.w}, reinterpret_cast<UInt8>(a.w), reinterpret_cast<Mask8>(c.w)};
    }

private:
    // Of a triangle: each corner and its normal; behind these the material, PointOnTriangle::rounding, all bits where
    // it shines, and its area.
    struct alignas(64) Record : std::array<Row, 4> {};

    RowLanes rows(UInt8 records, size_t k) const
    {
        return transpose([&](size_t i) { return load4(&records_[records[i]][k].x); });
    }

    std::vector<Record> records_;
    UInt8 first_{};  // of each mesh
};

}  // namespace lancer
