// Textures seen from so near that a pixel is less than a texel: there nothing is averaged, and the reference, which
// never does, must see the same.
#pragma once

#include "scene/build/shapes.h"
#include "scene/description/metals.h"
#include "support/scenes/scenes.h"

namespace lancer {

// Pictures of 4 x 3 texels: "colours" RGB, "mask" RGBA with alpha, "grey" floats, "normals" tilted by up to half a
// slope.
inline RasterFuture small_picture(const std::string& name)
{
    Raster r;
    r.width = 4, r.height = 3;
    r.channels = name == "mask" ? 4 : name == "grey" ? 1 : 3;
    r.is_float = name == "grey";
    for (size_t i = 0; i < r.value_count(); ++i) {
        const size_t channel = i % r.channels, step = i * 7919 % 211;
        if (r.is_float)
            r.floats.push_back(0.2f + 0.6f * static_cast<float>(step) / 211);
        else if (name == "normals")
            r.bytes.push_back(static_cast<uint8_t>(channel == 2 ? 250 : 80 + step % 96));
        else
            r.bytes.push_back(static_cast<uint8_t>(channel == 3 ? step % 3 * 127 : 40 + step));
    }
    std::promise<std::shared_ptr<const Raster>> promise;
    promise.set_value(std::make_shared<const Raster>(std::move(r)));
    return promise.get_future().share();
}

inline TextureUse small_texture(const char* name, Encoding encoding, Channel channel, Vec2 scale = {1, 1},
                                Vec2 offset = {})
{
    TextureUse t = picture_of(name, encoding, channel);
    t->use.scale = scale, t->use.offset = offset;
    return t;
}

// Four panels that fill the picture, a quarter each: colours and tilted normals; metal of changing roughness, clamped;
// heights and a luminance as opacity; a cut-out by alpha with waves before a wall.
inline SceneDescription panels_scene()
{
    SceneDescription d;
    d.render.multiscatter = false;  // the reference would need a table for each roughness
    const auto panel = [&](double x, double y, const MaterialDescription& m) {
        d.meshes.push_back(make_mesh(
            make_mapped_quad({x, y, 0}, {x + 1, y, 0.1}, {x + 1, y + 0.75, 0.2}, {x, y + 0.75, 0.1}, {1, 1}, m)));
    };
    MaterialDescription cloth = make_lambert("", {0.9f, 0.8f, 1});
    cloth.base_color_map = small_texture("colours", Encoding::srgb, Channel::color, {-1, 1}, {0.3f, 0.1f});
    cloth.normal_map = small_texture("normals", Encoding::linear, Channel::color);
    panel(-1, 0, cloth);
    MaterialDescription brushed = make_lambert("", {0.9f, 0.8f, 0.6f});
    brushed.type = MaterialType::metal;
    brushed.roughness = 0.9f;
    brushed.roughness_map = small_texture("grey", Encoding::linear, Channel::red, {0.8f, 0.9f}, {0.15f, 0.2f});
    brushed.roughness_map->use.wrap = Wrap::clamp;
    brushed.roughness_map->use.gain = 0.5f, brushed.roughness_map->use.bias = 0.4f;
    panel(0, 0, brushed);
    MaterialDescription hammered = make_lambert("", {0.7f, 0.4f, 0.3f});
    hammered.bump_map = small_texture("grey", Encoding::linear, Channel::red);
    hammered.bump_scale = 0.6f;
    hammered.opacity_map = small_texture("colours", Encoding::linear, Channel::green, {1, 1}, {0.5f, 0.25f});
    panel(-1, -0.75, hammered);
    MaterialDescription leaf = make_lambert("", {1, 1, 1});
    leaf.type = MaterialType::plastic;
    leaf.roughness = 0.5f;
    leaf.base_color_map = small_texture("mask", Encoding::srgb, Channel::color);
    leaf.metallic_map = small_texture("colours", Encoding::linear, Channel::blue);
    leaf.metallic = 1;
    leaf.opacity_map = small_texture("mask", Encoding::linear, Channel::automatic);
    leaf.bump_map.emplace();
    leaf.bump_map->type = TextureType::waves;
    leaf.bump_map->waves = {{0.15, 0.4, 6, 0.3}, {0.1, 2, 8, 1}};
    panel(0, -0.75, leaf);
    d.meshes.push_back(make_mesh(
        make_quad({-3, -2, -0.5}, {3, -2, -0.5}, {3, 2, -0.5}, {-3, 2, -0.5}, make_lambert("", {0.2f, 0.4f, 0.6f}))));
    d.lights = {light_of(LightType::sphere, {4, 4, 4}, {1.5, 1.5, 2.5}, 0.8), sky_of({0.4f, 0.5f, 0.6f})};
    d.camera = make_camera({0, 0, 4}, {0, 0, 0.1}, 2 * std::atan(0.74 / 3.9) * 180 / std::numbers::pi);
    return d;
}

// A smooth relief of few triangles with a map of normals whose texture coordinates are skewed and mirrored in the
// middle, as it is, and mirrored and turned by an instance; before a wall of brass.
inline SceneDescription relief_scene()
{
    SceneDescription d;
    MaterialDescription cloth = make_lambert("", {0.9f, 0.8f, 0.7f});
    cloth.normal_map = small_texture("normals", Encoding::linear, Channel::color);
    MeshData relief;
    relief.materials = {cloth};
    for (int j = 0; j <= 3; ++j)
        for (int i = -2; i <= 2; ++i) {
            const double x = 0.5 * i, y = 0.4 * j - 0.6;
            relief.positions.push_back({x, y, 0.25 * std::cos(2 * x + y) * std::cos(3 * y)});
            const Vec3d n{0.5 * std::sin(2 * x + y) * std::cos(3 * y),
                          0.25 * std::sin(2 * x + y) * std::cos(3 * y) + 0.75 * std::cos(2 * x + y) * std::sin(3 * y),
                          1};
            relief.normals.push_back(to_float(normalize(n)));
            relief.uvs.push_back({static_cast<float>(std::abs(x) + 0.2 * y), static_cast<float>(y + 0.1 * x * x)});
        }
    for (uint32_t j = 0; j < 3; ++j)
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t a = 5 * j + i;
            relief.triangles.push_back({a, a + 1, a + 6});
            relief.triangles.push_back({a, a + 6, a + 5});
        }
    relief.uv_triangles = relief.normal_triangles = relief.triangles;
    const auto data = std::make_shared<const MeshData>(std::move(relief));
    d.meshes.push_back(make_mesh(data, {{-0.6, 0.3, 0.2}, {10, 20, 0}, {0.6, 0.6, 0.6}}));
    d.meshes.push_back(make_mesh(data, {{}, {0, 10, 0}, {1, 1, 1}}));
    d.meshes.back().name = "relief";
    d.instances.push_back(instance_of("relief", {{0.55, -0.3, 0.1}, {0, 0, 30}, {-0.6, 0.6, 0.6}}));
    MaterialDescription brass = make_glossy("", MaterialType::metal, {1, 1, 1}, 0.4f);
    const MeasuredMetal metal = find_metal("brass").value();
    brass.eta = metal.eta, brass.k = metal.k;
    d.meshes.push_back(make_mesh(make_quad({-3, -2, -0.6}, {3, -2, -0.6}, {3, 2, -0.6}, {-3, 2, -0.6}, brass)));
    d.lights = {light_of(LightType::sphere, {4, 4, 4}, {1.5, 1.5, 2.5}, 0.8), sky_of({0.4f, 0.5f, 0.6f})};
    d.camera = make_camera({0, 0, 4}, {0, 0, 0.1}, 22);
    return d;
}

