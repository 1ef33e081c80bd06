// The film: sums of samples per pixel. Sums are double and grow in blocks of 16 samples, so that a picture rendered in
// several passes has the bits of one pass.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/aov_layout.h"
#include "core/color.h"
#include "core/layers.h"

namespace lancer {

inline constexpr uint32_t samples_per_block = 16;

struct Pixel {
    std::array<double, 3> sum{};  // of radiance
    double sum_sq = 0;            // of squared luminance, for the error estimate
    uint32_t n = 0;               // number of finite samples

    Color mean() const
    {
        if (n == 0) return {};
        const double s = 1.0 / n;
        return {static_cast<float>(sum[0] * s), static_cast<float>(sum[1] * s), static_cast<float>(sum[2] * s)};
    }
    Pixel& operator+=(const Pixel& o)
    {
        for (size_t c = 0; c < 3; ++c) sum[c] += o.sum[c];
        sum_sq += o.sum_sq;
        n += o.n;
        return *this;
    }
};

// Radiance of the samples of one replicate; see KernelSettings::replicates.
struct ReplicateSum {
    std::array<double, 3> sum{};
    uint32_t n = 0;
};

// Sums over one of the sets into which the denoiser divides a pixel's samples.
struct SampleSet {
    // Of the first surface that spreads light, seen by way of mirrors and smooth glass; misses are 0: albedo, shading
    // normal (world space), 1 / distance (scene units).
    using Features = std::array<float, 7>;

    std::array<double, 3> sum{};  // of radiance
    Features features{};          // likewise
    uint32_t n = 0;               // number of finite samples
    uint32_t seen = 0;            // number of samples that features count

    SampleSet& operator+=(const SampleSet& o)
    {
        for (size_t c = 0; c < sum.size(); ++c) sum[c] += o.sum[c];
        for (size_t i = 0; i < features.size(); ++i) features[i] += o.features[i];
        n += o.n, seen += o.seen;
        return *this;
    }
};

// How samples are dealt to sets, of which the denoiser makes two halves that are about as good as each other, and as
// independent as can be.
struct SetDeal {
    uint32_t replicates = 1;  // see KernelSettings::replicates

    // Without replicates three sets serve any number of samples n: with 2^k < n <= 2^(k+1) they are [0, 2^(k-1)),
    // [2^(k-1), 2^k) and [2^k, n), so that Sobol' points are cut into low-discrepancy sets. Two sets of every second
    // point, or of halves of these intervals, would each be worse, and err in opposite ways.
    constexpr bool has_intervals() const { return replicates == 1; }
    // With four replicates and more, the last one of each half is a set of its own, which can be held out.
    constexpr uint32_t count() const { return has_intervals() ? 3 : replicates < 4 ? 2 : 4; }
    // path: as in KernelSettings::replicate_of().
    constexpr uint32_t set_of(uint32_t path) const
    {
        if (has_intervals()) return 2;
        const uint32_t r = path % replicates;
        return (r & 1) + (replicates >= 4 && r + 2 >= replicates ? 2 : 0);
    }
    // Where intervals begin.
    static constexpr bool is_begin(uint32_t sample) { return std::has_single_bit(sample); }
    static constexpr uint32_t next_begin(uint32_t sample) { return std::bit_ceil(sample + 1); }
};

// Half-open rectangle of pixels in the coordinates of the whole picture, y down.
struct Tile {
    uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    uint32_t width() const { return x1 - x0; }
    uint32_t height() const { return y1 - y0; }
    bool has(uint32_t x, uint32_t y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    friend bool operator==(const Tile&, const Tile&) = default;
};

// Half-open range of sample indices within each pixel.
struct SampleRange {
    uint32_t begin = 0, end = 0;
};

// How many samples of a pixel hit what has this name; see render/mattes.h. n = 0: a free place.
struct Matte {
    uint32_t id = 0, n = 0;
};
// Places for the names of each kind in a pixel, objects and materials; what finds none is not counted.
inline constexpr uint32_t mattes_per_kind = 12, matte_kinds = 2;

struct Film {
    uint32_t width = 0, height = 0;  // of the whole picture
    Tile crop;                       // the part that is rendered; pixels holds only that
    std::vector<Pixel> pixels;
    // Sums for AOVs, pixel by pixel; empty if no AOV is requested.
    AovLayout aov_layout;
    std::vector<double> aovs;

    // Partial blocks: if a pass ended within a block, the next pass continues it. Parallel to pixels and to aovs, or
    // empty: then only the first block can be continued, while the pixel holds nothing else.
    std::vector<Pixel> open;
    std::vector<double> open_aovs;
    // Sums of each replicate, pixel by pixel; empty without replicates.
    std::vector<ReplicateSum> replicates;
    // Sums of each set, pixel by pixel; empty without denoising.
    SetDeal deal;
    std::vector<SampleSet> sets;

