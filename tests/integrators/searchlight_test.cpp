// A beam into a half-space of milk: the light around it, against photons of our own in double.
#include <gtest/gtest.h>

#include <random>

#include "support/scenes/media_scenes.h"
#include "support/shoot.h"

namespace lancer {
namespace {

constexpr double beam_radius = 0.3, half_width = 2;
constexpr uint32_t pixels_across = 48;
constexpr std::array<double, 5> rings{0.4, 0.7, 1.0, 1.4, 2.0};  // radii between which light is counted

struct Milk {
    double scattering, absorption, g;
};

std::optional<size_t> ring_of(double x, double y)
{
    // By the middle of the pixel, as in the picture.
    const double pixel = 2 * half_width / pixels_across;
    const auto middle = [&](double v) { return (std::floor(v / pixel) + 0.5) * pixel; };
    const double r = std::hypot(middle(x), middle(y));
    for (size_t i = 0; i + 1 < rings.size(); ++i)
        if (r >= rings[i] && r < rings[i + 1]) return i;
    return {};
}

// Radiance straight upwards for an irradiance of 1 over the beam, times the area of the ring. Each photon adds at each
// scattering what of it goes up and comes out.
std::vector<stats::Tally> photons(const Milk& milk, uint32_t count)
{
    std::mt19937_64 random(7);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const double sigma = milk.scattering + milk.absorption, g = milk.g;
    const auto phase = [&](double cosine) {
        return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    };
    std::vector<stats::Tally> found(rings.size() - 1);
    for (uint32_t i = 0; i < count; ++i) {
        std::vector<double> sum(found.size());
        const double radius = beam_radius * std::sqrt(unit()), turn = 2 * std::numbers::pi * unit();
        Vec3d p{radius * std::cos(turn), radius * std::sin(turn), 0}, w{0, 0, -1};
        double weight = std::numbers::pi * beam_radius * beam_radius;
        while (weight > 0) {
            p = p + w * (-std::log1p(-unit()) / sigma);
            if (p.z > 0) break;
            weight *= milk.scattering / sigma;
            if (const auto ring = ring_of(p.x, p.y)) sum[*ring] += weight * phase(w.z) * std::exp(sigma * p.z);
            const double s = (1 - g * g) / (1 + g - 2 * g * unit()), cosine = (1 + g * g - s * s) / (2 * g);
            const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = 2 * std::numbers::pi * unit();
            const Vec3d x = normalize(std::abs(w.z) < 0.9 ? cross(w, Vec3d{0, 0, 1}) : cross(w, Vec3d{1, 0, 0}));
            w = normalize(w * cosine + x * (sine * std::cos(angle)) + cross(w, x) * (sine * std::sin(angle)));
            if (weight < 0.05 && unit() < 0.5) break;
            if (weight < 0.05) weight *= 2;
        }
        for (size_t k = 0; k < sum.size(); ++k) found[k].add(sum[k]);
    }
    return found;
}

TEST(Searchlight, SpreadsInMilkAsPhotonsDo)
{
    for (const Milk& milk : {Milk{3, 0.2, 0.4}, Milk{4, 0.5, -0.3}}) {
        constexpr double far = 200;
        SceneDescription d;
        const auto of = [](double x) {
            return Color{static_cast<float>(x), static_cast<float>(x), static_cast<float>(x)};
        };
        d.materials = {
            make_scattering("milk", 1, of(milk.scattering), of(milk.absorption), static_cast<float>(milk.g))};
        d.planes = {plane_of({0, 0, 0}, {0, 0, 1}, "milk")};
        LightDescription spot = light_of(LightType::spot, of(far * far), {0, 0, far});
        const double angle = std::atan(beam_radius / far) * 180 / std::numbers::pi;
        spot.direction = {0, 0, -1};
        spot.inner_deg = static_cast<float>(angle * 0.9999), spot.outer_deg = static_cast<float>(angle);
        d.lights = {spot};
        d.camera = make_camera({0, 0, far}, {0, 0, 0}, 2 * std::atan(half_width / far) * 180 / std::numbers::pi);
        const Film film = shoot(d, {.width = pixels_across, .height = pixels_across, .spp = 320});
        const std::vector<stats::Tally> expected = photons(milk, 200000);
        const double pixel = 2 * half_width / pixels_across;
        for (size_t k = 0; k < expected.size(); ++k) {
            stats::Tally seen;
            double pixels = 0;
            for (uint32_t y = 0; y < pixels_across; ++y)
                for (uint32_t x = 0; x < pixels_across; ++x)
                    if (ring_of((x + 0.5) * pixel - half_width, (y + 0.5) * pixel - half_width) == k)
                        seen.add(tally(film.at(x, y)).mean), ++pixels;
            const double area = pixels * pixel * pixel;
            const std::string what = std::to_string(milk.g) + ", ring " + std::to_string(k);
            // The beam and the view open by 1 % each. The means of pixels differ by more than their noise: by the
            // profile within a ring.
            const double error = std::hypot(seen.error(), expected[k].error() / area);
            EXPECT_LT(error, 0.08 * seen.mean) << what;
            EXPECT_NEAR(seen.mean, expected[k].mean / area, 4 * error + 0.01 * seen.mean) << what;
        }
    }
}

}  // namespace
}  // namespace lancer
