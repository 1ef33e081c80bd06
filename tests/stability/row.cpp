#include "stability/row.h"

#include <cmath>
#include <limits>

#include "stability/fast_embree.h"

namespace lancer::stability {

bool Measure::passes() const
{
    if (!judged) return true;
    switch (bound) {
        case Bound::at_most:
            return value <= threshold;
        case Bound::at_least:
            return value >= threshold;
        case Bound::exactly:
            return value == threshold;
    }
    return false;
}

double Measure::margin() const
{
    if (bound == Bound::exactly) return passes() ? 1 : 0;
    const double over = bound == Bound::at_most ? value : threshold,
                 under = bound == Bound::at_most ? threshold : value;
    if (over == under) return 1;
    if (over < 0 && under < 0) return over / under;  // both below 0, such as slopes: the further, the better
    return over <= 0 ? std::numeric_limits<double>::infinity() : under / over;
}

std::unique_ptr<Accelerator> Setup::make(const Geometry& geometry) const
{
    if (fast()) return make_fast_embree(geometry);
    return make_accelerator(value_of<AccelKind>(accelerator).value(), geometry, "avx2");
}

std::vector<Row> all_rows()
{
    std::vector<Row> all;
    for (auto* group : {scale_rows, geometry_rows, ray_rows, sphere_rows, surface_rows, light_rows, film_rows,
                        camera_rows, material_rows, shipped_rows})
        for (Row& row : group()) all.push_back(std::move(row));
    return all;
}

}  // namespace lancer::stability
