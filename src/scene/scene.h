// The scene as rendered: arrays and ids, in normalised units. Built once, const ever after.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "core/compact_index_array.h"
#include "core/error.h"
#include "core/ranked_bitset.h"
#include "core/ray.h"
#include "geometry/geometry.h"
#include "materials/material.h"
#include "scene/corner_normals.h"
#include "scene/corner_table.h"
#include "scene/description/description.h"
#include "scene/lights/light.h"
#include "scene/placement.h"
#include "scene/specialisation.h"
#include "scene/surface.h"

namespace lancer {

// What shading needs to know of a mesh, beside its geometry.
struct MeshShading {
    CornerNormals normals;            // empty if the mesh is flat
    std::vector<Vec2> uvs;            // empty unless a texture is looked up with them
    CornerTable uv_triangles;         // of those triangles that have any and read them
    CompactIndexArray face_material;  // per triangle; empty if the mesh has one material
    std::vector<Color> colors;        // of the vertices, linear; empty if the mesh has none
    uint32_t material = 0;
    RankedBitset
        emitters;  // which of its triangles shine: their lights follow each other in their order; empty if none does

    uint32_t material_of(uint32_t triangle) const { return face_material.empty() ? material : face_material[triangle]; }
    // Whether holds(material) of one that some triangle of it wears.
    template <class Holds>
    bool uses(const Holds& holds) const
    {
        return face_material.empty() ? holds(material) : face_material.any(holds);
    }
    // Whether shading looks something up that not all its triangles share.
    bool differs_by_triangle() const { return !(normals.empty() && uvs.empty() && face_material.empty()); }
};

class Background;
class EnvironmentMap;

struct Scene {
    static constexpr uint32_t none = UINT32_MAX;

    Geometry geometry;
    std::vector<MeshShading> shading;  // parallel to geometry.meshes
    std::vector<uint32_t> sphere_material, plane_material;
    std::vector<PlaneMap> plane_maps;  // parallel to geometry.planes

    std::vector<Material> materials;
    std::vector<Emission> emission;      // parallel to materials
    std::vector<MaterialTraits> traits;  // parallel to materials
    std::vector<std::string> material_names;
    std::vector<uint32_t> mix_of;  // of each material its place in mixes, or none; empty if there are no mixes
    std::vector<Mix> mixes;
    std::vector<Texture> textures;
    std::vector<Medium> media;  // what transparent materials fill; empty if none has a priority or absorbs
    MediumStack camera_media;   // where the camera is

    LightTable lights;
    std::vector<uint32_t> mesh_first_light, instance_first_light, sphere_light;  // ids in lights, or none
    uint32_t environment_light = none;
    Color environment{};  // radiance of what no ray hits, where there is no map; else the map holds it
    std::shared_ptr<const EnvironmentMap> environment_map;
    std::shared_ptr<const Background> background;             // adds to either; null if it is but a constant
    std::shared_ptr<const EnvironmentMap> environment_table;  // by which all of it is drawn; null: it is a constant
    bool glow = false;                                        // see glow_of_lights()
    std::vector<PointLight> point_lights;                     // as the description lists them
    std::vector<DirectionalLight> directional_lights;         // likewise

    std::string file;  // of the description
    UnusedFeatures unused_features;
    Normalisation normalisation;
    Bounds bounds;  // of all but planes and giant spheres, scene units

    // Pictures that are still being read; the textures they become stand for 1 until then.
    struct Pending {
        uint32_t texture;
        TextureDescription what;
        RasterFuture image;
    };
    std::vector<Pending> pending;
    struct PendingEnvironment {
        LightDescription what;
        RasterFuture image;
    };
    std::optional<PendingEnvironment> pending_environment;
    struct PendingBackground {
        BackgroundDescription what;
        RasterFuture sky, ground;
    };
    std::optional<PendingBackground> pending_background;
    bool is_complete = false;
    bool has_normals = false;     // some mesh has normals at its corners
    bool has_tables = false;      // some mesh differs_by_triangle()
    bool terminator_fix = false;  // see shading_origin() in surface.cpp
    bool light_tree = true;       // see LightTable::tree
    bool soft_shadows = true;     // else spheres of light shine as from their centres
    bool legacy = false;          // see Switch::legacy

    // Checks what only the whole scene can tell, resolves names, normalises; asks `images` for the pictures that the
    // scene uses, but does not wait for them. Problems go to diagnostics; throws Error if there are any.
    static Scene begin(const SceneDescription& description, Diagnostics& diagnostics, const RasterSource& images = {});
    // Waits for the pictures and makes the textures, then lists the lights. A picture that could not be read is a
    // warning, and its texture stands for 1; but an environment or a background that could not be read would leave
    // the picture black, and is thrown as an Error. Geometry does not change: an accelerator may have been built
    // before.
    void complete(Diagnostics& diagnostics);
    // Both at once.
    static Scene build(const SceneDescription& description, Diagnostics& diagnostics, const RasterSource& images = {});

    uint32_t material_of(const Hit& hit) const
    {
        if (hit.kind == Kind::sphere) return sphere_material[hit.primitive];
        if (hit.kind == Kind::plane) return plane_material[hit.primitive];
        return shading[hit.geometry].material_of(hit.primitive);
    }
    // Whether all light that can be sampled is that of a sky of one colour: drawn by the cosine.
    bool has_constant_environment() const
    {
        return environment_light != none && lights.lights.size() == 1 && !environment_table;
    }
    // Whether what leaves the scene meets the same light everywhere, also as the camera sees it.
    bool has_uniform_background() const { return !environment_map && !background && !glow; }

    // What arrives along a ray that leaves the scene towards `dir` (unit).
    Color radiance_from(Vec3 dir) const;
    // What a ray sees that left the scene and that no light sampling could have found: the same, but for the pattern of
    // the background's ground, which is averaged over the ray's spread; and the glow of lights.
    Color radiance_seen(const Ray& ray, RayCone cone) const;
    // The place as materials see it.
    ShadingPoint shading_point(const Surface& surface) const;
    // The material that scatters at a place where `material` may be a mix. u in [0, 1) decides.
    uint32_t scattering_material(uint32_t material, const ShadingPoint& point, float u) const;

    // What the classic integrators see of a material there; of a mix, mixed.
    Phong phong(uint32_t material, const ShadingPoint& point) const;

    uint64_t triangle_count() const;  // instances not multiplied
};

}  // namespace lancer
