#include "materials/fuzz.h"

#include <algorithm>
#include <utility>

#include "core/color.h"

namespace lancer {

void FuzzTable::fill_row(uint32_t r)
{
    if (std::exchange(is_filled_[r], true)) return;
    // Midpoints; half of the azimuths, by symmetry.
    constexpr int heights = 64, azimuths = 32;
    std::array<Vec2, azimuths> around;
    for (int a = 0; a < azimuths; ++a) {
        const float phi = pi * (static_cast<float>(a) + 0.5f) / azimuths;
        around[static_cast<size_t>(a)] = {std::cos(phi), std::sin(phi)};
    }
    const Fuzz fuzz{mix(Fuzz::least_root, 1.0f, static_cast<float>(r) / (rows - 1))};
    for (uint32_t c = 0; c < cosines; ++c) {
        const float root = std::max(2e-3f, static_cast<float>(c) / (cosines - 1)), z = root * root;
        const Vec3 wo{std::sqrt(std::max(0.0f, (1 - z) * (1 + z))), 0, z};
        double sum = 0;
        for (int i = 0; i < heights; ++i) {
            // By even steps of the square root of the cosine: the value has a peak at grazing angles.
            const float s = (static_cast<float>(i) + 0.5f) / heights, cos = s * s;
            const float flat = std::sqrt((1 - cos) * (1 + cos));
            for (const Vec2 at : around)
                sum += static_cast<double>(fuzz.eval(wo, {flat * at.x, flat * at.y, cos}) * cos * 2 * s);
        }
        albedo_[r * cosines + c] = static_cast<float>(sum * 2 * pi_d / (heights * azimuths));
    }
    const auto first = albedo_.begin() + r * cosines;
    scale_[r] = 1 / std::max(1.0f, *std::max_element(first, first + cosines));
}

void FuzzTable::need(float roughness)
{
    const uint32_t first = cell(roughness).index;
    fill_row(first);
    fill_row(first + 1);
}

void FuzzTable::need_all()
{
    for (uint32_t r = 0; r < rows; ++r) fill_row(r);
}

FuzzTable::Row FuzzTable::row(float roughness) const
{
    const NodeCell c = cell(roughness);
    Row row;
    row.albedos_ = &albedo_[c.index * cosines], row.part_ = c.part;
    row.scale_ = scale_[c.index] + c.part * (scale_[c.index + 1] - scale_[c.index]);
    return row;
}

}  // namespace lancer
