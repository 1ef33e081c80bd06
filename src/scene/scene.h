// The scene as rendered: arrays and indices in normalised units. It is built once and constant while rendering.
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
#include "materials/material_variant.h"
#include "materials/medium.h"
#include "materials/phong.h"
#include "materials/traits.h"
#include "scene/corner_normals.h"
#include "scene/corner_table.h"
#include "scene/corner_tangents.h"
#include "scene/description/description.h"
#include "scene/fog.h"
#include "scene/lights/groups.h"
#include "scene/lights/light.h"
#include "scene/placement.h"
#include "scene/planar_mirror.h"
#include "scene/specialisation.h"
#include "scene/surface.h"

namespace lancer {

// Shading data of a mesh, beside its geometry.
struct MeshShading {
    CornerNormals normals;            // empty if the mesh is flat
    std::vector<Vec2> uvs;            // empty unless a texture uses them
    std::vector<Vec2> second_uvs;     // parallel to uvs; empty unless a texture uses them
    CornerTable uv_triangles;         // of the triangles that have uvs and use them
    CornerTangents tangents;          // of those whose material reads them
    CompactIndexArray face_material;  // per triangle; empty if the mesh has one material
    std::vector<Color> colors;        // of the vertices, linear; empty if the mesh has none
    std::vector<float> alphas;        // of the vertices, factors of the opacity; empty if all are 1
    uint32_t material = 0;
    RankedBitset emitters;  // its emissive triangles, whose lights have consecutive ids in the same order; empty if
                            // there are none

    std::vector<uint8_t> mirror_of;  // per triangle: see Scene::mirror_at(); empty if none is part of a mirror

    uint32_t material_of(uint32_t triangle) const { return face_material.empty() ? material : face_material[triangle]; }
    // Whether holds(material) is true for any material of the mesh.
    template <class Holds>
    bool uses(const Holds& holds) const
    {
        return face_material.empty() ? holds(material) : face_material.any(holds);
    }
    // Whether shading reads data that differ between its triangles.
    bool differs_by_triangle() const { return !(normals.empty() && uvs.empty() && face_material.empty()); }
};

class Background;
class EnvironmentMap;
class SceneBuilder;

struct Scene {
    static constexpr uint32_t none = UINT32_MAX;

    // They stand in scene.cpp, which knows the materials.
    Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    Geometry geometry;
    std::vector<MeshShading> shading;     // parallel to geometry.meshes
    std::vector<std::string> mesh_names;  // likewise: as the description names them, else of their files; each differs
    std::vector<uint32_t> sphere_material, plane_material;
    std::vector<PlaneMap> plane_maps;  // parallel to geometry.planes

    std::vector<Material> materials;
    std::vector<Emission> emission;      // parallel to materials
    std::vector<MaterialTraits> traits;  // parallel to materials
    std::vector<std::string> material_names;
    std::vector<uint32_t> mix_of;  // index in `mixes` of each material, or none; empty if there are no mixes
    std::vector<Mix> mixes;
    std::vector<Texture> textures;
    std::vector<Medium>
        media;  // inside transparent materials, and fog; empty if none has a priority, absorbs or scatters
    MediumStack camera_media;         // media around the camera
    Fog fog;                          // around all bodies
    bool scatters = false;            // some medium scatters
    bool passes_bare = false;         // some medium has a surface that shadow rays pass: Medium::is_bare
    bool ignores_scattering = false;  // the integrator knows absorption alone: media that would scatter do not

    LightTable lights;
    LightGroups light_groups;
    std::vector<uint32_t> mesh_first_light, instance_first_light, sphere_light;  // ids in lights, or none
    uint32_t environment_light = none;
    Color environment{};  // constant radiance of the environment, if there is no map
    std::shared_ptr<const EnvironmentMap> environment_map;
    std::shared_ptr<const Background> background;             // added to both; null if it is constant
    std::shared_ptr<const EnvironmentMap> environment_table;  // sampling table of all of it; null: it is constant
    bool glow = false;                                        // see glow_of_lights()
    std::vector<DeltaLight> delta_lights;                     // type by type, as the description lists them

    std::vector<PlanarMirror> mirrors;  // at most 255
    // Per triangle of each instance, as MeshShading::mirror_of; empty if no instance has a mirror.
    std::vector<std::vector<uint8_t>> instance_mirror_of;

