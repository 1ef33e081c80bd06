// The list of scene features, and the function that finds those of a scene. Kernels are specialised by it
// (render/specialize.cpp), and `lancer info` prints it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "materials/material_type.h"
#include "scene/description/light.h"

namespace lancer {

struct Scene;

enum class Feature {
    // shapes
    spheres,
    planes,
    instances,
    motion,  // while the shutter is open
    vertex_normals,
    vertex_colors,
    // surfaces; only materials that are in use count
    textures,
    bump_maps,
    normal_maps,
    cut_outs,
    materials,  // the first of one for each MaterialType
    media = materials + enum_names<MaterialType>.size(),
    scattering,  // by media
    // lights
    lights,  // the first of one for each LightType but the environment
    triangle_lights = lights + enum_names<LightType>.size() - 1,
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
constexpr Feature feature_of(MaterialType type)
{
    return static_cast<Feature>(static_cast<size_t>(Feature::materials) + static_cast<size_t>(type));
}
// type: not the environment.
constexpr Feature feature_of(LightType type)
{
    return static_cast<Feature>(static_cast<size_t>(Feature::lights) + static_cast<size_t>(type));
}
std::string name_of(Feature feature);

class Features {
public:
    constexpr Features() = default;
    constexpr Features(std::initializer_list<Feature> list)
    {
        for (const Feature f : list) bits_ |= bit(f);
    }
    // Of every type of material, and of light but the environment.
    static constexpr Features all_materials()
    {
        Features f;
        for (size_t i = 0; i < enum_names<MaterialType>.size(); ++i) f.add(feature_of(static_cast<MaterialType>(i)));
        return f;
    }
    static constexpr Features all_lights()
    {
        Features f{Feature::triangle_lights, Feature::shaped_triangle_lights};
        for (size_t i = 0; i + 1 < enum_names<LightType>.size(); ++i) f.add(feature_of(static_cast<LightType>(i)));
        return f;
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
