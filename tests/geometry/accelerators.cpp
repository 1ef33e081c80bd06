#include "geometry/accelerators.h"

namespace lancer {

Geometry random_geometry(uint64_t seed)
{
    Random random(seed);
    Geometry g;
    g.meshes.push_back(
        to_mesh(*make_uv_sphere(8, 12, 0.2), make_transform({0.5, 0, 0}, {20, 30, 40}, {0.7, 0.7, 0.7})));
    Mesh soup;
    for (uint32_t i = 0; i < 60; ++i) {
        const Vec3d at = random.point(-2, 2);
        for (uint32_t k = 0; k < 3; ++k) soup.positions.push_back(to_float(at + random.point(-0.5, 0.5)));
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    soup.positions.emplace_back();
    g.meshes.push_back(std::move(soup));
    g.meshes.push_back(to_mesh(*make_uv_sphere(6, 8, 0.1)));
    g.meshes.push_back(to_mesh(*make_cube()));
    g.meshes[2].instanced = g.meshes[3].instanced = true;
    for (uint32_t i = 0; i < 5; ++i) {
        Vec3d scale = random.point(0.1, 0.8);
        if (i % 2) scale.y = -scale.y;
        const Vec3d move = random.point(-2, 2), turn_deg = random.point(-180, 180);
        g.instances.push_back(make_instance(2 + i % 2, make_transform(move, turn_deg, scale)));
    }
    for (int i = 0; i < 8; ++i) g.spheres.push_back({random.point(-2, 2), random.uniform(0.05, 0.8)});
    g.planes.push_back({{0, 1, 0}, -2});
    g.planes.push_back({random.direction(), -3});
    return g;
}

Ray random_ray(Random& random, const Geometry& g)
{
    Vec3d org = random.point(-2.5, 2.5), dir = random.direction();
    switch (random.below(8)) {
        case 0: {
            const Mesh& m = g.meshes[0];
            const Vec3d at = to_double(m.positions[random.below(static_cast<uint32_t>(m.positions.size() - 1))]);
            dir = normalize(at - org);
            break;
        }
        case 1: {
            const auto axis = random.below(3);
            const double s = random.sign();
            dir = {axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : -0.0};
            break;
        }
        case 2:
            dir = normalize(org - dir * 100.0) * -1.0;
            org = org * 100.0;
            break;
        default:
            break;
    }
    return {.org = to_float(org), .dir = to_float(dir)};
}

}  // namespace lancer
