// Light of points and directions straight through bodies of smooth glass, against Fresnel's equations.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/fresnel.h"
#include "support/render.h"
#include "support/shoot.h"

namespace lancer {
namespace {

constexpr float ior = 1.7f;

MaterialDescription tinted_glass(float roughness = 0)
{
    MaterialDescription m = make_glossy("glass", MaterialType::glass, {0.9f, 0.8f, 1}, roughness);
    m.ior = ior;
    m.thin = false;
    return m;
}
SceneDescription floor_below(const LightDescription& light)
{
    SceneDescription d;
    d.render.straight_shadows = true;
    d.meshes.push_back(
        make_mesh(make_quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, make_lambert("floor", {1, 1, 1}))));
    d.lights = {light};
    d.camera = make_camera({0, 1, 3}, {0, 0, 0}, 20);
    return d;
}
// Wide, 2 thick, above the camera.
SceneDescription floor_below_block(const LightDescription& light, const MaterialDescription& m)
{
    SceneDescription d = floor_below(light);
    d.meshes.push_back(make_mesh(make_cube(m), {{0, 4, 0}, {}, {18, 1, 18}}));
    return d;
}
// One minus the reflectance of a face.
double let_in(double cos) { return 1 - fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), double{ior}).reflectance; }

// What is seen of the floor: by either kernel, each integrator and several accelerators.
template <class Check>
void for_each_way(const Check& check)
{
    for (const AccelKind accel : {AccelKind::embree, AccelKind::bvh8, AccelKind::list})
        for (const bool by_one : {false, true})
            for (const bool direct : {false, true})
                check([&](const SceneDescription& d) {
                    RenderRequest request;
                    request.settings.integrator = Path{.max_depth = 1};
                    if (direct) request.settings.integrator = Direct{};
                    if (by_one) request.settings.kernel.profile = Profile::all;
                    request.settings.accel = accel;
                    return render(d, request).film.at(16, 12).mean();
                });
}
void expect_ratio(Color with, Color without, Color part, const char* what)
{
    for (const auto channel : {&Color::r, &Color::g, &Color::b}) {
        ASSERT_GT(without.*channel, 0) << what;
        EXPECT_NEAR(with.*channel / (without.*channel), part.*channel, 1e-5f) << what;
    }
}

TEST(StraightShadows, LoseAtEachFaceWhatItReflects)
{
    const Color tint{0.9f, 0.8f, 1};
    for_each_way([&](const auto& seen) {
        for (const Vec3d wi : {Vec3d{0, 1, 0}, normalize(Vec3d{0.5, 1, 0.2}), normalize(Vec3d{1, 1, -1})}) {
            const LightDescription sun = directional_of({3, 3, 3}, -wi);
            const auto part = static_cast<float>(let_in(wi.y) * let_in(wi.y));
            expect_ratio(seen(floor_below_block(sun, tinted_glass())), seen(floor_below(sun)), tint * tint * part,
                         "two faces");
            EXPECT_EQ(seen(floor_below_block(sun, tinted_glass(0.5f))).g, 0) << "rough glass turns light";
        }
        const LightDescription bulb = light_of(LightType::point, {90, 90, 90}, {0, 4, 0});
        SceneDescription d = floor_below(bulb);
        d.materials = {tinted_glass()};
        d.spheres = {sphere_of({0, 4, 0}, 0.5, "glass")};
        expect_ratio(seen(d), seen(floor_below(bulb)), tint * static_cast<float>(let_in(1)), "from within a ball");
    });
}

TEST(StraightShadows, AreAbsorbedOnTheirWay)
{
    MaterialDescription m = tinted_glass();
    m.absorption = {0.1f, 0.2f, 0};
    const Vec3d wi = normalize(Vec3d{0.5, 1, 0.2});
    const LightDescription sun = directional_of({3, 3, 3}, -wi);
    const auto part = static_cast<float>(let_in(wi.y) * let_in(wi.y));
    const auto left = [&](float absorption) { return part * static_cast<float>(std::exp(-absorption * 2 / wi.y)); };
    for_each_way([&](const auto& seen) {
        expect_ratio(seen(floor_below_block(sun, m)), seen(floor_below(sun)),
                     {0.81f * left(0.1f), 0.64f * left(0.2f), left(0)}, "absorbed");
    });
}

// Light that a path can hit is found as it is.
TEST(StraightShadows, AreForLightsThatNoRayHits)
{
    SceneDescription d = floor_below_block(light_of(LightType::sphere, {9, 9, 9}, {0, 8, 0}, 1), tinted_glass());
    const auto drawn = [&](bool straight) {
        d.render.straight_shadows = straight;
        return render(d, {}).film;
    };
    EXPECT_TRUE(same_bits(drawn(true), drawn(false)));
    d.lights = {light_of(LightType::point, {90, 90, 90}, {0, 8, 0})};
    EXPECT_FALSE(same_bits(drawn(true), drawn(false)));
}

}  // namespace
}  // namespace lancer
