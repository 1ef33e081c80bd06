#include "scene/scene.h"

#include <map>

#include "core/names.h"
#include "scene/placement.h"
#include "scene/surface.h"

namespace lancer {
namespace {

// What lights are weighed by: luminance in double, which no radiance overflows.
double power_of(Color c) { return luminance(c.r, c.g, c.b); }

constexpr double far_limit = 1e15;  // scene units; Embree drops what lies beyond 1.8e18, and squares must stay finite

class Builder {
public:
    Builder(const SceneDescription& d, Diagnostics& diagnostics) : d_(d), diagnostics_(diagnostics), placement_(d) {}

    Scene build()
    {
        add_materials();
        scene_.normalisation = normalise(frame());
        add_spheres();
        add_planes();
        for (uint32_t i = 0; i < d_.meshes.size(); ++i) add_mesh(i);
        add_instances();
        scene_.bounds = transformed(subject_bounds(d_), to_transform(scene_.normalisation));
        add_lights();
        warn();
        diagnostics_.throw_if_errors();
        return std::move(scene_);
    }

private:
    // What the normalisation looks at: the subject, and where there is none, whatever has a place.
    Bounds frame() const
    {
        Bounds b = subject_bounds(d_);
        if (b.extent() > 0) return b;
        for (const auto& l : d_.lights)
            if (l.type == LightType::point) b.grow(l.position);
        if (d_.camera) {
            b.grow(d_.camera->position);
            b.grow(d_.camera->target);
        }
        return b;
    }

