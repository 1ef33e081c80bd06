// Rough metal, for one point and for several with the same bits: GGX microfacets of a conductor, Walter et al.,
// "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007. Multiple scattering is lost, or compensated by
// the lobe of Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses.
#pragma once

#include "materials/albedo_table.h"
#include "materials/fresnel.h"
#include "materials/microfacet.h"

namespace lancer {

// A complex index of refraction per channel.
struct Conductor {
    Color eta, k;
    Color normal, mean;  // its reflectance at normal incidence, and its cosine-weighted mean

    Color reflectance(double cos) const { return conductor_reflectance(eta, k, cos); }
};
// eta, k: finite, >= 0.
inline Conductor make_conductor(Color eta, Color k)
{
    Conductor c{.eta = eta, .k = k, .normal = {}, .mean = {}};
    c.normal = c.reflectance(1);
    const auto mean = [](float n, float absorption) {
        return static_cast<float>(cosine_mean([=](double cos) {
            return fresnel_conductor(cos, static_cast<double>(n), static_cast<double>(absorption));
        }));
    };
    c.mean = {mean(eta.r, k.r), mean(eta.g, k.g), mean(eta.b, k.b)};
    return c;
}

// What a facet reflects: F0 by Schlick's approximation, or the tint of a conductor.
template <class T>
struct MetalReflectanceT;
template <>
struct MetalReflectanceT<float> {
    Color color{};
    const Conductor* conductor = nullptr;

    Color operator()(double cos) const
    {
        return conductor ? color * conductor->reflectance(cos) : fresnel_schlick(color, cos);
    }
};
template <>
struct MetalReflectanceT<Float4> {
    Vec3T<Float4> color{}, eta{}, k{};
    Mask4f is_conductor{};

    void set(size_t i, const MetalReflectanceT<float>& one)
    {
        set_lane(color, i, one.color);
        is_conductor[i] = one.conductor ? -1 : 0;
        if (one.conductor) set_lane(eta, i, one.conductor->eta), set_lane(k, i, one.conductor->k);
    }
    Vec3T<Float4> operator()(Double4 cos) const
    {
        if (!any_lane(is_conductor)) return fresnel_schlick(color, cos);
        return select(is_conductor, product(color, conductor_reflectance(eta, k, cos)), fresnel_schlick(color, cos));
    }
};

// Above the surface; directions are local and unit.
template <class T>
struct RoughMetalT {
    using Double = decltype(to_double(T{}));
    using Value = BsdfValueT<SpectrumOf<T>, T>;

    MetalReflectanceT<T> fresnel{};
    T alpha{};                                 // > 0
    AlbedoTable::EvenLobeT<T> compensation{};  // of multiple scattering, if any
    SpectrumOf<T> multiple{};                  // its light, relative to what single scattering loses
    T mean{};                                  // the largest mean reflectance of a channel

    // Part of the light from this cosine that single scattering loses.
    T missing(T cos) const { return compensation.loss(cos); }
    T chance_of_multiple(T missing_o) const { return chance_of_even_lobe(missing_o, largest(multiple), mean); }
    // o: wo in double, unit; missing_o: of wo. wo.z, wi.z > 0.
    Value eval(const Vec3T<Double>& o, const Vec3T<T>& wi, T missing_o) const
    {
        const auto facets = eval_facets(GgxT<Double>{to_double(alpha)}, o, unit_in_double(wi));
        Value f{fresnel(facets.cos_h) * to_float(facets.f_cos), to_float(facets.pdf)};
        if (!compensation) return f;
        const auto comes_back = compensation.mean() > 0.0f;
        const T lobe = missing_o * missing(wi.z) / compensation.mean() * wi.z * (1 / pi);
        f.f_cos += multiple * select(comes_back, lobe, T{});
        f.pdf += chance_of_multiple(missing_o) * (compensation.pdf(wi.z) - f.pdf);
        return f;
    }
};
using RoughMetal = RoughMetalT<float>;

// Of four points.
struct RoughMetal4 : RoughMetalT<Float4> {
    void set(size_t i, const RoughMetal& one)
    {
        fresnel.set(i, one.fresnel), compensation.set(i, one.compensation);
        alpha[i] = one.alpha, mean[i] = one.mean;
        set_lane(multiple, i, one.multiple);
    }
};

}  // namespace lancer
