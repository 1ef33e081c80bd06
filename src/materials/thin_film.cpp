#include "materials/thin_film.h"

#include "core/elementary.h"
#include "core/warp.h"

namespace lancer {
namespace {

// The middle of each band as a wave number, 1 / nanometres, and its standard deviation: 600, 545 and 455 nanometres
// with a width at half height of about 70, 70 and 50.
constexpr float middle[] = {1.0f / 600, 1.0f / 545, 1.0f / 455};
constexpr float deviation[] = {8.3e-5f, 1.0e-4f, 1.03e-4f};
constexpr int orders = 4;

template <class T>
T in_unit_range(T x)
{
    return smaller(T{} + 1.0f, larger(T{}, x));
}

// Amplitudes of reflection, of light polarised across the plane of incidence and along it.
template <class T>
struct Amplitudes {
    T s, p;
};
template <class T>
Amplitudes<T> amplitudes(T cos_before, T cos_after, T index)
{
    return {(cos_before - index * cos_after) / (cos_before + index * cos_after),
            (index * cos_before - cos_after) / (index * cos_before + cos_after)};
}
// Cosine beyond a boundary; 0 under total reflection.
template <class T>
T cos_beyond(T cos, T index)
{
    return sqrt(larger(T{}, 1.0f - (1.0f - cos) * (1.0f + cos) / (index * index)));
}

// The phase in the middle of a band, and what of it counts. path: difference of optical paths.
template <class T>
struct Fringes {
    T cosine;      // of the phase
    T fade;        // by how much the mean over the band of the orders after those below is less than that in its middle
    T of[orders];  // of the first orders: the cosine times what more of it than that is left

    Fringes(T path, float wave_number, float width)
    {
        const T turns = path * wave_number, sigma = 2 * pi * width * path;
        T before = T{} + 1.0f;
        of[0] = cosine = sin_cos_2pi(turns - nearest(turns)).cos;
        for (int m = 1; m < orders; before = of[m - 1], ++m) of[m] = 2.0f * cosine * of[m - 1] - before;
        // Order m fades to the power m^2, and between two squares there are the odd powers.
        constexpr float log2_e = 1.44269504088896340736f;
        T left[orders + 1], odd = power_of_two(-0.5f * log2_e * sigma * sigma);
        const T square = odd * odd;
        left[0] = odd;
        for (int m = 1; m <= orders; ++m) odd *= square, left[m] = left[m - 1] * odd;
        fade = left[orders];
        for (int m = 0; m < orders; ++m) of[m] *= left[m] - fade;
    }
};

// The square of the sum of amplitudes, |a + (1 - a^2) b e / (1 + a b e)|^2 with the phase e. By its Fourier series: the
// mean over all phases, and orders of fringes.
template <class T>
T of_polarisation(T a, T b, const Fringes<T>& fringes)
{
    const T q = a * b, q2 = q * q, passed = (1.0f - a * a) * (1.0f - b * b), part = passed / (1.0f - q2);
    const T mean = 1.0f - part, all = 1.0f - passed / (1.0f + q2 + 2.0f * q * fringes.cosine);
    T series = fringes.of[orders - 1];
    for (int m = orders - 1; m-- > 0;) series = fringes.of[m] - q * series;
    const T sum = mean + fringes.fade * (all - mean) + 2.0f * part * q * series;
    return select(q2 < 1 - 1e-6f, sum, T{} + 1.0f);
}

}  // namespace

// below(cosine in the film, channel): the amplitudes of the boundary below the film.
template <class T>
template <class F>
SpectrumOf<T> ThinFilmT<T>::reflectance(T cos, const F& below) const
{
    const T inside = cos_beyond(cos, ior);
    const auto [s, p] = amplitudes(cos, inside, ior);
    const T above_s = s, above_p = p;
    const T path = 2.0f * ior * thickness * inside;
    const auto of = [&](size_t channel) {
        const Amplitudes<T> b = below(inside, channel);
        const Fringes<T> fringes(path, middle[channel], deviation[channel]);
        const T sum = of_polarisation(above_s, b.s, fringes) + of_polarisation(above_p, b.p, fringes);
        return select(inside > 0.0f, in_unit_range(0.5f * sum), T{} + 1.0f);
    };
    return {of(0), of(1), of(2)};
}

template <class T>
SpectrumOf<T> ThinFilmT<T>::on_dielectric(T cos, T base_ior) const
{
    const T c = in_unit_range(cos), beyond = cos_beyond(c, base_ior);
    const Spectrum r = reflectance(c, [&](T inside, size_t) { return amplitudes(inside, beyond, base_ior / ior); });
    return each(r, [&](T x) { return select(beyond > 0.0f, x, T{} + 1.0f); });
}

template <class T>
SpectrumOf<T> ThinFilmT<T>::on_metal(T cos, const Spectrum& base) const
{
    const auto& [r, g, b] = base;
    const T channels[] = {r, g, b};
    return reflectance(in_unit_range(cos), [&](T, size_t channel) {
        const T amplitude = sqrt(in_unit_range(channels[channel]));
        return Amplitudes<T>{-amplitude, amplitude};
    });
}

template struct ThinFilmT<float>;
template struct ThinFilmT<Float4>;

}  // namespace lancer
