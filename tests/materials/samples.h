// Parameter sets of every material, for the laws. One without sets of its own here has its defaults, and each of its
// parameters at the ends of its range.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "materials/material.h"
#include "scene/build/material_builder.h"
#include "scene/description/material.h"
#include "scene/description/presets.h"
#include "support/random.h"

namespace lancer {

template <class M>
struct Sample {
    std::string name;
    M material;
    bool lossless = false;   // albedo 1 in every direction
    bool transmits = false;  // light may go through
    double tolerance = 0;    // of the albedo, where tables take part in it
    bool narrow = false;     // has a smooth lobe too narrow for the cells of the laws; lobes_test looks at it closely
    bool sheds = false;      // loses what a lobe sends below the horizon, however little that is
    bool one_way = false;    // scales what is below a layer by what that lets through as seen from wo alone
    bool uneven = false;     // its diffuse part depends on the azimuth
};

template <class M>
std::vector<Sample<M>> samples()
{
    std::vector<Sample<M>> all;
    const auto add = [&](const std::string& name, const MaterialDescription& d) {
        const Material made = MaterialBuilder({}).make(d, [](const TextureUse&) { return no_texture; });
        all.push_back({name, std::get<M>(made), false, has_parameter(M::type, "absorption")});
    };
    add("default", default_description(M::type));
    const auto add_with = [&](const auto& row, const std::string& name, const auto& value) {
        MaterialDescription d = default_description(M::type);
        row.value_of(d) = value;
        add(std::string(row.key) + " " + name, d);
    };
    for_each_material_parameter([&](const auto& row) {
        if (index_of_key(M::parameters, row.key) == std::tuple_size_v<decltype(M::parameters)>) return;
        using Field = std::remove_cvref_t<decltype(row.value_of(std::declval<MaterialDescription&>()))>;
        const float most = row.range == ParameterRange::unit ? 1 : 4;
        for (const float x : {row.range == ParameterRange::positive ? 0.25f : 0, most / 2, most})
            if constexpr (std::is_same_v<Field, float>)
                add_with(row, std::to_string(x), x);
            else if constexpr (std::is_same_v<Field, Color>)
                add_with(row, std::to_string(x), Color{x, x / 2, x / 4});
    });
    return all;
}

template <>
inline std::vector<Sample<Lambert>> samples<Lambert>()
{
    return {{"white", {{1, 1, 1}}, true}, {"coloured", {{0.8f, 0.3f, 0.05f}}}, {"black", {{0, 0, 0}}}};
}
template <>
inline std::vector<Sample<Translucent>> samples<Translucent>()
{
    return {{"white", {{0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}}, true, true},
            {"white of two hues", {{1, 0.25f, 0.5f}, {0, 0.75f, 0.5f}}, true, true},
            {"white by scaling", {{1, 1, 1}, {0.6f, 0.6f, 0.6f}}, true, true},
            {"coloured", {{0.5f, 0.3f, 0.05f}, {0.1f, 0.6f, 0.3f}}, false, true},
            {"of too much light", {{1, 0.5f, 0.2f}, {0.6f, 1, 0.1f}}, false, true},
            {"that lets nothing through", {{0.8f, 0.3f, 0.05f}, {0, 0, 0}}},
            {"that reflects nothing", {{0, 0, 0}, {0.8f, 0.3f, 0.05f}}, false, true},
            {"that hardly reflects", {{1e-6f, 1e-6f, 1e-6f}, {0.8f, 0.3f, 0.05f}}, false, true},
            {"black", {{0, 0, 0}, {0, 0, 0}}}};
}
template <>
inline std::vector<Sample<Mirror>> samples<Mirror>()
{
    return {{"white", {{1, 1, 1}}, true}, {"gold", {{0.9f, 0.7f, 0.2f}}}};
}
// What the tables of albedos promise.
inline constexpr double table_error = 0.005;

// Rough glass whose facets lose nothing.
Glass make_glass(Color tint, float ior, float roughness, bool thin = false);
template <>
inline std::vector<Sample<Glass>> samples<Glass>()
{
    const Color white{1, 1, 1};
    return {{"crown", {white, 1.5f}, true, true},
            {"air bubble", {white, 1 / 1.33f}, true, true},
            {"nothing", {white, 1}, true, true},
            {"almost nothing", {white, 1.0001f}, true, true},
            {"diamond", {white, 2.42f}, true, true},
            {"germanium", {white, 4}, true, true},
            {"green", {{0.2f, 0.9f, 0.4f}, 1.6f}, false, true},
            {"frosted", make_glass(white, 1.5f, 0.8f), true, true, table_error},
            {"ground white", make_glass(white, 1.1f, 1), true, true, table_error},
            {"ground diamond", make_glass(white, 2.5f, 1), true, true, table_error},
            {"frosted coloured", make_glass({0.2f, 0.9f, 0.4f}, 1.8f, 1), false, true, table_error},
            {"white frosted bubble", make_glass(white, 1 / 1.33f, 0.7f), true, true, table_error},
            {"white ground bubble", make_glass(white, 0.4f, 1), true, true, table_error},
            {"frosted, single scattering", {white, 1.5f, 0.8f}, false, true},
            {"ground", {{0.2f, 0.9f, 0.4f}, 1.8f, 1}, false, true},
            {"frosted bubble", {white, 1 / 1.33f, 0.7f}, false, true},
            {"frosted nothing", {white, 1, 0.7f}, true, true},
            {"hardly frosted", {white, 1.5f, 0.05f}, false, true, 0, true},
            {"least frosted", {white, 1.5f, 0.004f}, false, true, 0, true},
            {"pane", {white, 1.5f, 0, true, true}, true, true},
            {"pane of air", {white, 1 / 1.33f, 0, true, true}, true, true},
            {"pane of nothing", {white, 1, 0, true, true}, true, true},
            {"green pane", {{0.2f, 0.9f, 0.4f}, 1.6f, 0, true, true}, false, true},
            {"white frosted pane", make_glass(white, 1.5f, 0.8f, true), true, true, table_error},
            {"white ground pane", make_glass(white, 2.42f, 1, true), true, true, table_error},
            {"white frosted pane of air", make_glass(white, 0.6f, 0.7f, true), true, true, table_error},
            {"frosted coloured pane", make_glass({0.2f, 0.9f, 0.4f}, 1.5f, 0.8f, true), false, true, table_error},
            {"frosted pane, single scattering", {white, 1.5f, 0.8f, true, true}, false, true},
            {"ground green pane", {{0.2f, 0.9f, 0.4f}, 1.8f, 1, true, true}, false, true},
            {"pane of ground diamond", {white, 2.42f, 1, true, true}, false, true},
            {"hardly frosted pane", {white, 1.5f, 0.05f, true, true}, false, true, 0, true}};
}

// Measured, of gold.
inline Conductor gold() { return make_conductor({0.143f, 0.375f, 1.442f}, {3.983f, 2.386f, 1.603f}); }

// Answers for every roughness of a metal.
std::shared_ptr<const AlbedoTable> table_of_reflectors();
template <>
inline std::vector<Sample<Metal>> samples<Metal>()
{
    const Color white{1, 1, 1}, copper{0.95f, 0.64f, 0.54f};
    const auto table = table_of_reflectors();
    return {{"white mirror", {white, 0}, true},
            {"white", {white, 1}},
            {"white compensated", {white, 1, {}, table}, true, false, table_error},
            {"white compensated half", {white, 0.7f, {}, table}, true, false, table_error},
            {"white compensated fine", {white, 0.1f, {}, table}, true, false, table_error, true},
            {"copper", {copper, 0.6f}},
            {"copper compensated", {copper, 0.8f, {}, table}, false, false, table_error},
            {"gold", {white, 0.7f, gold()}},
            {"gold compensated", {white, 1, gold(), table}, false, false, table_error},
            {"gold mirror", {{0.9f, 1, 0.8f}, 0, gold()}},
            {"black", {{0, 0, 0}, 0.8f}},
            {"black gold compensated", {{0, 0, 0}, 0.8f, gold(), table}},
            {"hardly rough", {copper, 0.05f}, false, false, 0, true},
            {"least rough", {copper, 0.004f}, false, false, 0, true}};
}

Plastic make_plastic(Color base, float roughness, float ior, Color specular = {1, 1, 1});
template <>
inline std::vector<Sample<Plastic>> samples<Plastic>()
{
    const Color white{1, 1, 1}, red{0.8f, 0.1f, 0.05f};
    static const std::vector<Sample<Plastic>> all{
        {"white smooth", make_plastic(white, 0, 1.5f), true, false, 1e-5},
        {"white diamond", make_plastic(white, 0, 2.42f), true, false, 1e-5},
        {"white", make_plastic(white, 0.7f, 1.5f), true, false, table_error},
        {"white roughest", make_plastic(white, 1, 2), true, false, table_error},
        {"white fine", make_plastic(white, 0.1f, 1.5f), true, false, table_error, true},
        {"red smooth", make_plastic(red, 0, 1.5f)},
        {"red", make_plastic(red, 0.6f, 1.4f, {0.5f, 0.6f, 1}), false, false, table_error},
        {"red bubble", make_plastic(red, 0.8f, 0.75f), false, false, table_error},
        {"white bubble", make_plastic(white, 0.6f, 0.6f), true, false, table_error},
        {"without a coat", make_plastic(red, 0.8f, 1)},
        {"coat alone", make_plastic({0, 0, 0}, 0.8f, 1.5f), false, false, table_error},
        {"smooth coat alone", make_plastic({0, 0, 0}, 0, 1.5f)},
        {"base alone", make_plastic(red, 0.8f, 1.5f, {0, 0, 0}), false, false, table_error},
        {"nothing", make_plastic({0, 0, 0}, 0.8f, 1.5f, {0, 0, 0})},
        {"least rough", make_plastic(red, 0.004f, 1.5f), false, false, table_error, true}};
    return all;
}

// Tables included. change: of a white one.
Principled make_principled(const std::function<void(MaterialDescription&)>& change);
template <>
std::vector<Sample<Principled>> samples<Principled>();

template <>
inline std::vector<Sample<Interface>> samples<Interface>()
{
    const Color white{1, 1, 1}, red{0.8f, 0.1f, 0.05f}, grey{0.5f, 0.5f, 0.5f};
    const Phong mirror{.specular = white, .diffusion = 0, .reflexion = 1};
    const Phong glass{.specular = white, .diffusion = 0, .refraction = 1, .inside_ior = 1.5f};
    const auto with = [](Phong p, const auto& change) {
        change(p);
        return p;
    };
    const auto highlight = [&](float shininess) {
        return Phong{.specular = white, .shininess = shininess, .diffusion = 0.6f};
    };
    std::vector<Sample<Interface>> all{
        {"white", {white, {}}, true},
        {"red", {red, {}}},
        {"black", {{0, 0, 0}, {}}},
        {"white mirror", {white, mirror}, true},
        {"white glass", {white, glass}, true, true},
        {"bubble", {white, with(glass, [](Phong& p) { std::swap(p.inside_ior, p.outside_ior); })}, true, true},
        {"index one", {white, with(glass, [](Phong& p) { p.inside_ior = 1; })}, true, true},
        {"green glass in water",
         {{0.2f, 0.9f, 0.4f}, with(glass, [](Phong& p) { p.outside_ior = 1.33f; })},
         false,
         true},
        {"glass without a mirror", {white, with(glass, [](Phong& p) { p.specular = {}; })}, false, true},
        {"mirror without glass", {{0, 0, 0}, glass}},
        {"frosted", {red, {white, red, grey, 20, 0.3f, 0.1f, 0.4f, 1.5f, 1}}, false, true},
        {"highlight of exponent 0", {red, highlight(0)}},
        {"highlight of exponent 0.5", {red, highlight(0.5f)}},
        {"highlight alone", {{0, 0, 0}, highlight(10)}},
        {"highlight of exponent 1e4", {red, highlight(1e4f)}, false, false, 0, true},
        {"highlight of exponent 1e6", {red, highlight(1e6f)}, false, false, 0, true},
        {"narrowest highlight", {red, highlight(3e38f)}, false, false, 0, true}};
    for (const std::string_view name : names_of_presets()) {
        const MaterialDescription m = *find_preset(name);
        all.push_back({std::string(name), {m.base_color, m.phong}, false, m.phong.refraction > 0});
    }
    for (Sample<Interface>& s : all) s.sheds = s.material.rest.diffusion > 0 && !is_black(s.material.rest.specular);
    return all;
}

// Index beyond the surface over index before it, of what lets light through.
template <class B>
float eta_through(const B& bsdf)
{
    if constexpr (requires { bsdf.index_beyond(); }) return bsdf.index_beyond();
    if constexpr (requires { bsdf.thin; })
        if (bsdf.thin) return 1;
    if constexpr (requires { bsdf.eta; })
        return static_cast<float>(bsdf.eta);
    else
        return 1;
}

// The first argument of eval() and sample(): what depends on wo alone, where the BSDF computes that apart, or wo.
template <class B>
auto seen(const B& bsdf, Vec3 wo)
{
    if constexpr (requires { bsdf.seen_from(wo); })
        return bsdf.seen_from(wo);
    else
        return wo;
}

// Roughness of its facets, where that is told.
template <class B>
float alpha_of(const B& bsdf)
{
    if constexpr (requires { bsdf.alpha.along; })
        return bsdf.alpha.along;
    else if constexpr (requires { bsdf.alpha; })
        return bsdf.alpha;
    else
        return 1;
}

struct Place {
    std::string name;
    ShadingPoint point;
    Vec3 wo;
};

// Both sides, from above to grazing.
std::vector<Place> places();

template <class M>
using BsdfOf = decltype(std::declval<M>().at(ShadingPoint{}));

// f(name, sample, place, bsdf) for every parameter set seen from everywhere.
template <class M, class F>
void for_each_bsdf(const F& f)
{
    for (const Sample<M>& s : samples<M>())
        for (const Place& p : places())
            f(std::string(name_of(M::type)) + " " + s.name + ", " + p.name, s, p, s.material.at(p.point));
}

// u and v of the extremes of their range, and in between.
template <class F>
void for_each_extreme_number(const F& f)
{
    constexpr float last = 1 - 0x1p-24f;
    for (const float u : {0.0f, 0x1p-24f, 0.04f, 0.5f, last})
        for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, last})
            for (const float y : {0.0f, 0x1p-24f, 0.125f, 0.5f, 0.75f, last}) f(u, Vec2{x, y});
}

}  // namespace lancer
