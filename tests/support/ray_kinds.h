// Rays of the kinds that renderers trace, and of the kinds that are hard, by address: on any geometry, without a
// renderer. For comparing answers; speed is measured with rays of real renders.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/frame.h"
#include "geometry/geometry.h"
#include "support/addressed.h"

namespace lancer {

enum class RayKind { random, primary, shadow, bounce, hard };
inline constexpr std::array ray_kinds{RayKind::random, RayKind::primary, RayKind::shadow, RayKind::bounce,
                                      RayKind::hard};
inline constexpr std::string_view name_of(RayKind kind)
{
    constexpr std::string_view names[] = {"random", "primary", "shadow", "bounce", "hard"};
    return names[static_cast<size_t>(kind)];
}

class RaysOfKinds {
public:
    // The geometry needs a triangle, and must outlive this.
    explicit RaysOfKinds(const Geometry& g, uint64_t seed = 1) : g_(g), seed_(seed)
    {
        for (uint32_t i = 0; i < g.instances.size(); ++i) add({g.instances[i].mesh, g.instances[i].to_world});
        for (uint32_t i = 0; i < g.meshes.size(); ++i)
            if (!g.meshes[i].instanced) add({i, {}});
        for (const Sphere& s : g.spheres) box_.grow(bounds(s));
    }

    Ray ray(RayKind kind, uint64_t index) const
    {
        AddressedRandom random(seed_ + 1000 * static_cast<uint64_t>(kind), index);
        switch (kind) {
            case RayKind::random:
                return towards(anywhere(random), random.direction());
            case RayKind::primary:
                return primary(random);
            case RayKind::shadow:
                return shadow(random);
            case RayKind::bounce:
                return bounce(random);
            case RayKind::hard:
                break;
        }
        return hard(random);
    }

private:
    struct Placed {
        uint32_t mesh;
        Transform to_world;
    };
    struct Place {
        Vec3d at, normal;  // unit
        Vec3 error;        // bound of its rounding error, per axis, as large as that of surface_at()
    };

    void add(const Placed& p)
    {
        const Mesh& m = g_.meshes[p.mesh];
        if (m.triangles.empty()) return;
        placed_.push_back(p);
        for (const auto& t : m.triangles)
            for (const uint32_t v : t) box_.grow(p.to_world.point(to_double(m.positions[v])));
    }
    static Ray towards(Vec3d org, Vec3d dir) { return {.org = to_float(org), .dir = to_float(dir)}; }
    // In the box of everything and half of it around.
    Vec3d anywhere(AddressedRandom& random) const
    {
        const Vec3d half = (box_.upper - box_.lower) * 0.5;
        return random.in_box(box_.lower - half, box_.upper + half);
    }
    const Placed& placed(AddressedRandom& random) const
    {
        return placed_[random.below(static_cast<uint32_t>(placed_.size()))];
    }
    // Corners of a triangle in the scene's space.
    std::array<Vec3d, 3> triangle(AddressedRandom& random, const Placed& p) const
    {
        const Mesh& m = g_.meshes[p.mesh];
        const auto& t = m.triangles[random.below(static_cast<uint32_t>(m.triangles.size()))];
        std::array<Vec3d, 3> v;
        for (size_t k = 0; k < 3; ++k) v[k] = p.to_world.point(to_double(m.positions[t[k]]));
        return v;
    }
    Place place(AddressedRandom& random) const
    {
        for (;;) {
            const Placed& p = placed(random);
            const auto v = triangle(random, p);
            const Vec3d n = cross(v[1] - v[0], v[2] - v[0]);
            double a = random.uniform(), b = random.uniform();
            if (!(length(n) > 0)) continue;
            if (a + b > 1) a = 1 - a, b = 1 - b;
            const Vec3d at = v[0] + (v[1] - v[0]) * a + (v[2] - v[0]) * b;
            // Of the corners' coordinates, before and after an instance moved them.
            const Vec3d t = p.to_world.translation;
            const auto size = [&](Vec3d x) { return abs(x) + (abs(x - t) + abs(t)) * (t == Vec3d{} ? 0.0 : 2.0); };
            const Vec3d sizes = size(v[0]) * (1 - a - b) + size(v[1]) * a + size(v[2]) * b;
            return {at, normalize(n), to_float(sizes) * gamma(8)};
        }
    }
    static Ray from(const Place& p, Vec3d dir)
    {
        const Vec3 d = to_float(dir);
        return {.org = offset_origin(to_float(p.at), p.error, to_float(p.normal), d), .dir = d};
    }
    // Half of them from outside through a window around everything, half from the middle.
    Ray primary(AddressedRandom& random) const
    {
        const Vec3d center = box_.center(), eye = center + Vec3d{0.6, 0.4, 1} * (2 * box_.radius());
        if (random.below(2)) {
            const Vec3d look = normalize(Vec3d{-0.8, -0.2, -0.6});
            return towards(center, normalize(look + random.in_box({-0.8, -0.8, -0.8}, {0.8, 0.8, 0.8})));
        }
        return towards(eye, normalize(random.in_box(box_.lower, box_.upper) - eye));
    }
    Ray shadow(AddressedRandom& random) const
    {
        const Place a = place(random), b = place(random);
        const Vec3d way = b.at - a.at;
        const double distance = length(way);
        if (!(distance > 0)) return from(a, a.normal);
        Ray ray = from(a, way / distance);
        ray.t_max = static_cast<float>(distance * (1 - 1e-4));
        return ray;
    }
    Ray bounce(AddressedRandom& random) const
    {
        const Place p = place(random);
        return from(p, normalize(p.normal * (random.below(2) ? 1.0 : -1.0) + random.direction()));
    }
    // Through a corner or an edge, parallel to an axis with zeros of both signs, from a side of the box, from afar.
    Ray hard(AddressedRandom& random) const
    {
        const auto v = triangle(random, placed(random));
        const uint32_t k = random.below(3), what = random.below(5);
        Vec3d org = anywhere(random);
        if (what == 0) return towards(org, normalize(v[k] - org));
        if (what == 1) {
            const Vec3d on_edge = v[k] + (v[(k + 1) % 3] - v[k]) * random.uniform();
            return towards(org, normalize(on_edge - org));
        }
        if (what == 2) {
            const Vec3d center = box_.center(), d = random.direction() * (100 * box_.radius());
            return towards(center - d, normalize(random.in_box(box_.lower, box_.upper) - (center - d)));
        }
        const double zero[] = {0.0, -0.0};
        const uint32_t axis = random.below(3);
        const double along = random.below(2) ? 1 : -1;
        const auto component = [&](uint32_t i) {
            const double z = zero[random.below(2)];
            return i == axis ? along : z;
        };
        const double x = component(0), y = component(1);
        const Vec3d dir{x, y, component(2)};
        const bool on_corner = random.below(2);
        const auto start = [&](uint32_t i) {
            const auto c = static_cast<int>(i);
            if (what == 4) return i == k ? box_.lower[c] : org[c];
            return i == axis || !on_corner ? org[c] : v[k][c];
        };
        return towards({start(0), start(1), start(2)}, dir);
    }

    const Geometry& g_;
    uint64_t seed_;
    std::vector<Placed> placed_;
    Bounds box_;
};

}  // namespace lancer
