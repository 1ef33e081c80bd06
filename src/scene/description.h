// What a scene file says, as plain data in the units of the file, with the place where each thing was said.
// io/ fills it; Scene::build checks what only the whole scene can tell, resolves names and freezes it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/error.h"
#include "core/vec.h"

namespace lancer {

enum class MaterialType { lambert, mirror, glass };

struct MaterialDescription {
    std::string name;
    Location where;
    MaterialType type = MaterialType::lambert;
    Color base_color{0.8f, 0.8f, 0.8f};  // albedo, or tint of mirror and glass; in [0, 1]
    float ior = 1.5f;                    // glass: index of refraction inside over outside, > 0
    Color emission{};                    // radiance
    bool emission_both_sides = false;    // else only on the side of the normal
};

// One mesh file after loading: validated, triangulated, still in double and in the file's units.
struct MeshData {
    std::string file;
    std::vector<std::string> material_files;         // as found and read
    std::vector<Vec3d> positions;                    // finite
    std::vector<std::array<uint32_t, 3>> triangles;  // indices into positions, in range
    std::vector<Vec3> normals;                       // finite, unit; empty if the file has none
    std::vector<std::array<uint32_t, 3>>
        normal_triangles;                 // parallel to triangles, no_normal where a face has none; empty if normals is
    std::vector<uint32_t> face_material;  // per triangle, index into materials; empty if materials has one entry
    std::vector<MaterialDescription> materials;  // at least one
    uint64_t content_hash = 0;                   // of the bytes of the mesh file and its material files
    static constexpr uint32_t no_normal = UINT32_MAX;
};

// Scale first, then rotation about x, then y, then z (degrees), then translation.
struct TransformDescription {
    Vec3d translate{0, 0, 0}, rotate_deg{0, 0, 0}, scale{1, 1, 1};
};

struct MeshDescription {
    std::string name;  // may be empty; an [[instance]] refers to it
    Location where;
    std::shared_ptr<const MeshData> data;  // the same file named twice is loaded once
    std::string material;                  // if not empty: replaces every material of the file
    TransformDescription transform;
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
};

struct PlaneDescription {
    Location where;
    Vec3d point{}, normal{0, 1, 0};  // normal: finite, not zero, need not be unit
    std::string material;
};

enum class LightType { point, sphere, environment };

struct LightDescription {
    Location where;
    LightType type = LightType::point;
    Vec3d position{};   // point; center of sphere
    double radius = 1;  // sphere
    Color power{};      // intensity (point), radiance (sphere, environment); finite, >= 0
};

enum class CameraType { pinhole, thin_lens };

struct CameraDescription {
    Location where;
    CameraType type = CameraType::pinhole;
    Vec3d position{0, 0, 5}, target{0, 0, 0}, up{0, 1, 0};
    double fov_deg = 40;          // vertical, in (0, 180)
    double aperture = 0;          // thin lens: radius of the lens, scene units
    std::optional<double> focus;  // thin lens: distance of the plane in focus; default: |target - position|
};

// Larger pictures are refused before anything is allocated for them.
inline constexpr uint32_t max_picture_side = 65536;
inline constexpr uint64_t max_picture_pixels = uint64_t{1} << 28;

// What [render] may say; the command line overrides it. Names are validated by whoever has the list.
struct RenderDescription {
    Location where;
    std::optional<std::string> integrator, filter, sampler;
    std::optional<uint32_t> spp, max_depth;
    std::optional<uint64_t> seed;
    std::optional<std::array<uint32_t, 2>> size;  // width, height
};

struct SceneDescription {
    std::string file;
    RenderDescription render;
    std::optional<CameraDescription> camera;  // absent: fitted to the bounds
    std::vector<MeshDescription> meshes;
    std::vector<InstanceDescription> instances;
    std::vector<SphereDescription> spheres;
    std::vector<PlaneDescription> planes;
    std::vector<LightDescription> lights;
    std::vector<MaterialDescription> materials;  // [material.NAME], names unique
    uint64_t content_hash = 0;                   // of the bytes of every file read
};

}  // namespace lancer
