// Auxiliary outputs (AOVs): properties of the first surface that a sample hits, for denoisers, compositing and
// debugging. They are summed as radiance is, in double and block by block, so that they have the same bits for any
// number of threads, tiles, batches and passes.
#pragma once

#include <vector>

#include "core/film.h"
#include "core/image.h"
#include "render/aov_kind.h"
#include "render/light_layers.h"
#include "render/mattes.h"
#include "render/workspace.h"

namespace lancer {

// Albedo under uniform illumination; of a mix, mixed.
Color albedo_at(const Scene& scene, uint32_t material, const ShadingPoint& point);
// Base colour of the material; of a mix, mixed.
Color base_color_at(const Scene& scene, uint32_t material, const ShadingPoint& point);

std::vector<Aov> all_aovs();

// How many channels it has in a picture file.
size_t channel_count(Aov aov);

// The sums that these AOVs need. Variance and sample count need none: the radiance sums contain them.
AovLayout layout_of(const std::vector<Aov>& which);

// Variance of a pixel's mean luminance, as for independent samples; 0 for less than two.
double variance_of_mean(const Pixel& pixel);

// Sums AOVs, the features of the denoiser and the layers of light into a film that has room for them.
class AovListener : public NoListener {
public:
    // axis: the direction of the camera, unit.
    AovListener(const Scene& scene, const Accelerator& accel, Vec3 axis, Film& film, const Tile& tile, Workspace& w)
        : scene_(scene),
          accel_(accel),
          axis_(axis),
          film_(film),
          tile_(tile),
          w_(w),
          sees_through_glass_(film.aov_layout.has(AovSum::through)),
          catches_shadows_(film.aov_layout.has(AovSum::caught)),
          follows_(film.layers.has_lobes || sees_through_glass_ || catches_shadows_),
          waits_(!scene.media.empty())
    {
    }
    void ray(const PathState& s, const Hit& hit) const
    {
        if (!is_from_camera(s)) return;
        if (film_.hides_background && !hit && !scene_.scatters) w_.has_missed[s.slot] = 1;
        if (s.has_passed()) return;
        count(w_.slots[s.slot]);
        if (!film_.mattes.empty() && hit) add_to_mattes(w_.slots[s.slot], hit);
    }
    void background_only(const SampleId& id) const { count(id); }
    void added(const PathState& s, const Hit& hit, Color radiance) const
    {
        if (film_.layers.size() == 0) return;
        const LobeShare lobes = film_.layers.has_lobes ? w_.trails.of(index_of(s)).lobes : LobeShare{};
        add_to_layers(s.slot, scene_.group_of(hit), s.segment, lobes, radiance);
    }
    void shadow(const ShadowEnds& ends, const Ray&, Color radiance, bool occluded) const
    {
        if (film_.layers.size() == 0 || occluded) return;
        const LobeShare lobes = film_.layers.has_lobes ? w_.trails.of_shadow(ends) : LobeShare{};
        add_to_layers(ends.slot, scene_.group_of_light(ends.light), ends.segment, lobes, radiance);
    }
    void mirrored_shadow(const ShadowEnds& ends, const Ray& ray, Color radiance, bool occluded) const
    {
        shadow(ends, ray, radiance, occluded);
    }
    void vertex(const PathState& s, const Surface& surface) const;
    template <class V>
    bool takes(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler) const
    {
        if (!catches_shadows_ || !scene_.traits[surface.material].catches_shadows || !is_straight(s)) return false;
        w_.alpha.catch_shadow(view, s, surface, sampler);
        return true;
    }
    bool hides_sky(const PathState& s) const
    {
        // Camera rays are hidden with their samples: Workspace::has_missed; but not where media may have brought light.
        if (is_from_camera(s)) return film_.hides_background && scene_.scatters;
        if (!sees_through_glass_ || !is_straight(s)) return false;
        w_.alpha.add_background(s);
        return true;
    }
    template <class V, class Integrator>
    void left(const V& view, const Integrator& integrator, const PathState& s, const Surface& surface,
              const Sampler& sampler, const QueueSizes& queued) const
    {
        if (follows_)
            w_.trails.follow(view, integrator, s, index_of(s), surface, sampler, queued, film_.layers.has_lobes,
                             w_.queue);
    }
    // AOVs are of the surface behind a medium; where there is none, or it is not there, of the place in the medium.
    void scattered(const PathState& s, float t, const Medium& medium, const Surface* end) const;
    void left_medium(const PathState& s, const QueueSizes& queued) const
    {
        if (follows_) w_.trails.follow_medium(index_of(s), queued, w_.queue);
    }
    void begin_samples() const
    {
        if (follows_) w_.trails.begin(w_.slots.size());
        if (sees_through_glass_ || catches_shadows_) w_.alpha.begin(w_.slots.size());
        if (waits_) begin_late();
    }
    void end_samples() const
    {
        if (waits_) add_late();
        if (sees_through_glass_ || catches_shadows_) add_alpha();
    }
    void end_rays(Counters& counters) const
    {
        if (follows_) w_.trails.end_rays();
        if (catches_shadows_) counters.shadow_rays += w_.alpha.trace(accel_);
    }
    void begin_block(uint32_t first) const;
    void end_block(uint32_t end) const;

private:
    static bool is_from_camera(const PathState& s) { return s.depth == 0; }
    void count(const SampleId& id) const
    {
        if (film_.aov_layout.has(AovSum::samples)) ++*sum_of(id, AovSum::samples);
        if (!film_.sets.empty()) ++set_of(id).seen;
    }
    // s is one of the states that are traced.
    size_t index_of(const PathState& s) const { return static_cast<size_t>(&s - w_.states.data()); }
    void add_to_layers(uint32_t slot, uint8_t group, PathSegment segment, const LobeShare& lobes, Color radiance) const
    {
        add_radiance(&w_.layers[size_t{slot} * film_.layers.size()], film_.layers, group, segment, lobes, radiance);
    }
    void add_to_mattes(const SampleId& id, const Hit& hit) const
    {
        Matte* const mattes = film_.mattes_of(film_.index(id.x, id.y));
        count_matte({mattes, mattes_per_kind}, matte_id(object_name(scene_, hit)));
        count_matte({mattes + mattes_per_kind, mattes_per_kind},
                    matte_id(scene_.material_names[scene_.material_of(hit)]));
    }
    SampleSet& set_of(const SampleId& id) const { return film_.set_of(film_.index(id.x, id.y), id.sample); }
    void add_features(const PathState& s, const Surface& surface) const;
    void add_distance(const PathState& s, float distance) const;
    void add_alpha() const;
    void begin_late() const;
    void add_late() const;
    // Whether the camera sees what the ray meets, as it is or through smooth glass.
    bool is_straight(const PathState& s) const
    {
        return sees_through_glass_ ? w_.trails.of(index_of(s)).is_straight : is_from_camera(s);
    }
    // The sums of the sample's pixel, which must lie in the film.
    double* sums_of(const SampleId& id) const
    {
        const size_t pixel = size_t{id.y - tile_.y0} * tile_.width() + (id.x - tile_.x0);
        return &w_.aov_block[pixel * film_.aov_layout.size()];
    }
    double* sum_of(const SampleId& id, AovSum sum) const { return sums_of(id) + film_.aov_layout.offset(sum); }

