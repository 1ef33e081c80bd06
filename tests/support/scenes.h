// Small scenes in code, as descriptions: what the tests of scene, integrators and render draw. Each is about one unit
// large, has its camera, and fits a picture of any size.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "scene/camera.h"
#include "scene/scene.h"
#include "support/images.h"

namespace lancer {

// A mesh of one material, flat-shaded.
std::shared_ptr<const MeshData> make_mesh_data(std::vector<Vec3d> positions,
                                               std::vector<std::array<uint32_t, 3>> triangles,
                                               MaterialDescription material = {});

// Two triangles; a, b, c, d counter-clockwise seen from the side of the normal.
inline std::shared_ptr<const MeshData> make_quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, MaterialDescription material = {})
{
    return make_mesh_data({a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}, std::move(material));
}

// The same with texture coordinates: (0, 0) at a, (u, 0) at b, (u, v) at c, (0, v) at d.
std::shared_ptr<const MeshData> make_mapped_quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, Vec2 uv,
                                                 MaterialDescription material);

TextureUse picture_of(const std::string& name, Encoding encoding, Channel channel = Channel::color);
inline TextureUse heights_of(const std::string& name) { return picture_of(name, Encoding::linear, Channel::red); }

// A closed sphere of radius 1 around the origin; neighbours share their vertices. bump: how far the surface waves in
// and out, 0 for none. Vertices come row by row between a pole at +z (the first) and one at -z (the last).
std::shared_ptr<const MeshData> make_uv_sphere(uint32_t rows, uint32_t columns, double bump = 0,
                                               MaterialDescription material = {});

// A cube of side 2 around the origin, normals outwards.
std::shared_ptr<const MeshData> make_cube(MaterialDescription material = {});

inline MaterialDescription make_lambert(std::string name, Color albedo)
{
    return {.name = std::move(name), .where = {}, .base_color = albedo};
}
inline MaterialDescription make_emitter(std::string name, Color radiance)
{
    return {.name = std::move(name), .where = {}, .base_color = {}, .emission = radiance};
}
inline MeshDescription make_mesh(std::shared_ptr<const MeshData> data, TransformDescription transform = {})
{
    return {.name = {}, .where = {}, .data = std::move(data), .material = {}, .transform = transform};
}
CameraDescription make_camera(Vec3d position, Vec3d target, double fov_deg);

// Built field by field: g++ 12 takes the strings of aggregates in temporaries for uninitialised.
SphereDescription sphere_of(Vec3d center, double radius, std::string material = {}, Location where = {});
PlaneDescription plane_of(Vec3d point, Vec3d normal, std::string material = {}, Location where = {});
LightDescription light_of(LightType type, Color power, Vec3d position = {}, double radius = 1, Location where = {});
// irradiance: on what faces it; direction: the way that its light goes.
LightDescription directional_of(Color irradiance, Vec3d direction);
LightDescription sky_map_of(Color factor, Vec3d rotate_deg = {}, Location where = {});
inline LightDescription sky_of(Color radiance) { return light_of(LightType::environment, radiance); }
InstanceDescription instance_of(std::string mesh, TransformDescription transform, Location where = {});

// The inside of a sphere that emits everywhere and reflects rho: its radiance is emitted (1 + rho + rho^2 + ...).
SceneDescription closed_furnace(float rho, Color emitted = {1, 1, 1});

// A box open to the front with coloured walls, two blocks and a quad light of two triangles: meshes only, all diffuse.
SceneDescription cornell_scene();

// A mirror, a glass and a diffuse sphere on a plane under a sphere light and a constant sky, through a thin lens:
// no mesh at all.
SceneDescription spheres_scene();

// Every kind of light (point, sphere, emitting triangles, sky) over a bumpy mesh and a floor of two triangles.
SceneDescription lights_scene();

// One bumpy mesh in five places - turned, stretched, mirrored - and an instanced lamp, on a plane.
SceneDescription instances_scene();

// Textures of every kind, on meshes, an instance, a sphere and a plane.
SceneDescription textured_scene();

// A surface that stops a part of the rays; with `squares` only on every other of so many squares along each side.
MaterialDescription make_gauze(std::string name, Color albedo, float opacity, float squares = 0);
// Cut-outs and fractional opacity on all that can have it: meshes with and without a texture, one with both solid and
// half-open faces, instances, spheres, a plane, and lights of which a part is missing.
SceneDescription holes_scene();

// roughness: perceptual.
MaterialDescription make_glossy(std::string name, MaterialType type, Color base_color, float roughness);
MaterialDescription make_copper(std::string name, float roughness);
// Everything between mirror and matt: rough metal by colour and by index, rough glass as a ball and as a pane with a
// point of light behind it, plastic smooth and rough, mixes by a checker and by a map of what is metal, and bumps;
// under a ball, a textured panel and a map of the sky.
SceneDescription glossy_scene();

SceneDescription media_scene();   // in support/media_scenes.cpp
SceneDescription shapes_scene();  // in support/shapes_scene.cpp

struct NamedScene {
    const char* name;
    SceneDescription description;
};
std::vector<NamedScene> all_test_scenes();

// The same scene s times as large, seen the same: lengths grow by s, intensities by s^2, radiances stay.
SceneDescription scaled_by(SceneDescription d, double s);

inline Scene build_scene(const SceneDescription& d, const RasterSource& images = test_picture)
{
    Diagnostics diagnostics;
    return Scene::build(d, d.render, diagnostics, images);
}

// The camera of the description, or the one fitted to what it shows.
Camera camera_of(const SceneDescription& d, const Scene& scene, uint32_t width, uint32_t height);

}  // namespace lancer
