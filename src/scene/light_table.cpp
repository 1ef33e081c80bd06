#include "scene/light_table.h"

namespace lancer {
namespace {

// What lights are weighed by: luminance in double, which no radiance overflows.
double power_of(Color c) { return luminance(c.r, c.g, c.b); }

class Lister {
public:
    explicit Lister(Scene& scene) : scene_(scene) {}

    void list()
    {
        for (const PointLight& light : scene_.point_lights) add(light, 4 * pi_d * power_of(light.intensity));
        list_spheres();
        list_meshes();
        list_environment();
        scene_.lights.pick = Discrete(powers_);
    }

private:
    uint32_t next() const { return static_cast<uint32_t>(scene_.lights.lights.size()); }
    void add(const Light& light, double power)
    {
        scene_.lights.lights.push_back(light);
        powers_.push_back(power);
    }
    void list_spheres()
    {
        for (uint32_t i = 0; i < scene_.geometry.spheres.size(); ++i) {
            const Emission& e = scene_.emission[scene_.sphere_material[i]];
            scene_.sphere_light.push_back(e.is_dark() ? Scene::none : next());
            if (e.is_dark()) continue;
            const double r = scene_.geometry.spheres[i].radius;
            add(SphereLight{i}, r * r * 4 * pi_d * pi_d * power_of(e.radiance.value) * (e.both_sides ? 2 : 1));
        }
    }
    void list_meshes()
    {
        const auto meshes = static_cast<uint32_t>(scene_.geometry.meshes.size());
        scene_.mesh_first_light.resize(meshes, Scene::none);
        for (uint32_t i = 0; i < meshes; ++i) {
            scene_.shading[i].emitter_rank = rank_emitters(i);
            if (!scene_.geometry.meshes[i].instanced)
                scene_.mesh_first_light[i] = add_triangle_lights(Hit::no_instance, i);
        }
        for (uint32_t i = 0; i < scene_.geometry.instances.size(); ++i)
            scene_.instance_first_light.push_back(add_triangle_lights(i, scene_.geometry.instances[i].mesh));
    }
    // The emitting triangles of a mesh, ranked; nothing if there are none.
    std::vector<uint32_t> rank_emitters(uint32_t mesh) const
    {
        const MeshShading& s = scene_.shading[mesh];
        const auto emits = [&](uint32_t triangle) { return !scene_.emission[s.material_of(triangle)].is_dark(); };
        if (s.face_material.empty() && scene_.emission[s.material].is_dark()) return {};
        std::vector<uint32_t> rank(scene_.geometry.meshes[mesh].triangles.size(), Scene::none);
        uint32_t next = 0;
        for (uint32_t i = 0; i < rank.size(); ++i)
            if (emits(i)) rank[i] = next++;
        if (next == 0) rank.clear();
        return rank;
    }
    uint32_t add_triangle_lights(uint32_t instance, uint32_t mesh)
    {
        const uint32_t first = next();
        const MeshShading& s = scene_.shading[mesh];
        for (uint32_t i = 0; i < s.emitter_rank.size(); ++i) {
            if (s.emitter_rank[i] == Scene::none) continue;
            const Emission& e = scene_.emission[s.material_of(i)];
            const double area = static_cast<double>(triangle_point(scene_, instance, mesh, i, {}).area);
            add(TriangleLight{instance, mesh, i}, area * pi_d * power_of(e.radiance.value) * (e.both_sides ? 2 : 1));
        }
        return first;
    }
    void list_environment()
    {
        if (is_black(scene_.environment)) return;
        scene_.environment_light = next();
        const double r = std::max(scene_.bounds.radius(), 1.0);
        add(EnvironmentLight{}, r * r * 4 * pi_d * pi_d * power_of(scene_.environment));
    }

    Scene& scene_;
    std::vector<double> powers_;  // of each light
};

}  // namespace

void build_light_table(Scene& scene) { Lister(scene).list(); }

}  // namespace lancer
