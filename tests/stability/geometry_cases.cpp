#include "stability/geometry_cases.h"

#include "app/run_program.h"
#include "stability/exact.h"
#include "stability/obj_text.h"
#include "stability/pictures.h"
#include "support/hits.h"
#include "support/watertight.h"

namespace lancer::stability {
namespace {

// Two fans, tip to tip around a regular polygon: closed, of triangles `aspect` times as long as wide.
Mesh double_fan(uint32_t corners, double aspect)
{
    const double width = 2 * pi_d / corners, height = std::sqrt(std::max(1.0, aspect * width * aspect * width - 1));
    Mesh mesh;
    for (uint32_t i = 0; i < corners; ++i)
        mesh.positions.push_back(to_float(Vec3d{std::cos(width * i), std::sin(width * i), 0}));
    mesh.positions.push_back(to_float(Vec3d{0, 0, height}));
    mesh.positions.push_back(to_float(Vec3d{0, 0, -height}));
    mesh.positions.emplace_back();
    for (uint32_t i = 0; i < corners; ++i) {
        mesh.triangles.push_back({i, (i + 1) % corners, corners});
        mesh.triangles.push_back({(i + 1) % corners, i, corners + 1});
    }
    return mesh;
}

// A ball in the middle of the picture whose triangles are all there twice, black first and white second, and a mesh in
// the place of another one.
SceneDescription all_twice()
{
    SceneDescription d;
    MeshData ball = *make_uv_sphere(24, 48, 0.1, make_lambert("first", {0.1f, 0.1f, 0.1f}));
    const std::vector<std::array<uint32_t, 3>> once = ball.triangles;
    ball.face_material.assign(once.size(), 0);
    ball.triangles.insert(ball.triangles.end(), once.begin(), once.end());
    ball.face_material.resize(ball.triangles.size(), 1);
    ball.materials.push_back(make_lambert("second", {0.9f, 0.9f, 0.9f}));
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(std::move(ball))));
    for (const float albedo : {0.2f, 0.8f})
        d.meshes.push_back(make_mesh(make_cube(make_lambert("cube", {albedo, albedo, albedo})),
                                     {{2, 0, 0}, {20, 30, 0}, {0.6, 0.6, 0.6}}));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = make_camera({0.8, 0.5, 6}, {0.8, 0, 0}, 40);
    return d;
}

}  // namespace

double pixels_by_threads(const std::string& obj, const std::string& mtl, const std::string& accelerator)
{
    const TempFolder folder;
    write_bytes(folder.file("a.obj"), obj);
    write_bytes(folder.file("a.mtl"), mtl);
    std::optional<Image> first;
    double differ = 0;
    for (const char* threads : {"1", "3", "8"}) {
        const Said said = run_program(folder, {"render", "a.obj", "-o", "a.exr", "--size", "24x24", "-s", "4", "-t",
                                               threads, "--accel", accelerator, "-q"});
        if (said.code != 0) throw Error(ErrorKind::failed, said.err);
        Image image = read_exr(folder.file("a.exr"));
        if (!first)
            first = std::move(image);
        else
            for (size_t i = 0; i < image.pixels.size(); ++i)
                differ += std::memcmp(&image.pixels[i], &first->pixels[i], sizeof(Color)) != 0;
    }
    return differ;
}

Outcome slivers(const Setup& setup)
{
    struct Shape {
        uint32_t corners;
        double aspect;
    };
    std::vector<Shape> shapes{{60, 1e2}, {600, 1e3}, {2000, 1e4}, {2000, 1e5}, {2000, 1e6}, {2000, 1e7}};
    if (setup.tier != Tier::A)
        for (const double aspect : {1e5, 1e6, 1e7}) shapes.push_back({500000, aspect});
    std::map<Aim, double> misses, rays;
    for (const Shape& shape : shapes) {
        Geometry g;
        g.meshes.push_back(double_fan(shape.corners, shape.aspect));
        const auto accel = setup.make(g);
        // From the middle, far from every face: the ball of radius 1/2 touches none.
        const RaysFromInside from_inside(g.meshes[0], {{{0, 0, 0}, 0.5}});
        // Of the largest each ray meets the boxes of thousands.
        const uint64_t count = setup.scaled(800, 5000, 100000) / (shape.corners > 2000 ? 20 : 1);
        for (const Aim aim : {Aim::random, Aim::edge, Aim::vertex})
            for (const Asked asked : all_asked) {
                misses[aim] += static_cast<double>(
                    count_misses(*accel, from_inside, aim, asked, static_cast<uint64_t>(asked) * count, count));
                rays[aim] += static_cast<double>(count);
            }
    }
    Outcome out;
    for (const auto& [aim, count] : rays) {
        const std::string what = "leaks per million rays: " + std::string(name_of(aim));
        const double per_million = 1e6 * misses[aim] / count;
        // Embree promises nothing at corners.
        const bool promised = aim != Aim::vertex || !setup.accelerator.starts_with("embree");
        out.measures.push_back(promised ? at_most(what, per_million, 0) : told(what, per_million));
    }
    return out;
}

