// Sheets of glass in a uniform world, where what loses nothing cannot be seen, and their light against closed forms.
#include <gtest/gtest.h>

#include "materials/fresnel.h"
#include "materials/thin_sheet.h"
#include "support/ways.h"

namespace lancer {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

MaterialDescription clear_glass()
{
    MaterialDescription m = make_glossy("glass", MaterialType::glass, {1, 1, 1}, 0);
    m.ior = 1.5f;
    return m;
}
const std::vector<Vec3d> square{{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
const Triangles front{{0, 1, 2}, {0, 2, 3}}, back{{0, 3, 1}, {1, 3, 2}};

Triangles operator+(Triangles a, const Triangles& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
Triangles turned_round(Triangles t)
{
    for (auto& corners : t) std::swap(corners[1], corners[2]);
    return t;
}
std::vector<Vec3d> slab_of(double thickness)
{
    std::vector<Vec3d> p = make_cube()->positions;
    for (Vec3d& v : p) v = {5 * v.x, 5 * v.y, 0.5 * thickness * v.z};
    return p;
}
SceneDescription under_white_sky(std::shared_ptr<const MeshData> data, double from)
{
    SceneDescription d;
    d.lights.push_back(sky_of({1, 1, 1}));
    d.meshes.push_back(make_mesh(std::move(data)));
    d.camera = make_camera({0.5, 0.3, from}, {0, 0, 0}, 50);
    return d;
}

struct Case {
    std::string name;
    std::shared_ptr<const MeshData> data;
};
std::vector<Case> cases()
{
    const Triangles cube = make_cube()->triangles, both = cube + turned_round(cube);
    std::vector<Case> all{
        {"single sheet", make_mesh_data(square, front, clear_glass())},
        {"doubled sheet", make_mesh_data(square, front + turned_round(front), clear_glass())},
        {"doubled sheet, other diagonal", make_mesh_data(square, front + back, clear_glass())},
        {"sheet doubled on both sides", make_mesh_data(square, front + back + front + back, clear_glass())}};
    for (const double thickness : {0.05, 1.0}) {
        const std::string name = thickness < 0.2 ? "thin slab" : "slab";
        all.push_back({name, make_mesh_data(slab_of(thickness), cube, clear_glass())});
        all.push_back({"doubled " + name, make_mesh_data(slab_of(thickness), both, clear_glass())});
    }
    std::vector<Vec3d> p = slab_of(4);
    Triangles t = cube;
    for (const auto& corners : front) t.push_back({corners[0] + 8, corners[1] + 8, corners[2] + 8});
    for (const Vec3d& v : square) p.push_back(v * 0.5);
    all.push_back({"sheet inside a closed body", make_mesh_data(p, t, clear_glass())});
    return all;
}

// Every sample by itself, so that the mean is 1 as well, far within 0.002.
TEST(SheetFurnace, SheetsAndSlabsAreInvisibleInEverySample)
{
    for (const Case& c : cases())
        for (const double from : {14.0, -14.0})
            for (const AccelKind accel : {AccelKind::embree, AccelKind::bvh8}) {
                Shot shot{.integrator = without_roulette({}), .width = 16, .height = 16, .spp = 64};
                shot.accel = accel;
                expect_all_equal(shoot(under_white_sky(c.data, from), shot), {1, 1, 1}, gamma(512),
                                 c.name + (from > 0 ? " from the front" : " from the back"));
            }
}

// With roulette and by light sampling the mean is the same.
TEST(SheetFurnace, SheetsAndSlabsAreInvisibleInTheMean)
{
    stats::Family family;
    for (const Case& c : cases())
        for (const double from : {14.0, -14.0}) {
            const stats::Tally t =
                tally(shoot(under_white_sky(c.data, from),
                            {.width = 32, .height = 32, .spp = 256, .sampler = SamplerKind::independent}));
            EXPECT_NEAR(t.mean, 1, 0.002) << c.name << from;
            family.add(stats::mean_p(t, 1, 1e-5), c.name);
        }
}

// What a single face of a body would show, which has no other: 0.4666 from the front and 2.2002 from the back.
TEST(SheetFurnace, WithoutRecognitionASheetIsWrong)
{
    MaterialDescription solid = clear_glass();
    solid.thin = false;
    for (const auto& [from, expected] : {std::pair{14.0, 0.04 + 0.96 / 2.25}, {-14.0, 0.04 + 0.96 * 2.25}}) {
        SceneDescription d = under_white_sky(make_mesh_data(square, front, solid), from);
        d.camera = make_camera({0, 0, from}, {0, 0, 0}, 0.1);
        const stats::Tally t = tally(shoot(d, {.spp = 256, .sampler = SamplerKind::independent}));
        EXPECT_NEAR(t.mean, expected, 5 * t.error() + 1e-4);
    }
}

// What the facets of rough sheets lose comes back.
TEST(SheetFurnace, RoughSheetsAreInvisibleInTheMean)
{
    for (const float roughness : {0.0f, 0.2f, 0.5f, 0.8f, 1.0f}) {
        MaterialDescription m = clear_glass();
        m.roughness = roughness;
        const double seen = tally(shoot(under_white_sky(make_mesh_data(square, front, m), 14),
                                        {.spp = 256, .sampler = SamplerKind::independent}))
                                .mean;
        EXPECT_NEAR(seen, 1, roughness == 0 ? 1e-4 : 0.01) << roughness;
    }
}

// A lamp seen through a tinted sheet, against the series of the pane that it stands for; and a slab just too thick to
// be one shows the same.
TEST(Sheets, ShowWhatTheirPaneWould)
{
    const double c = 0.8;
    for (const double angle : {0.0, 40.0, 70.0}) {
        const double cos = std::cos(angle * pi_d / 180);
        const double r = fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), 1.5).reflectance;
        const double through = c * c * (1 - r) * (1 - r) / (1 - c * c * r * r);
        for (const double thickness : {0.0, 0.05, 0.25}) {
            MaterialDescription m = clear_glass();
            m.base_color = {0.8f, 0.8f, 0.8f};
            SceneDescription d =
                under_white_sky(thickness == 0 ? make_mesh_data(square, front, m)
                                               : make_mesh_data(slab_of(thickness), make_cube()->triangles, m),
                                10);
            d.lights.clear();
            MaterialDescription lamp = make_emitter("lamp", {1, 1, 1});
            d.materials = {lamp};
            d.planes = {plane_of({0, 0, -3}, {0, 0, 1}, "lamp")};
            d.camera = make_camera(Vec3d{std::sin(angle * pi_d / 180), 0, cos} * 2.0, {0, 0, 0}, 0.01);
            const stats::Tally t =
                tally(shoot(d, {.integrator = without_roulette({}), .spp = 256, .sampler = SamplerKind::independent}));
            EXPECT_NEAR(t.mean, through, 5 * t.error() + 2e-4) << angle << " " << thickness;
        }
    }
}

// All kernels and integrators that follow mirrors see the same behind a pane.
TEST(Sheets, AreTheSameToAllIntegrators)
{
    SceneDescription d = under_white_sky(make_mesh_data(square, front + back, clear_glass()), 6);
    d.lights.clear();
    d.materials = {make_emitter("lamp", {1, 0.8f, 0.6f})};
    d.spheres = {sphere_of({0.5, 0, -3}, 1, "lamp"), sphere_of({-1, 0.5, 4}, 0.5, "lamp")};
    std::vector<TilesOverSeeds> found;
    std::vector<std::string> names;
    for (const char* name : {"path", "direct", "whitted", "random-decision"}) {
        RenderSettings settings;
        settings.integrator = value_of<IntegratorKind>(name).value();
        settings.max_depth = 7;
        found.emplace_back(d, Shot{.integrator = make_integrator(settings), .spp = 64, .seed = found.size() + 1});
        names.push_back(name);
    }
    expect_one_mean(std::move(found), {.pictures = 8, .detectable = 0.03, .names = names}, "a lamp behind a pane");
}

// A floor under so many tilted sheets of tinted glass, and the camera between them and the floor.
SceneDescription floor_under(uint32_t sheets, const LightDescription& light, bool rough)
{
    SceneDescription d;
    d.meshes.push_back(
        make_mesh(make_quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, make_lambert("floor", {1, 1, 1}))));
    MaterialDescription pane = make_glossy("pane", MaterialType::glass, {0.9f, 0.8f, 1}, rough ? 0.5f : 0.0f);
    pane.ior = 1.7f;
    for (uint32_t i = 0; i < sheets; ++i) {
        const double y = 2 + i;
        d.meshes.push_back(make_mesh(make_quad({-9, y, 9}, {9, y + 3, 9}, {9, y + 3, -9}, {-9, y, -9}, pane)));
    }
    d.lights = {light};
    d.camera = make_camera({0, 1, 3}, {0, 0, 0}, 20);
    return d;
}

// Light that no ray can hit goes straight through smooth sheets: each lets pass what its series says, whichever
// integrator and kernel asks. Rough sheets and bodies turn it.
TEST(Sheets, LetPointsAndSunsThrough)
{
    const Vec3d wi = normalize(Vec3d{0.3, 1, 0.2}), n = normalize(Vec3d{-3, 18, 0});
    const double c = dot(wi, n), r = fresnel_dielectric_double(c, (1 - c) * (1 + c), double{1.7f}).reflectance;
    const SheetColors colors = colors_of_sheet(r, {0.9f, 0.8f, 1});
    const Color once = colors.transmitted * static_cast<float>(1 - reflectance_of_sheet(r));
    const LightDescription sun = directional_of({3, 3, 3}, -wi);
    for (const bool by_one : {false, true})
        for (const bool direct : {false, true}) {
            const auto seen = [&](const SceneDescription& d) {
                RenderRequest request;
                request.settings.integrator = Path{.max_depth = 1};
                if (direct) request.settings.integrator = Direct{};
                if (by_one) request.settings.kernel.profile = Profile::all;
                return render(d, request).film.at(16, 12).mean();
            };
            const Color open = seen(floor_under(0, sun, false)), one = seen(floor_under(1, sun, false)),
                        two = seen(floor_under(2, sun, false));
            EXPECT_GT(open.g, 0.5f);
            for (const auto channel : {&Color::r, &Color::g, &Color::b}) {
                EXPECT_NEAR(one.*channel / (open.*channel), once.*channel, 1e-5f);
                EXPECT_NEAR(two.*channel / (open.*channel), once.*channel * once.*channel, 1e-5f);
            }
            EXPECT_EQ(seen(floor_under(1, sun, true)).g, 0) << "rough";
            const LightDescription point = light_of(LightType::point, {900, 900, 900}, {6, 20, 4});
            const float ratio = seen(floor_under(1, point, false)).g / seen(floor_under(0, point, false)).g;
            EXPECT_NEAR(ratio, once.g, 0.02f) << "a point in about this direction";
        }
}

// d 0.3 on both faces stops as much as on one.
TEST(Sheets, OpacityOnBothFacesCountsOnce)
{
    for (const Triangles& t : {front, front + back, front + turned_round(front)}) {
        SceneDescription d = under_white_sky(make_mesh_data(square, t, make_gauze("veil", {0, 0, 0}, 0.3f)), 8);
        d.camera = make_camera({0, 0, 8}, {0, 0, 0}, 20);
        const stats::Tally seen = tally(shoot(d, {.spp = 256, .sampler = SamplerKind::independent}));
        EXPECT_NEAR(seen.mean, 0.7, 5 * seen.error());
    }
}

}  // namespace
}  // namespace lancer
