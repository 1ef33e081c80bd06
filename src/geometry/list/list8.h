// A list of triangles, each tested against eight rays at once: for a few dozen triangles faster than any tree, as it
// has no boxes and no unpredictable branches. Watertight, by the test of bvh8/leaf.h with the roles of rays and
// triangles exchanged. Triangles in a face of the bounds, like the walls of a room, are not tested for shadow rays that
// begin and end inside.
#pragma once

#include "geometry/edge_lanes.h"
#include "geometry/packet_tree.h"
#include "geometry/triangle_float.h"

namespace lancer {

// A PacketTree.
class List8 {
public:
    // Number of triangles per part; shared corners of a part are sheared once.
    static constexpr size_t part_size = 64;

    explicit List8(const TriangleSet& triangles);

    template <class Found>
    void closest(const Ray& ray, float& t_max, const Found& found) const
    {
        const uint32_t first = 0;
        const ShearedPacket r({&ray, 1}, {&first, 1});
        PacketHits best(broadcast(t_max));
        closest(r, best, [&](Mask8 met, uint32_t number, Float8 t) { return lanes_of(met[0] && found(number, t[0])); });
        t_max = best.t(0);
    }
    template <class Found>
    bool any(const Ray& ray, const Found& found) const
    {
        const uint32_t first = 0;
        return any(ShearedPacket({&ray, 1}, {&first, 1}),
                   [&](Mask8 met, uint32_t number, Float8 t) { return lanes_of(met[0] && found(number, t[0])); }) != 0;
    }

    template <class Counts>
    void closest(const ShearedPacket& r, PacketHits& best, const Counts& counts) const
    {
        for_candidates(all_, r, r.valid, [&](const Triangle& triangle, Mask8 inside) {
            Distance d;
            Mask8 met = reached(triangle, r, inside, best, d);
            met = counts(met, triangle.number, d.t);
            best.low = select(met, d.low, best.low), best.high = select(met, d.high, best.high);
            best.number = select(met, UInt8{} + triangle.number, best.number);
            return true;
        });
    }
    template <class Counts>
    uint32_t any(const ShearedPacket& r, const Counts& counts) const
    {
        PacketHits reach(r.rays.t_max);
        Mask8 open = r.valid;
        const auto close = [&](const Triangle& triangle, Mask8 inside) {
            Distance d;
            const Mask8 met = reached(triangle, r, inside & open, reach, d);
            open &= ~counts(met, triangle.number, d.t);
            return movemask(open) != 0;
        };
        for_candidates(inner_, r, open, close);
        if (!in_faces_.empty()) {
            const Mask8 leaving = open & ~stays_inside(r.rays);
            if (movemask(leaving) != 0) for_candidates(in_faces_, r, leaving, close);
        }
        return movemask(r.valid & ~open);
    }

    uint64_t bytes() const;
    double sah_cost() const;

private:
    struct Triangle {
        struct Along {
            float a, normal, size;  // first corner; cross product of two sides, and of their absolute values
        };
        std::array<Along, 3> along;  // per axis
        std::array<uint32_t, 3> corners;
        uint32_t number;
        std::array<Vec3, 3> places;  // of the corners
    };
    struct Part {
        std::array<std::vector<float>, 3> corners;  // per axis
        std::vector<Triangle> triangles;

        uint32_t add_corner(Vec3 p);
    };
    using Parts = std::vector<Part>;
    struct Point {
        Float8 x, y;
    };
    using Points = std::array<Point, 3 * part_size>;
    struct Edges {
        Float8 u, v, w;  // edge functions

        Edges(const Triangle& t, const Points& points)
        {
            const Point &a = points[t.corners[0]], &b = points[t.corners[1]], &c = points[t.corners[2]];
            u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
        }
        // Its sign bit: the line passes the triangle, if no edge function is 0.
        Mask8 signs_differ() const
        {
            const auto bits = [](Float8 x) { return reinterpret_cast<Mask8>(x); };
            return (bits(u) ^ bits(v)) | (bits(u) ^ bits(w));
        }
        // 0 where an edge function is 0. It may underflow.
        Float8 product() const { return abs(u * v * w); }
        Mask8 contain() const { return (min(u, min(v, w)) >= Float8{}) | (max(u, max(v, w)) <= Float8{}); }
        Mask8 touch() const { return (u == Float8{}) | (v == Float8{}) | (w == Float8{}); }
    };
    // Triangles of a part that the lines of some rays hit.
    struct Candidates {
        static_assert(part_size <= 64);
        uint64_t which;                        // bit i: triangle i
        std::array<Mask8, part_size> outside;  // sign bits: rays that do not hit it
    };

