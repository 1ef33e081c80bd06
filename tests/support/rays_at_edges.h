// Rays from inside a closed mesh that look for gaps between its triangles, by address: random ones, at edges, at
// corners, and parallel to the axes with zeros of both signs, on coordinates of corners where that is possible. Woop,
// Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, tests so.
#pragma once

#include <string_view>

#include "core/ray.h"
#include "support/closed_mesh.h"

namespace lancer {

enum class Aim { random, edge, vertex, axis };
inline constexpr std::array aims{Aim::random, Aim::edge, Aim::vertex, Aim::axis};
inline constexpr std::string_view name_of(Aim aim)
{
    constexpr std::string_view names[] = {"random", "edge", "vertex", "axis"};
    return names[static_cast<size_t>(aim)];
}

class RaysFromInside {
public:
    // balls: at least one; see balls_inside(). The mesh must outlive this.
    RaysFromInside(const Mesh& mesh, std::vector<Ball> balls, uint64_t seed = 1)
        : mesh_(mesh), balls_(std::move(balls)), seed_(seed)
    {
        // Corners that a line parallel to an axis through a ball runs into.
        for (const Ball& ball : balls_)
            for (int axis = 0; axis < 3; ++axis) {
                std::vector<uint32_t> above;
                for (uint32_t i = 0; i + 1 < mesh.positions.size() && above.size() < 4096; ++i) {
                    Vec3d d = to_double(mesh.positions[i]) - ball.center;
                    d = with(d, axis, 0.0);
                    if (length(d) < ball.radius) above.push_back(i);
                }
                in_line_.push_back(std::move(above));
            }
    }

    Ray ray(Aim aim, uint64_t index) const
    {
        AddressedRandom random(seed_ + 1000 * static_cast<uint64_t>(aim), index);
        const uint32_t b = random.below(static_cast<uint32_t>(balls_.size()));
        const Ball& ball = balls_[b];
        // In its inner half, so that rounding leaves it inside.
        const Vec3d shift = random.direction() * (ball.radius * 0.5 * random.uniform());
        const Vec3 org = to_float(random.below(8) ? ball.center + shift : ball.center);
        const auto at = [&](Vec3d target) -> Ray {
            return {.org = org, .dir = to_float(normalize(target - to_double(org)))};
        };
        if (aim == Aim::random) return {.org = org, .dir = to_float(random.direction())};
        if (aim == Aim::axis) return along_axis(random, b, org);
        const auto& t = mesh_.triangles[random.below(static_cast<uint32_t>(mesh_.triangles.size()))];
        const uint32_t k = random.below(3);
        const Vec3d p = to_double(mesh_.positions[t[k]]), q = to_double(mesh_.positions[t[(k + 1) % 3]]);
        if (aim == Aim::vertex) return at(p);
        // Not where float takes it for the corner.
        const double s = random.below(2) ? 0.5 : random.uniform(1e-4, 1 - 1e-4);
        return at(p + (q - p) * s);
    }

private:
    template <class T>
    static Vec3T<T> with(Vec3T<T> v, int axis, T value)
    {
        (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
        return v;
    }
    Ray along_axis(AddressedRandom& random, uint32_t ball, Vec3 org) const
    {
        const auto axis = static_cast<int>(random.below(3));
        const auto zero = [&] { return random.below(2) ? 0.0f : -0.0f; };
        const float x = zero(), y = zero();
        const Vec3 dir = with(Vec3{x, y, zero()}, axis, random.below(2) ? 1.0f : -1.0f);
        const std::vector<uint32_t>& above = in_line_[3 * ball + static_cast<uint32_t>(axis)];
        if (!above.empty() && random.below(4)) {
            const Vec3 corner = mesh_.positions[above[random.below(static_cast<uint32_t>(above.size()))]];
            org = with(corner, axis, org[axis]);
        }
        return {.org = org, .dir = dir};
    }

    const Mesh& mesh_;
    std::vector<Ball> balls_;
    uint64_t seed_;
    std::vector<std::vector<uint32_t>> in_line_;  // of each ball and axis
};

}  // namespace lancer
