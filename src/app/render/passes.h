// The passes of a render: a film gets twice the samples again and again, until there are enough or the render is
// interrupted, so that an interrupted one is a picture too. What is known of it is kept meanwhile: its figures, its
// error, its checkpoints.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/render/checkpoints.h"
#include "app/render/error_log.h"
#include "app/render/limits.h"
#include "app/render/live_view.h"
#include "app/render/recipe.h"
#include "app/signals.h"
#include "render/denoise/denoise.h"
#include "render/renderer.h"
#include "report/metrics/error_estimate.h"
#include "scene/camera.h"

namespace lancer {

// Whether any sample was rendered, be it one that was not finite.
inline bool has_samples(const RunStats& stats) { return stats.samples + stats.counters.dropped > 0; }
// Of a pixel, on average. pixels: of the picture, or of the shard.
inline double samples_per_pixel(const RunStats& stats, uint64_t pixels)
{
    return static_cast<double>(stats.samples) / static_cast<double>(std::max<uint64_t>(pixels, 1));
}

class Passes {
public:
    // recipe: of the picture, complete but for the figures, which grow. settings: with unlimited_spp if only time or
    // error stops the render. All must outlive this. Throws Error if the film does not fit into --memory, or if the
    // checkpoint of --resume is of another picture.
    Passes(PictureRecipe& recipe, const RenderSettings& settings, ErrorLog& log, Signals& signals);

    void run(const Renderer& renderer, const Camera& camera);
    // The last checkpoint, or the part that a shard is. Returns the names of what holds a shard.
    std::vector<std::string> write_checkpoint();
    bool can_go_on() const { return can_go_on_; }  // that checkpoint is written

    const Film& film() const { return film_; }
    uint64_t pixels() const { return pixels_; }  // of the picture, or of the shard
    // The picture with the present samples; computed once, as the last row of a log is of the picture that is written.
    // Without pixels after an interrupt.
    const Denoised& denoised();
    // Of the picture without the samples that are held out, which tell it; nothing if none are.
    void tell_error_of_denoised();

private:
    void go_on_from(const RenderState& state);
    RenderState state() const;
    void one_pass(const Renderer& renderer, const Camera& camera, Progress& progress, std::stop_source& enough);
    void end_pass();
    bool is_enough(Progress& progress);
    bool is_complete() const { return left_.empty(); }  // the pass
    void add_samples(const Counters& counters);
    void estimate_error();
    void log_error();
    std::optional<double> error_to_judge();
    void write_snapshot(Progress& progress);

    PictureRecipe& recipe_;
    const RenderOptions& options_;
    RunStats& stats_;
    const RenderSettings& settings_;
    ErrorLog& log_;
    Signals& signals_;
    std::vector<Tile> tiles_;
    uint64_t pixels_;
    RenderLimits limits_;
    Film film_;
    LiveView live_view_;
    Checkpoints checkpoints_;
    HalfBuffers halves_;
    Denoised denoised_;
    uint64_t denoised_samples_ = 0;  // of the picture that it is of
    SampleRange range_;              // of the pass
    std::vector<Tile> left_;         // of the pass
    bool can_go_on_ = false;
};

}  // namespace lancer
