#include <limits>

#include "stability/exact.h"
#include "stability/pictures.h"
#include "stability/sphere_cases.h"
#include "support/addressed.h"

namespace lancer::stability {
namespace {

// A floor of squares of that side, seen from one unit above; a ball of radius 1 gives the scene its size.
SceneDescription checker_floor(double square)
{
    SceneDescription d;
    MaterialDescription squares = make_lambert("squares", {1, 1, 1});
    TextureDescription checker;
    checker.type = TextureType::checker;
    checker.use.scale = {static_cast<float>(1 / square), static_cast<float>(1 / square)};
    squares.base_color_map = checker;
    d.materials = {squares};
    d.planes.push_back(plane_of({}, {0, 1, 0}, "squares"));
    d.spheres.push_back(sphere_of({0, 5, 0}, 1));
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}

struct Cells {
    double wrong = 0, counted = 0, off_plane = 0;
};
Cells look_along(const Scene& scene, const Accelerator& accel, double square, double least, double most, size_t rays)
{
    Cells cells;
    const double scale = scene.normalisation.scale;
    const double factor = static_cast<double>(static_cast<float>(1 / square));
    const Checker& checker = std::get<Checker>(scene.textures.at(0));
    for (size_t i = 0; i < rays; ++i) {
        AddressedRandom random(9, i);
        const double t = std::pow(10.0, random.uniform(least, most)), phi = random.uniform(0, 2 * pi_d);
        const Vec3d d = normalize(Vec3d{std::cos(phi), -1 / t, std::sin(phi)});
        const Vec3d eye{random.uniform(-1, 1), 1, random.uniform(-1, 1)};
        const Ray ray{.org = to_float(eye * scale), .dir = to_float(d)};
        const Hit hit = accel.closest(ray);
        if (!hit || hit.kind != Kind::plane) {
            ++cells.wrong, ++cells.counted;
            continue;
        }
        const Surface s = surface_at(scene, ray, hit);
        const RealVec o = real(ray.org), w = real(ray.dir);
        const Real along = -o[1] / w[1];
        const Plane& plane = scene.geometry.planes[0];
        const RealVec p{(o[0] + along * w[0]) / scale, 0, (o[2] + along * w[2]) / scale};
        const Vec3d& u = scene.plane_maps[0].u;
        const Vec3d& v = scene.plane_maps[0].v;
        const auto cell = [&](const Vec3d& axis) { return std::floor(inner(p, real(axis)) * factor); };
        const bool even = std::fmod(cell(u) + cell(v), 2.0L) == 0;
        cells.wrong += (checker.eval(s.uv, {}).r > 0.5f) != even;
        ++cells.counted;
        cells.off_plane = std::max(cells.off_plane,
                                   std::abs(static_cast<double>(inner(real(s.p), real(plane.normal)) - plane.offset)));
    }
    return cells;
}

}  // namespace

Outcome grazing_checker(const Setup& setup)
{
    Outcome out;
    const size_t rays = setup.scaled(30000, 1000000, 1000000);
    for (const double square : {1.0, 0.7}) {
        const Scene scene = build_scene(checker_floor(square));
        for (const char* name : judged_names) {
            const auto accel = make_accelerator(value_of<AccelKind>(name).value(), scene.geometry, "avx2");
            const Cells near = look_along(scene, *accel, square, 0, 6, rays);
            const Cells far = look_along(scene, *accel, square, 6, 7, rays / 4);
            const std::string where = ", squares of " + std::to_string(square).substr(0, 3) + ", " + name;
            out.measures.push_back(
                at_most("wrong squares up to t = 1e6, share" + where, near.wrong / near.counted, 1e-4));
            out.measures.push_back(told("wrong squares from 1e6 to 1e7, share" + where, far.wrong / far.counted));
            out.measures.push_back(at_most("height of a hit up to t = 1e7, ulps of 1" + where,
                                           std::max(near.off_plane, far.off_plane) / ulp(1), 2));
        }
    }
    return out;
}

Outcome horizon(const Setup&)
{
    Geometry g;
    g.planes.push_back({{0, 1, 0}, 0});
    const Scene scene = build_scene(checker_floor(1));
    constexpr float tiny = std::numeric_limits<float>::denorm_min(), small = 1e-38f;
    double wrong = 0, rays = 0, not_numbers = 0;
    for (const char* name : judged_names) {
        const auto accel = make_accelerator(value_of<AccelKind>(name).value(), scene.geometry, "avx2");
        for (const float slope : {0.0f, tiny, small, 1e-30f, 1e-20f, 1e-14f, 1e-10f, 1e-8f, 1e-6f})
            for (const float sign : {1.0f, -1.0f})
                for (const Vec3 level : {Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{-0.6f, 0, 0.8f}, Vec3{0.0f, -0.0f, 1}})
                    for (const float height : {1.0f, -1.0f, 1e-6f, 1e4f}) {
                        const float y = sign * slope;
                        const Ray ray{.org = {2, height, 3}, .dir = {level.x, y, level.z}};
                        // To the horizon and no farther: what is said of the plane's end.
                        const double t = -static_cast<double>(height) / static_cast<double>(y);
                        const bool below = t > 0 && t <= plane_extent;
                        const Hit hit = accel->closest(ray);
                        wrong += (hit.kind == Kind::plane) != below || accel->any(ray) != below;
                        if (hit) {
                            const Surface s = surface_at(scene, ray, hit);
                            not_numbers += !is_finite(to_double(s.p)) || !std::isfinite(s.t) ||
                                           !std::isfinite(s.uv.x) || !std::isfinite(s.uv.y);
                        }
                        ++rays;
                    }
    }
    Outcome out;
    // A picture whose middle row is the horizon: the seam.
    double seam = 0;
    for (const AccelKind accel : judged_kinds)
        for (const double height : {1.0, 1e-3, 1e3}) {
            SceneDescription d = checker_floor(1);
            d.materials[0].base_color_map.reset();
            d.materials[0].base_color = {};
            d.spheres.clear();
            d.camera = make_camera({0, height, 0}, {0, height, -1}, 1e-5);
            const Film film = take(d, {.width = 4, .height = 16, .spp = 16, .accel = accel}, out);
            for (uint32_t y = 0; y < 16; ++y)
                for (uint32_t x = 0; x < 4; ++x) seam += luminance_of(film.at(x, y)) != (y < 8 ? 1 : 0);
        }
    out.measures = {at_most("rays on the wrong side of the horizon", wrong, 0),
                    at_most("places that are no numbers", not_numbers, 0),
                    at_most("pixels of the wrong colour at the horizon", seam, 0), told("rays", rays)};
    return out;
}

}  // namespace lancer::stability
