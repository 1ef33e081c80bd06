// What a scene file says, as plain data in the units of the file, with the place where each thing was said.
// io/ fills it; Scene::build checks what only the whole scene can tell, resolves names and freezes it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/error.h"
#include "core/vec.h"
#include "materials/phong.h"
#include "materials/textures/texture.h"
#include "scene/description/background.h"
#include "scene/description/render_settings.h"

namespace lancer {

enum class TextureType { image, checker, grid, rim, waves };

// A texture as it is used in one place.
struct TextureDescription {
    Location where;
    TextureType type = TextureType::image;
    std::string file;               // image: path as found on disk
    ImageUse use;                   // image; scale and offset also of the others but rim
    Color even{1, 1, 1}, odd{};     // checker
    Color band{1, 1, 1}, ground{};  // grid
    float band_width = 0.05f;       // grid, rim; in [0, 1]
    std::vector<Wave> waves{};      // waves

    // Whether both make the same texture.
    friend bool operator==(const TextureDescription& a, const TextureDescription& b)
    {
        return a.type == b.type && a.file == b.file && a.use == b.use && a.even == b.even && a.odd == b.odd &&
               a.band == b.band && a.ground == b.ground && a.band_width == b.band_width && a.waves == b.waves;
    }
};
using TextureUse = std::optional<TextureDescription>;

enum class MaterialType { lambert, mirror, metal, glass, plastic, mix, interface };

// What a material says, each parameter with its default. A texture multiplies the number it belongs to.
struct MaterialDescription {
    std::string name;
    Location where;
    MaterialType type = MaterialType::lambert;
    Color base_color{0.8f, 0.8f, 0.8f};  // albedo (lambert, plastic), F0 (metal), tint (mirror, glass); in [0, 1]
    TextureUse base_color_map{};
    float ior = 1.5f;                   // glass, plastic: index of refraction inside over outside, > 0
    Color absorption{};                 // glass, interface: of what is inside, per unit of length, >= 0
    std::optional<int32_t> priority{};  // glass, interface: over other media in the same place
    float roughness = 0;                // metal, glass, plastic: perceptual, in [0, 1]; GGX alpha is its square
    TextureUse roughness_map{};
    std::optional<Color> eta{}, k{};  // metal: complex index of refraction; base_color is then only a tint
    std::optional<float> metallic{};  // metal, plastic: part of metal in a mix of both, in [0, 1]
    TextureUse metallic_map{};
    Color specular{1, 1, 1};  // plastic: tint of the coat's reflection; in [0, 1]
    float opacity = 1;        // part of the rays that are stopped, in [0, 1]
    TextureUse opacity_map{};
    TextureUse bump_map{};    // heights
    float bump_scale = 1;     // slope of a step from black to white between neighbouring texels; a factor on waves
    TextureUse normal_map{};  // tangent space, y along +v
    Color emission{};         // radiance
    TextureUse emission_map{};
    bool emission_both_sides = false;  // else only on the side of the normal
    std::string first{}, second{};     // mix: names of [material.NAME]
    float weight = 0.5f;               // mix: of the second
    TextureUse weight_map{};
    Phong phong{};  // interface; its diffuse colour is base_color

