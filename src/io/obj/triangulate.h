// Polygons of a mesh file into triangles: quads along the shorter of the diagonals that keep both halves facing the
// same way, which is what most programs do and where bent quads bend least; others by a fan if that is right and else
// by ear clipping, seen along the Newell normal. A polygon of n corners gives at most n - 2 triangles, corner numbers
// in the polygon's own direction.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/vec.h"
#include "io/obj/ear_clipping.h"

namespace lancer {

// Not normalised; twice the area of a plane polygon long.
inline Vec3d newell_normal(std::span<const Vec3d> p)
{
    Vec3d n;
    for (size_t i = 2; i < p.size(); ++i) n += cross(p[i - 1] - p[0], p[i] - p[0]);
    return n;
}

// Whether the height of a triangle is above the rounding of its coordinates.
inline bool has_area(Vec3d p, Vec3d q, Vec3d r)
{
    const double place = std::max({max_component(abs(p)), max_component(abs(q)), max_component(abs(r))});
    if (place == 0) return false;
    const Vec3d a = (q - p) / place, b = (r - p) / place;
    const double longest = std::max({length(a), length(b), length(b - a)});
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    return length(cross(a, b)) > rounding * longest;
}

class Triangulator {
public:
    using Triangle = EarClipper::Triangle;

    // The result is valid until the next call.
    std::span<const Triangle> operator()(std::span<const Vec3d> polygon)
    {
        triangles_.clear();
        const auto n = static_cast<uint32_t>(polygon.size());
        if (n < 3) return triangles_;
        project(polygon);
        const bool is_fan = fan(n);
        if (n == 4 && area(0, 1, 3) > 0 && area(1, 2, 3) > 0 && !(is_fan && diagonal(0, 2) <= diagonal(1, 3))) {
            triangles_.assign({{0, 1, 3}, {1, 2, 3}});
        } else if (n > 4 && !is_fan) {
            triangles_.clear();
            clip_ears_(points_, triangles_);
        }
        return triangles_;
    }

private:
    double area(uint32_t a, uint32_t b, uint32_t c) const { return signed_area(points_[a], points_[b], points_[c]); }

    double diagonal(size_t a, size_t b) const { return length(local_[b] - local_[a]); }

    // Drops the axis along which the normal is longest, so that the polygon runs counter-clockwise. Relative to a
    // corner and to the size, so that neither a far place nor a tiny polygon costs digits.
    void project(std::span<const Vec3d> polygon)
    {
        double extent = 0;
        for (const Vec3d& p : polygon) extent = std::max(extent, max_component(abs(p - polygon[0])));
        if (!(extent > 0 && extent < 1e300)) extent = 1;
        local_.clear();
        for (const Vec3d& p : polygon) local_.push_back((p - polygon[0]) / extent);
        const Vec3d n = newell_normal(local_), size = abs(n);
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        points_.clear();
        for (const Vec3d& p : local_) points_.push_back(n[axis] < 0 ? PlanePoint{p[v], p[u]} : PlanePoint{p[u], p[v]});
    }

    // Leaves the fan in triangles_; false if it is wrong because a part of it faces the other way.
    bool fan(uint32_t n)
    {
        bool right = true;
        for (uint32_t i = 2; i < n; ++i) {
            triangles_.push_back({0, i - 1, i});
            right = right && area(0, i - 1, i) > 0;
        }
        return right;
    }

    std::vector<Triangle> triangles_;
    std::vector<Vec3d> local_;
    std::vector<PlanePoint> points_;
    EarClipper clip_ears_;
};

}  // namespace lancer
