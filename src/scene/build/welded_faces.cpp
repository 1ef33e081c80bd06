#include "scene/build/welded_faces.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "core/bounds.h"
#include "core/hash.h"

namespace lancer {
namespace {

// Files round coordinates to six digits, often of numbers that are rounded already.
constexpr double rounding_of_files = 2e-6;  // of the extent of all
constexpr double most_of_edge = 0.01;       // of the shortest edge at a vertex: details are not closed

// Whether the vertex normals of a triangle point away from the side that its winding shows.
bool is_turned(const MeshData& data, uint32_t triangle)
{
    if (data.normals.empty() || data.normal_triangles[triangle][0] == MeshData::no_normal) return false;
    const auto& [a, b, c] = data.triangles[triangle];
    const Vec3d n = cross(data.positions[b] - data.positions[a], data.positions[c] - data.positions[a]);
    Vec3d sum{};
    for (const uint32_t i : data.normal_triangles[triangle]) sum += to_double(data.normals[i]);
    return dot(n, sum) < 0;
}

// The number of each vertex among those with different positions, which go to `welded`.
std::vector<uint32_t> numbers_of(const std::vector<Vec3d>& positions, std::vector<Vec3d>& welded)
{
    std::vector<uint32_t> order(positions.size()), number(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
    std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) { return key(i) < key(j); });
    for (size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i - 1]) != key(order[i])) welded.push_back(positions[order[i]]);
        number[order[i]] = static_cast<uint32_t>(welded.size() - 1);
    }
    return number;
}

// Vertices of open edges, each with how far another one may be away that is meant to be the same.
class Seams {
public:
    explicit Seams(const WeldedFaces& faces) : faces_(faces), reach_(faces.positions.size())
    {
        Bounds bounds;
        for (const Vec3d& p : faces.positions) bounds.grow(p);
        most_ = rounding_of_files * bounds.extent();
        for_each_edge(edges_of(faces, [](uint32_t) { return true; }), [&](std::span<const FaceAtEdge> at) {
            const auto forward = std::count_if(at.begin(), at.end(), [](const auto& e) { return e.forward; });
            if (2 * static_cast<size_t>(forward) == at.size()) return;
            const double length = lancer::length(faces.positions[at[0].low] - faces.positions[at[0].high]);
            for (const uint32_t v : {at[0].low, at[0].high}) {
                double& reach = reach_[v];
                if (reach == 0) open_.push_back(v), reach = most_;
                reach = std::min(reach, most_of_edge * length);
            }
        });
    }
    // The vertex that stands for each, or itself; empty: all stay.
    std::vector<uint32_t> joined()
    {
        if (open_.empty() || !(most_ > 0)) return {};
        std::sort(open_.begin(), open_.end());
        std::vector<uint32_t> stands(reach_.size());
        std::iota(stands.begin(), stands.end(), 0u);
        bool any = false;
        for (const uint32_t v : open_) {
            const Vec3d p = faces_.positions[v];
            const auto near = nearest(v, p);
            if (near != v)
                stands[v] = near, any = true;
            else
                cells_.emplace(hash_of(cell_of(p)), v);
        }
        return any ? stands : std::vector<uint32_t>{};
    }

private:
    using Cell = std::array<int64_t, 3>;
    Cell cell_of(Vec3d p) const
    {
        const auto at = [&](double x) { return static_cast<int64_t>(std::floor(x / most_)); };
        return {at(p.x), at(p.y), at(p.z)};
    }
    static uint64_t hash_of(const Cell& c)
    {
        uint64_t h = 0;
        for (const int64_t x : c) h = mix_bits(h + static_cast<uint64_t>(x) + 0x9e3779b97f4a7c15ull);
        return h;
    }
    // An earlier vertex within reach of both.
    uint32_t nearest(uint32_t v, Vec3d p) const
    {
        const Cell c = cell_of(p);
        for (int64_t x = -1; x <= 1; ++x)
            for (int64_t y = -1; y <= 1; ++y)
                for (int64_t z = -1; z <= 1; ++z) {
                    const auto [first, last] = cells_.equal_range(hash_of({c[0] + x, c[1] + y, c[2] + z}));
                    for (auto it = first; it != last; ++it)
                        if (length(faces_.positions[it->second] - p) <= std::min(reach_[v], reach_[it->second]))
                            return it->second;
                }
        return v;
    }

    const WeldedFaces& faces_;
    double most_ = 0;
    std::vector<double> reach_;  // of each vertex; 0 if no edge there is open
    std::vector<uint32_t> open_;
    std::unordered_multimap<uint64_t, uint32_t> cells_;
};

}  // namespace

void sort_by_edge(std::vector<FaceAtEdge>& edges)
{
    const auto key = [](const FaceAtEdge& e) { return std::pair(uint64_t{e.low} << 32 | e.high, e.face); };
    std::sort(edges.begin(), edges.end(), [&](const FaceAtEdge& a, const FaceAtEdge& b) { return key(a) < key(b); });
}

WeldedFaces weld_faces(const MeshData& data, const Transform& place, std::span<const uint32_t> which)
{
    WeldedFaces faces;
    std::vector<uint32_t> used;
    used.reserve(3 * which.size());
    for (const uint32_t t : which) used.insert(used.end(), data.triangles[t].begin(), data.triangles[t].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<Vec3d> positions;
    positions.reserve(used.size());
    for (const uint32_t v : used) positions.push_back(place.point(data.positions[v]) + Vec3d{});  // -0 becomes 0
    const std::vector<uint32_t> number = numbers_of(positions, faces.positions);
    const bool mirrors = place.determinant() < 0;
    for (const uint32_t t : which) {
        WeldedFaces::Corners corners;
        for (size_t k = 0; k < 3; ++k)
            corners[k] = number[static_cast<size_t>(std::lower_bound(used.begin(), used.end(), data.triangles[t][k]) -
                                                    used.begin())];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        if (is_turned(data, t) != mirrors) std::swap(corners[1], corners[2]);
        faces.number.push_back(t), faces.corners.push_back(corners);
    }
    if (const std::vector<uint32_t> stands = Seams(faces).joined(); !stands.empty())
        for (WeldedFaces::Corners& corners : faces.corners)
            for (uint32_t& v : corners) v = stands[v];
    return faces;
}

}  // namespace lancer