    std::string file;  // of the description
    UnusedFeatures unused_features;
    // What building took for thin sheets, in words, and how long each look at the whole scene took. For reports only.
    struct Note {
        Location where;
        std::string text;
    };
    std::vector<Note> sheets;
    std::vector<Note> divisions;  // of meshes, in words
    struct Analysis {
        std::string name;
        double seconds = 0;
    };
    std::vector<Analysis> analyses;
    Normalisation normalisation;
    Bounds bounds;  // of all but planes and giant spheres, scene units

    bool has_normals = false;     // some mesh has corner normals
    bool has_tables = false;      // some mesh differs_by_triangle()
    bool terminator_fix = false;  // see shading_origin() in surface.cpp
    // Of an environment light sampling leaves to BSDF sampling what is darker than this times its mean; 0: nothing.
    double sky_compensation = 0;
    bool light_tree = true;         // see LightTable::tree
    bool passes_glass = false;      // see lights_pass_glass()
    bool straight_shadows = false;  // see through_glass()
    bool soft_shadows = true;       // else sphere lights are sampled at their centres
    bool legacy = false;            // see RenderSettings::legacy

    // Starts to build a scene: checks it, resolves names, normalises, and requests from `images` the pictures that the
    // scene uses, without waiting for them. settings: resolved; [render] of the description is not used. Problems go to
    // diagnostics; throws Error if there are errors.
    static SceneBuilder begin(const SceneDescription& description, const RenderSettings& settings,
                              Diagnostics& diagnostics, const RasterSource& images = {});
    // begin() and SceneBuilder::finish().
    static Scene build(const SceneDescription& description, const RenderSettings& settings, Diagnostics& diagnostics,
                       const RasterSource& images = {});

    // Of a material that is no mix.
    MaterialType type_of(uint32_t material) const;
    // Whether some light goes through it, refracted or straight on; of any material.
    bool lets_through(uint32_t material) const;
    bool lets_through() const;
    uint32_t material_of(const Hit& hit) const
    {
        if (hit.kind == Kind::sphere) return sphere_material[hit.primitive];
        if (hit.kind == Kind::plane) return plane_material[hit.primitive];
        return shading[hit.geometry].material_of(hit.primitive);
    }
    // The group, as its index in LightGroups::names, of a light of the table, or of what a ray hit or, where it hit
    // nothing, of the sky. none: the sky.
    uint8_t group_of_light(uint32_t light) const;
    uint8_t group_of(const Hit& hit) const
    {
        return hit ? light_groups.of_material[material_of(hit)] : light_groups.of_sky;
    }
    // The mirror that a ray has hit, as its index in `mirrors` plus 1; else 0.
    uint8_t mirror_at(const Hit& hit) const
    {
        if (hit.kind != Kind::triangle) return 0;
        const bool is_placed = hit.instance != Hit::no_instance;
        if (is_placed && instance_mirror_of.empty()) return 0;
        const std::vector<uint8_t>& of = is_placed ? instance_mirror_of[hit.instance] : shading[hit.geometry].mirror_of;
        return of.empty() ? uint8_t{0} : of[hit.primitive];
    }
    // Whether the only light is a constant environment, which is sampled by the cosine.
    bool has_constant_environment() const
    {
        return environment_light != none && lights.lights.size() == 1 && !environment_table;
    }
    // Whether any light comes from outside of the scene, listed in `lights` or not.
    bool has_sky() const { return environment_table || !is_black(environment); }
    // Whether there is a delta light or a material that emits.
    bool has_emitters() const;
    // Whether some material catches shadows.
    bool catches_shadows() const;
    // Whether all rays that leave the scene have the same radiance, camera rays included.
    bool has_uniform_background() const { return !environment_map && !background && !glow; }

    // Radiance of a ray that leaves the scene towards `dir` (unit), as light sampling sees it.
    Color radiance_from(Vec3 dir) const;
    // Radiance of a ray that left the scene and that light sampling does not cover: the same with the background's
    // ground filtered by the ray's cone, and the glow of lights.
    Color radiance_seen(const Ray& ray, RayCone cone) const;
    // What materials know of a surface point.
    ShadingPoint shading_point(const Surface& surface) const;
    // The scattering material at a point whose `material` may be a mix; u in [0, 1) selects.
    uint32_t scattering_material(uint32_t material, const ShadingPoint& point, float u) const;

    // Phong parameters of a material for the classic integrators; of a mix, mixed.
    Phong phong(uint32_t material, const ShadingPoint& point) const;

    uint64_t triangle_count() const;  // instanced meshes count once
};

}  // namespace lancer
