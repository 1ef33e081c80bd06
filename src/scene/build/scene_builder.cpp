#include "scene/build/scene_builder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/names.h"
#include "core/srgb.h"
#include "scene/alpha_test.h"
#include "scene/build/divide_meshes.h"
#include "scene/build/fold.h"
#include "scene/build/light_group.h"
#include "scene/build/material_table.h"
#include "scene/build/media.h"
#include "scene/build/mesh_tables.h"
#include "scene/build/mikk_tangents.h"
#include "scene/build/receive_environment.h"
#include "scene/build/relight.h"
#include "scene/build/shapes.h"
#include "scene/build/texture_table.h"
#include "scene/build/thin_glass.h"
#include "scene/environment/environment.h"

namespace lancer {
namespace {

constexpr double far_limit = 1e15;  // scene units; Embree drops what lies beyond 1.8e18, and squares must stay finite

// See Scene::sky_compensation. The factor was fitted on rooms and streets under photographed skies; from 1 to 4 the
// error differs by less than a tenth. Only where multiple importance sampling makes up for what is left out.
double sky_compensation(const RenderSettings& s)
{
    const bool is_path = s.integrator == IntegratorKind::path || s.integrator == IntegratorKind::direct;
    return s.mis_compensation && is_path && !s.legacy && s.nee && s.mis ? 2 : 0;
}

// One run over a description: fills a scene and what is still missing of it.
class Builder {
public:
    Builder(const SceneDescription& d, const RenderSettings& settings, Diagnostics& diagnostics,
            const RasterSource& images, Scene& scene, PendingPictures& pending)
        : d_(d),
          diagnostics_(diagnostics),
          images_(images),
          placement_(d),
          scene_(scene),
          pending_(pending),
          integrator_(settings.integrator),
          compact_(settings.compact),
          materials_(d, settings, scene, pending.textures, diagnostics, images)
    {
        scene_.terminator_fix = settings.terminator;
        scene_.soft_shadows = settings.soft_shadows;
        scene_.straight_shadows = settings.straight_shadows;
        scene_.light_tree = settings.light_tree;
        scene_.sky_compensation = sky_compensation(settings);
        scene_.legacy = settings.legacy;
    }

    void build()
    {
        scene_.file = d_.file;
        scene_.normalisation = normalise(frame());
        add_spheres();
        add_planes();
        for (uint32_t i = 0; i < d_.meshes.size(); ++i) add_mesh(i);
        add_instances();
        end_paths();
        if (!scene_.legacy) make_thin_glass(d_, places_, materials_, scene_, diagnostics_);
        scene_.bounds = transformed(subject_bounds(d_), to_transform(scene_.normalisation));
        add_given_lights();
        if (d_.background) add_background(*d_.background);
        if (d_.fog) add_fog(*d_.fog, d_.lights, integrator_, scene_, diagnostics_);
        materials_.finish();
        diagnostics_.throw_if_errors();
    }

private:
    // What the normalisation looks at: the subject, and where there is none, whatever has a place.
    Bounds frame() const
    {
        Bounds b = subject_bounds(d_);
        if (b.extent() > 0) return b;
        for (const auto& l : d_.lights)
            for_each_parameter_of(l.type, [&](const auto& row) {
                if (row.key == "position") b.grow(l.position);
            });
        if (d_.camera) {
            b.grow(d_.camera->position);
            b.grow(d_.camera->target);
        }
        return b;
    }

