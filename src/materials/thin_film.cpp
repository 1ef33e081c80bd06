#include "materials/thin_film.h"

#include <algorithm>
#include <cmath>

#include "core/warp.h"

namespace lancer {
namespace {

// The middle of each band as a wave number, 1 / nanometres, and its standard deviation: 600, 545 and 455 nanometres
// with a width at half height of about 70, 70 and 50.
constexpr Color middle{1.0f / 600, 1.0f / 545, 1.0f / 455};
constexpr Color deviation{8.3e-5f, 1.0e-4f, 1.03e-4f};
constexpr int orders = 4;

// Amplitudes of reflection, of light polarised across the plane of incidence and along it.
struct Amplitudes {
    float s, p;
};
Amplitudes amplitudes(float cos_before, float cos_after, float index)
{
    return {(cos_before - index * cos_after) / (cos_before + index * cos_after),
            (index * cos_before - cos_after) / (index * cos_before + cos_after)};
}
// Cosine beyond a boundary; 0 under total reflection.
float cos_beyond(float cos, float index)
{
    return std::sqrt(std::max(0.0f, 1 - (1 - cos) * (1 + cos) / (index * index)));
}

// The cosine of the phase of each order of reflection in the middle of a band, and by how much its mean over the band
// is less; what fades of the orders beyond counts as the first of them. path: difference of optical paths.
struct Fringes {
    float cosine[orders], fade[orders + 1];

    Fringes(float path, float wave_number, float width)
    {
        const float turns = path * wave_number, sigma = 2 * pi * width * path;
        for (int m = 1; m <= orders; ++m) {
            const float t = turns * static_cast<float>(m);
            cosine[m - 1] = sin_cos_2pi(t - std::floor(t)).cos;
        }
        for (int m = 1; m <= orders + 1; ++m) fade[m - 1] = std::exp(-0.5f * sigma * sigma * static_cast<float>(m * m));
    }
};

// The square of the sum of amplitudes, |a + (1 - a^2) b e / (1 + a b e)|^2 with the phase e, by its Fourier series.
float of_polarisation(float a, float b, const Fringes& fringes)
{
    const float q = a * b, passed = (1 - a * a) * (1 - b * b), denominator = 1 - q * q;
    if (!(denominator > 1e-6f)) return 1;
    const float constant = 1 - passed / denominator, factor = 2 * passed / denominator;
    float faded = constant, sharp = constant, power = 1;
    for (int m = 0; m < orders; ++m) {
        power *= -q;
        const float order = factor * power * fringes.cosine[m];
        faded -= order * fringes.fade[m], sharp -= order;
    }
    const float all = 1 - passed / (1 + q * q + 2 * q * fringes.cosine[0]);
    return std::clamp(faded + fringes.fade[orders] * (all - sharp), 0.0f, 1.0f);
}

}  // namespace

// below(cosine in the film, channel): the amplitudes of the boundary below the film.
template <class F>
Color ThinFilm::reflectance(float cos, const F& below) const
{
    const float inside = cos_beyond(cos, ior);
    if (!(inside > 0)) return {1, 1, 1};
    const Amplitudes above = amplitudes(cos, inside, ior);
    const float path = 2 * ior * thickness * inside;
    const auto of = [&](float Color::*channel) {
        const Amplitudes b = below(inside, channel);
        const Fringes fringes(path, middle.*channel, deviation.*channel);
        return 0.5f * (of_polarisation(above.s, b.s, fringes) + of_polarisation(above.p, b.p, fringes));
    };
    return {of(&Color::r), of(&Color::g), of(&Color::b)};
}

Color ThinFilm::on_dielectric(float cos, float base_ior) const
{
    const float c = std::clamp(cos, 0.0f, 1.0f), beyond = cos_beyond(c, base_ior);
    if (!(beyond > 0)) return {1, 1, 1};
    return reflectance(c, [&](float inside, float Color::*) { return amplitudes(inside, beyond, base_ior / ior); });
}

Color ThinFilm::on_metal(float cos, Color base) const
{
    return reflectance(std::clamp(cos, 0.0f, 1.0f), [&](float, float Color::*channel) {
        const float r = std::sqrt(std::clamp(base.*channel, 0.0f, 1.0f));
        return Amplitudes{-r, r};
    });
}

}  // namespace lancer
