#include "scene/description/render_options.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <limits>

namespace lancer {
namespace {

using S = RenderSettings;

template <auto member>
constexpr ChoiceField choice()
{
    using E = std::remove_cvref_t<decltype(S{}.*member)>;
    return {.names = enum_names<E>,
            .get = [](const S& s) { return static_cast<size_t>(s.*member); },
            .set = [](S& s, size_t i) { s.*member = static_cast<E>(i); },
            .address = [](const S& s) -> const void* { return &(s.*member); }};
}
constexpr NumberField<uint32_t> count(uint32_t S::*member, uint32_t least, uint32_t most)
{
    return {member, least, most};
}

constexpr uint32_t max_count = std::numeric_limits<int32_t>::max();
constexpr uint64_t max_seed = std::numeric_limits<int64_t>::max();  // what TOML, JSON and EXR can hold

constexpr std::array rows{
    RenderOption{
        .name = "size", .field = SizeField{&S::size}, .help = "width and height of the picture", .unit = "pixels"},
    RenderOption{.name = "spp",
                 .field = count(&S::spp, 1, max_count),
                 .help = "how often each pixel is sampled",
                 .unit = "samples per pixel",
                 .flag = "-s"},
    RenderOption{.name = "seed",
                 .field = NumberField<uint64_t>{&S::seed, 0, max_seed},
                 .help = "seed of the random numbers: another seed gives other noise"},
    RenderOption{.name = "integrator", .field = choice<&S::integrator>(), .help = "how light is computed"},
    RenderOption{.name = "max_depth",
                 .field = count(&S::max_depth, 0, max_count),
                 .help = "longest path: 1 is direct light only, 0 no limit, for whitted and random-decision 7",
                 .unit = "surface vertices",
                 .bias = {.effect = "light that takes more than N surface vertices is missing",
                          .when = "asked for; `whitted` and `random-decision` have 7 unless told otherwise"}},
    RenderOption{.name = "sampler",
                 .field = choice<&S::sampler>(),
                 .help = "where sample points come from: Owen-scrambled Sobol points, or independent ones"},
    RenderOption{.name = "filter", .field = choice<&S::filter>(), .help = "reconstruction filter of the pixels"},
    RenderOption{.name = "accel",
                 .field = choice<&S::accel>(),
                 .help = "ray-intersection backend: Embree, trees of our own, or lists of all primitives; auto is "
                         "list8 for up to 64 triangles, bvh8 for long triangles at an angle and where things "
                         "move, and a million instances, else Embree"},
    RenderOption{
        .name = "isa", .field = choice<&S::isa>(), .help = "instruction set of Embree; others round differently"},
    RenderOption{.name = "nee",
                 .field = SwitchField{&S::nee},
                 .help = "light sampling (next-event estimation): a shadow ray to a light at each vertex"},
    RenderOption{.name = "mis",
                 .field = SwitchField{&S::mis},
                 .help = "multiple importance sampling weighs light sampling against BSDF sampling; off: light "
                         "sampling alone where it is possible"},
    RenderOption{.name = "direct",
                 .field = SwitchField{&S::direct},
                 .help = "light that comes straight from an emitter to the first surface that spreads it",
                 .bias = {.effect = "that light is missing: straight from an emitter to the first surface that spreads "
                                    "it"}},
    RenderOption{
        .name = "indirect",
        .field = SwitchField{&S::indirect},
        .help = "light that such a surface gets by way of other surfaces, mirrors and glass included",
        .bias = {.effect = "that light is missing: by way of other surfaces to the first one that spreads it"}},
    RenderOption{.name = "emitters",
                 .field = SwitchField{&S::emitters},
                 .help = "what the camera sees of emitters and of the environment, also in mirrors and through smooth "
                         "glass",
                 .bias = {.effect = "emitters and the environment are missing where the camera sees them"}},
    RenderOption{.name = "fresnel",
                 .field = SwitchField{&S::fresnel},
                 .help = "smooth glass reflects and refracts; off: it only refracts, but for total internal reflection",
                 .bias = {.effect = "smooth glass only refracts, but for total internal reflection"}},
    RenderOption{.name = "soft_shadows",
                 .field = SwitchField{&S::soft_shadows},
                 .help = "sphere lights have penumbrae; off: they send light as from a point at their centre, with "
                         "the same power (needs nee)",
                 .bias = {.effect = "sphere lights send light as from their centres: no penumbra"}},
    RenderOption{.name = "straight_shadows",
                 .field = SwitchField{&S::straight_shadows},
                 .help = "point and directional lights of path and direct shine straight through bodies of smooth "
                         "glass, which else stop them",
                 .bias = {.effect = "light of points and directions goes straight through smooth glass, tinted and "
                                    "without caustics",
                          .when = "asked for, with `path` or `direct`",
                          .applies = [](const S& s) { return s.straight_shadows && !is_classic(s.integrator); }}},
    RenderOption{.name = "always_nee",
                 .field = SwitchField{&S::always_nee},
                 .help = "light sampling also where BSDF sampling has the same density: on diffuse surfaces under a "
                         "constant environment without other lights"},
    RenderOption{.name = "mis_compensation",
                 .field = SwitchField{&S::mis_compensation},
                 .help = "path and direct sample only what is bright of an environment, above twice its mean, and of a "
                         "constant one beside other lights nothing; BSDF sampling finds the rest (needs nee and mis)"},
    RenderOption{.name = "learned_nee",
                 .field = SwitchField{&S::learned_nee},
                 .help =
                     "path samples lights as often, and of several the one, as a pilot's shadow rays brought light to "
                     "places near by; BSDF sampling finds the rest (needs nee and mis)"},
    RenderOption{.name = "mirror_nee",
                 .field = SwitchField{&S::mirror_nee},
                 .help = "path samples lights also by way of large flat mirrors; without it nothing finds what points "
                         "and directional lights send by way of them (needs nee)"},
    RenderOption{.name = "light_tree",
                 .field = SwitchField{&S::light_tree},
                 .help = "of more than 64 points, spheres and triangles of light one is chosen by what it may send to "
                         "a place; off: by its power"},
    RenderOption{.name = "split",
                 .field = SwitchField{&S::split},
                 .help = "paths of path split into 2 or 4 at the first surface that spreads light, if a pilot finds "
                         "that this pays"},
    RenderOption{.name = "roulette",
                 .field = SwitchField{&S::roulette},
                 .help = "Russian roulette of path goes by the part of the pixel's light that a path may still bring; "
                         "off: by its throughput alone, from the fifth vertex on"},
    RenderOption{.name = "stop",
                 .field = SwitchField{&S::stop},
                 .help = "a pixel ends before it has all its samples if its mean is known well enough",
                 .bias = {.effect = "a pixel ends when a sample is close to the mean so far: it does so by chance, and "
                                    "thin bright things get lost",
                          .when = "asked for, with `legacy` and a classic integrator",
                          .applies = [](const S& s) { return s.stop && s.legacy && is_classic(s.integrator); }}},
    RenderOption{.name = "multiscatter",
                 .field = SwitchField{&S::multiscatter},
                 .help = "rough metal and glass get the light back that single scattering between facets loses",
                 .bias = {.effect = "rough metal and glass lose the light that scatters several times between facets, "
                                    "more with roughness"}},
    RenderOption{.name = "terminator",
                 .field = SwitchField{&S::terminator},
                 .help = "softens the edge of shadow on smoothed coarse meshes",
                 .bias = {.effect = "rays of smoothed meshes start from the rounder shape that their normals promise: "
                                    "near the edge of shadow they get light that the faces themselves would keep "
                                    "away"}},
    RenderOption{.name = "compact",
                 .field = SwitchField{&S::compact},
                 .help = "normals of vertices take 32 bits instead of 96",
                 .bias = {.effect = "normals of vertices are off by up to 0.003 degrees"}},
    RenderOption{.name = "legacy",
                 .field = SwitchField{&S::legacy},
                 .help = "pictures of the two programs that lancer grew from, their faults included",
                 .bias = {.effect = "the ways of two older programs; of `path`: see "
                                    "[scene-format.md](scene-format.md#legacy)"},
                 .flag = "--legacy"},
    RenderOption{.name = "stop_error",
                 .field = NumberField<double>{&S::stop_error, 1e-9, 1e9},
                 .help = "with stop: a pixel ends when the 95 % confidence interval of its mean reaches no further "
                         "than this to either side",
                 .unit = "relative"},
    RenderOption{.name = "replicates",
                 .field = count(&S::replicates, 1, 1024),
                 .help = "independent replicates, to which the samples are dealt: they give the error with an "
                         "interval, and may add noise"},
    RenderOption{
        .name = "texture_limit",
        .field = count(&S::texture_limit, 0, 65536),
        .help = "longest side of the pictures of textures: finer MIP levels are dropped, which saves memory; "
                "0 is no limit",
        .unit = "pixels",
        .bias = {.effect = "pictures of textures have at most N pixels along a side: finer details are averaged"}},
};

// Converts to anything, for count_fields().
struct AnyValue {
    template <class T>
    operator T() const;
};
// How many fields an aggregate has.
template <class T, class... Values>
consteval size_t count_fields()
{
    if constexpr (requires { T{Values{}..., AnyValue{}}; })
        return count_fields<T, Values..., AnyValue>();
    else
        return sizeof...(Values);
}
static_assert(count_fields<S>() == rows.size() + 1, "every field of RenderSettings but `given` has a row");
static_assert(rows.size() <= 64, "RenderSettings::given has a bit for each row");

const void* address_of(const S& s, const OptionField& field)
{
    return std::visit(
        [&]<class Field>(const Field& f) -> const void* {
            if constexpr (std::is_same_v<Field, ChoiceField>)
                return f.address(s);
            else
                return &(s.*f.member);
        },
        field);
}

uint64_t bit_of_row(const RenderOption& option) { return uint64_t{1} << (&option - rows.data()); }

std::string number_text(double x)
{
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

}  // namespace

std::span<const RenderOption> render_options() { return rows; }

const RenderOption& render_option(std::string_view name)
{
    for (const RenderOption& row : rows)
        if (row.name == name) return row;
    std::abort();
}

uint64_t RenderSettings::bit_of(const void* field) const
{
    for (const RenderOption& row : rows)
        if (address_of(*this, row.field) == field) return bit_of_row(row);
    return 0;
}

bool is_given(const S& settings, const RenderOption& option) { return (settings.given & bit_of_row(option)) != 0; }
void mark_given(S& settings, const RenderOption& option) { settings.given |= bit_of_row(option); }

void override_with(S& settings, const S& over)
{
    for (const RenderOption& row : rows) {
        if (!is_given(over, row)) continue;
        std::visit(
            [&]<class Field>(const Field& f) {
                if constexpr (std::is_same_v<Field, ChoiceField>)
                    f.set(settings, f.get(over));
                else
                    settings.*f.member = over.*f.member;
            },
            row.field);
        mark_given(settings, row);
    }
}

bool is_default(const S& settings, const RenderOption& option)
{
    return value_text(settings, option) == value_text({}, option);
}

bool is_biased(const S& settings, const RenderOption& option)
{
    if (option.bias.effect.empty()) return false;
    return option.bias.applies ? option.bias.applies(settings) : !is_default(settings, option);
}

std::string value_text(const S& s, const RenderOption& option)
{
    return std::visit(
        [&]<class Field>(const Field& f) -> std::string {
            if constexpr (std::is_same_v<Field, ChoiceField>)
                return std::string(f.names[f.get(s)]);
            else if constexpr (std::is_same_v<Field, SwitchField>)
                return s.*f.member ? "true" : "false";
            else if constexpr (std::is_same_v<Field, SizeField>)
                return std::to_string((s.*f.member).width) + "x" + std::to_string((s.*f.member).height);
            else if constexpr (std::is_same_v<Field, NumberField<double>>)
                return number_text(s.*f.member);
            else
                return std::to_string(s.*f.member);
        },
        option.field);
}

}  // namespace lancer
