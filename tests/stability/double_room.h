// A renderer of rooms of spheres that shares nothing with the product: double throughout, a loop over all spheres, the
// C library's random numbers, no light sampling and no roulette. Diffuse surfaces, seen from outside their spheres.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/vec.h"
#include "support/statistics/significance.h"

namespace lancer::stability {

class DoubleRoom {
public:
    struct Ball {
        Vec3d center;
        double radius, albedo, emission;
    };

    explicit DoubleRoom(std::vector<Ball> balls, uint64_t seed) : balls_(std::move(balls)), engine_(salted(seed)) {}

    // Radiance along a ray by one path of at most `vertices` vertices that scatter.
    double sample(Vec3d org, Vec3d dir, uint32_t vertices)
    {
        double radiance = 0, throughput = 1;
        size_t last = balls_.size();
        for (uint32_t i = 0; i <= vertices; ++i) {
            double nearest = INFINITY;
            size_t hit = balls_.size();
            for (size_t k = 0; k < balls_.size(); ++k) {
                if (k == last) continue;  // convex: no ray that leaves a ball meets it again
                const Vec3d o = org - balls_[k].center;
                const double b = -dot(o, dir), c = dot(o, o) - balls_[k].radius * balls_[k].radius;
                const double discriminant = b * b - c;
                if (!(discriminant >= 0) || b <= 0) continue;
                const double t = c / (b + std::sqrt(discriminant));
                if (t > 0 && t < nearest) nearest = t, hit = k;
            }
            if (hit == balls_.size()) return radiance;
            radiance += throughput * balls_[hit].emission;
            throughput *= balls_[hit].albedo;
            org = org + dir * nearest;
            dir = around(normalize(org - balls_[hit].center));
            last = hit;
        }
        return radiance;
    }
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(engine_); }

private:
    // With the density of the cosine: a point of the unit sphere on top of the normal.
    Vec3d around(Vec3d n)
    {
        for (;;) {
            const double x = 2 * uniform() - 1, y = 2 * uniform() - 1, z = 2 * uniform() - 1;
            const double d = x * x + y * y + z * z;
            if (d > 1 || d == 0) continue;
            return normalize(n + Vec3d{x, y, z} * (1 / std::sqrt(d)));
        }
    }

    std::vector<Ball> balls_;
    std::mt19937_64 engine_;
};

}  // namespace lancer::stability