    void check_near(Vec3d p, const Location& where, const char* what)
    {
        if (!is_finite(p) || max_component(abs(p)) > far_limit)
            diagnostics_.error(where, std::string(what) + " lies too far from the rest of the scene");
    }
    void add_spheres()
    {
        const auto add = [&](Vec3d center, double radius, uint32_t material) {
            scene_.geometry.spheres.push_back(
                {scene_.normalisation.to_scene(center), radius * scene_.normalisation.scale});
            scene_.sphere_material.push_back(material);
            return scene_.geometry.spheres.back();
        };
        for (const auto& s : d_.spheres) {
            const Sphere added = add(s.center, s.radius, material_of(s, materials_, diagnostics_));
            check_near(abs(added.center) + Vec3d{added.radius, 0, 0}, s.where, "this sphere");
            add_path(s);
        }
        for (const auto& l : d_.lights) {
            if (l.type != LightType::sphere || is_black(l.power)) continue;
            const Sphere added =
                add(l.position, l.radius,
                    materials_.add(
                        {.name = "light", .where = l.where, .base_color = {}, .emission = l.power, .group = l.group}));
            check_near(abs(added.center) + Vec3d{added.radius, 0, 0}, l.where, "this light");
        }
    }
    // Of the sphere that was added last.
    void add_path(const SphereDescription& s)
    {
        Steps<Sphere> steps = steps_of(s, scene_.normalisation);
        if (steps.empty()) return;
        if (shines(scene_.sphere_material.back())) return warn_of_still_light(s.where);
        for (const Sphere& at : steps) check_near(abs(at.center) + Vec3d{at.radius, 0, 0}, s.where, "this sphere");
        scene_.geometry.motion.spheres.resize(scene_.geometry.spheres.size());
        scene_.geometry.motion.spheres.back() = std::move(steps);
    }
    bool shines(uint32_t material) const { return !scene_.emission[material].is_dark(); }
    void warn_of_still_light(const Location& where)
    {
        diagnostics_.warning(where,
                             "what shines is not blurred by its motion: it stays where it is when the shutter "
                             "opens");
    }
    void add_planes()
    {
        for (const auto& p : d_.planes) {
            const Vec3d n = normalize(p.normal), point = scene_.normalisation.to_scene(p.point);
            check_near(point, p.where, "this plane");
            scene_.geometry.planes.push_back({n, dot(n, point)});
            scene_.plane_material.push_back(material_of(p, scene_.legacy, materials_));
            scene_.plane_maps.push_back(make_plane_map(p));
        }
    }
    void add_mesh(uint32_t index)
    {
        const MeshDescription& m = d_.meshes[index];
        const MeshData& data = *m.data;
        const bool instanced = placement_.instanced[index];
        // An instanced mesh is kept in a frame of its own, as near to 1 as the scene is.
        const Normalisation own = instanced ? normalise(bounds_of(data)) : Normalisation{};
        const Transform place =
            instanced ? to_transform(own) : compose(to_transform(scene_.normalisation), to_transform(m.transform));
        own_.push_back(own);
        places_.push_back(place);

        Mesh mesh;
        mesh.instanced = instanced;
        MeshShading shading;
        if (m.bands) {
            shading.material = materials_.banded(m.material, *m.bands, TextureType::rim, m.where);
        } else if (!m.material.empty()) {
            shading.material = materials_.named(m.material, m.where);
        } else {
            std::vector<uint32_t> ids;
            for (const auto& description : data.materials) ids.push_back(materials_.add_from_file(description));
            if (ids.size() == 1 || data.face_material.empty()) {
                shading.material = ids.empty() ? materials_.named("", m.where) : ids[0];
            } else {
                std::vector<uint32_t> of_faces(data.face_material.size());
                std::transform(data.face_material.begin(), data.face_material.end(), of_faces.begin(),
                               [&](uint32_t f) { return ids[f]; });
                set_materials(shading, of_faces);
            }
        }
        fill_tables(data, place, linear_colors(data, m.vertex_colors),
                    m.vertex_colors == VertexColors::none ? std::vector<float>{} : data.alphas, scene_.traits, mesh,
                    shading, scene_.unused_features);
        if (compact_) pack_normals(mesh, shading.normals);
        if (data.second_uvs.empty() && shading.uses([&](uint32_t id) { return scene_.traits[id].reads_second_uv; }))
            diagnostics_.warning(m.where,
                                 "a texture of 'uv_set = 1' is on a mesh that has one set of texture "
                                 "coordinates, which is used");
        for (size_t i = 0; i < mesh.vertices(); ++i)
            if (const Vec3& p = mesh.vertex(i);
                !is_finite(p) || max_component(abs(p)) > static_cast<float>(far_limit)) {
                diagnostics_.error(m.where, "this mesh lies too far from the rest of the scene");
                break;
            }
        // A mirroring map turns the winding round, not the side that a face shows.
        if (place.determinant() < 0)
            for (auto* triangles : {&mesh.triangles, &shading.normals.triangles, &shading.uv_triangles.all(),
                                    &shading.tangents.triangles.all()})
                for (auto& t : *triangles) std::swap(t[1], t[2]);
        scene_.has_normals |= !shading.normals.empty();
        scene_.geometry.meshes.push_back(std::move(mesh));
        scene_.shading.push_back(std::move(shading));
        scene_.mesh_names.push_back(own_name(m));
    }
    // The second of a name is called "NAME.2".
    std::string own_name(const MeshDescription& m)
    {
        std::string name = m.name;
        if (name.empty())
            name = m.data->file.empty() ? m.data->shape : std::filesystem::path(m.data->file).stem().string();
        std::string own = name;
        size_t& count = mesh_name_counts_[name];
        for (++count; !mesh_names_.insert(own).second; ++count) own = name + "." + std::to_string(count);
        return own;
    }
    static std::vector<Color> linear_colors(const MeshData& data, VertexColors meaning)
    {
        if (meaning == VertexColors::none) return {};
        std::vector<Color> colors = data.colors;
        if (meaning == VertexColors::linear) return colors;
        const auto decoded = [](float x) { return static_cast<float>(linear_from_srgb(static_cast<double>(x))); };
        for (Color& c : colors) c = {decoded(c.r), decoded(c.g), decoded(c.b)};
        return colors;
    }
    void add_instance(uint32_t mesh, const TransformDescription& transform, const Location& where)
    {
        const Transform to_world = placed(mesh, transform, d_.meshes[mesh].transform);
        check_near(to_world.translation, where, "this instance");
        scene_.geometry.instances.push_back({mesh, to_world, inverse(to_world)});
    }
    void add_instances()
    {
        scene_.geometry.instances.reserve(instance_count(d_));
        for (const auto& i : d_.instances) {
            const auto it = placement_.by_name.find(i.mesh);
            if (it == placement_.by_name.end()) {
                std::vector<std::string> known;
                for (const auto& m : placement_.by_name) known.push_back(m.first);
                diagnostics_.error(i.where, "unknown mesh '" + i.mesh + "'" + suggestion(i.mesh, known));
                continue;
            }
            const uint32_t mesh = it->second;
            add_instance(mesh, i.transform, i.where);
            add_path(i, mesh);
            for (const TransformDescription& t : i.more) add_instance(mesh, t, i.where);
        }
    }
    // The tables of paths are as long as those of the shapes, or empty.
    void end_paths()
    {
        Geometry& g = scene_.geometry;
        if (!g.motion.spheres.empty()) g.motion.spheres.resize(g.spheres.size());
        if (!g.motion.instances.empty()) g.motion.instances.resize(g.instances.size());
    }
    // Of an instance, from the mesh's own space to the scene's.
    Transform placed(uint32_t mesh, const TransformDescription& own, const TransformDescription& of_mesh) const
    {
        const Transform to_file = compose(to_transform(own), to_transform(of_mesh));
        return compose(compose(to_transform(scene_.normalisation), to_file), inverse(to_transform(own_[mesh])));
    }
    // Of the instance that was added last.
    void add_path(const InstanceDescription& i, uint32_t mesh)
    {
        const MeshDescription& m = d_.meshes[mesh];
        Steps<Transform> steps;
        for (size_t k = 0; k < std::max(i.path.size(), m.path.size()); ++k)
            steps.push_back(
                placed(mesh, i.path.empty() ? i.transform : i.path[k], m.path.empty() ? m.transform : m.path[k]));
        if (stand_still(steps)) return;
        if (scene_.shading[mesh].uses([&](uint32_t id) { return shines(id); })) return warn_of_still_light(i.where);
        for (const Transform& at : steps) check_near(at.translation, i.where, "this instance");
        scene_.geometry.motion.instances.resize(scene_.geometry.instances.size());
        scene_.geometry.motion.instances.back() = std::move(steps);
    }

