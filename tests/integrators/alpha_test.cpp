// Light through surfaces that stop a part of it, for every way to find it: what a factor on the light can say instead.
#include <gtest/gtest.h>

#include "support/shoot.h"

namespace lancer {
namespace {

constexpr Vec3d lamp_at{0, 1.2, 0};

// A floor that is lit by one emitter, which the camera does not see.
SceneDescription lit_by(bool ball, MaterialDescription glow)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, make_lambert("floor", {0.6f, 0.5f, 0.4f}))));
    if (ball)
        d.spheres.push_back(sphere_of(lamp_at, 0.5, glow.name));
    else
        d.meshes.push_back(
            make_mesh(make_quad({-0.6, 1.2, -0.6}, {0.6, 1.2, -0.6}, {0.6, 1.2, 0.6}, {-0.6, 1.2, 0.6}, glow)));
    d.materials.push_back(std::move(glow));
    d.camera = make_camera({0, 0.5, 2.5}, {0, 0, 0}, 30);
    return d;
}
MaterialDescription glow_of(float radiance, float opacity = 1, bool both_sides = false)
{
    MaterialDescription m = make_gauze("glow", {}, opacity);
    m.emission = {radiance, radiance, radiance};
    m.emission_both_sides = both_sides;
    return m;
}

// Every way to find the light, by either integrator, in every tile and as a whole.
void expect_same_light(const SceneDescription& a, const SceneDescription& b, const std::string& what)
{
    uint64_t seed = 0;
    const auto both = [&](const AnyIntegrator& integrator, const std::string& name) {
        Shot shot{.integrator = integrator, .width = 16, .height = 16};
        shot.seed = ++seed;
        const TilesOverSeeds one(a, shot);
        shot.seed = ++seed;
        const TilesOverSeeds other(b, shot);
        EXPECT_GT(expect_one_mean({one, other}, {.pictures = 12, .detectable = 0.25}, what + ", " + name), 0.01);
    };
    for (const DirectLight how : {DirectLight{true, true}, DirectLight{true, false}, DirectLight{false, false}}) {
        const std::string name = !how.nee ? "bsdf" : how.mis ? "nee and mis" : "nee";
        both(Path{.max_depth = 2, .direct = how}, "path, " + name);
        both(Direct{.direct = how}, "direct, " + name);
    }
}

TEST(ThroughHoles, ASheetTakesItsPartOfTheLight)
{
    for (const bool ball : {false, true}) {
        SceneDescription veiled = lit_by(ball, glow_of(4));
        // Above the camera's view, and wide enough for all that reaches the floor.
        veiled.meshes.push_back(
            make_mesh(make_quad({-9, 0.6, 9}, {9, 0.6, 9}, {9, 0.6, -9}, {-9, 0.6, -9}, make_gauze("veil", {}, 0.3f))));
        expect_same_light(veiled, lit_by(ball, glow_of(4 * 0.7f)), ball ? "ball" : "panel");
    }
}

TEST(ThroughHoles, SkyThroughTwoSheetsAndAPlane)
{
    // A floor in a black well, so deep that no sky is seen beside the sheets.
    MeshData well = *make_cube(make_lambert("well", {}));
    well.triangles.erase(well.triangles.begin() + 6, well.triangles.begin() + 8);  // no lid
    SceneDescription bare = lit_by(false, make_lambert("unlit", {}));
    bare.meshes.back() = make_mesh(std::make_shared<const MeshData>(well), {{0, 0, 0}, {}, {3, 0.5, 3}});
    SceneDescription veiled = bare;
    for (const double y : {0.6, 0.7})
        veiled.meshes.push_back(
            make_mesh(make_quad({-90, y, 90}, {90, y, 90}, {90, y, -90}, {-90, y, -90}, make_gauze("veil", {}, 0.3f))));
    veiled.materials.push_back(make_gauze("film", {}, 0.5f));
    veiled.planes.push_back(plane_of({0, 0.8, 0}, {0, 1, 0}, "film"));
    veiled.lights.push_back(sky_of({2, 2, 2}));
    const float left = 2 * 0.7f * 0.7f * 0.5f;
    bare.lights.push_back(sky_of({left, left, left}));
    expect_same_light(veiled, bare, "sky");
}

TEST(ThroughHoles, AnEmitterSendsAsMuchAsThereIsOfIt)
{
    for (const bool ball : {false, true})
        expect_same_light(lit_by(ball, glow_of(4, 0.4f)), lit_by(ball, glow_of(4 * 0.4f)), ball ? "ball" : "panel");
}

// Through the near side of a ball that shines on both, its far side is seen.
TEST(ThroughHoles, ABallShowsItsInside)
{
    const float opacity = 0.4f, seen = opacity + (1 - opacity) * opacity;
    expect_same_light(lit_by(true, glow_of(4, opacity, true)), lit_by(true, glow_of(4 * seen)), "ball");
}

// Straight through: what the camera sees of a sky behind sheets.
TEST(ThroughHoles, TheCameraSeesWhatIsBehind)
{
    SceneDescription d;
    d.meshes.push_back(
        make_mesh(make_quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, make_gauze("veil", {}, 0.3f))));
    d.meshes[0].name = "veil";
    for (const double z : {0.0, -1.0}) d.instances.push_back(instance_of("veil", {{0, 0, z}, {0, 0, 0}, {1, 1, 1}}));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = make_camera({0, 0, 4}, {0, 0, 0}, 40);
    stats::Family family;
    for (const AnyIntegrator& integrator : {AnyIntegrator{Path{}}, AnyIntegrator{Direct{}}})
        for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::independent})
            family.add(
                stats::mean_p(tally(shoot(d, {.integrator = integrator, .spp = 64, .sampler = sampler})), 0.7 * 0.7),
                "sky behind two sheets");
}

}  // namespace
}  // namespace lancer
