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
#include "materials/textures/texture.h"
#include "scene/description/background.h"
#include "scene/description/light.h"
#include "scene/description/material.h"
#include "scene/description/render_settings.h"

namespace lancer {

// A tangent of a vertex, or of a corner of a triangle.
struct MeshTangent {
    Vec3 along{};    // +u, unit; zero where there is none
    float sign = 1;  // 1 or -1: the bitangent is sign * cross(normal, along)
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
    std::vector<Vec2> second_uvs;         // parallel to uvs: another set of them; empty if no texture uses it
    std::vector<MeshTangent> tangents;    // parallel to positions; empty if the file has none that a normal map uses
    std::vector<Color> colors;            // parallel to positions, as in the file, in [0, 1]; empty if it has none
    std::vector<float> alphas;            // parallel to positions, of colors, in [0, 1]; empty if all are 1
    bool made_normals = false;            // by smoothing groups; the file has none
    std::vector<uint32_t> face_material;  // per triangle, index into materials; empty if materials has one entry
    std::vector<MaterialDescription> materials;  // at least one; none for a shape
    uint64_t content_hash = 0;                   // of the bytes of the mesh file and its material files
    static constexpr uint32_t no_normal = UINT32_MAX, no_uv = UINT32_MAX;
};

// Scale first, then rotation about x, then y, then z (degrees), then translation.
struct TransformDescription {
    Vec3d translate{0, 0, 0}, rotate_deg{0, 0, 0}, scale{1, 1, 1};
};

// Where a thing is at even steps of time from the opening of the shutter to its closing; the first is the place that
// the rest of its description has. Empty: it stands still.
template <class Place>
using PlacesAtSteps = std::vector<Place>;

// A second material on a plane or a triangle: lines of it in a grid, or along the sides.
struct Bands {
    std::string material;
    float width = 0.05f;  // part of a cell, or of a barycentric coordinate; in [0, 1]
};

// How the triangles of a mesh are divided when the scene is built, to be displaced.
struct SubdivisionDescription {
    bool is_asked = false;          // also where no material of the scene displaces the mesh
    double edge_pixels = 1;         // edges longer than this in the picture of the first camera are halved; 0: all are
    std::optional<uint32_t> level;  // so often at most
    static constexpr uint32_t most_levels = 12;
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
    SubdivisionDescription subdivision{};
    PlacesAtSteps<TransformDescription> path{};  // it is drawn as an instance then
};

struct InstanceDescription {
    Location where;
    std::string mesh;
    TransformDescription transform;  // applied after the mesh's own
    PlacesAtSteps<TransformDescription> path{};
    // Of further instances of the mesh, which stand still: millions of them need no name and location each.
    std::vector<TransformDescription> more{};

    size_t count() const { return 1 + more.size(); }
    // f(transform) for all of them.
    template <class F>
    void for_each(const F& f) const
    {
        f(transform);
        for (const TransformDescription& t : more) f(t);
    }
};

struct SphereDescription {
    Location where;
    Vec3d center{};
    double radius = 1;     // finite, > 0
    std::string material;  // empty: the default grey Lambert
    enum class Part { whole, bubble, inside_of_bubble };
    Part part = Part::whole;  // inside of a bubble: the material is turned inside out
    struct Place {
        Vec3d center{};
        double radius = 1;
    };
    PlacesAtSteps<Place> path{};
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

enum class CameraType { pinhole, thin_lens };
template <>
inline constexpr auto enum_names<CameraType> = std::to_array<std::string_view>({"pinhole", "thin_lens"});

struct CameraDescription {
    std::string name;  // empty: the [camera] itself
    Location where;
    CameraType type = CameraType::pinhole;
    Vec3d position{0, 0, 5}, target{0, 0, 0}, up{0, 1, 0};
    double fov_deg = 40;          // vertical, in (0, 180)
    double aperture = 0;          // thin lens: radius of the lens, scene units
    std::optional<double> focus;  // thin lens: distance of the plane in focus; default: |target - position|
    std::string inside{};         // if not empty: the material that fills what the camera is in
    // What the file leaves out: a view of the scene completes it (scene/view/auto_view.h).
    struct Missing {
        bool position = false, target = false, up = false, fov = false;
        bool is_any() const { return position || target || up || fov; }
    } missing{};
};

// What [animation] says of the whole film.
struct AnimationDescription {
    uint32_t first = 1, last = 1;  // frames, both included
    double fps = 24;               // frames per second, > 0
    double shutter = 0;            // how long it is open from a frame on, in frames; in [0, 1]
    double frame = 1;              // the one that the rest of the description is of
    bool moves_views_only = true;  // and nothing of what is seen
    bool blurs_all = true;         // whatever moves, an open shutter blurs
};

// [fog]: what fills the scene around all bodies.
struct FogDescription {
    Location where;
    Color scattering{}, absorption{};  // per unit of length, >= 0
    float anisotropy = 0;              // mean cosine of what is scattered, in (-1, 1)
    // Its box: of two corners, without one of which it has no end there; or up to a height; or that of the scene.
    std::optional<Vec3d> low{}, high{};
    std::optional<double> height{};
    bool z_up = false;  // along which axis is the height
};

// What a scene file says of cameras at some time.
struct CamerasAtTime {
    std::optional<CameraDescription> own;  // [camera]
    std::vector<CameraDescription> named;
};

struct SceneDescription {
    std::string file;
    std::optional<AnimationDescription> animation;
    RenderSettings render;                    // what [render] gives
    std::optional<CameraDescription> camera;  // the one to render; absent: fitted to the bounds
    // That of the file in the first frame of its animation: meshes are divided for it, so that they are the same in all
    // frames. Absent: for `camera`.
    std::optional<CameraDescription> first_camera{};
    std::vector<CameraDescription> cameras;  // the named ones
    // `camera` at even steps of time from the opening of the shutter, where it is the same, to its closing. Empty: it
    // stands still.
    std::vector<CameraDescription> camera_path{};
    // The cameras at these times, of which complete_camera_path() makes it.
    std::vector<CamerasAtTime> cameras_later{};
    std::vector<MeshDescription> meshes;
    std::vector<InstanceDescription> instances;
    std::vector<SphereDescription> spheres;
    std::vector<PlaneDescription> planes;
    std::vector<LightDescription> lights;
    std::optional<BackgroundDescription> background;
    std::optional<FogDescription> fog;
    std::vector<MaterialDescription> materials;  // [material.NAME], names unique
    std::vector<MaterialOverride> overrides;     // in order; the first that matches counts
    uint64_t content_hash = 0;                   // of the bytes of every file read, and of the frame of an animation
    // Of what the scene file, definitions and animation say, but for what moves views: of two frames of one film it is
    // the same if they differ in their cameras at most.
    uint64_t still_hash = 0;
};

}  // namespace lancer
