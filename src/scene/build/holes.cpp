#include "scene/build/holes.h"

#include <bit>

#include "core/disjoint_sets.h"
#include "core/hash.h"

namespace lancer {
namespace {

uint64_t key_of(uint32_t low, uint32_t high) { return uint64_t{low} << 32 | high; }

int turn_of(const FaceAtEdge& e) { return e.forward ? 1 : -1; }

}  // namespace

double open_part(const WeldedFaces& faces, const CoincidentFaces& copies, std::span<const FaceAtEdge> edges,
                 std::span<const uint32_t> part)
{
    struct Border {
        uint32_t from, to;
        int times;
    };
    std::vector<Border> borders;
    for_each_edge(edges, [&](std::span<const FaceAtEdge> at) {
        int turn = 0;
        for (const FaceAtEdge& e : at)
            if (copies.stands(e.face)) turn += turn_of(e);
        if (turn > 0) borders.push_back({at[0].low, at[0].high, turn});
        if (turn < 0) borders.push_back({at[0].high, at[0].low, -turn});
    });
    // Borders that hang together by vertices are those of one hole.
    std::unordered_map<uint32_t, uint32_t> first_at;
    DisjointSets holes(borders.size());
    for (uint32_t i = 0; i < borders.size(); ++i)
        for (const uint32_t v : {borders[i].from, borders[i].to}) holes.join(i, first_at.emplace(v, i).first->second);
    std::vector<Vec3d> areas(borders.size());
    for (uint32_t i = 0; i < borders.size(); ++i) {
        const uint32_t hole = holes.find(i);
        const Vec3d o = faces.positions[borders[hole].from];
        areas[hole] += cross(faces.positions[borders[i].from] - o, faces.positions[borders[i].to] - o) *
                       static_cast<double>(borders[i].times);
    }
    double open = 0, area = 0;
    for (const Vec3d& a : areas) open += length(a);
    for (const uint32_t f : part) area += length(faces.normal(f));
    return open / area;
}

bool OtherEdges::close(std::span<const FaceAtEdge> edges) const
{
    bool all = true;
    for_each_edge(edges, [&](std::span<const FaceAtEdge> at) {
        int turn = 0;
        for (const FaceAtEdge& e : at) turn += turn_of(e);
        if (turn == 0) return;
        const auto it = turns_.find(key_of(at[0].low, at[0].high));
        all = all && it != turns_.end() && it->second == -turn;
    });
    return all;
}

std::vector<uint32_t> OtherEdges::vertices_of(const MeshData& data, const Transform& place, const WeldedFaces& faces)
{
    const auto hash = [](Vec3d p) {
        uint64_t h = 0;
        for (const double x : {p.x, p.y, p.z}) h = mix_bits(h ^ std::bit_cast<uint64_t>(x + 0.0)) + 1;
        return h;
    };
    std::unordered_map<uint64_t, uint32_t> vertex_at;
    for (const WeldedFaces::Corners& corners : faces.corners)
        for (const uint32_t v : corners) vertex_at.emplace(hash(faces.positions[v]), v);
    std::vector<uint32_t> vertex(data.positions.size(), UINT32_MAX);
    for (size_t i = 0; i < vertex.size(); ++i)
        if (const auto it = vertex_at.find(hash(place.point(data.positions[i]))); it != vertex_at.end())
            vertex[i] = it->second;
    return vertex;
}

void OtherEdges::add(const WeldedFaces::Corners& triangle, const std::vector<uint32_t>& vertex, bool mirrors)
{
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = vertex[triangle[k]], b = vertex[triangle[(k + 1) % 3]];
        if (a == UINT32_MAX || b == UINT32_MAX || a == b) continue;
        turns_[key_of(std::min(a, b), std::max(a, b))] += (a < b) != mirrors ? 1 : -1;
    }
}

}  // namespace lancer
