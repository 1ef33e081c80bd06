// Where samples end up. Sums are double and grow in blocks of 16 samples, so that a picture in several passes has the
// bits of one pass.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/aov_layout.h"
#include "core/color.h"

namespace lancer {

inline constexpr uint32_t samples_per_block = 16;

struct Pixel {
    std::array<double, 3> sum{};  // of radiance
    double sum_sq = 0;            // of squared luminance: feeds the error estimate
    uint32_t n = 0;               // samples that count; a non-finite one does not

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

// Light of the samples of one replicate: see KernelSettings::replicates.
struct ReplicateSum {
    std::array<double, 3> sum{};
    uint32_t n = 0;
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

struct Film {
    uint32_t width = 0, height = 0;  // of the whole picture
    Tile crop;                       // the part that is rendered; pixels holds only that
    std::vector<Pixel> pixels;
    // Sums for AOVs: all of the first pixel, then all of the next one. Empty if none is wanted: nobody then looks at
    // what is hit first.
    AovLayout aov_layout;
    std::vector<double> aovs;

    // Blocks that the last pass ended within and that the next one goes on with: parallel to pixels and to aovs, else
    // empty: then only the first block can be gone on with, while there is nothing else in a pixel.
    std::vector<Pixel> open;
    std::vector<double> open_aovs;
    // If they are wanted, all of the first pixel, then all of the next one; else empty.
    std::vector<ReplicateSum> replicates;

    // Samples that each pixel shall have, if they may end early: parallel to pixels, else empty. 0: not known yet.
    std::vector<uint32_t> wanted;

    Film(uint32_t w, uint32_t h, Tile c) : width(w), height(h), crop(c), pixels(size_t{c.width()} * c.height()) {}
    // Wants sums for AOVs. Nothing must have been rendered yet.
    void keep_aovs(const AovLayout& layout) { aov_layout = layout, aovs.assign(pixels.size() * layout.size(), 0); }
    // From now on a pass may end after any sample without a bit that differs. Aovs must be there before.
    void keep_blocks_open() { open.resize(pixels.size()), open_aovs.resize(aovs.size()); }
    // With what is open.
    Pixel whole(size_t i) const
    {
        Pixel p = pixels[i];
        if (!open.empty()) p += open[i];
        return p;
    }
    // Double k of the sums for AOVs, likewise; see AovLayout::offset().
    double whole_aov(size_t i, size_t k) const
    {
        const size_t at = i * aov_layout.size() + k;
        return open_aovs.empty() ? aovs[at] : aovs[at] + open_aovs[at];
    }
    size_t index(uint32_t x, uint32_t y) const { return size_t{y - crop.y0} * crop.width() + (x - crop.x0); }
    Pixel& at(uint32_t x, uint32_t y) { return pixels[index(x, y)]; }
    const Pixel& at(uint32_t x, uint32_t y) const { return pixels[index(x, y)]; }
};

// Samples of all pixels once each has `spp`, or as many as it wants if that is less.
uint64_t samples_wanted(const Film& film, uint32_t spp);

// Relative mean squared error of the film as its own samples tell it: mean over pixels of var / n / (mean^2 + 0.01) in
// luminance. An upper estimate: it takes the samples for independent, and Sobol' points do better.
double estimate_rel_mse(const Film& film);

}  // namespace lancer
