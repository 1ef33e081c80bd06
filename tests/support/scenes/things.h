// What scenes are made of, as descriptions: meshes, shapes, lights, materials, cameras.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "scene/description/description.h"

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

// A surface that stops a part of the rays; with `squares` only on every other of so many squares along each side.
MaterialDescription make_gauze(std::string name, Color albedo, float opacity, float squares = 0);
// roughness: perceptual.
MaterialDescription make_glossy(std::string name, MaterialType type, Color base_color, float roughness);
MaterialDescription make_copper(std::string name, float roughness);
MaterialDescription make_translucent(std::string name, Color reflected, Color transmitted);

}  // namespace lancer