    // Sums of radiance of each layer: of each pixel those of its first set, of its second and so on; without sets there
    // is one. Empty without layers.
    LayerLayout layers;
    std::vector<std::array<double, 3>> layer_sums;

    // Of each pixel those of objects, then those of materials; empty without mattes.
    std::vector<Matte> mattes;

    // Samples whose camera ray hits nothing are black, for a picture with an alpha channel. With AovSum::through so is
    // what glass shows of the background, with AovSum::caught so is what catches shadows.
    bool hides_background = false;

    // Adaptive sampling: number of samples of each pixel, 0 while it is unknown. Parallel to pixels; empty if all
    // pixels get the same number.
    std::vector<uint32_t> wanted;

    Film(uint32_t w, uint32_t h, Tile c) : width(w), height(h), crop(c), pixels(size_t{c.width()} * c.height()) {}
    // Allocates sums for AOVs. Must be called before rendering.
    void keep_aovs(const AovLayout& layout) { aov_layout = layout, aovs.assign(pixels.size() * layout.size(), 0); }
    void keep_sets(const SetDeal& how) { deal = how, sets.resize(pixels.size() * deal.count()); }
    void keep_mattes() { mattes.resize(pixels.size() * mattes_per_kind * matte_kinds); }
    Matte* mattes_of(size_t pixel) { return &mattes[pixel * mattes_per_kind * matte_kinds]; }
    // Allocates the layers; sets must be allocated before.
    void keep_layers(const LayerLayout& layout)
    {
        layers = layout;
        layer_sums.resize(pixels.size() * sets_of_layers() * layers.size());
    }
    size_t sets_of_layers() const { return sets.empty() ? 1 : deal.count(); }
    // The layers of a set of a pixel, as many as there are.
    std::array<double, 3>* layers_of(size_t pixel, size_t set)
    {
        return &layer_sums[(pixel * sets_of_layers() + set) * layers.size()];
    }
    // The sum of layer k of a pixel over its sets.
    std::array<double, 3> layer(size_t pixel, size_t k) const
    {
        std::array<double, 3> sum{};
        for (size_t set = 0; set < sets_of_layers(); ++set)
            for (size_t c = 0; c < 3; ++c)
                sum[c] += layer_sums[(pixel * sets_of_layers() + set) * layers.size() + k][c];
        return sum;
    }
    // The set of a path of a pixel.
    SampleSet& set_of(size_t pixel, uint32_t path) { return sets[pixel * deal.count() + deal.set_of(path)]; }
    // Without replicates: before the first sample of a pixel that is in the next interval.
    void begin_interval(size_t pixel)
    {
        SampleSet* const s = &sets[pixel * deal.count()];
        s[0] += s[1], s[1] = s[2], s[2] = {};
        for (size_t k = 0; k < layers.size(); ++k) {
            auto &a = layers_of(pixel, 0)[k], &b = layers_of(pixel, 1)[k], &c = layers_of(pixel, 2)[k];
            for (size_t i = 0; i < a.size(); ++i) a[i] += b[i];
            b = c, c = {};
        }
    }
    // Allows passes to end after any sample without changing the bits of the picture. AOVs must be allocated before.
    void keep_blocks_open() { open.resize(pixels.size()), open_aovs.resize(aovs.size()); }
    // The sums including partial blocks.
    Pixel whole(size_t i) const
    {
        Pixel p = pixels[i];
        if (!open.empty()) p += open[i];
        return p;
    }
    // Double k of a pixel's AOV sums including partial blocks; see AovLayout::offset().
    double whole_aov(size_t i, size_t k) const
    {
        const size_t at = i * aov_layout.size() + k;
        return open_aovs.empty() ? aovs[at] : aovs[at] + open_aovs[at];
    }
    size_t index(uint32_t x, uint32_t y) const { return size_t{y - crop.y0} * crop.width() + (x - crop.x0); }
    Pixel& at(uint32_t x, uint32_t y) { return pixels[index(x, y)]; }
    const Pixel& at(uint32_t x, uint32_t y) const { return pixels[index(x, y)]; }
};

// Total number of samples when each pixel has `spp`, or its own number where that is less.
uint64_t samples_wanted(const Film& film, uint32_t spp);

// Relative mean squared error estimated from the film's own samples: the mean over pixels of var / n / (mean^2 + 0.01)
// in luminance. It is an upper estimate: it assumes independent samples, and Sobol' points converge faster.
double estimate_rel_mse(const Film& film);

}  // namespace lancer
