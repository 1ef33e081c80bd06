// What is left out while rendering does not change a bit: each version of the kernel, folded textures, pixels that see
// nothing but the sky, shadow rays that would bring nothing.
#include <gtest/gtest.h>

#include <random>

#include "materials/material.h"
#include "render/estimators/background_only.h"
#include "render/kernel/tinted_shadows.h"
#include "support/render.h"
#include "support/shoot.h"
#include "support/stage.h"

namespace lancer {
namespace {

TEST(Specialisation, EveryProfileThatCoversASceneDrawsTheSameBits)
{
    uint32_t compared = 0;
    for (const auto& [name, d] : all_test_scenes())
        for (const AnyIntegrator& integrator : all_integrators()) {
            const Scene scene = build_scene(d);
            RenderRequest r;
            r.settings.integrator = integrator;
            r.settings.kernel.profile = Profile::all;
            const Rendered all = render(d, r);
            for (size_t i = 0; i < enum_names<Profile>.size(); ++i) {
                const auto profile = static_cast<Profile>(i);
                if (profile == Profile::all || choose_kernel(scene, integrator, profile).profile() != profile) continue;
                r.settings.kernel.profile = profile;
                const Rendered some = render(d, r);
                EXPECT_TRUE(same_bits(all.film, some.film)) << name << ", " << name_of(profile);
                EXPECT_EQ(all.counters.shadow_rays, some.counters.shadow_rays) << name << ", " << name_of(profile);
                EXPECT_EQ(all.counters.bounce_rays, some.counters.bounce_rays) << name << ", " << name_of(profile);
                ++compared;
            }
        }
    EXPECT_GT(compared, 0u);
}

// Whatever a picture of one value belongs to, the scene is that in which its value stands in the file.
TEST(Specialisation, APictureOfOneValueIsItsValue)
{
    const RasterSource even = [](const std::string&) {
        Raster r = {.width = 3, .height = 4, .channels = 1, .bytes = {}, .floats = {}, .is_float = false};
        r.bytes.assign(12, 153);
        std::promise<std::shared_ptr<const Raster>> promise;
        promise.set_value(std::make_shared<const Raster>(std::move(r)));
        return promise.get_future().share();
    };
    constexpr float value = 153 / 255.0f;
    for (const MaterialType type :
         {MaterialType::lambert, MaterialType::translucent, MaterialType::mirror, MaterialType::metal,
          MaterialType::glass, MaterialType::plastic, MaterialType::interface}) {
        SceneDescription with = lights_scene();
        MaterialDescription m = make_lambert("m", {0.7f, 0.8f, 0.9f});
        m.type = type;
        m.roughness = 0.7f;
        m.emission = {0.2f, 0.1f, 0.3f};
        MaterialDescription plain = m;
        const TextureUse grey = picture_of("grey", Encoding::linear, Channel::red);
        m.base_color_map = m.emission_map = m.bump_map = grey;
        plain.base_color *= value, plain.emission *= value;
        if (type == MaterialType::metal || type == MaterialType::glass || type == MaterialType::plastic) {
            m.roughness_map = grey;
            plain.roughness *= value;
        }
        with.spheres.push_back(sphere_of({-0.9, -0.2, 0.4}, 0.5, "m"));
        if (type == MaterialType::translucent) {
            m.transmittance_map = grey;
            plain.transmittance *= value;
        }
        SceneDescription without = with;
        with.materials.push_back(m);
        without.materials.push_back(plain);
        RenderRequest r;
        r.spp = {4};
        r.images = even;
        for (const AnyIntegrator& integrator : all_integrators()) {
            r.settings.integrator = integrator;
            EXPECT_TRUE(same_bits(render(with, r).film, render(without, r).film)) << static_cast<int>(type);
        }
    }
}

// Of light and of AOVs: the same as if the rays were traced.
TEST(Specialisation, PixelsOfOpenSkyHaveTheirBitsUntraced)
{
    uint64_t untraced = 0;
    for (const auto& [name, scene] : all_test_scenes())
        for (const AnyIntegrator& integrator : all_integrators())
            for (const StopRule stop : {StopRule::never, StopRule::confidence, StopRule::last_sample}) {
                SceneDescription d = scene;
                d.planes.clear();
                d.camera->fov_deg = 90;
                RenderRequest r;
                r.width = 64, r.height = 48;
                r.spp = {3, 2};
                r.settings.integrator = integrator;
                r.settings.kernel.stop = stop;
                const Rendered light = render(d, r);
                r.aovs = all_aovs();
                const Rendered some = render(d, r);
                r.traces_open_sky = true;
                const Rendered all = render(d, r);
                EXPECT_TRUE(same_bits(light.film, all.film)) << name;
                EXPECT_TRUE(same_bits(some.film, all.film)) << name;
                EXPECT_EQ(some.film.aovs, all.film.aovs) << name;
                EXPECT_EQ(some.film.open_aovs, all.film.open_aovs) << name;
                EXPECT_EQ(light.counters.background_only_samples, some.counters.background_only_samples) << name;
                EXPECT_EQ(some.counters.camera_rays + some.counters.background_only_samples, all.counters.camera_rays)
                    << name;
                EXPECT_EQ(all.counters.background_only_samples, 0u) << name;
                untraced += some.counters.background_only_samples;
            }
    EXPECT_GT(untraced, 100'000u);
}

// Rays all over the pixels around one that is said to be open meet nothing: any camera, near and far, also within the
// bounds of the scene and above floors that go on behind it.
TEST(Specialisation, OpenSkyIsOpen)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto somewhere = [&](double size) { return Vec3d{number(random), number(random), number(random)} * size; };
    uint64_t open = 0, cameras_with_some = 0;
    for (int i = 0; i < 120; ++i) {
        SceneDescription d;
        for (int k = 0; k < 1 + i % 7; ++k) {
            const Vec3d a = somewhere(2), b = a + somewhere(i % 3 ? 0.5 : 20), c = a + somewhere(0.5);
            d.meshes.push_back(triangle_mesh(a, b, c, {}));
        }
        // Neighbours in the list that are neighbours in space, by and large.
        if (i % 2 == 0) {
            MeshData chain;
            Vec3d at = somewhere(1);
            for (uint32_t k = 0; k < 40; ++k, at = at + somewhere(k % 16 ? 0.06 : 1)) {
                for (int corner = 0; corner < 3; ++corner) chain.positions.push_back(at + somewhere(0.03));
                chain.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
            }
            chain.materials.emplace_back();
            d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(std::move(chain))));
        }
        if (i % 4 == 0)
            d.meshes.push_back(make_mesh(make_quad({-90, -1, -90}, {-90, -1, 90}, {90, -1, 90}, {90, -1, -90})));
        if (i % 5 == 0) d.spheres.push_back(sphere_of(somewhere(2), 0.3));
        if (i % 6 == 0) {
            d.meshes.push_back(make_mesh(make_cube(), {somewhere(1), {}, {0.1, 0.2, 0.1}}));
            d.meshes.back().name = "cube";
            d.instances.push_back(instance_of("cube", {somewhere(1), {20, 30, 40}, {1, 1, 1}}));
        }
        d.camera = make_camera(somewhere(i % 2 ? 4 : 0.8), somewhere(0.5), i % 3 ? 60 : 120);
        const Stage stage(d);
        const Camera camera = camera_of(d, stage.scene, 40, 30);
        SamplingPlan plan;
        find_background_only(stage.scene, camera, 40, 30, plan);
        uint64_t here = 0;
        for (uint32_t y = 0; y < 30; ++y)
            for (uint32_t x = 0; x < 40; ++x) {
                if (!plan.is_background_only(x, y)) continue;
                ++here;
                for (int n = 0; n < 9; ++n) {
                    const Vec2 film{static_cast<float>(x + 0.5 + 1.5 * number(random)),
                                    static_cast<float>(y + 0.5 + 1.5 * number(random))};
                    ASSERT_FALSE(stage.list.closest(camera.ray(film, {}))) << i << ": " << x << ", " << y;
                }
            }
        open += here;
        cameras_with_some += here > 0;
    }
    EXPECT_GT(open, 10'000u);
    EXPECT_GT(cameras_with_some, 40u);
}

// To project ten million boxes takes longer than the rays that it saves.
TEST(Specialisation, OpenSkyIsNotLookedForBehindCountlessInstances)
{
    for (const size_t count : {300u, 500u}) {
        SceneDescription d;
        d.meshes.push_back(make_mesh(make_cube(), {{}, {}, {0.001, 0.001, 0.001}}));
        d.meshes.back().name = "cube";
        d.instances.push_back(instance_of("cube", {}));
        d.instances.back().more.resize(count - 1);
        d.camera = make_camera({0, 0, 3}, {}, 60);
        const Stage stage(d);
        ASSERT_EQ(stage.scene.geometry.instances.size(), count);
        SamplingPlan plan;
        find_background_only(stage.scene, camera_of(d, stage.scene, 40, 30), 40, 30, plan);
        EXPECT_EQ(plan.is_background_only(0, 0), count == 300);
    }
}

// The camera's first rays are replayed, shadow rays heard: each has something to bring.
TEST(Specialisation, NoShadowRayIsTracedForNothing)
{
    uint64_t heard = 0;
    bool tints = false;
    const PathListener listener{.ray = [](const PathState& s, const Hit&) { EXPECT_FALSE(is_black(s.throughput)); },
                                .vertex = [](const PathState&, const Surface&) {},
                                .added = [](const PathState&, Color) {},
                                .shadow =
                                    [&](const Ray&, Color brings, bool occluded) {
                                        // What tints a shadow may stop all of it, on the way.
                                        EXPECT_FALSE(is_black(brings) && !(occluded && tints));
                                        ++heard;
                                    }};
    for (const NamedScene& named : all_test_scenes()) {
        const std::string name = named.name;
        // What a medium absorbs on the way is taken off when the ray is on its way.
        if (!build_scene(named.description).media.empty()) continue;
        // Lamps of no albedo; a throughput so small that the next bounce leaves nothing of it.
        SceneDescription scene = named.description;
        scene.materials.push_back(make_lambert("dark", {1e-30f, 1e-30f, 1e-30f}));
        scene.spheres.push_back(sphere_of({0.3, 0.2, 0.6}, 0.3, "dark"));
        for (const AnyIntegrator& integrator : all_integrators())
            with_threads(1, [&] {
                const testing::ScopedTrace which(
                    __FILE__, __LINE__,
                    name + ", " + std::visit([](const auto& i) { return std::string(name_of(i.kind)); }, integrator));
                tints = std::visit([]<class I>(const I&) { return TintsShadows<I>; }, integrator);
                RendererConfig settings;
                settings.integrator = integrator;
                const Renderer renderer(build_scene(scene), settings);
                const Camera camera = camera_of(scene, renderer.scene(), 16, 12);
                for (uint32_t y = 0; y < 12; ++y)
                    for (uint32_t x = 0; x < 16; ++x) renderer.replay(camera, 16, 12, {x, y, 0}, listener);
            });
    }
    EXPECT_GT(heard, 1000u);
}

}  // namespace
}  // namespace lancer
