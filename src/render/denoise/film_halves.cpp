#include "render/denoise/film_halves.h"

#include <algorithm>

#include "render/aov.h"

namespace lancer {
namespace {

using SetsOfHalf = std::array<bool, 4>;

// Which sets of a pixel each half is made of. Of three the newest goes to the larger part until it is as large as the
// one before it; of four those that are held out are used, too, unless they are not to be.
std::array<SetsOfHalf, 2> sets_of_halves(const Film& film, size_t pixel, UsedSets used)
{
    if (film.deal.has_intervals()) {
        const SampleSet* const s = &film.sets[pixel * film.deal.count()];
        if (s[2].n < s[1].n) return {{{true, false, true, false}, {false, true, false, false}}};
        return {{{true, true, false, false}, {false, false, true, false}}};
    }
    const bool all = film.deal.count() == 4 && used == UsedSets::all;
    return {{{true, false, all, false}, {false, true, false, all}}};
}

SampleSet sum_of(const Film& film, size_t pixel, const SetsOfHalf& sets)
{
    SampleSet sum;
    for (size_t k = 0; k < film.deal.count(); ++k)
        if (sets[k]) sum += film.sets[pixel * film.deal.count() + k];
    return sum;
}

// The samples of both halves of a pixel. A half without a sample is as good as the other.
struct Halves {
    std::array<SetsOfHalf, 2> sets;
    std::array<SampleSet, 2> sums;
    std::array<uint32_t, 2> samples;
};
Halves halves_of_pixel(const Film& film, size_t pixel, UsedSets used)
{
    Halves h{sets_of_halves(film, pixel, used), {}, {}};
    for (size_t k = 0; k < 2; ++k) h.sums[k] = sum_of(film, pixel, h.sets[k]), h.samples[k] = h.sums[k].n;
    for (size_t k = 0; k < 2; ++k)
        if (h.samples[k] == 0) h.sets[k] = h.sets[1 - k], h.sums[k] = h.sums[1 - k];
    return h;
}

void add_means(const SampleSet& set, std::array<std::vector<float>, HalfPlanes::of_half>& planes)
{
    const double n = std::max(set.n, 1u);
    for (size_t c = 0; c < 3; ++c) planes[c].push_back(static_cast<float>(set.sum[c] / n));
    const float seen = static_cast<float>(std::max(set.seen, 1u));
    for (size_t k = 0; k < set.features.size(); ++k) planes[3 + k].push_back(set.features[k] / seen);
    // The harmonic mean of distances; 0 where nothing is hit.
    float& distance = planes.back().back();
    if (distance > 0) distance = 1 / distance;
}

// Light spread around an object would shine where the picture is transparent.
void hide_background(const Film& film, std::vector<Color>& pixels)
{
    for (size_t i = 0; i < pixels.size(); ++i)
        if (alpha_at(film, i) == 0) pixels[i] = {};
}

// Puts the light of a layer in the place of all light. Its variance is known from the halves alone.
void set_layer(const Film& film, uint32_t layer, HalfPlanes& planes)
{
    const size_t sets = film.deal.count();
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        std::array<Color, 2> means{};
        const Halves halves = halves_of_pixel(film, i, UsedSets::all);
        for (size_t h = 0; h < 2; ++h) {
            std::array<double, 3> sum{};
            for (size_t set = 0; set < sets; ++set)
                for (size_t c = 0; c < 3 && halves.sets[h][set]; ++c)
                    sum[c] += film.layer_sums[(i * sets + set) * film.layers.size() + layer][c];
            const double n = std::max(halves.sums[h].n, 1u);
            for (size_t c = 0; c < 3; ++c) planes.halves[h][c][i] = static_cast<float>(sum[c] / n);
            means[h] = {planes.halves[h][0][i], planes.halves[h][1][i], planes.halves[h][2][i]};
        }
        const float difference = luminance(means[0]) - luminance(means[1]);
        planes.variance[i] = difference * difference / 4;
    }
}

}  // namespace