    // Said at the same place, with the same name, and the same.
    friend bool operator==(const MaterialDescription&, const MaterialDescription&) = default;
};

// Every texture that a material may have.
inline std::array<const TextureUse*, 8> textures_of(const MaterialDescription& m)
{
    return {&m.base_color_map, &m.roughness_map, &m.metallic_map, &m.opacity_map,
            &m.bump_map,       &m.normal_map,    &m.emission_map, &m.weight_map};
}
inline bool reads_textures(const MaterialDescription& m)
{
    for (const TextureUse* use : textures_of(m))
        if (*use) return true;
    return false;
}

// [[material_override]]: the materials of mesh files whose name matches get what is said here.
struct MaterialOverride {
    Location where;
    std::string match;     // shell pattern: *, ?, [...]
    std::string material;  // if not empty: a [material.NAME] that takes their place
    std::function<MaterialDescription(const MaterialDescription&)> change;  // else: the changed description
};

// One mesh file after loading: validated, triangulated, still in double and in the file's units.
struct MeshData {
    std::string file;                                // empty for a shape
    std::string shape;                               // what it is instead of a file: "triangle", "pyramid"
    std::vector<std::string> material_files;         // as found and read
    std::vector<Vec3d> positions;                    // finite
    std::vector<std::array<uint32_t, 3>> triangles;  // indices into positions, in range
    std::vector<Vec3> normals;                       // finite, unit; empty if the file has none
    std::vector<std::array<uint32_t, 3>>
        normal_triangles;   // parallel to triangles, no_normal where a face has none; empty if normals is
    std::vector<Vec2> uvs;  // finite, v upwards; empty if no face has any
    std::vector<std::array<uint32_t, 3>> uv_triangles;  // as normal_triangles, no_uv where a face has none
    std::vector<Color> colors;            // parallel to positions, as in the file, in [0, 1]; empty if it has none
    std::vector<uint32_t> face_material;  // per triangle, index into materials; empty if materials has one entry
    std::vector<MaterialDescription> materials;  // at least one; none for a shape
    uint64_t content_hash = 0;                   // of the bytes of the mesh file and its material files
    static constexpr uint32_t no_normal = UINT32_MAX, no_uv = UINT32_MAX;
};

// Scale first, then rotation about x, then y, then z (degrees), then translation.
struct TransformDescription {
    Vec3d translate{0, 0, 0}, rotate_deg{0, 0, 0}, scale{1, 1, 1};
};

// A second material on a plane or a triangle: lines of it in a grid, or along the sides.
struct Bands {
    std::string material;
    float width = 0.05f;  // part of a cell, or of a barycentric coordinate; in [0, 1]
};

// What the numbers of vertex colours are; none: they are not looked at.
enum class VertexColors { srgb, linear, none };

struct MeshDescription {
    std::string name;  // may be empty; an [[instance]] refers to it
    Location where;
    std::shared_ptr<const MeshData> data;  // the same file named twice is loaded once
    std::string material;                  // if not empty: replaces every material of the file
    TransformDescription transform;
    std::optional<Bands> bands{};  // a shape, with the texture coordinates that Rim wants
    VertexColors vertex_colors = VertexColors::srgb;
};

struct InstanceDescription {
    Location where;
    std::string mesh;
    TransformDescription transform;  // applied after the mesh's own
};

struct SphereDescription {
    Location where;
    Vec3d center{};
    double radius = 1;     // finite, > 0
    std::string material;  // empty: the default grey Lambert
    enum class Part { whole, bubble, inside_of_bubble };
    Part part = Part::whole;  // inside of a bubble: the material is turned inside out
};

struct PlaneDescription {
    Location where;
    Vec3d point{}, normal{0, 1, 0};  // normal: finite, not zero, need not be unit
    std::string material;
    std::optional<std::array<Vec3d, 2>> axes{};  // a step of 1 in u, in v, from the point; they span the plane, and
                                                 // u x v is along the normal. Else coordinates are of the file
    std::optional<Bands> bands{};
    bool is_water = false;      // with waves in place of the material's own bumps; no material: clear water
    std::vector<Wave> waves{};  // water; empty: default_waves()
};

enum class LightType { point, directional, sphere, environment };

struct LightDescription {
    Location where;
    LightType type = LightType::point;
    Vec3d position{};           // point; center of sphere
    Vec3d direction{0, -1, 0};  // directional: the way that the light goes; finite, not zero, need not be unit
    double radius = 1;          // sphere
    Color power{};              // intensity (point), irradiance on a surface that faces it (directional), radiance
                                // (sphere, environment; with a file its factor); finite, >= 0
    std::string file{};         // environment: latitude-longitude picture; empty: constant
    Vec3d rotate_deg{0, 0, 0};  // environment with a file: about x, then y, then z
};

enum class CameraType { pinhole, thin_lens };

struct CameraDescription {
    std::string name;  // empty: the [camera] itself
    Location where;
    CameraType type = CameraType::pinhole;
    Vec3d position{0, 0, 5}, target{0, 0, 0}, up{0, 1, 0};
    double fov_deg = 40;          // vertical, in (0, 180)
    double aperture = 0;          // thin lens: radius of the lens, scene units
    std::optional<double> focus;  // thin lens: distance of the plane in focus; default: |target - position|
    std::string inside{};         // if not empty: the material that fills what the camera is in
};

struct SceneDescription {
    std::string file;
    RenderSettings render;                    // what [render] gives
    std::optional<CameraDescription> camera;  // the one to render; absent: fitted to the bounds
    std::vector<CameraDescription> cameras;   // the named ones
    std::vector<MeshDescription> meshes;
    std::vector<InstanceDescription> instances;
    std::vector<SphereDescription> spheres;
    std::vector<PlaneDescription> planes;
    std::vector<LightDescription> lights;
    std::optional<BackgroundDescription> background;
    std::vector<MaterialDescription> materials;  // [material.NAME], names unique
    std::vector<MaterialOverride> overrides;     // in order; the first that matches counts
    uint64_t content_hash = 0;                   // of the bytes of every file read
};

}  // namespace lancer