    void add_given_lights()
    {
        for (const auto& l : d_.lights) {
            if (is_black(l.power)) {
                scene_.unused_features.add("lights without power", 1);
                continue;
            }
            for_each_parameter_of(l.type, [&](const auto& row) {
                if (row.key == "position") check_near(scene_.normalisation.to_scene(l.position), l.where, "this light");
            });
            if (l.type == LightType::environment) add_environment(l);
        }
        list_delta_lights(d_, scene_, diagnostics_);
    }
    // Constant ones add up; of pictures there can be one.
    void add_environment(const LightDescription& l)
    {
        add_to_sky(l.group, l.where);
        if (l.file.empty()) {
            scene_.environment += l.power;
        } else if (pending_.environment) {
            diagnostics_.error(l.where, "a second environment with a file; the first stands at " +
                                            to_string(pending_.environment->what.where));
        } else {
            pending_.environment = {l, images_ ? images_(l.file) : RasterFuture{}};
        }
    }

    // All light from outside of the scene is one, and of one group.
    void add_to_sky(const std::string& group, const Location& where)
    {
        const uint8_t index = light_group(scene_, group, where, diagnostics_);
        if (sky_ && scene_.light_groups.of_sky != index)
            diagnostics_.error(where, "all environments and the background are of one group; the first is stated at " +
                                          to_string(*sky_));
        if (!sky_) scene_.light_groups.of_sky = index, sky_ = where;
    }

