// The two lobes of plastic (materials/plastic.h) without their colours, for one point and for several with the same
// bits.
#pragma once

#include "materials/albedo_table.h"
#include "materials/fresnel.h"
#include "materials/microfacet.h"

namespace lancer {

// T: float or a vector of them. Facets: AlbedoTable::Row of the coat, one per lane; unused where alpha is 0.
template <class T, class Facets>
struct PlasticCoat {
    using D = decltype(to_double(T{}));
    T eta, alpha, mean_through;  // mean_through: 1 - hemispherical albedo
    Facets facets;

    // Data that depends on wo only.
    struct Seen {
        T through;    // transmittance of the coat
        T choice;     // probability of sampling the coat
        Vec3T<D> wo;  // unit
    };
    // Factors of the two colours in f cos, and the density.
    struct Value {
        T base, coat, pdf;
    };

    // 1 - E
    T through(T cos) const
    {
        const D c = to_double(smaller(T{} + 1.0f, cos));
        const T smooth = to_float(fresnel_dielectric_double(c, (1.0 - c) * (1.0 + c), to_double(eta)).reflectance);
        const T whole = whole_of_coat(smooth, eta, alpha);
        return 1.0f - whole + whole * loss_of(facets, cos);
    }
    // wo: z > 0. specular, base: largest components of the colours. Lobes are selected by the light that they reflect.
    Seen seen(const Vec3T<T>& wo, T specular, T base) const
    {
        const T through_o = through(wo.z);
        const T by_coat = specular * (1.0f - through_o), by_base = base * through_o * mean_through;
        return {through_o, select(by_coat > 0.0f, by_coat / (by_coat + by_base), T{}), unit_in_double(wo)};
    }
    // The factor of the base alone. wi: z > 0.
    T eval_base(const Seen& o, const Vec3T<T>& wi) const
    {
        return o.through * through(wi.z) * pdf_cosine_hemisphere(wi.z);
    }
    // Value and density without a delta lobe. wi: z > 0.
    Value eval(const Seen& o, const Vec3T<T>& wi) const
    {
        const Value smooth{eval_base(o, wi), T{}, (1.0f - o.choice) * pdf_cosine_hemisphere(wi.z)};
        const auto is_rough = alpha > 0.0f;
        if (movemask(is_rough) == 0) return smooth;
        const auto f = eval_facets(GgxT<D>{to_double(alpha)}, o.wo, unit_in_double(wi));
        const D c = to_double(to_float(f.cos_h));
        const T reflected = to_float(fresnel_dielectric_double(c, (1.0 - c) * (1.0 + c), to_double(eta)).reflectance);
        return {smooth.base, select(is_rough, reflected * to_float(f.f_cos), T{}),
                select(is_rough, smooth.pdf + o.choice * to_float(f.pdf), smooth.pdf)};
    }
};

}  // namespace lancer