// Bands of a grid on a plane and along the sides of a triangle, looked at through a lens as narrow as a band.
inline SceneDescription bands_scene()
{
    SceneDescription d;
    d.materials = {make_lambert("tile", {0.8f, 0.7f, 0.5f}), make_lambert("line", {0.1f, 0.1f, 0.3f}),
                   make_glossy("ruby", MaterialType::plastic, {0.7f, 0.1f, 0.1f}, 0.5f)};
    PlaneDescription floor = plane_of({0.1, 0, 0}, {0, 0, 1}, "tile");
    floor.axes = {Vec3d{0.5, 0.1, 0}, Vec3d{0, 0.4, 0}};
    floor.bands = Bands{"line", 0.1f};
    d.planes = {floor};
    MeshDescription triangle = make_mesh(make_triangle({0.11, 0.03, 0.02}, {0.2, 0.06, 0.02}, {0.13, -0.05, 0.02}));
    triangle.material = "ruby";
    triangle.bands = Bands{"line", 0.15f};
    d.meshes.push_back(triangle);
    d.lights = {light_of(LightType::sphere, {4, 4, 4}, {1.5, 1.5, 2.5}, 0.8), sky_of({0.4f, 0.5f, 0.6f})};
    d.camera = make_camera({0.1, 0.1, 4}, {0.12, 0.02, 0}, 2.2);
    return d;
}

}  // namespace lancer
