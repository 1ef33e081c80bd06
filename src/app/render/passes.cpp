#include "app/render/passes.h"

#include <cmath>
#include <stop_token>

#include "app/console.h"
#include "app/render/content.h"
#include "app/render/identity.h"
#include "app/render/phase_clock.h"
#include "app/render/progress.h"
#include "app/render/render_memory.h"
#include "app/render/shard.h"
#include "core/names.h"
#include "render/denoise/film_halves.h"
#include "report/metrics/held_out_error.h"

namespace lancer {
namespace {

std::vector<Tile> tiles_to_render(const PictureRecipe& recipe)
{
    const Tile& crop = recipe.stats.settings.crop;
    const Shard& shard = recipe.options.shard;
    return shard.is_whole() ? make_tiles(crop, recipe.options.tile) : tiles_of(shard, crop);
}

Film film_that_fits(const PictureRecipe& recipe)
{
    require_memory(recipe);
    return empty_film(recipe);
}

}  // namespace

Passes::Passes(PictureRecipe& recipe, const RenderSettings& settings, ErrorLog& log, Signals& signals)
    : recipe_(recipe),
      options_(recipe.options),
      stats_(recipe.stats),
      settings_(settings),
      log_(log),
      signals_(signals),
      tiles_(tiles_to_render(recipe)),
      pixels_(pixels_of(tiles_)),
      limits_({.spp = settings.spp, .time = options_.time, .error = options_.error, .looks_early = log.is_wanted()}),
      film_(film_that_fits(recipe)),
      live_view_(options_, film_, stats_.scene.warnings),
      checkpoints_(recipe, film_)
{
    const std::optional<RenderState> before = checkpoints_.resume(film_);
    if (before) go_on_from(*before);
}

void Passes::go_on_from(const RenderState& state)
{
    const uint32_t reached = state.pass.end;
    if (reached > settings_.spp)
        throw Error(ErrorKind::usage, {},
                    format_text("--resume: the checkpoint has up to %u samples per pixel, more than the %u of --spp",
                                reached, settings_.spp));
    limits_.begin_with(state.wall_s, state.cpu_s);
    stats_.passes = state.passes;
    halves_ = HalfBuffers(state.halves, state.error);
    if (!state.error_log.empty()) log_.begin_with(state.error_log);
    add_samples(state.counters);
    if (state.left.empty()) estimate_error();
    if (!options_.quiet)
        print_note(format_text("going on after %.1f samples per pixel", samples_per_pixel(stats_, pixels_)));
    range_ = state.pass, left_ = state.left;
    // Of merged shards some may be missing.
    if (std::vector<Tile> missing = tiles_without(state.held, film_.crop);
        options_.shard.is_whole() && !missing.empty())
        range_.begin = 0, left_ = std::move(missing);
}

RenderState Passes::state() const
{
    return {.shard = options_.shard,
            .held = options_.shard.is_whole() ? std::vector{film_.crop} : tiles_of(options_.shard, film_.crop),
            .pass = range_,
            .left = left_,
            .counters = stats_.counters,
            .wall_s = limits_.wall_seconds(),
            .cpu_s = limits_.cpu_seconds(),
            .passes = stats_.passes,
            .halves = halves_.halves(),
            .error = halves_.rel_mse(),
            .error_log = log_.is_wanted() ? log_.text() : ""};
}

void Passes::run(const Renderer& renderer, const Camera& camera)
{
    Progress progress(options_.quiet ? ProgressKind::none : options_.progress,
                      settings_.spp == unlimited_spp ? 0 : settings_.spp, pixels_, options_.time);
    std::stop_source enough;
    const std::stop_callback on_interrupt(signals_.stop(), [&] { enough.request_stop(); });
    signals_.poll();
    while (!left_.empty() || (range_.end < settings_.spp && !tiles_.empty())) {
        if (left_.empty()) range_ = {range_.end, limits_.next_end(range_.end)}, left_ = tiles_;
        one_pass(renderer, camera, progress, enough);
        if (signals_.interrupted() || is_enough(progress)) break;
    }
    if (tiles_.empty()) range_ = {0, settings_.spp};  // more shards than pixels
    progress.clear();
}

void Passes::one_pass(const Renderer& renderer, const Camera& camera, Progress& progress, std::stop_source& enough)
{
    progress.begin_pass(range_, left_.size());
    limits_.begin_pass();
    while (!left_.empty() && !enough.stop_requested()) {
        if (has_samples(stats_) && signals_.take_snapshot_request()) {
            limits_.pause();
            write_snapshot(progress);
            limits_.resume();
        }
        if (has_samples(stats_) && checkpoints_.are_due()) {
            limits_.pause();
            checkpoints_.begin_write(recipe_, state(), film_);
            limits_.resume();
        }
        std::stop_source halt;
        const std::stop_callback on_enough(enough.get_token(), [&] { halt.request_stop(); });
        PassResult result = renderer.pass(camera, film_, left_, range_, halt.get_token(), [&](const Tile& tile) {
            signals_.poll();
            live_view_.tile_done(film_, tile, progress);
            if (limits_.is_out_of_time()) enough.request_stop();
            progress.tile_done();
            if (signals_.snapshot_requested() || checkpoints_.are_due()) halt.request_stop();
        });
        add_samples(result.counters);
        left_ = std::move(result.left);
    }
    limits_.end_pass();
    end_pass();
}

void Passes::end_pass()
{
    // If no pixel needs more samples, the film is final.
    const uint32_t spp = stats_.partial ? range_.end : settings_.spp;
    estimate_error();
    if (!is_complete()) return;
    stats_.passes.push_back({spp, stats_.render_s, stats_.estimated_error});
    if (limits_.is_mark(spp) && log_.is_wanted()) log_error();
}

// Whether what was asked for is reached.
bool Passes::is_enough(Progress& progress)
{
    const uint32_t spp = range_.end;
    // If no pixel needs more samples, the render is done.
    if (!stats_.partial) progress.begin_pass(range_ = {settings_.spp, settings_.spp}, tiles_.size());
    progress.end_pass(stats_.estimated_error, stats_.rays());
    const auto stop = limits_.reached(range_.end, error_to_judge());
    if (!stop) return false;
    stats_.partial = false;
    if (*stop != Stop::samples) stats_.stopped_by = name_of(*stop);
    if (*stop != Stop::samples || settings_.spp == unlimited_spp) {
        RenderSettings& told = stats_.settings.render;
        told.spp = spp;
        stats_.settings.hash = hash_of_settings(told, options_.picture.scene);
    }
    if (*stop != Stop::samples && log_.is_wanted() && !(is_complete() && limits_.is_mark(spp))) log_error();
    return true;
}

// Of a pass, or of the part of it up to a snapshot.
void Passes::add_samples(const Counters& counters)
{
    stats_.counters += counters;
    stats_.render_s = limits_.wall_seconds();
    stats_.samples = 0;
    for (size_t i = 0; i < film_.pixels.size(); ++i) stats_.samples += film_.whole(i).n;
    // Computed from the film: an interrupt may come after the last tile of a pass.
    const uint64_t wanted =
        options_.shard.is_whole() ? samples_wanted(film_, settings_.spp) : uint64_t{settings_.spp} * pixels_;
    stats_.partial = stats_.samples + stats_.counters.dropped < wanted;
}

void Passes::estimate_error()
{
    if (settings_.spp > 1) halves_.look(film_);
    if (const auto error = halves_.rel_mse()) stats_.estimated_error = std::sqrt(*error);
    if (film_.replicates.empty()) return;
    const auto from_replicates = estimate_from_replicates(film_, settings_.replicates);
    if (!from_replicates) return;
    stats_.estimated_error = std::sqrt(from_replicates->rel_mse);
    stats_.estimated_interval = {std::sqrt(from_replicates->interval.low), std::sqrt(from_replicates->interval.high)};
}

// A row of the error log: of the denoised picture where that is what will be written. What denoising it takes is part
// of its time, what denoising earlier ones took is not.
void Passes::log_error()
{
    if (!options_.denoise || samples_per_pixel(stats_, pixels_) < 2)
        return log_.add(to_image(film_), stats_, limits_.cpu_seconds());
    const double wall = wall_seconds(), cpu = cpu_seconds();
    const std::vector<Color>& pixels = denoised().pixels;
    if (pixels.empty()) return;
    RunStats stats = stats_;
    stats.render_s += wall_seconds() - wall;
    log_.add(to_image(film_, pixels), stats, limits_.cpu_seconds() + (cpu_seconds() - cpu));
}

const Denoised& Passes::denoised()
{
    if (denoised_samples_ == stats_.samples) return denoised_;
    const SignalWatch watch(signals_);
    denoised_ = denoise_film(film_, UsedSets::all, signals_.stop());
    if (!denoised_.pixels.empty()) denoised_samples_ = stats_.samples;
    return denoised_;
}

// The error that --error is about; nothing while it is not known.
std::optional<double> Passes::error_to_judge()
{
    if (options_.denoise && options_.error) {
        if (!limits_.looks_at_denoised(range_.end)) return {};
        tell_error_of_denoised();
        // What few samples tell may be far off, but its interval knows that.
        if (!stats_.denoised_interval) return {};
        return stats_.denoised_interval->high;
    }
    // Samples that all agree may all have missed the same light.
    return stats_.estimated_error > 0.0 ? stats_.estimated_error : std::nullopt;
}

void Passes::tell_error_of_denoised()
{
    if (film_.deal.count() != 4) return;
    timed(stats_, "error of denoised", [&] {
        const SignalWatch watch(signals_);
        const Denoised used = denoise_film(film_, UsedSets::without_held_out, signals_.stop());
        if (used.pixels.empty()) return;
        const auto error = held_out_error(film_, used.pixels);
        if (!error) return;
        const auto root = [](double x) { return std::sqrt(std::max(0.0, x)); };
        stats_.denoised_error = root(error->rel_mse);
        stats_.denoised_interval = {root(error->interval.low), root(error->interval.high)};
    });
}

void Passes::write_snapshot(Progress& progress)
{
    progress.clear();
    try {
        write_outputs(options_.outputs, content_of(film_, {}, recipe_));
    } catch (const Error& problem) {
        return print_as_warning(problem, "the render goes on without this snapshot");
    }
    print_note(format_text("snapshot written at %.1f spp", samples_per_pixel(stats_, pixels_)));
}

std::vector<std::string> Passes::write_checkpoint()
{
    if (!has_samples(stats_) && !tiles_.empty()) return {};
    can_go_on_ = checkpoints_.write(recipe_, state(), film_);
    if (options_.shard.is_whole()) return {};
    if (can_go_on_) return {options_.checkpoint};
    // All that a shard has rendered is in there.
    return checkpoints_.rescue(recipe_, state(), film_);
}

}  // namespace lancer
