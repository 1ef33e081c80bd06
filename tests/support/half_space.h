// How a half-space of a medium that scatters evenly, without a boundary of its own, reflects light: Chandrasekhar,
// "Radiative Transfer", 1950, chapter V. In long double.
#pragma once

#include <cmath>
#include <vector>

namespace lancer {

class HalfSpace {
public:
    // albedo: of a single scattering, in [0, 1].
    explicit HalfSpace(double albedo) : albedo_(static_cast<long double>(albedo)), h_(nodes, 1)
    {
        // 1 / H(m) = sqrt(1 - albedo) + albedo / 2 int m' H(m') / (m + m') dm', iterated from 1.
        for (int i = 0; i < 2000; ++i) {
            std::vector<long double> next(nodes);
            long double change = 0;
            for (size_t k = 0; k < nodes; ++k) {
                next[k] = 0.5L * (h_[k] + at(node(k)));
                change = std::max(change, std::abs(next[k] - h_[k]));
            }
            h_ = next;
            if (change < 1e-12L) break;
        }
    }
    // Of a beam at that cosine, and likewise of even light what leaves towards it, as radiance.
    double reflects(double cosine) const
    {
        return static_cast<double>(1 - at(static_cast<long double>(cosine)) * std::sqrt(1 - albedo_));
    }
    double reflects_even_light() const
    {
        long double sum = 0;
        for (size_t k = 0; k < nodes; ++k) sum += 2 * node(k) * (1 - h_[k] * std::sqrt(1 - albedo_)) * weight(k);
        return static_cast<double>(sum);
    }

private:
    // The midpoint rule in x with m = x^2 (3 - 2 x), whose slope is 0 at both ends.
    static constexpr size_t nodes = 200;
    static long double x(size_t k) { return (static_cast<long double>(k) + 0.5L) / nodes; }
    static long double node(size_t k) { return x(k) * x(k) * (3 - 2 * x(k)); }
    static long double weight(size_t k) { return 6 * x(k) * (1 - x(k)) / nodes; }
    long double at(long double cosine) const
    {
        long double sum = 0;
        for (size_t k = 0; k < nodes; ++k) sum += weight(k) * node(k) * h_[k] / (cosine + node(k));
        return 1 / (std::sqrt(1 - albedo_) + 0.5L * albedo_ * sum);
    }

    long double albedo_;
    std::vector<long double> h_;  // H at the nodes
};

}  // namespace lancer
