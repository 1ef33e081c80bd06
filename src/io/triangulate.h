// Polygons of a mesh file into triangles: quads along a diagonal that keeps both halves facing the same way, others
// by a fan if that is right and else by ear clipping, seen along the Newell normal. A polygon of n corners gives at
// most n - 2 triangles, corner numbers in the polygon's own direction. Self-crossing polygons give something.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace lancer {

// Not normalised; twice the area of a plane polygon long.
inline Vec3d newell_normal(std::span<const Vec3d> p)
{
    Vec3d n;
    for (size_t i = 2; i < p.size(); ++i) n += cross(p[i - 1] - p[0], p[i] - p[0]);
    return n;
}

class Triangulator {
public:
    using Triangle = std::array<uint32_t, 3>;

    // The result is valid until the next call.
    std::span<const Triangle> operator()(std::span<const Vec3d> polygon)
    {
        triangles_.clear();
        const auto n = static_cast<uint32_t>(polygon.size());
        if (n < 3) return triangles_;
        project(polygon);
        if (!fan(n)) {
            if (n == 4 && area(0, 1, 3) > 0 && area(1, 2, 3) > 0)
                triangles_.assign({{0, 1, 3}, {1, 2, 3}});
            else if (n > 4)
                clip_ears(n);
        }
        return triangles_;
    }

private:
    struct Point {
        double x = 0, y = 0;
        friend bool operator==(const Point&, const Point&) = default;
    };
    struct Reflex {
        Point p;
        uint32_t corner = 0;
    };

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
        for (const Vec3d& p : local_) points_.push_back(n[axis] < 0 ? Point{p[v], p[u]} : Point{p[u], p[v]});
    }

    double area(uint32_t a, uint32_t b, uint32_t c) const { return area(points_[a], points_[b], points_[c]); }
    static double area(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

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

    void clip_ears(uint32_t n)
    {
        triangles_.clear();
        previous_.resize(n);
        next_.resize(n);
        for (uint32_t i = 0; i < n; ++i) {
            previous_[i] = i == 0 ? n - 1 : i - 1;
            next_[i] = i + 1 == n ? 0 : i + 1;
        }
        collect_reflex(n);
        uint32_t corner = 0, tried = 0;
        bool stuck = false;  // self-crossing, or hopelessly long: cut off anything from now on
        work_ = 0;
        for (uint32_t left = n; left > 3;) {
            stuck = stuck || tried >= 2 * left || work_ > max_work;
            const bool relaxed = tried >= left;  // corners without area go only if there is no proper ear
            const double a = area(previous_[corner], corner, next_[corner]);
            if (!stuck && !(a > 0 ? is_ear(corner) : relaxed && a == 0)) {
                corner = next_[corner];
                ++tried;
                continue;
            }
            if (a != 0) triangles_.push_back({previous_[corner], corner, next_[corner]});
            next_[previous_[corner]] = next_[corner];
            previous_[next_[corner]] = previous_[corner];
            next_[corner] = corner;                    // marks it as gone
            corner = next_[next_[previous_[corner]]];  // not the neighbour: that would make a fan of slivers
            tried = 0;
            --left;
        }
        triangles_.push_back({previous_[corner], corner, next_[corner]});
    }

    // Only a corner that is not convex at the start can ever lie inside an ear.
    void collect_reflex(uint32_t n)
    {
        reflex_.clear();
        for (uint32_t i = 0; i < n; ++i)
            if (!(area(previous_[i], i, next_[i]) > 0)) reflex_.push_back({points_[i], i});
        std::sort(reflex_.begin(), reflex_.end(), [](const Reflex& a, const Reflex& b) {
            return a.p.x != b.p.x ? a.p.x < b.p.x : a.corner < b.corner;
        });
    }

    bool is_ear(uint32_t corner)
    {
        const Point a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
        const auto [low, high] = std::minmax({a.x, b.x, c.x});
        auto r = std::lower_bound(reflex_.begin(), reflex_.end(), low,
                                  [](const Reflex& candidate, double x) { return candidate.p.x < x; });
        for (; r != reflex_.end() && r->p.x <= high; ++r, ++work_) {
            if (next_[r->corner] == r->corner || r->p == a || r->p == b || r->p == c) continue;
            if (area(a, b, r->p) >= 0 && area(b, c, r->p) >= 0 && area(c, a, r->p) >= 0) return false;
        }
        return true;
    }

    static constexpr uint64_t max_work = 2'000'000'000;  // tests of a point against an ear: a few seconds
    uint64_t work_ = 0;
    std::vector<Triangle> triangles_;
    std::vector<Vec3d> local_;
    std::vector<Point> points_;
    std::vector<uint32_t> previous_, next_;
    std::vector<Reflex> reflex_;
};

}  // namespace lancer
