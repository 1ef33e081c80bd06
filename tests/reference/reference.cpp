#include "reference/reference.h"

#include <atomic>
#include <stdexcept>
#include <thread>

#include "reference/walk.h"
#include "support/salt.h"

namespace reference {

// fov is the vertical angle from edge to edge. Thin lens: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th
// ed., section 5.2.3; all rays through a place of the film meet in the plane in focus.
Ray camera_ray(const lancer::CameraDescription& c, double x, double y, uint32_t width, uint32_t height, double lens_u,
               double lens_v)
{
    const Vec eye = vec(c.position), forward = unit(vec(c.target) - eye);
    const Vec right = unit(cross(forward, vec(c.up))), up = cross(right, forward);
    const double half = std::tan(c.fov_deg * pi / 360);
    const Vec way = forward + right * (half * (2 * x - width) / height) - up * (half * (2 * y - height) / height);
    if (c.type != lancer::CameraType::thin_lens || c.aperture == 0) return {eye, unit(way)};
    const double focus = c.focus.value_or(norm(vec(c.target) - eye));
    const double r = c.aperture * std::sqrt(lens_u), turn = 2 * pi * lens_v;
    const Vec on_lens = right * (r * std::cos(turn)) + up * (r * std::sin(turn));
    return {eye + on_lens, unit(way * focus - on_lens)};
}

Picture render(const World& world, const lancer::CameraDescription& camera, const Options& o)
{
    Picture picture{o.width, o.height, o.spp, std::vector<Rgb>(size_t{o.width} * o.height),
                    std::vector<double>(size_t{o.width} * o.height)};
    const auto pixel = [&](uint32_t x, uint32_t y) {
        const uint64_t number = uint64_t{y} * o.width + x;
        Rgb sum;
        double mean = 0, squares = 0;  // of luminance: Welford 1962
        for (uint32_t i = 0; i < o.spp; ++i) {
            Random random(lancer::salted(o.seed), number, i);
            const double px = x + random.next(), py = y + random.next(), lu = random.next(), lv = random.next();
            const Rgb light =
                walk(world, camera_ray(camera, px, py, o.width, o.height, lu, lv), {o.max_depth, o.indirect}, random);
            sum += light;
            const double l = luminance(light), step = l - mean;
            mean += step / (i + 1);
            squares += step * (l - mean);
        }
        picture.mean[number] = sum * (1.0 / o.spp);
        picture.variance[number] = o.spp > 1 ? squares / (o.spp - 1) / o.spp : 0;
    };
    std::atomic<uint32_t> next_row{0};
    const auto work = [&] {
        for (uint32_t y; (y = next_row++) < o.height;)
            for (uint32_t x = 0; x < o.width; ++x) pixel(x, y);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < o.threads; ++i) others.emplace_back(work);
    work();
    others.clear();
    return picture;
}

Picture render(const lancer::SceneDescription& scene, const Options& options, const lancer::RasterSource& images)
{
    if (!scene.camera) throw std::invalid_argument("the reference needs a camera");
    return render(World(scene, images), *scene.camera, options);
}

}  // namespace reference
