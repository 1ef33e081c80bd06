// Fuzz: the light that short fibres upright on a surface scatter, as on velvet or dust. The distribution of their
// normals is that of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 courses, with the
// visibility of Neubelt and Pettineo, "Crafting a Next-Gen Material Pipeline for The Order: 1886", SIGGRAPH 2013
// courses. Its albedo, by which what is below gets less light, is a table that is computed here.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/vec.h"

namespace lancer {

struct Fuzz {
    float roughness;  // perceptual, in [0, 1]

    // f, without a colour and before scale(). Both directions unit, z > 0.
    float eval(Vec3 wo, Vec3 wi) const
    {
        const Vec3 sum = wo + wi;
        const float flat2 = (sum.x * sum.x + sum.y * sum.y) / dot(sum, sum);  // squared sine of the half vector
        const float exponent = 1 / alpha(), density = (2 + exponent) * (1 / (2 * pi));
        return density * std::pow(std::min(1.0f, flat2), 0.5f * exponent) /
               std::max(1e-7f, 4 * (wo.z + wi.z - wo.z * wi.z));
    }
    // The exponent of the sine is 1 / alpha. The smoothest fuzz has fibres that all but stand upright.
    float alpha() const { return std::max(least_root * least_root, roughness * roughness); }
    static constexpr float least_root = 0.26f;
};

// The albedo by cosine and roughness, and the factor that keeps it at 1 or below: seen along the surface, smooth fuzz
// would scatter more light than comes. Computed by a fixed quadrature, so that the bits are always the same.
class FuzzTable {
public:
    // From now on albedo() and scale() answer for this roughness, in [0, 1], or for every one: 2 ms and 25 ms. The bits
    // do not depend on what else was needed.
    void need(float roughness);
    void need_all();
    // Of the scaled fuzz. cos: in [0, 1].
    float albedo(float cos, Fuzz fuzz) const
    {
        const Cell c = cell(std::sqrt(std::clamp(cos, 0.0f, 1.0f)), cosines), r = row(fuzz);
        const auto at = [&](uint32_t i) {
            const float* a = &albedo_[i * cosines + c.index];
            return a[0] + c.part * (a[1] - a[0]);
        };
        const float low = at(r.index);
        return std::min(1.0f, scale(fuzz) * (low + r.part * (at(r.index + 1) - low)));
    }
    float scale(Fuzz fuzz) const
    {
        const Cell r = row(fuzz);
        return scale_[r.index] + r.part * (scale_[r.index + 1] - scale_[r.index]);
    }

private:
    static constexpr uint32_t cosines = 33, rows = 25;
    struct Cell {
        uint32_t index;
        float part;
    };
    void fill_row(uint32_t row);
    static Cell row(Fuzz fuzz) { return cell((fuzz.roughness - Fuzz::least_root) / (1 - Fuzz::least_root), rows); }
    static Cell cell(float x, uint32_t nodes)
    {
        const float at = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
        const uint32_t index = std::min(static_cast<uint32_t>(at), nodes - 2);
        return {index, at - static_cast<float>(index)};
    }
    std::array<float, rows * cosines> albedo_{};  // row by row, at even steps of the root of the cosine
    std::array<float, rows> scale_{};
    std::array<bool, rows> is_filled_{};
};

}  // namespace lancer
