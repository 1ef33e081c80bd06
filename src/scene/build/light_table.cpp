#include "scene/build/light_table.h"

#include <utility>

#include "core/parallel.h"
#include "core/warp.h"
#include "scene/alpha_test.h"
#include "scene/environment/environment.h"
#include "scene/lights/tree.h"

namespace lancer {
namespace {

// Luminance in double, which no radiance overflows.
double power_of(Color c) { return luminance(c.r, c.g, c.b); }

// Lower bound of a textured emitter's power relative to its power without the texture, so that every emitting point can
// be sampled even if the estimate fails.
constexpr double least_emission = 0.01;

// Estimated mean radiance of one side of a triangle for light selection: 16 equal parts, the texture filtered over
// each.
double mean_emission(const Scene& scene, const TriangleLight& light, const ColorParam& radiance)
{
    const double plain = power_of(radiance.value);
    if (radiance.texture == no_texture) return plain;
    const auto uv_at = [&](Vec2 at) {
        const TrianglePoint p = triangle_point(scene, light.instance, light.mesh, light.triangle, at);
        const auto* image = std::get_if<ImageTexture>(&scene.textures[radiance.texture]);
        return image && image->use().by_second_uv ? p.second_uv : p.uv;
    };
    const Vec2 a = uv_at({0, 0}), ab = uv_at({1, 0}) - a, ac = uv_at({0, 1}) - a;
    ShadingPoint part{.uv_width = std::sqrt(std::abs(ab.x * ac.y - ab.y * ac.x) / 32),
                      .textures = scene.textures.data()};
    part.second_uv_width = part.uv_width;
    long double sum = 0;  // exact where all parts are alike: so bright is the same without the texture
    const auto add = [&](float s, float t) {
        part.second_uv = a + ab * (s / 12) + ac * (t / 12), part.uv = part.second_uv;
        sum += std::max(0.0, power_of(part.eval(radiance)));
    };
    for (int i = 0; i < 4; ++i)
        for (int j = 0; i + j < 4; ++j) {
            const auto s = static_cast<float>(3 * i), t = static_cast<float>(3 * j);
            add(s + 1, t + 1);
            if (i + j < 3) add(s + 2, t + 2);
        }
    return std::max(static_cast<double>(sum / 16), least_emission * plain);
}

// Weights of the cells of an EmissionMap: the luminance of the triangle's picture, filtered over quarters of cells. A
// part of the mean is added, as the filter may miss what shines.
std::vector<double> emission_weights(const Scene& scene, const TriangleLight& light, uint32_t side)
{
    constexpr double everywhere = 0.05;
    const uint32_t material = scene.shading[light.mesh].material_of(light.triangle);
    const ColorParam& radiance = scene.emission[material].radiance;
    const auto corner = [&](Vec2 at) {
        return triangle_point(scene, light.instance, light.mesh, light.triangle, at).uv;
    };
    const Vec2 a = corner({0, 0}), ab = corner({1, 0}) - a, ac = corner({0, 1}) - a;
    ShadingPoint part{.uv_width = std::sqrt(std::abs(ab.x * ac.y - ab.y * ac.x) / 8) / static_cast<float>(side),
                      .textures = scene.textures.data()};
    std::vector<double> weights(size_t{side} * side);
    double sum = 0;
    for (uint32_t row = 0; row < 2 * side; ++row)
        for (uint32_t column = 0; column < 2 * side; ++column) {
            const float cells = 0.5f / static_cast<float>(side);
            const Vec2 at = square_to_triangle(
                Vec2{(static_cast<float>(column) + 0.5f) * cells, (static_cast<float>(row) + 0.5f) * cells});
            part.uv = a + ab * at.x + ac * at.y;
            const double opacity = double{opacity_at(scene, material, part)};
            const double w = 0.25 * std::max(0.0, power_of(part.eval(radiance))) * opacity;
            weights[size_t{row / 2} * side + column / 2] += w, sum += w;
        }
    const double mean = sum / static_cast<double>(weights.size());
    for (double& w : weights) w += everywhere * mean;
    return weights;
}

class Lister {
public:
    explicit Lister(Scene& scene) : scene_(scene) {}

