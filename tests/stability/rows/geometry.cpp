// Rows G of the stability matrix: meshes that are bad, or hard to build trees over.
#include <numeric>

#include "app/run_program.h"
#include "io/obj/triangulate.h"
#include "stability/exact.h"
#include "stability/geometry_cases.h"
#include "stability/obj_text.h"
#include "stability/pictures.h"
#include "support/meshes.h"
#include "support/random.h"

namespace lancer::stability {
namespace {

// Faces without area between those of a ball, of every kind.
Outcome no_area(const Setup&)
{
    const auto ball = make_uv_sphere(12, 24, 0.1);
    std::string clean =
        positions_text(*ball) + "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1000.1 0.1 3\nv 1000.2 0.2 3\nv 1000.4 0.4 3\n";
    std::string dirty = clean;
    const auto n = static_cast<uint32_t>(ball->positions.size());
    const std::array<std::array<uint32_t, 3>, 5> bad{
        {{0, 0, 0}, {1, 1, 2}, {n, n + 1, n + 2}, {n + 3, n + 4, n + 5}, {n + 2, n, n + 2}}};
    uint64_t added = 0;
    for (size_t i = 0; i < ball->triangles.size(); ++i) {
        clean += face_text(ball->triangles[i]);
        dirty += face_text(bad[i % bad.size()]) + face_text(ball->triangles[i]);
        ++added;
    }
    const TempFolder folder;
    write_bytes(folder.file("clean.obj"), clean);
    write_bytes(folder.file("dirty.obj"), dirty);
    Diagnostics diagnostics;
    const auto loaded = load_obj(folder.file("dirty.obj"), diagnostics);
    const auto kept = load_right(folder.file("clean.obj"));
    double counted = 0;
    for (const auto& w : diagnostics.warnings())
        if (message_of(w).find("zero-area") != std::string::npos) counted += static_cast<double>(w.count);
    Outcome out;
    double differ = 0;
    for (const AccelKind accel : judged_kinds) {
        const auto picture = [&](const std::shared_ptr<const MeshData>& mesh) {
            SceneDescription d;
            d.meshes.push_back(make_mesh(mesh));
            d.lights.push_back(sky_of({1, 1, 1}));
            d.camera = make_camera({0, 0.5, 4}, {0, 0, 0}, 40);
            return take(d, {.spp = 4, .accel = accel}, out);
        };
        differ += pixels_that_differ(picture(loaded), picture(kept));
    }
    out.measures = {
        exactly("faces counted as dropped, of " + std::to_string(added), counted, static_cast<double>(added)),
        at_most("pixels with other bits than without them", differ, 0)};
    return out;
}

// OBJ files of which one line is wrong, given to the program. With and without --strict they are refused for `wrong`,
// the line is named and nothing is written. For `left_out`, which refers to nothing or to what is no number, the line
// is named and the rest is drawn; --strict refuses it.
Outcome refused(const std::vector<std::string>& wrong, const std::vector<std::string>& left_out)
{
    const TempFolder folder;
    double codes = 0, unnamed = 0, written = 0;
    const auto draw = [&](const std::string& line, bool strict, bool is_refused) {
        write_bytes(folder.file("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\n" + line + "\n");
        std::vector<std::string> arguments{"render", "bad.obj", "-o", "bad.exr", "--size", "8x8", "-s", "1"};
        if (strict) arguments.push_back("--strict");
        const Said said = run_program(folder, arguments);
        codes += said.code != (is_refused ? 65 : 0);
        written += std::filesystem::remove(folder.file("bad.exr")) == is_refused;
        return said.err;
    };
    for (const bool strict : {false, true}) {
        for (const std::string& line : wrong)
            unnamed += draw(line, strict, true).find("bad.obj:6: error: ") == std::string::npos;
        for (const std::string& line : left_out)
            unnamed += draw(line, strict, strict).find("bad.obj:6: warning: ") == std::string::npos;
    }
    Outcome out;
    out.measures = {at_most("exit codes other than 65, or 0 for what is left out", codes, 0),
                    at_most("messages that do not name the line", unnamed, 0),
                    at_most("pictures of what is refused, or none of what is left out", written, 0),
                    told("files", static_cast<double>(wrong.size() + left_out.size()))};
    return out;
}
Outcome no_numbers(const Setup&)
{
    return refused(
        {"v nan 0 0", "v 0 inf 0", "v 0 0 -inf", "v 0 1e400 0", "v 0 0 -1e999", "v abc 0 0", "v 1,5 0 0", "v 0 0"},
        {"vn 0 nan 1\nf 1//2 2//2 3//2", "vn 0 0\nf 1//2 2//2 3//2", "vn inf 0 0\nf 1//-1 2//-1 3//-1"});
}
Outcome no_indices(const Setup&)
{
    return refused(
        {"f 1 2 0", "f 1 2 4", "f 1 2 -4", "f 1 2 2147483648", "f 1 2 4294967299", "f 1 2 18446744073709551616",
         "f 1 2 -9223372036854775808", "f 1//2147483648 2 3", "f 1//2 2//1 3//1"},
        {"f 1/1 2/1 3/1", "f 1/2147483648 2 3", "f 1//0 2//0 3//0", "f 1/0/1 2/0/1 3/0/1"});
}

// Two squares of which one lies so much above the other, turned.
constexpr double squares_z = 0.1;
std::array<MeshDescription, 2> two_squares(double apart)
{
    const auto square = [&](double z, double turn) {
        return make_mesh(make_quad({-0.6, -0.6, z}, {0.6, -0.6, z}, {0.6, 0.6, z}, {-0.6, 0.6, z},
                                   make_lambert("square", {0.5f, 0.5f, 0.5f})),
                         {{0, 0, 0}, {0, 0, turn}, {1, 1, 1}});
    };
    return {square(squares_z, 0), square(squares_z + apart, 30)};
}
SceneDescription nearly_coplanar()
{
    SceneDescription d = cornell_scene();
    d.meshes.erase(d.meshes.begin() + 6, d.meshes.end());
    for (MeshDescription& m : two_squares(1e-7 * squares_z)) d.meshes.push_back(std::move(m));
    return d;
}

constexpr std::array instruction_sets{"avx2", "avx", "sse4.2", "sse2"};

// How far behind the nearer square a ray may end that meets the other one, for distances from none to many steps of
// float: by any instruction set it is the nearer one, of equal distances in float either.
struct Nearness {
    double behind = 0;                     // at most, in steps of float at the distance
    double lost = 0, other = 0, rays = 0;  // other: rays that meet another square than by avx2
};
Nearness nearness(size_t rays)
{
    Nearness out;
    const double step = ulp(2.0);
    Hit on_upper;
    on_upper.geometry = 1;
    for (const double apart : {0.03, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 32.0}) {
        Geometry g;
        for (const MeshDescription& m : two_squares(apart * step))
            g.meshes.push_back(to_mesh(*m.data, make_transform({}, m.transform.rotate_deg, {1, 1, 1})));
        std::vector<std::unique_ptr<Accelerator>> all;
        for (const char* isa : instruction_sets) all.push_back(make_accelerator(AccelKind::embree, g, isa));
        Random random(7);
        for (size_t i = 0; i < rays; ++i) {
            const Vec3d org{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(1, 3)};
            const double x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4);
            const Ray ray{.org = to_float(org), .dir = to_float(normalize(Vec3d{x, y, squares_z} - org))};
            const double upper = triangle_t(g, ray, on_upper);
            uint32_t by_avx2 = 0;
            for (size_t k = 0; k < all.size(); ++k) {
                const Hit hit = all[k]->closest(ray);
                ++out.rays;
                if (!hit)
                    ++out.lost;
                else
                    out.behind = std::max(out.behind, (triangle_t(g, ray, hit) - upper) / ulp(upper));
                if (k == 0) by_avx2 = hit.geometry;
                out.other += hit.geometry != by_avx2;
            }
        }
    }
    return out;
}
Outcome overlap(const Setup& setup)
{
    Outcome out;
    double differ = 0;
    const std::string squares =
        "mtllib a.mtl\nv -1 -1 0.1\nv 1 -1 0.1\nv 1 1 0.1\nv -1 1 0.1\nv 0 -1.4 0.10000001\nv 1.4 0 0.10000001\n"
        "v 0 1.4 0.10000001\nv -1.4 0 0.10000001\nusemtl a\nf 1 2 3 4\nusemtl b\nf 5 6 7 8\n";
    for (const char* accel : judged_names)
        differ += pixels_by_threads(squares, "newmtl a\nKd 0.1 0.1 0.1\nnewmtl b\nKd 0.9 0.9 0.9\n", accel);
    // Of one colour: which square is met must not show, neither in what light reaches it nor in where it goes on to.
    LeastP least;
    const SceneDescription alike = nearly_coplanar();
    const auto pictures = static_cast<uint32_t>(setup.scaled(16, 32, 64));
    CountedShot shot{.spp = static_cast<uint32_t>(setup.scaled(6, 64, 64)), .accel = AccelKind::embree, .seed = 1};
    const auto by_avx2 = tiles_over_seeds(alike, shot, pictures, out);
    for (const char* isa : instruction_sets) {
        shot.isa = isa, ++shot.seed;
        least.add(by_avx2, tiles_over_seeds(alike, shot, pictures, out));
    }
    const Nearness n = nearness(setup.scaled(2000, 50'000, 500'000));
    out.measures = {at_most("pixels with other bits by 3 and 8 threads", differ, 0),
                    at_most("rays lost by any instruction set", n.lost, 0),
                    at_most("steps of float that a hit lies behind the nearer square", n.behind, 1),
                    at_most("rays that meet another square by another instruction set", n.other, 0),
                    least.measure("least p of Welch's tests, both of one colour, all instruction sets against avx2"),
                    detectable(by_avx2, by_avx2)};
    return out;
}

// A half ball, one of flipped faces, and three leaves at one edge, under a lamp and a sky.
SceneDescription open_meshes()
{
    SceneDescription d;
    MeshData half = *make_uv_sphere(12, 24, 0, make_lambert("half", {0.7f, 0.5f, 0.4f}));
    half.triangles.resize(half.triangles.size() / 2);
    MeshData flipped = *make_uv_sphere(12, 24, 0.1, make_lambert("flipped", {0.4f, 0.7f, 0.5f}));
    for (size_t i = 0; i < flipped.triangles.size(); i += 3)
        std::swap(flipped.triangles[i][0], flipped.triangles[i][1]);
    const auto leaves = make_mesh_data({{0, 0, 0}, {0, 1, 0}, {1, 0.3, 0}, {-0.7, 0.3, 0.7}, {-0.4, 0.3, -0.8}},
                                       {{0, 1, 2}, {0, 1, 3}, {0, 4, 1}}, make_lambert("leaf", {0.6f, 0.6f, 0.6f}));
    const auto add = [&](MeshData data, Vec3d at) {
        d.meshes.push_back(
            make_mesh(std::make_shared<const MeshData>(std::move(data)), {at, {20, 30, 0}, {0.7, 0.7, 0.7}}));
    };
    add(std::move(half), {-1.1, 0, 0});
    add(std::move(flipped), {0.6, 0, 0});
    add(*leaves, {-0.2, -0.7, 1});
    d.lights.push_back(sky_of({0.4f, 0.4f, 0.4f}));
    d.lights.push_back(light_of(LightType::sphere, {4, 4, 4}, {0.5, 2.5, 2}, 0.6));
    d.camera = make_camera({0, 0.6, 4}, {-0.1, 0, 0}, 40);
    return d;
}
Outcome open_and_flipped(const Setup& setup)
{
    Outcome out;
    const SceneDescription d = open_meshes();
    const auto pictures = static_cast<uint32_t>(setup.scaled(16, 32, 64));
    CountedShot shot{.spp = static_cast<uint32_t>(setup.scaled(6, 128, 256)), .accel = AccelKind::embree, .seed = 1};
    const auto by = [&](AnyIntegrator integrator) {
        shot.integrator = std::move(integrator), ++shot.seed;
        return tiles_over_seeds(d, shot, pictures, out);
    };
    const auto path = [](DirectLight direct) {
        return Path{.direct = direct, .split = false, .roulette_by_pixel = false};
    };
    const auto reference = by(path({true, true}));
    LeastP ways, classic;
    ways.add(reference, by(path({true, false})));
    ways.add(reference, by(path({false, false})));
    // The classic integrators know no light between diffuse surfaces: against what is direct.
    const auto direct = by(Path{.max_depth = 1, .split = false, .roulette_by_pixel = false});
    classic.add(direct, by(Direct{}));
    classic.add(direct, by(RandomDecision{}));
    out.measures = {ways.measure("least p of Welch's tests, ways to find light"),
                    classic.measure("least p of Welch's tests, direct light: path, direct, random-decision"),
                    detectable(reference, reference)};
    return out;
}

std::vector<Vec3d> star(size_t n)
{
    std::vector<Vec3d> p;
    for (size_t i = 0; i < n; ++i) {
        const double angle = 2 * pi_d * static_cast<double>(i) / static_cast<double>(n), r = i % 2 ? 0.4 : 1;
        p.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    return p;
}
Outcome polygons(const Setup& setup)
{
    Triangulator triangulate;
    double worst = 0, too_many = 0, slowest = 0;
    for (const size_t n : {3u, 4u, 5u, 6u, 16u, 255u, 256u, 257u, 1000u, 20000u, 70000u}) {
        const std::vector<Vec3d> p = star(n);
        const auto start = std::chrono::steady_clock::now();
        const auto triangles = triangulate(p);
        if (n == 20000) slowest = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        // Between its rings a star of n corners is n triangles from the middle.
        const double exact = n % 2 ? 0 : 0.5 * 0.4 * std::sin(2 * pi_d / double(n)) * double(n);
        double area = 0, outline = 0;
        for (const auto& t : triangles) area += length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
        for (size_t i = 2; i < n; ++i) outline += cross(p[i - 1] - p[0], p[i] - p[0]).z / 2;
        worst = std::max(worst, std::abs(area / (exact > 0 ? exact : outline) - 1));
        too_many += triangles.size() > n - 2;
        // The same corners in an order that crosses itself: some triangles, and an end.
        std::vector<Vec3d> tangle;
        const size_t step = n % 617 ? 617 : 619;
        if (std::gcd(n, step) == 1 && n < 10000)
            for (size_t i = 0; i < n; ++i) tangle.push_back(p[i * step % n]);
        if (!tangle.empty()) too_many += triangulate(tangle).size() > n - 2;
    }
    Outcome out;
    out.measures = {at_most("error of the area, relative", worst, 1e-6),
                    at_most("polygons of too many triangles", too_many, 0),
                    seconds(setup, "seconds for 20 000 corners", slowest, 2)};
    return out;
}

}  // namespace

std::vector<Row> geometry_rows()
{
    return {
        {"G1", "closed fans of slivers, 1e2 to 1e7 times as long as wide", "policy", Tier::A, true, slivers},
        {"G2", "faces without area", "itself without them", Tier::A, false, no_area},
        {"G3", "corners that are no numbers", "policy", Tier::A, false, no_numbers},
        {"G4", "indices out of range", "policy", Tier::A, false, no_indices},
        {"G5", "every triangle twice, of two materials", "itself built again", Tier::A, true, coincident_triangles},
        {"G6", "two squares from nothing to 32 steps of float apart", "long double; itself, other instruction sets",
         Tier::A, false, overlap},
        {"G7", "open, flipped and non-manifold meshes", "other integrators", Tier::A, false, open_and_flipped},
        {"G8", "polygons of up to 70 000 corners, concave and crossing", "closed form", Tier::A, false, polygons},
        {"G9", "a grid of up to 1e8 triangles", "closed form", Tier::A, true, large_grid},
        {"G10", "up to a million triangles in one place", "policy", Tier::A, true, one_place},
    };
}

}  // namespace lancer::stability