    // Where a camera ray adds what it has met. Rays that skip surfaces meet theirs after other samples of the pixel
    // have met theirs, sooner or later by the size of the batch: what they add waits for the end, or sums would depend
    // on it.
    double* sum_of(const PathState& s, AovSum sum) const
    {
        if (!waits_) return sum_of(w_.slots[s.slot], sum);
        return &w_.late_aovs[size_t{s.slot} * film_.aov_layout.size() + film_.aov_layout.offset(sum)];
    }
    SampleSet::Features& features_of(const PathState& s) const
    {
        return waits_ ? w_.late_features[s.slot] : set_of(w_.slots[s.slot]).features;
    }

    const Scene& scene_;
    const Accelerator& accel_;
    Vec3 axis_;
    Film& film_;
    const Tile& tile_;
    Workspace& w_;
    bool sees_through_glass_, catches_shadows_, follows_, waits_;
};

// The channels of a picture file: albedo.R .G .B, flat.R .G .B, normal.X .Y .Z (world space), position.X .Y .Z and
// depth.Z and Z, along the optical axis (units of the scene file), uv.U .V, material.ID (of the first sample, counted
// from 1; 0: nothing hit), variance.V (of the pixel's mean luminance), mask.A (the part of the samples that hit
// something), samples.N (how many the pixel has). Means over samples, misses being 0; depth, Z, position and uv over
// those that hit. The film must have the sums of `which`.
std::vector<ImagePlane> aov_planes(const Film& film, const std::vector<Aov>& which, const Normalisation& normalisation);

// The sums that alpha needs. glass: the background behind it is hidden as well; catcher: something catches shadows.
void add_alpha_sums(bool glass, bool catcher, AovLayout& layout);
// Alpha of a pixel, whose sums the film must have: the part of the samples that hit something. Of those that went on
// through glass to the background what it let through is left out; of those on what catches shadows all but the part
//     (sum of the direct light that is blocked) / (sum of the direct light if nothing were in the way).
double alpha_at(const Film& film, size_t pixel);
// The alpha channel, "A".
ImagePlane alpha_of(const Film& film);

}  // namespace lancer