    void list()
    {
        const double r = std::max(scene_.bounds.radius(), 1.0);
        disk_ = pi_d * r * r;
        for (const DeltaLight& any : scene_.delta_lights)
            std::visit([&](const auto& light) { add(light, light.power(disk_)); }, any);
        scene_.lights.deltas = next();
        list_spheres();
        list_meshes();
        map_pictures();
        list_environment();
        scene_.lights.pick = Discrete(powers_);
        if (scene_.light_tree) grow_tree();
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
            const Color radiance = e.towards(true, {.textures = scene_.textures.data()});  // without uv: one for all
            add(SphereLight{i}, r * r * 4 * pi_d * pi_d * power_of(radiance) * (e.both_sides ? 2 : 1));
        }
    }
    void list_meshes()
    {
        const auto meshes = static_cast<uint32_t>(scene_.geometry.meshes.size());
        scene_.mesh_first_light.resize(meshes, Scene::none);
        for (uint32_t i = 0; i < meshes; ++i) {
            scene_.shading[i].emitters = emitters_of(i);
            if (!scene_.geometry.meshes[i].instanced)
                scene_.mesh_first_light[i] = add_triangle_lights(Hit::no_instance, i);
        }
        for (uint32_t i = 0; i < scene_.geometry.instances.size(); ++i)
            scene_.instance_first_light.push_back(add_triangle_lights(i, scene_.geometry.instances[i].mesh));
    }
    // The emissive triangles of a mesh; empty if there are none.
    RankedBitset emitters_of(uint32_t mesh) const
    {
        const MeshShading& s = scene_.shading[mesh];
        const auto shines = [&](uint32_t material) { return !scene_.emission[material].is_dark(); };
        if (!s.uses(shines)) return {};
        const size_t triangles = scene_.geometry.meshes[mesh].triangles.size();
        return RankedBitset(static_cast<uint32_t>(triangles), [&](uint32_t t) { return shines(s.material_of(t)); });
    }
    TriangleLight triangle_light(uint32_t instance, uint32_t mesh, uint32_t triangle) const
    {
        const MeshShading& s = scene_.shading[mesh];
        const bool smooth = s.normals.find(scene_.geometry.meshes[mesh], triangle) != nullptr;
        if (smooth || instance != Hit::no_instance) return {instance, mesh, triangle};
        const TriangleInteraction place = triangle_interaction(scene_, instance, mesh, triangle, {});
        return {instance, mesh, triangle, place.n, place.area};
    }
    // Powers are computed in parallel: a scene may have millions of textured emitters.
    uint32_t add_triangle_lights(uint32_t instance, uint32_t mesh)
    {
        const uint32_t first = next();
        const RankedBitset& emitters = scene_.shading[mesh].emitters;
        const size_t triangles = emitters.empty() ? 0 : scene_.geometry.meshes[mesh].triangles.size();
        for (uint32_t i = 0; i < triangles; ++i)
            if (emitters.has(i)) add(triangle_light(instance, mesh, i), 0);
        constexpr uint32_t block = 1024;
        parallel_for((next() - first + block - 1) / block, [&](size_t b) {
            const uint32_t begin = first + static_cast<uint32_t>(b) * block;
            for (uint32_t id = begin; id < std::min(begin + block, next()); ++id) powers_[id] = triangle_power(id);
        });
        return first;
    }
    double triangle_power(uint32_t id) const
    {
        const auto& light = std::get<TriangleLight>(scene_.lights.lights[id]);
        const Emission& e = scene_.emission[scene_.shading[light.mesh].material_of(light.triangle)];
        const double area =
            static_cast<double>(triangle_point(scene_, light.instance, light.mesh, light.triangle, {}).area);
        return area * pi_d * mean_emission(scene_, light, e.radiance) * (e.both_sides ? 2 : 1);
    }
    // Points on a triangle that shows a picture are sampled by its brightness. With many triangles each has a small
    // part of it.
    void map_pictures()
    {
        constexpr size_t most_cells = size_t{1} << 20;
        constexpr uint32_t most_along = 64, least_along = 8;
        constexpr double worthwhile = 0.02;  // relative variance
        std::vector<uint32_t> shown;
        for (uint32_t id = 0; id < next(); ++id)
            if (const auto* light = std::get_if<TriangleLight>(&scene_.lights.lights[id]))
                if (has_picture(*light) && powers_[id] > 0) shown.push_back(id);
        uint32_t side = most_along;
        while (side >= least_along && shown.size() * side * side > most_cells) side /= 2;
        if (side < least_along) return;
        std::vector<std::vector<double>> weights(shown.size());
        parallel_for(shown.size(), [&](size_t i) {
            weights[i] = emission_weights(scene_, std::get<TriangleLight>(scene_.lights.lights[shown[i]]), side);
        });
        for (size_t i = 0; i < shown.size(); ++i) {
            if (!(relative_variance(weights[i]) > worthwhile)) continue;
            std::get<TriangleLight>(scene_.lights.lights[shown[i]]).map =
                static_cast<uint32_t>(scene_.lights.maps.size());
            scene_.lights.maps.emplace_back(weights[i], side);
        }
    }
    bool has_picture(const TriangleLight& light) const
    {
        const uint32_t material = scene_.shading[light.mesh].material_of(light.triangle);
        return scene_.emission[material].radiance.texture != no_texture || scene_.traits[material].has_holes();
    }
    void list_environment()
    {
        const EnvironmentMap* map = scene_.environment_table.get();
        if (map ? !map->is_sampled() : is_black(scene_.environment)) return;
        const bool is_alone = std::all_of(powers_.begin(), powers_.end(), [](double power) { return power == 0; });
        if (!map && !is_alone && scene_.sky_compensation > 0) return;  // all of it is left to BSDF sampling
        scene_.environment_light = next();
        add(EnvironmentLight{}, disk_ * (map ? map->power() : 4 * pi_d * power_of(scene_.environment)));
    }

