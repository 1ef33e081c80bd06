// What a scene file can say of a material: a field for each parameter, and below one row for each key, with its range
// and the texture that may multiply it. Which type of material has which of them, and with which default, stands beside
// the struct of each material (materials/parameter.h). Scene files, overrides, the list of pictures and the table of
// docs/scene-format.md, which a test compares, go over these rows.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/color.h"
#include "core/error.h"
#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "scene/description/parameter_range.h"
#include "scene/description/texture.h"

namespace lancer {

// What a material says, each parameter with its default. A texture multiplies the number it belongs to. Every
// parameter has a row below.
struct MaterialDescription {
    std::string name;
    Location where;
    MaterialType type = MaterialType::lambert;
    // Albedo (lambert, plastic, of what a translucent sheet reflects), F0 (metal), tint (mirror, glass); in [0, 1].
    Color base_color{0.8f, 0.8f, 0.8f};
    TextureUse base_color_map{};
    Color transmittance{0.4f, 0.4f, 0.4f};  // translucent: albedo of what it lets through; principled: tint; in [0, 1]
    TextureUse transmittance_map{};
    float ior = 1.5f;                   // glass, plastic, principled: index of refraction inside over outside, > 0
    std::optional<bool> thin{};         // glass, principled: a sheet without an inside; nothing: its shape decides
    Color absorption{};                 // glass, interface, principled: of what is inside, per unit of length, >= 0
    std::optional<int32_t> priority{};  // likewise: over other media in the same place
    Color scattering{};                 // likewise, of glass and principled: what is scattered inside, >= 0
    float scattering_anisotropy = 0;    // likewise: mean cosine of what is scattered inside, in (-1, 1)
    // Likewise: what is inside by how a thick body of it looks, in place of absorption and scattering: its colour, in
    // [0, 1], and the mean free path of each channel, > 0.
    std::optional<Color> subsurface_color{};
    Color subsurface_radius{1, 1, 1};
    float roughness = 0;  // metal, glass, plastic, principled: perceptual, in [0, 1]; GGX alpha is its square
    TextureUse roughness_map{};
    std::optional<Color> eta{}, k{};  // metal: complex index of refraction; base_color is then only a tint
    std::optional<float> metallic{};  // metal, plastic, principled: part of metal in a mix of both, in [0, 1]
    TextureUse metallic_map{};
    Color specular{1, 1, 1};  // plastic, principled: tint of the reflection; in [0, 1]
    // principled, see materials/principled.h; weights, roughness and colours in [0, 1]
    float base_weight = 1;        // factor of base_color
    float diffuse_roughness = 0;  // of the diffuse body
    float specular_weight = 1;    // of the reflection of the base
    float anisotropy = 0;         // of its facets: 0: the same in all directions
    TextureUse anisotropy_map{};
    float anisotropy_rotation = 0;  // of their tangent, part of a turn
    TextureUse anisotropy_rotation_map{};
    float transmission = 0;  // part of the dielectric that is clear; tint of each refraction: transmittance
    TextureUse transmission_map{};
    float transmission_depth = 0;  // length on which what is inside absorbs all but transmittance; 0: it is a tint
    float coat = 0;
    TextureUse coat_map{};
    Color coat_color{1, 1, 1};
    float coat_roughness = 0;
    TextureUse coat_roughness_map{};
    float coat_ior = 1.6f;     // > 0
    float coat_darkening = 1;  // by light that the coat sends back to the base
    float fuzz = 0;
    TextureUse fuzz_map{};
    Color fuzz_color{1, 1, 1};
    TextureUse fuzz_color_map{};
    float fuzz_roughness = 0.5f;
    TextureUse fuzz_roughness_map{};
    float film = 0;
    TextureUse film_map{};
    float film_thickness = 500;  // nanometres, >= 0
    TextureUse film_thickness_map{};
    float film_ior = 1.4f;  // > 0
    float opacity = 1;      // part of the rays that are stopped, in [0, 1]
    TextureUse opacity_map{};
    TextureUse bump_map{};    // heights
    float bump_scale = 1;     // slope of a step from black to white between neighbouring texels; a factor on waves
    TextureUse normal_map{};  // tangent space, y along +v
    TextureUse displacement_map{};    // heights by which the vertices of a divided mesh move along their normals
    float displacement_scale = 1;     // of a step from black to white, units of the mesh file
    float displacement_midlevel = 0;  // height that stays where it is
    bool shadow_catcher = false;      // in pictures with alpha only its shadows are seen
    Color emission{};                 // radiance
    TextureUse emission_map{};
    bool emission_both_sides = false;  // else only on the side of the normal
    std::string group{};               // of lights, see scene/lights/groups.h; empty: none
    std::string first{}, second{};     // mix: names of [material.NAME]
    float weight = 0.5f;               // mix: of the second
    TextureUse weight_map{};
    // interface; its diffuse colour is base_color, what the file calls ior is its inside_ior.
    Phong phong{.inside_ior = 1.5f};
    // Of a mesh file's material: the keys that decided its type, and whether other keys say another.
    std::string why{};
    bool is_doubtful = false;