    void add_background(const BackgroundDescription& b)
    {
        scene_.glow = b.glow;
        add_to_sky(b.group, b.where);
        if (b.sky == SkyType::color && b.ground == GroundType::none) {
            scene_.environment += b.sky_color * b.strength;
            return;
        }
        const auto ask = [&](const BackgroundPicture& p) {
            return p.file.empty() || !images_ ? RasterFuture{} : images_(p.file);
        };
        pending_.background = {b, ask(b.sky_picture), ask(b.ground_picture)};
    }

    const SceneDescription& d_;
    Diagnostics& diagnostics_;
    const RasterSource& images_;
    Placement placement_;
    Scene& scene_;
    PendingPictures& pending_;
    IntegratorKind integrator_;
    bool compact_;
    MaterialTable materials_;
    std::vector<Normalisation> own_;  // of each mesh
    std::set<std::string> mesh_names_;
    std::map<std::string, size_t> mesh_name_counts_;
    std::vector<Transform> places_;  // likewise, from its units to those of its positions
    std::optional<Location> sky_;    // where the first light from outside of the scene stands
};

}  // namespace

SceneBuilder::SceneBuilder(const SceneDescription& description, const RenderSettings& settings,
                           Diagnostics& diagnostics, const RasterSource& images, PictureMemory memory)
    : scene_(std::make_unique<Scene>()), memory_(std::move(memory)), texture_limit_(settings.texture_limit)
{
    const std::optional<SceneDescription> divided =
        divide_meshes(description, settings, images, memory_, scene_->divisions, diagnostics);
    Builder(divided ? *divided : description, settings, diagnostics, images, *scene_, pending_).build();
    bind_alpha_test(*scene_);
}

bool SceneBuilder::may_have_emitters() const
{
    return scene_->has_emitters() || pending_.environment || pending_.background;
}

void SceneBuilder::complete(Diagnostics& diagnostics)
{
    Scene& s = *scene_;
    check_picture_memory(pending_, memory_, texture_limit_);
    receive_textures(s, std::exchange(pending_.textures, {}), memory_, texture_limit_, diagnostics);
    share_texels(s);
    fold_constants(s);
    drop_unread_uvs(s);
    add_mikk_tangents(s);
    if (pending_.environment) receive_environment(s, *std::exchange(pending_.environment, {}), memory_, diagnostics);
    if (pending_.background)
        receive_background(s, *std::exchange(pending_.background, {}), memory_, texture_limit_, diagnostics);
    diagnostics.throw_if_errors();
    list_lights(s);
    mark_dark_media(s);
    s.has_tables =
        std::any_of(s.shading.begin(), s.shading.end(), [](const auto& mesh) { return mesh.differs_by_triangle(); });
    // Light sampling may leave all of an environment to BSDF sampling.
    bool emits = !s.lights.lights.empty() || (s.environment_table && !s.environment_table->is_black());
    for (const uint32_t m : s.plane_material) emits = emits || !s.emission[m].is_dark();
    if (!emits) diagnostics.warning({s.file, 0, 0}, "nothing emits light: the picture will be black");
    if (s.ignores_scattering)
        diagnostics.warning({s.file, 0, 0},
                            "this integrator follows no light that media scatter: fog and bodies only absorb");
}

std::unique_ptr<const Scene> SceneBuilder::finish(Diagnostics& diagnostics)
{
    complete(diagnostics);
    return std::move(scene_);
}

Scene SceneBuilder::finish_by_value(Diagnostics& diagnostics)
{
    complete(diagnostics);
    scene_->geometry.alpha_test = {};  // which refer to where it stands
    return std::move(*std::exchange(scene_, nullptr));
}

}  // namespace lancer