    // Few lights are selected by power alone: that is cheaper than evaluating their importance.
    void grow_tree()
    {
        constexpr uint32_t many = 64;
        std::vector<uint32_t> far;
        for (uint32_t id = 0; id < next(); ++id)
            if (is_far(scene_.lights.lights[id])) far.push_back(id);
        if (next() - far.size() <= many) return;
        std::vector<LightBounds> bounds(next());
        constexpr uint32_t block = 1024;
        parallel_for((next() + block - 1) / block, [&](size_t b) {
            const uint32_t begin = static_cast<uint32_t>(b) * block;
            for (uint32_t id = begin; id < std::min(begin + block, next()); ++id) {
                const std::optional<LightBounds> own = bounds_of(scene_.lights.lights[id]);
                if (!own) continue;
                bounds[id] = *own;
                bounds[id].power = powers_[id];
            }
        });
        scene_.lights.tree = std::make_shared<const LightTree>(bounds);
        scene_.lights.tree_share = 1;
        for (const uint32_t id : far)
            scene_.lights.tree_share -= static_cast<double>(scene_.lights.pick.probability(id));
        scene_.lights.far = std::move(far);
    }
    static bool is_far(const Light& any)
    {
        return std::visit(
            []<class L>(const L& light) {
                if constexpr (is_delta_light<L>) return !light.bounds();
                return std::is_same_v<L, EnvironmentLight>;
            },
            any);
    }
    // Nothing if it is infinitely far away.
    std::optional<LightBounds> bounds_of(const Light& any) const
    {
        return std::visit([&](const auto& light) { return bounds_of(light); }, any);
    }
    template <class L>
    requires is_delta_light<L>
    static std::optional<LightBounds> bounds_of(const L& light) { return light.bounds(); }
    static std::optional<LightBounds> bounds_of(const EnvironmentLight&) { return {}; }
    std::optional<LightBounds> bounds_of(const SphereLight& light) const
    {
        LightBounds b;
        b.box = bounds(scene_.geometry.spheres[light.sphere]);
        b.normals.angle = pi_d;
        return b;
    }
    std::optional<LightBounds> bounds_of(const TriangleLight& light) const
    {
        const uint32_t material = scene_.shading[light.mesh].material_of(light.triangle);
        LightBounds b;
        b.both_sides = scene_.emission[material].both_sides;
        for (const Vec2 corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}}) {
            const TrianglePoint at = triangle_point(scene_, light.instance, light.mesh, light.triangle, corner);
            b.box.grow(to_double(at.p));
            b.normals.include({to_double(at.n), 0});
        }
        return b;
    }

    Scene& scene_;
    std::vector<double> powers_;  // of each light
    double disk_ = 0;             // area that the scene shows to a light infinitely far away
};

}  // namespace

void build_light_table(Scene& scene) { Lister(scene).list(); }

}  // namespace lancer
