// Normals in 32 bits change little of a picture, by every integrator.
#include <gtest/gtest.h>

#include "support/render.h"

namespace lancer {
namespace {

SceneDescription smooth_balls(bool placed)
{
    SceneDescription d;
    MeshData ball = *make_uv_sphere(24, 12, 0, make_lambert("ball", {0.7f, 0.5f, 0.3f}));
    for (const Vec3d& p : ball.positions) ball.normals.push_back(to_float(normalize(p)));
    ball.normal_triangles = ball.triangles;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(std::move(ball))));
    if (placed) {
        d.meshes[0].name = "ball";
        d.instances = {instance_of("ball", {}), instance_of("ball", {{1.2, 0.3, -1}, {20, 30, 0}, {1, 0.7, 1.2}})};
    }
    d.lights.push_back(sky_of({0.4f, 0.5f, 0.6f}));
    d.lights.push_back(light_of(LightType::point, {60, 50, 40}, {3, 4, 5}));
    d.camera = make_camera({0, 0.5, 4}, {}, 45);
    return d;
}

TEST(Compact, PicturesDifferByLittle)
{
    for (const bool placed : {false, true}) {
        size_t changed = 0;  // not ambient occlusion, which asks only what is seen
        for (const AnyIntegrator& integrator : all_integrators()) {
            SceneDescription d = smooth_balls(placed);
            RenderRequest r;
            r.settings.integrator = integrator;
            const Rendered full = render(d, r);
            d.render.compact = true;
            const Rendered compact = render(d, r);
            double off = 0, sum = 0;
            for (size_t i = 0; i < full.film.pixels.size(); ++i) {
                const double of_full = static_cast<double>(full.film.pixels[i].mean().g);
                off += std::abs(of_full - static_cast<double>(compact.film.pixels[i].mean().g));
                sum += of_full;
            }
            EXPECT_LT(off, 1e-2 * sum);
            changed += off > 0;
        }
        EXPECT_GE(changed + 1, all_integrators().size()) << "normals were not packed";
    }
}

}  // namespace
}  // namespace lancer
