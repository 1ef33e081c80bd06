#include "geometry/list/list8.h"

#include <algorithm>

#include "core/bounds.h"
#include "geometry/triangle_float.h"

namespace lancer {

List8::List8(const TriangleSet& triangles)
{
    Bounds bounds;
    for (uint32_t i = 0; i < triangles.size(); ++i)
        if (triangles.is_finite(i))
            for (const Vec3 p : triangles.corners(i)) bounds.grow(to_double(p));
    if (bounds.empty()) return;
    low_ = to_float(bounds.lower), high_ = to_float(bounds.upper);
    const auto is_in_face = [&](const std::array<Vec3, 3>& corners) {
        for (int k = 0; k < 3; ++k)
            for (const float face : {low_[k], high_[k]})
                if (corners[0][k] == face && corners[1][k] == face && corners[2][k] == face) return true;
        return false;
    };
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        if (!triangles.is_finite(i)) continue;
        const auto corners = triangles.corners(i);
        add(all_, i, corners);
        add(is_in_face(corners) ? in_faces_ : inner_, i, corners);
    }
}

void List8::add(Parts& parts, uint32_t number, const std::array<Vec3, 3>& corners)
{
    if (parts.empty() || parts.back().triangles.size() == part_size) parts.emplace_back();
    Part& part = parts.back();
    Triangle t{{}, {}, number, corners};
    const auto& [a, b, c] = t.places;
    const Vec3 e = b - a, g = c - a;
    for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        const float first = e[x] * g[y], second = e[y] * g[x];
        t.along[static_cast<size_t>(k)] = {a[k], first - second, std::abs(first) + std::abs(second)};
    }
    for (size_t k = 0; k < 3; ++k) t.corners[k] = part.add_corner(t.places[k]);
    part.triangles.push_back(t);
}

uint32_t List8::Part::add_corner(Vec3 p)
{
    const auto count = static_cast<uint32_t>(corners[0].size());
    for (uint32_t i = 0; i < count; ++i)
        if (corners[0][i] == p.x && corners[1][i] == p.y && corners[2][i] == p.z) return i;
    corners[0].push_back(p.x), corners[1].push_back(p.y), corners[2].push_back(p.z);
    return count;
}

uint64_t List8::bytes() const
{
    uint64_t sum = 0;
    for (const auto* parts : {&all_, &inner_, &in_faces_})
        for (const Part& part : *parts)
            sum += sizeof(Part) + part.triangles.size() * sizeof(Triangle) + 3 * part.corners[0].size() * sizeof(float);
    return sum;
}

double List8::sah_cost() const
{
    double sum = 0;
    for (const Part& part : all_) sum += static_cast<double>(part.triangles.size());
    return sum;
}

void List8::find_exactly(const Part& part, const Points& points, Mask8 valid, Candidates& candidates)
{
    candidates.which = 0;
    for (size_t i = 0; i < part.triangles.size(); ++i) {
        const Triangle& t = part.triangles[i];
        const Edges edges(t, points);
        Mask8 inside = edges.contain() & valid;
        if (const uint32_t on_edge = movemask(inside & edges.touch())) {
            const Point &a = points[t.corners[0]], &b = points[t.corners[1]], &c = points[t.corners[2]];
            inside &= ~lanes_of(on_edge & ~contain_origin(on_edge, {a.x, a.y, b.x, b.y, c.x, c.y}));
        }
        candidates.outside[i] = ~inside;
        candidates.which |= uint64_t{movemask(inside) != 0} << i;
    }
}

const List8::Triangle& List8::numbered(uint32_t number) const
{
    const auto ends_before = [](const Part& part, uint32_t n) { return part.triangles.back().number < n; };
    const Part& part = *std::lower_bound(all_.begin(), all_.end(), number, ends_before);
    return *std::lower_bound(part.triangles.begin(), part.triangles.end(), number,
                             [](const Triangle& t, uint32_t n) { return t.number < n; });
}

uint32_t List8::decide(const Triangle& triangle, const ShearedPacket& r, uint32_t lanes, PacketHits& best,
                       Distance& d) const
{
    const auto distance = [&r](const Triangle& to, size_t i) {
        const auto& [a, b, c] = to.places;
        return distance_to_plane(lane(r.rays.org, i), lane(r.rays.dir, i), static_cast<int>(r.axes[2]), a, b, c);
    };
    uint32_t met = 0;
    for_each_lane(lanes, [&](uint32_t i) {
        const float t = distance(triangle, i);
        d.t[i] = d.low[i] = d.high[i] = t;
        const bool is_first = best.number[i] == PacketHits::none;
        // Both distances are rounded in the same way: of coincident triangles the first stays.
        if (!is_first) best.low[i] = best.high[i] = distance(numbered(best.number[i]), i);
        met |= uint32_t{t >= r.rays.t_min[i] && (is_first ? t <= best.high[i] : t < best.high[i])} << i;
    });
    return met;
}

}  // namespace lancer
