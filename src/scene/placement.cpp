#include "scene/placement.h"

#include <algorithm>

namespace lancer {
namespace {

double power_of_two_scale(double extent) { return extent > 0 ? std::ldexp(1.0, -std::ilogb(extent)) : 1; }

}  // namespace

Normalisation normalise(const Bounds& b)
{
    if (b.empty()) return {};
    const bool far = max_component(abs(b.center())) > 8 * b.extent();
    return {far ? b.center() : Vec3d{},
            power_of_two_scale(b.extent() > 0 ? b.extent() : max_component(abs(b.center())))};
}

Transform to_transform(const Normalisation& n)
{
    return {{n.scale, 0, 0}, {0, n.scale, 0}, {0, 0, n.scale}, -n.center * n.scale};
}

Steps<Sphere> steps_of(const SphereDescription& sphere, const Normalisation& normalisation)
{
    Steps<Sphere> steps;
    for (const auto& place : sphere.path)
        steps.push_back({normalisation.to_scene(place.center), place.radius * normalisation.scale});
    return stand_still(steps) ? Steps<Sphere>{} : steps;
}

Bounds bounds_of(const MeshData& data)
{
    Bounds b;
    for (const Vec3d& p : data.positions) b.grow(p);
    return b;
}

Bounds transformed(const Bounds& b, const Transform& m)
{
    Bounds out;
    if (b.empty()) return out;
    for (int corner = 0; corner < 8; ++corner)
        out.grow(m.point({corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y,
                          corner & 4 ? b.upper.z : b.lower.z}));
    return out;
}

std::vector<Bounds> bounds_of_instanced(const SceneDescription& d, const Placement& placement)
{
    std::vector<Bounds> all(d.meshes.size());
    for (size_t i = 0; i < all.size(); ++i)
        if (placement.instanced[i]) all[i] = bounds_of(*d.meshes[i].data);
    return all;
}

Transform to_transform(const TransformDescription& t) { return make_transform(t.translate, t.rotate_deg, t.scale); }

Bounds subject_bounds(const SceneDescription& d)
{
    Bounds b;
    const Placement placement(d);
    for (size_t i = 0; i < d.meshes.size(); ++i)
        if (!placement.instanced[i]) {
            const Transform m = to_transform(d.meshes[i].transform);
            for (const Vec3d& p : d.meshes[i].data->positions) b.grow(m.point(p));
        }
    const std::vector<Bounds> of_meshes = bounds_of_instanced(d, placement);
    for (const auto& i : d.instances)
        if (const auto it = placement.by_name.find(i.mesh); it != placement.by_name.end()) {
            const MeshDescription& mesh = d.meshes[it->second];
            const Transform of_mesh = to_transform(mesh.transform);
            i.for_each([&](const TransformDescription& t) {
                b.grow(transformed(of_meshes[it->second], compose(to_transform(t), of_mesh)));
            });
        }
    // Spheres from small to large; one that dwarfs all before it is a wall or a sky, not part of the subject.
    std::vector<Sphere> spheres;
    for (const auto& s : d.spheres) spheres.push_back({s.center, s.radius});
    for (const auto& l : d.lights)
        if (l.type == LightType::sphere) spheres.push_back({l.position, l.radius});
    std::stable_sort(spheres.begin(), spheres.end(),
                     [](const Sphere& x, const Sphere& y) { return x.radius < y.radius; });
    for (const Sphere& s : spheres) {
        if (b.extent() > 0 && s.radius > 32 * b.extent()) break;
        b.grow(bounds(s));
    }
    return b;
}

}  // namespace lancer
