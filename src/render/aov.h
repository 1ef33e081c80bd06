// Auxiliary outputs (AOVs): properties of the first surface that a sample hits, for denoisers, compositing and
// debugging. They are summed as radiance is, in double and block by block, so that they have the same bits for any
// number of threads, tiles, batches and passes.
#pragma once

#include <vector>

#include "core/film.h"
#include "core/image.h"
#include "render/aov_kind.h"
#include "render/workspace.h"

namespace lancer {

// Albedo under uniform illumination; of a mix, mixed.
Color albedo_at(const Scene& scene, uint32_t material, const ShadingPoint& point);
// Base colour of the material; of a mix, mixed.
Color base_color_at(const Scene& scene, uint32_t material, const ShadingPoint& point);

std::vector<Aov> all_aovs();

// The sums that these AOVs need. Variance and sample count need none: the radiance sums contain them.
AovLayout layout_of(const std::vector<Aov>& which);

// Variance of a pixel's mean luminance, as for independent samples; 0 for less than two.
double variance_of_mean(const Pixel& pixel);

// Sums AOVs, and the features of the denoiser, into a film that has room for them.
class AovListener : public NoListener {
public:
    AovListener(const Scene& scene, const Accelerator& accel, Film& film, const Tile& tile, Workspace& w)
        : scene_(scene), accel_(accel), film_(film), tile_(tile), w_(w)
    {
    }
    void ray(const PathState& s, const Hit& hit) const
    {
        if (!is_counted(s)) return;
        count(w_.slots[s.slot]);
        if (film_.hides_background && !hit) w_.has_missed[s.slot] = 1;
    }
    void background_only(const SampleId& id) const { count(id); }
    void vertex(const PathState& s, const Surface& surface) const;
    void begin_block(uint32_t first) const;
    void end_block(uint32_t end) const;

private:
    static bool is_counted(const PathState& s) { return s.depth == 0; }  // camera rays
    void count(const SampleId& id) const
    {
        if (film_.aov_layout.has(AovSum::samples)) ++*sum_of(id, AovSum::samples);
        if (!film_.sets.empty()) ++set_of(id).seen;
    }
    SampleSet& set_of(const SampleId& id) const { return film_.set_of(film_.index(id.x, id.y), id.sample); }
    void add_features(const PathState& s, const Surface& surface) const;
    // The sums of the sample's pixel, which must lie in the film.
    double* sum_of(const SampleId& id, AovSum sum) const
    {
        const size_t pixel = size_t{id.y - tile_.y0} * tile_.width() + (id.x - tile_.x0);
        return &w_.aov_block[pixel * film_.aov_layout.size() + film_.aov_layout.offset(sum)];
    }

    const Scene& scene_;
    const Accelerator& accel_;
    Film& film_;
    const Tile& tile_;
    Workspace& w_;
};

// The channels of a picture file: albedo.R .G .B, flat.R .G .B, normal.X .Y .Z (world space), position.X .Y .Z and
// depth.Z (units of the scene file), uv.U .V, material.ID (of the first sample, counted from 1; 0: nothing hit),
// variance.V (of the pixel's mean luminance), mask.A (the part of the samples that hit something), samples.N (how many
// the pixel has). Means over samples, misses being 0; depth, position and uv over those that hit.
// The film must have the sums of `which`.
std::vector<ImagePlane> aov_planes(const Film& film, const std::vector<Aov>& which, const Normalisation& normalisation);

// The alpha channel, "A": as mask.A. The film must have its sums.
ImagePlane alpha_of(const Film& film);

}  // namespace lancer