    static void add(Parts& parts, uint32_t number, const std::array<Vec3, 3>& corners);
    // Calls f(triangle, lanes), in order, for triangles that the lines of some rays hit, until f returns false.
    // Candidates are collected first, so that branches do not wait for arithmetic.
    template <class F>
    static void for_candidates(const Parts& parts, const ShearedPacket& r, Mask8 valid, const F& f)
    {
        Points points;
        Candidates candidates;
        const uint32_t idle = ~movemask(valid) & 255u;
        for (const Part& part : parts) {
            shear(part, r, points);
            Float8 least_product = broadcast(1.0f);
            candidates.which = 0;
            const size_t count = part.triangles.size();
            for (size_t i = 0; i < count; ++i) {
                const Edges edges(part.triangles[i], points);
                const Mask8 outside = edges.signs_differ();
                least_product = min(edges.product(), least_product);
                candidates.outside[i] = outside;
                candidates.which |= uint64_t{(movemask(outside) | idle) != 255} << i;
            }
            if (movemask((least_product == Float8{}) & valid) != 0) find_exactly(part, points, valid, candidates);
            for (uint64_t which = candidates.which; which != 0; which &= which - 1) {
                const auto i = static_cast<size_t>(std::countr_zero(which));
                if (!f(part.triangles[i], ~(candidates.outside[i] >> 31) & valid)) return;
            }
        }
    }
    // The same candidates where edge functions are 0 and their signs do not tell.
    static void find_exactly(const Part& part, const Points& points, Mask8 valid, Candidates& candidates);
    static void shear(const Part& part, const ShearedPacket& r, Points& points)
    {
        const float *x = part.corners[r.axes[0]].data(), *y = part.corners[r.axes[1]].data(),
                    *z = part.corners[r.axes[2]].data();
        for (size_t i = 0; i < part.corners[0].size(); ++i) {
            const Float8 height = broadcast(z[i]) - r.org.z;
            points[i] = {fnmadd(r.sx, height, broadcast(x[i]) - r.org.x),
                         fnmadd(r.sy, height, broadcast(y[i]) - r.org.y)};
        }
    }

    // Lanes whose rays stay inside of the bounds, to a little more than t_max, as the distance to a face is rounded. A
    // fused product and sum keeps the order of numbers: an end that is rounded to the inside is inside.
    Mask8 stays_inside(const RayPacket& rays) const
    {
        const Float8 reach = -(rays.t_max + rays.t_max * 0x1p-22f);
        const auto along = [&](Float8 org, Float8 dir, float low, float high) {
            const Float8 end = fnmadd(reach, dir, org);
            return (min(org, end) > broadcast(low)) & (max(org, end) < broadcast(high));
        };
        return along(rays.org.x, rays.dir.x, low_.x, high_.x) & along(rays.org.y, rays.dir.y, low_.y, high_.y) &
               along(rays.org.z, rays.dir.z, low_.z, high_.z);
    }

    struct Distance {
        Float8 t, low, high;  // with bounds of its error
    };
    // The lanes that hit the triangle up to the nearest hit so far, or before it if that is another triangle's. As
    // LeafRay::within().
    Mask8 reached(const Triangle& triangle, const ShearedPacket& r, Mask8 lanes, PacketHits& best, Distance& d) const
    {
        const Triangle::Along &x = triangle.along[r.axes[0]], &y = triangle.along[r.axes[1]],
                              &z = triangle.along[r.axes[2]];
        const Float8 px = broadcast(x.a) - r.org.x, py = broadcast(y.a) - r.org.y, pz = broadcast(z.a) - r.org.z;
        const Float8 slope = fmadd(broadcast(x.normal), r.sx, fmadd(broadcast(y.normal), r.sy, broadcast(z.normal)));
        const Float8 scale = r.sz / slope;
        const Float8 t =
            fmadd(broadcast(x.normal), px, fmadd(broadcast(y.normal), py, broadcast(z.normal) * pz)) * scale;
        const Float8 of_place =
            fmadd(broadcast(x.size), abs(px), fmadd(broadcast(y.size), abs(py), broadcast(z.size) * abs(pz)));
        const Float8 of_slope =
            fmadd(broadcast(x.size), r.length.x, fmadd(broadcast(y.size), r.length.y, broadcast(z.size) * r.length.z));
        const Float8 error = abs(scale * gamma(8)) * fmadd(abs(t), of_slope, of_place);
        d = {t, t - error, t + error};
        lanes &= ~((d.high < r.rays.t_min) | (d.low > best.high));
        const Mask8 sure = (error < t * most_distance_error) & (d.low > r.rays.t_min) & (d.high < best.low);
        const uint32_t unsure = movemask(lanes & ~sure);
        if (unsure == 0) return lanes;
        return (lanes & sure) | lanes_of(decide(triangle, r, unsure, best, d));
    }
    // The same for lanes that float cannot decide.
    uint32_t decide(const Triangle& triangle, const ShearedPacket& r, uint32_t lanes, PacketHits& best,
                    Distance& d) const;
    const Triangle& numbered(uint32_t number) const;

    Parts all_, inner_, in_faces_;  // the triangles in faces of the bounds are apart for any()
    Vec3 low_{}, high_{};           // bounds of all corners
};

}  // namespace lancer
