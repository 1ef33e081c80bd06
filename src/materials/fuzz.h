// Fuzz: the light that short fibres upright on a surface scatter, as on velvet or dust. The distribution of their
// normals is that of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 courses, with the
// visibility of Neubelt and Pettineo, "Crafting a Next-Gen Material Pipeline for The Order: 1886", SIGGRAPH 2013
// courses. Its albedo, by which what is below gets less light, is a table that is computed here.
#pragma once

#include <array>
#include <cstdint>

#include "core/elementary.h"
#include "core/lanes/vec.h"
#include "materials/albedo_nodes.h"

namespace lancer {

// T: float, or a vector of them.
template <class T>
struct FuzzT {
    T roughness;  // perceptual, in [0, 1]

    // f, without a colour and before the scale of the table. Both directions unit, z > 0.
    T eval(const Vec3T<T>& wo, const Vec3T<T>& wi) const
    {
        const Vec3T<T> sum = wo + wi;
        const T flat2 = (sum.x * sum.x + sum.y * sum.y) / dot(sum, sum);  // squared sine of the half vector
        const T exponent = 1.0f / alpha(), density = (2.0f + exponent) * (1 / (2 * pi));
        return density * power(smaller(T{} + 1.0f, flat2), 0.5f * exponent) /
               larger(T{} + 1e-7f, 4.0f * (wo.z + wi.z - wo.z * wi.z));
    }
    // The exponent of the sine is 1 / alpha. The smoothest fuzz has fibres that all but stand upright.
    T alpha() const { return larger(T{} + least_root * least_root, roughness * roughness); }
    static constexpr float least_root = 0.26f;
};
using Fuzz = FuzzT<float>;

// The albedo by cosine and roughness, and the factor that keeps it at 1 or below: seen along the surface, smooth fuzz
// would scatter more light than comes. Computed by a fixed quadrature, so that the bits are always the same.
class FuzzTable {
public:
    // From now on row() answers for this roughness, in [0, 1], or for every one: 2 ms and 25 ms. The bits do not depend
    // on what else was needed.
    void need(float roughness);
    void need_all();

    // Of one roughness; default-constructed: no fuzz. The table must outlive it.
    class Row {
    public:
        float scale() const { return scale_; }
        // Of the scaled fuzz. cos: in [0, 1].
        float albedo(float cos) const
        {
            const NodeCell c = root_cell(cos, cosines);
            return scaled(table_square(albedos_ + c.index, cosines).at(c.part, part_), scale_);
        }
        // Four rows, each at its own cosine.
        static Float4 albedo(const std::array<Row, 4>& four, Float4 cos)
        {
            const NodeCellT<Float4> c = root_cell(cos, cosines);
            const auto at = [&](size_t i) { return four[i].albedos_ + c.index[i]; };
            const auto each = [&](float Row::*of) {
                return Float4{four[0].*of, four[1].*of, four[2].*of, four[3].*of};
            };
            const auto square = table_square(std::array{at(0), at(1), at(2), at(3)}, cosines);
            return scaled(square.at(c.part, each(&Row::part_)), each(&Row::scale_));
        }

    private:
        friend FuzzTable;
        template <class T>
        static T scaled(T albedo, T scale)
        {
            return smaller(T{} + 1.0f, scale * albedo);
        }
        static constexpr uint32_t cosines = 33;
        static constexpr std::array<float, 2 * cosines> none{};

        const float* albedos_ = none.data();  // of two roughnesses, one behind the other
        float part_ = 0, scale_ = 0;          // weight of the second; of Fuzz::eval()
    };
    Row row(float roughness) const;

private:
    static constexpr uint32_t cosines = Row::cosines, rows = 25;
    void fill_row(uint32_t row);
    static NodeCell cell(float roughness)
    {
        return even_cell((roughness - Fuzz::least_root) / (1 - Fuzz::least_root), rows);
    }
    std::array<float, rows * cosines> albedo_{};  // row by row, at even steps of the root of the cosine
    std::array<float, rows> scale_{};
    std::array<bool, rows> is_filled_{};
};

inline float albedo_of(const FuzzTable::Row& row, float cos) { return row.albedo(cos); }
inline Float4 albedo_of(const std::array<FuzzTable::Row, 4>& rows, Float4 cos)
{
    return FuzzTable::Row::albedo(rows, cos);
}

}  // namespace lancer