Outcome coincident_triangles(const Setup& setup)
{
    const SceneDescription d = all_twice();
    const Scene scene = build_scene(d);
    const Camera camera = camera_of(d, scene, 32, 24);
    const auto hits = [&](const Accelerator& accel) {
        std::vector<Hit> all;
        for (uint32_t y = 0; y < 24; ++y)
            for (uint32_t x = 0; x < 32; ++x)
                all.push_back(
                    accel.closest(camera.ray({static_cast<float>(x) + 0.3f, static_cast<float>(y) + 0.6f}, {})));
        return all;
    };
    const std::vector<Hit> first = hits(*setup.make(scene.geometry));
    double differ = 0, second = 0, met = 0;
    for (size_t build = 1; build < setup.scaled(20, 100, 100); ++build) {
        const std::vector<Hit> again = hits(*setup.make(scene.geometry));
        for (size_t i = 0; i < first.size(); ++i) differ += !same_bits(first[i], again[i]);
    }
    const auto half = static_cast<uint32_t>(scene.geometry.meshes[0].triangles.size() / 2);
    for (const Hit& hit : first) {
        met += hit ? 1 : 0;
        second += hit && (hit.geometry == 0 ? hit.primitive >= half : hit.geometry == 2);
    }
    Outcome out;
    out.measures = {at_most("hits that another build of the same says otherwise", differ, 0)};
    // What is documented: bvh2 takes the first of two triangles in one place, the others the one that they meet first.
    const std::string what = "hits of the second of two in one place, of " + std::to_string(static_cast<int>(met));
    out.measures.push_back(setup.accelerator == "bvh2" ? at_most(what, second, 0) : told(what, second));
    if (setup.fast()) return out;
    const MeshData& ball = *d.meshes[0].data;
    std::string obj = "mtllib a.mtl\n" + positions_text(ball);
    for (size_t i = 0; i < ball.triangles.size(); ++i)
        obj += (i % (ball.triangles.size() / 2) ? "" : i ? "usemtl b\n" : "usemtl a\n") + face_text(ball.triangles[i]);
    out.measures.push_back(
        at_most("pixels with other bits by 3 and 8 threads",
                pixels_by_threads(obj, "newmtl a\nKd 0.1 0.1 0.1\nnewmtl b\nKd 0.9 0.9 0.9\n", setup.accelerator), 0));
    return out;
}

Outcome large_grid(const Setup& setup)
{
    const auto side = static_cast<uint32_t>(setup.scaled(300, 1500, 7072));
    Geometry g;
    Mesh& mesh = g.meshes.emplace_back();
    mesh.positions.reserve((size_t{side} + 1) * (side + 1) + 1);
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            mesh.positions.push_back({static_cast<float>(x) / static_cast<float>(side),
                                      static_cast<float>(y) / static_cast<float>(side), 0.25f});
    mesh.positions.emplace_back();
    mesh.triangles.reserve(size_t{2} * side * side);
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * (side + 1) + x, b = a + side + 1;
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({a, b + 1, b});
        }
    const auto accel = setup.make(g);
    const size_t rays = setup.scaled(50000, 1000000, 10000000);
    double misses = 0, error = 0;
    for (size_t i = 0; i < rays; ++i) {
        AddressedRandom random(1, i);
        const Vec3 org = to_float(random.in_box({-1, -1, 0.3}, {2, 2, 2}));
        Vec3d at = random.in_box({1e-4, 1e-4, 0.25}, {1 - 1e-4, 1 - 1e-4, 0.25});
        // At lines of the grid, too, but not at their crossings: Embree promises nothing at corners.
        if (i % 4 == 0) {
            at.x = (1 + random.below(side - 1)) / static_cast<double>(side);
            at.y = (random.below(side) + random.uniform(0.05, 0.95)) / side;
        }
        const Ray ray{.org = org, .dir = to_float(normalize(at - to_double(org)))};
        const Hit hit = accel->closest(ray);
        const double t = (0.25 - static_cast<double>(org.z)) / static_cast<double>(ray.dir.z);
        misses += !hit;
        if (hit) error = std::max(error, ulps_between(static_cast<double>(hit.t), t));
    }
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const double bytes = static_cast<double>(accel->stats().bytes) +
                         static_cast<double>(mesh.positions.size() * sizeof(Vec3)) +
                         triangles * sizeof mesh.triangles[0];
    Outcome out;
    out.measures = {at_most("misses", misses, 0), at_most("error of t, ulps", error, 2),
                    at_most("bytes a triangle, buffers included", bytes / triangles, 125),
                    told("triangles", triangles)};
    return out;
}

Outcome one_place(const Setup& setup)
{
    const auto count = static_cast<uint32_t>(setup.scaled(50000, 1000000, 1000000));
    Geometry g;
    g.meshes.push_back({.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {}}, .triangles = {}});
    g.meshes[0].triangles.assign(count, {0, 1, 2});
    const auto start = std::chrono::steady_clock::now();
    const auto accel = setup.make(g);
    const double build = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double wrong = 0;
    for (int i = 0; i < 20; ++i) {
        AddressedRandom random(1, static_cast<uint64_t>(i));
        const float x = static_cast<float>(random.uniform(-0.2, 1.2)),
                    y = static_cast<float>(random.uniform(-0.2, 1.2));
        const Ray ray{.org = {x, y, 2}, .dir = {0, 0, -1}};
        const bool hits = x >= 0 && y >= 0 && x + y <= 1;
        const Hit hit = accel->closest(ray);
        wrong += static_cast<bool>(hit) != hits || accel->any(ray) != hits || (hit && hit.t != 2);
    }
    Outcome out;
    out.measures = {at_most("wrong hits", wrong, 0), seconds(setup, "seconds to build", build, 10),
                    told("triangles", count)};
    return out;
}

}  // namespace lancer::stability