DenoiseInput HalfPlanes::input(uint32_t width, uint32_t height) const
{
    DenoiseInput in{.width = width, .height = height, .halves = {}, .variance = variance};
    for (size_t h = 0; h < 2; ++h) {
        DenoiseHalf& half = in.halves[h];
        for (size_t c = 0; c < 3; ++c) {
            half.color[c] = halves[h][c];
            half.albedo[c] = halves[h][3 + c];
            half.normal[c] = halves[h][6 + c];
        }
        half.depth = halves[h][9];
        half.samples = samples[h];
    }
    return in;
}

HalfPlanes halves_of(const Film& film, UsedSets used)
{
    HalfPlanes planes;
    for (auto& half : planes.halves)
        for (auto& plane : half) plane.reserve(film.pixels.size());
    std::array<uint64_t, 2> samples{};
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const Halves halves = halves_of_pixel(film, i, used);
        for (size_t h = 0; h < 2; ++h) samples[h] += halves.samples[h], add_means(halves.sums[h], planes.halves[h]);
    }
    for (size_t h = 0; h < 2; ++h)
        planes.samples[h] =
            static_cast<float>(static_cast<double>(samples[h]) / static_cast<double>(film.pixels.size()));
    planes.variance.reserve(film.pixels.size());
    for (size_t i = 0; i < film.pixels.size(); ++i)
        planes.variance.push_back(static_cast<float>(variance_of_mean(film.whole(i))));
    return planes;
}

Denoised denoise_film(const Film& film, UsedSets used, const std::stop_token& stop)
{
    HalfPlanes halves = halves_of(film, used);
    const auto denoised_of = [&](const HalfPlanes& planes) {
        Denoised denoised = denoise_picture(planes.input(film.crop.width(), film.crop.height()), stop);
        if (film.hides_background && !denoised.pixels.empty()) hide_background(film, denoised.pixels);
        return denoised;
    };
    Denoised denoised = denoised_of(halves);
    if (used == UsedSets::without_held_out || denoised.pixels.empty()) return denoised;
    for (uint32_t k = 0; k < film.layers.size(); ++k) {
        set_layer(film, k, halves);
        denoised.layers.push_back(denoised_of(halves).pixels);
        if (denoised.layers.back().empty()) return {};
    }
    return denoised;
}

std::vector<std::string> names_of_halves()
{
    std::vector<std::string> names;
    for (const std::string half : {"denoise.a.", "denoise.b."})
        for (const char* name :
             {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"})
            names.push_back(half + name);
    names.push_back("denoise.variance.V");
    return names;
}

std::vector<ImagePlane> planes_of(HalfPlanes halves)
{
    std::vector<ImagePlane> planes;
    const std::vector<std::string> names = names_of_halves();
    for (auto& half : halves.halves)
        for (auto& values : half) planes.push_back({names[planes.size()], std::move(values)});
    planes.push_back({names.back(), std::move(halves.variance)});
    return planes;
}

std::vector<ImagePlane> guide_planes(const Film& film)
{
    std::vector<ImagePlane> planes;
    for (const char* name : {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"})
        planes.push_back({std::string("oidn.") + name, {}});
    for (ImagePlane& plane : planes) plane.values.reserve(film.pixels.size());
    const size_t count = film.deal.count();
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        SampleSet all;
        for (size_t s = 0; s < count; ++s) all += film.sets[i * count + s];
        for (size_t k = 0; k < planes.size(); ++k)
            planes[k].values.push_back(all.features[k] / static_cast<float>(std::max(all.seen, 1u)));
    }
    return planes;
}

HalfPlanes halves_from(std::vector<std::vector<float>> planes, const std::array<float, 2>& samples)
{
    HalfPlanes halves;
    halves.samples = samples;
    size_t i = 0;
    for (auto& half : halves.halves)
        for (auto& values : half) values = std::move(planes[i++]);
    halves.variance = std::move(planes[i]);
    return halves;
}

}  // namespace lancer
