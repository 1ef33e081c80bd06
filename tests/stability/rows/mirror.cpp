// Rows D1 and D2: light that mirrors throw back and forth.
#include "app/run_program.h"
#include "io/image/exr.h"
#include "stability/groups.h"
#include "stability/shots.h"

namespace lancer::stability {
namespace {

// Two mirrors a distance of 2 apart between which a ray from the middle rises so that it meets sky after `bounces`.
SceneDescription facing_mirrors(uint32_t bounces, Color tint)
{
    SceneDescription d;
    MaterialDescription mirror = make_lambert("mirror", tint);
    mirror.type = MaterialType::mirror;
    d.meshes.push_back(make_mesh(make_quad({-1, -5, -5}, {-1, 5, -5}, {-1, 5, 5}, {-1, -5, 5}, mirror)));
    d.meshes.push_back(make_mesh(make_quad({1, -5, 5}, {1, 5, 5}, {1, 5, -5}, {1, -5, -5}, mirror)));
    d.lights.push_back(sky_of({2, 2, 2}));
    d.camera = make_camera({0, 0, 0}, {1, 2.5 / bounces, 0}, 1e-4);
    return d;
}

// How far the places where a path meets the mirrors are from those of its first ray, unfolded; file units.
double worst_place(const SceneDescription& d, uint32_t bounces)
{
    RendererConfig settings;
    settings.integrator = without_roulette({});
    const Renderer renderer(build_scene(d), settings);
    const Normalisation& n = renderer.scene().normalisation;
    const Camera camera = camera_of(d, renderer.scene(), 2, 2);
    Vec3d org, dir;
    uint32_t met = 0;
    double worst = 0;
    PathListener listener{
        .ray = [](const PathState&, const Hit&) {},
        .vertex =
            [&](const PathState& s, const Surface& surface) {
                if (s.depth == 0) {
                    org = n.to_file(to_double(s.ray.org)), dir = to_double(s.ray.dir);
                }
                const double along = (2 * met + 1 - org.x) / dir.x;
                const Vec3d unfolded{met % 2 ? -1. : 1., org.y + dir.y * along, org.z + dir.z * along};
                worst = std::max(worst, length(n.to_file(to_double(surface.p)) - unfolded));
                ++met;
            },
        .added = [](const PathState&, Color) {},
        .shadow = [](const Ray&, Color, bool) {}};
    renderer.replay(camera, 2, 2, {0, 0, 0}, listener);
    return met == bounces ? worst : std::numeric_limits<double>::infinity();
}

Outcome parallel_mirrors(const Setup& setup)
{
    constexpr uint32_t n = 1000;
    Outcome out;
    const SceneDescription d = facing_mirrors(n, {1, 0.999f, 1});
    const Film film = shoot(d, {.integrator = without_roulette({}), .width = 4, .height = 4}, setup, out);
    const auto darker = static_cast<float>(2 * std::pow(double{0.999f}, double{n}));
    out.measures = {at_most("error of the radiance", worst_pixel(film, {2, darker, 2}), 1e-5),
                    at_most("error of the place, in widths of the box", worst_place(d, n) / 2, 1e-3)};
    return out;
}

// A box of mirrors that shine a little themselves: from anywhere, any way, e (1 + a + ... + a^depth).
SceneDescription mirror_box(float tint, float emission, bool hole)
{
    SceneDescription d;
    MaterialDescription mirror = make_lambert("mirror", {tint, tint, tint});
    mirror.type = MaterialType::mirror;
    mirror.emission = {emission, emission, emission};
    mirror.emission_both_sides = true;
    auto box = std::make_shared<MeshData>(*make_cube(mirror));
    if (hole) {  // instead of the front, four strips around a hole
        box->triangles.erase(box->triangles.begin() + 2, box->triangles.begin() + 4);
        const auto strip = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d e) {
            const auto at = static_cast<uint32_t>(box->positions.size());
            box->positions.insert(box->positions.end(), {a, b, c, e});
            box->triangles.push_back({at, at + 1, at + 2});
            box->triangles.push_back({at, at + 2, at + 3});
        };
        constexpr double h = 0.3;
        strip({-1, -1, 1}, {1, -1, 1}, {1, -h, 1}, {-1, -h, 1});
        strip({-1, h, 1}, {1, h, 1}, {1, 1, 1}, {-1, 1, 1});
        strip({-1, -h, 1}, {-h, -h, 1}, {-h, h, 1}, {-1, h, 1});
        strip({h, -h, 1}, {1, -h, 1}, {1, h, 1}, {h, h, 1});
        d.lights.push_back(sky_of({2, 2, 2}));
    }
    d.meshes.push_back(make_mesh(std::move(box)));
    d.camera = make_camera({0.3, 0.2, -0.1}, {-0.5, -0.4, -1}, 60);
    return d;
}

// The program with a stack of 256 kB on a scene that Whitted's integrator follows 10000 deep.
int exit_code_with_small_stack(double& error)
{
    const TempFolder folder;
    std::string corners, faces;
    for (int i = 0; i < 8; ++i)
        corners += std::string("v ") + (i & 1 ? "1 " : "-1 ") + (i & 2 ? "1 " : "-1 ") + (i & 4 ? "1\n" : "-1\n");
    write_bytes(folder.file("box.obj"), corners + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    write_bytes(folder.file("box.toml"), R"(version = 1
[camera]
position = [0.3, 0.2, -0.1]
target = [-0.5, -0.4, -1]
[render]
integrator = "whitted"
max_depth = 10000
[material.mirror]
type = "mirror"
base_color = [1, 1, 1]
emission = [1e-4, 1e-4, 1e-4]
emission_sides = "both"
[[mesh]]
file = "box.obj"
material = "mirror"
)");
    const Limited stack(RLIMIT_STACK, 256 << 10);
    const Said said = run_program(folder, {"render", "box.toml", "--size", "4x4", "-s", "1", "-o", "box.exr"});
    error = std::numeric_limits<double>::infinity();
    if (said.code != 0) return said.code;
    error = 0;
    for (const Color& c : read_exr(folder.file("box.exr")).pixels)
        error = std::max(error, std::abs(double{c.g} / (1e-4 * 10001) - 1));
    return said.code;
}

Outcome mirrors_all_around(const Setup& setup)
{
    Outcome out;
    constexpr uint32_t depth = 10000;
    const double a = double{0.999f}, series = (1 - std::pow(a, depth + 1.0)) / (1 - a);
    const Path path = without_roulette({.max_depth = depth});
    const auto side = static_cast<uint32_t>(setup.scaled(4, 16, 32));
    const Shot shot{.integrator = path, .width = side, .height = side, .spp = 1};
    const auto shines = static_cast<float>(1 / series);
    const Film closed = shoot(mirror_box(0.999f, shines, false), shot, setup, out);
    out.measures.push_back(at_most("closed, radiance", worst_pixel(closed, {1, 1, 1}), 1e-4));
    // One bounce in 70 finds the hole: of paths of 10000 all do.
    const Film open = shoot(mirror_box(1, 0, true), shot, setup, out);
    out.measures.push_back(at_most("with a hole to the sky, radiance", worst_pixel(open, {2, 2, 2}), 1e-4));
    double error = 0;
    out.measures.push_back(exactly("exit code with a stack of 256 kB", exit_code_with_small_stack(error), 0));
    out.measures.push_back(at_most("the same, radiance", error, 1e-4));
    return out;
}

}  // namespace

std::vector<Row> mirror_rows()
{
    return {
        {"D1", "parallel mirrors, 1000 bounces, albedo 1 and 0.999", "closed form", Tier::A, false, parallel_mirrors},
        {"D2", "box of mirrors, closed and with a hole, depth 10000", "closed form, policy", Tier::A, false,
         mirrors_all_around}};
}

}  // namespace lancer::stability