    // Said at the same place, with the same name, and the same.
    friend bool operator==(const MaterialDescription&, const MaterialDescription&) = default;
};

// [[material_override]]: the materials of mesh files whose name matches get what is said here.
struct MaterialOverride {
    Location where;
    std::string match;     // shell pattern: *, ?, [...]
    std::string material;  // if not empty: a [material.NAME] that takes their place
    std::function<MaterialDescription(const MaterialDescription&)> change;  // else: the changed description
};

// What a texture is used for; it decides what a scene file need not say of it.
enum class TextureRole {
    none,
    color,    // sRGB where the picture holds integers
    normal,   // three numbers, linear
    number,   // one number: the luminance, linear
    opacity,  // one number: alpha where the picture has some
    heights,  // one number, of which only the slope counts
};

// Value, Map: pointers to members of MaterialDescription, or functions of it that return one by reference.
template <class Value, class Map>
struct MaterialParameter {
    std::string_view key;
    Value value;
    ParameterRange range;
    TextureRole role;          // of the texture
    std::string_view map_key;  // empty: no texture multiplies it
    Map map;
    std::array<std::string_view, 2> words;  // of a choice

    constexpr auto& value_of(auto& description) const { return std::invoke(value, description); }
    constexpr auto& map_of(auto& description) const { return std::invoke(map, description); }
};
template <class Row>
inline constexpr bool has_map = !std::is_same_v<decltype(std::declval<Row>().map), std::nullptr_t>;

namespace material_rows {

template <class Value>
constexpr MaterialParameter<Value, std::nullptr_t> number(std::string_view key, Value value, ParameterRange range,
                                                          std::array<std::string_view, 2> words = {})
{
    return {key, value, range, TextureRole::none, {}, nullptr, words};
}
template <class Value, class Map>
constexpr MaterialParameter<Value, Map> mapped(std::string_view key, Value value, ParameterRange range,
                                               std::string_view map_key, Map map, TextureRole role)
{
    return {key, value, range, role, map_key, map, {}};
}
template <class Value>
constexpr MaterialParameter<Value, std::nullptr_t> image(std::string_view key, Value value, TextureRole role)
{
    return {key, value, ParameterRange::texture, role, {}, nullptr, {}};
}

using M = MaterialDescription;
using enum ParameterRange;

// The interface keeps its own in Phong's model.
inline constexpr auto ior = [](auto& m) -> auto&
{
    return m.type == MaterialType::interface ? m.phong.inside_ior : m.ior;
};
inline constexpr auto specular = [](auto& m) -> auto&
{
    return m.type == MaterialType::interface ? m.phong.specular : m.specular;
};

inline constexpr std::tuple all{
    mapped("base_color", &M::base_color, unit, "texture", &M::base_color_map, TextureRole::color),
    mapped("transmittance", &M::transmittance, unit, "transmittance_texture", &M::transmittance_map,
           TextureRole::color),
    mapped("roughness", &M::roughness, unit, "roughness_texture", &M::roughness_map, TextureRole::number),
    mapped("metallic", &M::metallic, unit, "metallic_texture", &M::metallic_map, TextureRole::number),
    number("ior", ior, positive),
    number("thin", &M::thin, boolean),
    number("absorption", &M::absorption, not_negative),
    number("priority", &M::priority, million),
    number("scattering", &M::scattering, not_negative),
    number("scattering_anisotropy", &M::scattering_anisotropy, below_one),
    number("subsurface_color", &M::subsurface_color, unit),
    number("subsurface_radius", &M::subsurface_radius, positive),
    number("eta", &M::eta, positive),
    number("k", &M::k, not_negative),
    number("specular", specular, unit),
    number("first", &M::first, name),
    number("second", &M::second, name),
    mapped("weight", &M::weight, unit, "weight_texture", &M::weight_map, TextureRole::number),
    number("ambient", member_of(&M::phong, &Phong::ambient), not_negative),
    number("shininess", member_of(&M::phong, &Phong::shininess), not_negative),
    number("diffusion", member_of(&M::phong, &Phong::diffusion), unit),
    number("reflexion", member_of(&M::phong, &Phong::reflexion), unit),
    number("refraction", member_of(&M::phong, &Phong::refraction), unit),
    number("outside_ior", member_of(&M::phong, &Phong::outside_ior), positive),
    number("base_weight", &M::base_weight, unit),
    number("diffuse_roughness", &M::diffuse_roughness, unit),
    number("specular_weight", &M::specular_weight, unit),
    mapped("anisotropy", &M::anisotropy, unit, "anisotropy_texture", &M::anisotropy_map, TextureRole::number),
    mapped("anisotropy_rotation", &M::anisotropy_rotation, unit, "anisotropy_rotation_texture",
           &M::anisotropy_rotation_map, TextureRole::number),
    mapped("transmission", &M::transmission, unit, "transmission_texture", &M::transmission_map, TextureRole::number),
    number("transmission_depth", &M::transmission_depth, not_negative),
    mapped("coat", &M::coat, unit, "coat_texture", &M::coat_map, TextureRole::number),
    number("coat_color", &M::coat_color, unit),
    mapped("coat_roughness", &M::coat_roughness, unit, "coat_roughness_texture", &M::coat_roughness_map,
           TextureRole::number),
    number("coat_ior", &M::coat_ior, positive),
    number("coat_darkening", &M::coat_darkening, unit),
    mapped("fuzz", &M::fuzz, unit, "fuzz_texture", &M::fuzz_map, TextureRole::number),
    mapped("fuzz_color", &M::fuzz_color, unit, "fuzz_color_texture", &M::fuzz_color_map, TextureRole::color),
    mapped("fuzz_roughness", &M::fuzz_roughness, unit, "fuzz_roughness_texture", &M::fuzz_roughness_map,
           TextureRole::number),
    mapped("film", &M::film, unit, "film_texture", &M::film_map, TextureRole::number),
    mapped("film_thickness", &M::film_thickness, not_negative, "film_thickness_texture", &M::film_thickness_map,
           TextureRole::number),
    number("film_ior", &M::film_ior, positive),
    mapped("opacity", &M::opacity, unit, "opacity_texture", &M::opacity_map, TextureRole::opacity),
    image("bump_texture", &M::bump_map, TextureRole::heights),
    number("bump_scale", &M::bump_scale, finite),
    image("normal_texture", &M::normal_map, TextureRole::normal),
    image("displacement_texture", &M::displacement_map, TextureRole::heights),
    number("displacement_scale", &M::displacement_scale, finite),
    number("displacement_midlevel", &M::displacement_midlevel, finite),
    number("shadow_catcher", &M::shadow_catcher, boolean),
    mapped("emission", &M::emission, not_negative, "emission_texture", &M::emission_map, TextureRole::color),
    number("emission_sides", &M::emission_both_sides, choice, {"front", "both"}),
    number("group", &M::group, ParameterRange::group)};

}  // namespace material_rows

inline constexpr const auto& material_parameters = material_rows::all;

// A field that may be nothing, as the value that it then has; any other field as it is.
template <class T>
constexpr T& value_in(T& field)
{
    return field;
}
template <class T>
constexpr T& value_in(std::optional<T>& field)
{
    return *field;
}
// What a texture that stands alone multiplies.
inline void set_to_one(Color& color) { color = {1, 1, 1}; }
inline void set_to_one(float& number) { number = 1; }
inline void set_to_one(std::optional<float>& number) { number = 1.0f; }

// f(row) for each.
template <class F>
constexpr void for_each_material_parameter(const F& f)
{
    std::apply([&](const auto&... row) { (f(row), ...); }, material_parameters);
}

// Every texture that a material may have.
std::vector<const TextureUse*> textures_of(const MaterialDescription& material);
// Those that are looked up while rendering: all but heights that displace.
std::vector<const TextureUse*> shading_textures_of(const MaterialDescription& material);
bool reads_textures(const MaterialDescription& material);

// The types that have a parameter, in their order; empty: all of them.
std::vector<MaterialType> types_with(std::string_view key);
bool has_parameter(MaterialType type, std::string_view key);

// A material of a type that says nothing of itself.
MaterialDescription default_description(MaterialType type);
// What is principled but says no more than a plainer type can say, as that type; any other as it is. The picture of the
// plainer type is what is meant.
MaterialDescription plainest(const MaterialDescription& material);
// Makes it one of another type, which begins with its own defaults: a number with a texture is then 1. The base colour
// and all textures stay, as does what materials of all types have: a mesh file knows these best.
void change_type(MaterialDescription& material, MaterialType type);

}  // namespace lancer