    uint32_t add_material(const MaterialDescription& m)
    {
        switch (m.type) {
            case MaterialType::lambert:
                scene_.materials.emplace_back(Lambert{m.base_color});
                break;
            case MaterialType::mirror:
                scene_.materials.emplace_back(Mirror{m.base_color});
                break;
            case MaterialType::glass:
                scene_.materials.emplace_back(Glass{m.base_color, m.ior});
                break;
        }
        scene_.emission.push_back({m.emission, m.emission_both_sides});
        scene_.material_names.push_back(m.name);
        return static_cast<uint32_t>(scene_.materials.size() - 1);
    }
    void add_materials()
    {
        for (const auto& m : d_.materials) by_name_.emplace(m.name, add_material(m));
        used_.resize(d_.materials.size());
    }
    uint32_t default_material()
    {
        if (default_material_ == Scene::none) default_material_ = add_material({.name = "default", .where = {}});
        return default_material_;
    }
    // The id of a named material; an empty name is the default grey, as is an unknown one, so that building goes on to
    // find what else is wrong.
    uint32_t material(const std::string& name, const Location& where)
    {
        if (name.empty()) return default_material();
        if (const auto it = by_name_.find(name); it != by_name_.end()) {
            if (it->second < used_.size()) used_[it->second] = true;
            return it->second;
        }
        std::vector<std::string> known;
        for (const auto& m : d_.materials) known.push_back(m.name);
        diagnostics_.error(where, "unknown material '" + name + "'" + suggestion(name, known));
        return default_material();
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
            const Sphere added = add(s.center, s.radius, material(s.material, s.where));
            check_near(abs(added.center) + Vec3d{added.radius, 0, 0}, s.where, "this sphere");
        }
        for (const auto& l : d_.lights) {
            if (l.type != LightType::sphere || is_black(l.power)) continue;
            const Sphere added =
                add(l.position, l.radius,
                    add_material({.name = "light", .where = l.where, .base_color = {}, .emission = l.power}));
            check_near(abs(added.center) + Vec3d{added.radius, 0, 0}, l.where, "this light");
        }
    }
    void add_planes()
    {
        for (const auto& p : d_.planes) {
            const Vec3d n = normalize(p.normal), point = scene_.normalisation.to_scene(p.point);
            check_near(point, p.where, "this plane");
            scene_.geometry.planes.push_back({n, dot(n, point)});
            scene_.plane_material.push_back(material(p.material, p.where));
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

        Mesh mesh;
        mesh.instanced = instanced;
        mesh.positions.reserve(data.positions.size() + 1);
        for (const Vec3d& p : data.positions) mesh.positions.push_back(to_float(place.point(p)));
        mesh.positions.emplace_back();
        for (const Vec3& p : mesh.positions)
            if (!is_finite(p) || max_component(abs(p)) > static_cast<float>(far_limit)) {
                diagnostics_.error(m.where, "this mesh lies too far from the rest of the scene");
                break;
            }
        mesh.triangles = data.triangles;

        MeshShading shading;
        const Transform back = inverse(place);
        for (const Vec3& n : data.normals)
            shading.normals.push_back(to_float(normalize(back.normal_by_inverse(to_double(n)))));
        shading.normal_triangles = data.normal_triangles;
        // A mirroring map turns the winding round, not the side that a face shows.
        if (place.determinant() < 0) {
            for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
            for (auto& t : shading.normal_triangles) std::swap(t[1], t[2]);
        }
        if (!m.material.empty()) {
            shading.material = material(m.material, m.where);
        } else {
            std::vector<uint32_t> ids;
            for (const auto& description : data.materials) ids.push_back(add_material(description));
            if (ids.size() == 1 || data.face_material.empty()) {
                shading.material = ids.empty() ? material("", m.where) : ids[0];
            } else {
                shading.face_material.reserve(data.face_material.size());
                for (const uint32_t f : data.face_material) shading.face_material.push_back(ids[f]);
            }
        }
        scene_.geometry.meshes.push_back(std::move(mesh));
        scene_.shading.push_back(std::move(shading));
    }
    void add_instances()
    {
        for (const auto& i : d_.instances) {
            const auto it = placement_.by_name.find(i.mesh);
            if (it == placement_.by_name.end()) {
                std::vector<std::string> known;
                for (const auto& m : placement_.by_name) known.push_back(m.first);
                diagnostics_.error(i.where, "unknown mesh '" + i.mesh + "'" + suggestion(i.mesh, known));
                continue;
            }
            const Transform to_file = compose(to_transform(i.transform), to_transform(d_.meshes[it->second].transform));
            const Transform to_world =
                compose(compose(to_transform(scene_.normalisation), to_file), inverse(to_transform(own_[it->second])));
            check_near(to_world.translation, i.where, "this instance");
            scene_.geometry.instances.push_back({it->second, to_world, inverse(to_world)});
        }
    }

    void add_light(const Light& light, double power)
    {
        scene_.lights.lights.push_back(light);
        powers_.push_back(power);
    }
    // The emitting triangles of a mesh, ranked; nothing if there are none.
    std::vector<uint32_t> rank_emitters(uint32_t mesh) const
    {
        const MeshShading& s = scene_.shading[mesh];
        const auto emits = [&](uint32_t triangle) {
            return !is_black(scene_.emission[s.material_of(triangle)].radiance);
        };
        if (s.face_material.empty() && is_black(scene_.emission[s.material].radiance)) return {};
        std::vector<uint32_t> rank(scene_.geometry.meshes[mesh].triangles.size(), Scene::none);
        uint32_t next = 0;
        for (uint32_t i = 0; i < rank.size(); ++i)
            if (emits(i)) rank[i] = next++;
        if (next == 0) rank.clear();
        return rank;
    }
    uint32_t add_triangle_lights(uint32_t instance, uint32_t mesh)
    {
        const auto first = static_cast<uint32_t>(scene_.lights.lights.size());
        const MeshShading& s = scene_.shading[mesh];
        for (uint32_t i = 0; i < s.emitter_rank.size(); ++i) {
            if (s.emitter_rank[i] == Scene::none) continue;
            const Emission& e = scene_.emission[s.material_of(i)];
            const double area = static_cast<double>(triangle_point(scene_, instance, mesh, i, {}).area);
            add_light(TriangleLight{instance, mesh, i}, area * pi_d * power_of(e.radiance) * (e.both_sides ? 2 : 1));
        }
        return first;
    }
    void add_lights()
    {
        const double s2 = scene_.normalisation.scale * scene_.normalisation.scale;
        for (const auto& l : d_.lights) {
            if (l.type == LightType::point && !is_black(l.power)) {
                const Vec3d p = scene_.normalisation.to_scene(l.position);
                check_near(p, l.where, "this light");
                const Color intensity = l.power * static_cast<float>(s2);
                add_light(PointLight{to_float(p), intensity}, 4 * pi_d * power_of(intensity));
            }
            if (l.type == LightType::environment) scene_.environment += l.power;
        }
        for (uint32_t i = 0; i < scene_.geometry.spheres.size(); ++i) {
            const Emission& e = scene_.emission[scene_.sphere_material[i]];
            scene_.sphere_light.push_back(is_black(e.radiance) ? Scene::none
                                                               : static_cast<uint32_t>(scene_.lights.lights.size()));
            if (is_black(e.radiance)) continue;
            const double r = scene_.geometry.spheres[i].radius;
            add_light(SphereLight{i}, r * r * 4 * pi_d * pi_d * power_of(e.radiance) * (e.both_sides ? 2 : 1));
        }
        const auto meshes = static_cast<uint32_t>(scene_.geometry.meshes.size());
        scene_.mesh_first_light.resize(meshes, Scene::none);
        for (uint32_t i = 0; i < meshes; ++i) {
            scene_.shading[i].emitter_rank = rank_emitters(i);
            if (!scene_.geometry.meshes[i].instanced)
                scene_.mesh_first_light[i] = add_triangle_lights(Hit::no_instance, i);
        }
        for (uint32_t i = 0; i < scene_.geometry.instances.size(); ++i)
            scene_.instance_first_light.push_back(add_triangle_lights(i, scene_.geometry.instances[i].mesh));
        if (!is_black(scene_.environment)) {
            scene_.environment_light = static_cast<uint32_t>(scene_.lights.lights.size());
            const double r = std::max(scene_.bounds.radius(), 1.0);
            add_light(EnvironmentLight{}, r * r * 4 * pi_d * pi_d * power_of(scene_.environment));
        }
        scene_.lights.pick = Discrete(powers_);
    }

    void warn()
    {
        bool emits = scene_.environment_light != Scene::none || !scene_.lights.lights.empty();
        for (const uint32_t m : scene_.plane_material) emits = emits || !is_black(scene_.emission[m].radiance);
        if (!emits) diagnostics_.warning({d_.file, 0, 0}, "nothing emits light: the picture will be black");
        for (size_t i = 0; i < d_.materials.size(); ++i)
            if (!used_[i])
                diagnostics_.warning(d_.materials[i].where, "material '" + d_.materials[i].name + "' is not used");
    }

    const SceneDescription& d_;
    Diagnostics& diagnostics_;
    Placement placement_;
    Scene scene_;
    std::map<std::string, uint32_t> by_name_;
    std::vector<bool> used_;
    std::vector<Normalisation> own_;  // of each mesh
    std::vector<double> powers_;      // of each light
    uint32_t default_material_ = Scene::none;
};

}  // namespace

Scene Scene::build(const SceneDescription& description, Diagnostics& diagnostics)
{
    return Builder(description, diagnostics).build();
}

uint64_t Scene::triangle_count() const
{
    uint64_t n = 0;
    for (const Mesh& m : geometry.meshes) n += m.triangles.size();
    return n;
}

}  // namespace lancer
