// The list of scene features, and the function that finds those of a scene. Kernels are specialised by it
// (render/specialize.cpp), and `lancer info` prints it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace lancer {

struct Scene;

enum class Feature {
    // shapes
    spheres,
    planes,
    instances,
    vertex_normals,
    vertex_colors,
    // surfaces; only materials that are in use count
    textures,
    bump_maps,
    normal_maps,
    cut_outs,
    lambert,
    mirror,
    metal,
    glass,
    plastic,
    interface,
    mixes,
    media,
    // lights
    point_lights,
    directional_lights,
    sphere_lights,
    triangle_lights,
    shaped_triangle_lights,  // smooth or instanced ones; their triangle is read when they are sampled
    constant_sky,
    sky_map,
    background,
    textured_lights,
    light_tree,
    // methods
    terminator,
    legacy,
    count
};
inline constexpr std::array<std::string_view, static_cast<size_t>(Feature::count)> feature_names{
    "spheres",
    "planes",
    "instances",
    "vertex normals",
    "vertex colours",
    "textures",
    "bump maps",
    "normal maps",
    "opacity",
    "lambert",
    "mirror",
    "metal",
    "glass",
    "plastic",
    "interface",
    "mixes",
    "media",
    "point lights",
    "directional lights",
    "sphere lights",
    "triangle lights",
    "smooth or instanced triangle lights",
    "constant environment",
    "sky map",
    "background",
    "textured lights",
    "light tree",
    "terminator",
    "legacy"};

class Features {
public:
    constexpr Features() = default;
    constexpr Features(std::initializer_list<Feature> list)
    {
        for (const Feature f : list) bits_ |= bit(f);
    }
    static constexpr Features all() { return Features((uint64_t{1} << static_cast<size_t>(Feature::count)) - 1); }

    constexpr bool has(Feature f) const { return (bits_ & bit(f)) != 0; }
    constexpr void add(Feature f, bool really = true) { bits_ |= really ? bit(f) : 0; }
    constexpr Features operator|(Features o) const { return Features(bits_ | o.bits_); }
    // Whether `needed` is a subset of these features.
    constexpr bool covers(Features needed) const { return (needed.bits_ & ~bits_) == 0; }

private:
    constexpr explicit Features(uint64_t bits) : bits_(bits) {}
    static constexpr uint64_t bit(Feature f) { return uint64_t{1} << static_cast<size_t>(f); }
    uint64_t bits_ = 0;
};

// Features of a complete scene.
Features features_of(const Scene& scene);

}  // namespace lancer
