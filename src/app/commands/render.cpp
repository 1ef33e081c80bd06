// lancer render: a scene into pictures.
#include <string>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/prepare.h"
#include "app/render/content.h"
#include "app/render/describe.h"
#include "app/render/frames.h"
#include "app/render/header_camera.h"
#include "app/render/identity.h"
#include "app/render/passes.h"
#include "app/render/phase_clock.h"
#include "app/render/render_frame.h"
#include "app/render/resolved.h"
#include "app/render/summary.h"
#include "app/system_info.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "render/estimators/auto_exposure.h"

namespace lancer {
namespace {

// One run of the command. Its figures grow as it goes.
class Run {
public:
    // film: of the frames before, or null.
    Run(const RenderOptions& options, Signals& signals, FrameCache* film) : signals_(signals), film_(film)
    {
        asked_.options = options;
    }
    FrameEnd execute();

private:
    void load();
    bool is_finished();
    std::shared_ptr<const Renderer> build();
    void describe_settings(const Renderer& renderer);
    void choose_curve(const Renderer& renderer);
    void render(const Renderer& renderer);
    void write(const PictureContent& picture);
    void write_stats();
    int report();

    Signals& signals_;
    FrameCache* film_;
    Diagnostics diagnostics_;
    ResolvedRender asked_;
    PictureRecipe picture_;
    std::optional<ErrorLog> log_;
    std::vector<std::string> written_;  // pictures
    bool has_failed_ = false;           // something could not be written as it was asked for
    bool can_go_on_ = false;            // the last checkpoint is written
    uint64_t pixels_ = 0;               // of the picture, or of the shard
};

void Run::load()
{
    timed(picture_.stats, "load", [&] { asked_ = resolve_render(asked_.options, diagnostics_, film_); });
    const RenderOptions& options = asked_.options;
    picture_.options = options;
    picture_.keeps_blocks_open = options.time || options.error || Checkpoints::are_wanted(options);
    log_.emplace(options);
    if (log_->is_wanted())
        log_->require_size(to_image(Film(asked_.settings.size.width, asked_.settings.size.height, asked_.crop)));
    log_->warn_of_shared_samples(asked_.settings.seed);
}

void Run::describe_settings(const Renderer& renderer)
{
    const RenderOptions& options = asked_.options;
    picture_.stats.settings = {.render = asked_.settings,
                               .crop = asked_.crop,
                               .threads = asked_.prepared.threads,
                               .tile = options.tile,
                               .batch = options.batch,
                               .kernel = std::string(name_of(renderer.profile())),
                               .hash = hash_of_settings(asked_.settings, options.picture.scene),
                               .options = reproducing_options(asked_.settings) + options_text(options.picture.scene),
                               .identity = picture_.stats.settings.identity};
}

// Before the first sample, so that snapshots and interrupted renders have the exposure of the finished picture.
void Run::choose_curve(const Renderer& renderer)
{
    picture_.curve.tonemap = asked_.output.tonemap.value_or(usual_tonemap(asked_.settings));
    const Exposure exposure = *asked_.output.exposure;
    picture_.curve.exposure_stops = exposure.stops;
    if (!exposure.is_automatic || (asked_.options.shard.is_whole() && !has_display_output(asked_.options))) return;
    timed(picture_.stats, "choose exposure", [&] {
        picture_.curve.exposure_stops =
            auto_exposure(renderer, asked_.prepared.metered, asked_.settings.size, pixel_grid(asked_.settings));
    });
    if (!asked_.options.quiet)
        print_note("PNG, PPM and JPEG: --exposure " + shortest(picture_.curve.exposure_stops) +
                   ", chosen from the picture");
}

void Run::render(const Renderer& renderer)
{
    const RenderOptions& options = asked_.options;
    RunStats& stats = picture_.stats;
    const uint32_t width = asked_.settings.size.width, height = asked_.settings.size.height;
    const Camera camera(asked_.prepared.description, renderer.scene().normalisation, width, height,
                        pixel_grid(asked_.settings));
    picture_.normalisation = renderer.scene().normalisation;
    picture_.light_groups = renderer.scene().light_groups.names;
    if (options.mattes) picture_.manifests = matte_manifests(renderer.scene());
    picture_.camera = header_camera(camera, picture_.normalisation, width, height);
    Passes passes(picture_, asked_.settings, *log_, signals_);
    pixels_ = passes.pixels();
    timed(stats, "render", [&] {
        passes.run(renderer, camera);
        // Here, as the plan is computed in the first pass.
        if (options.verbose) print_sampling_plan(renderer.integrator(), *renderer.plan(camera, width, height));
    });
    written_ = passes.write_checkpoint();
    can_go_on_ = passes.can_go_on();
    const Film& film = passes.film();
    if (options.outliers > 0 && !signals_.interrupted())
        stats.error_sources =
            timed(stats, "find outliers", [&] { return find_error_sources(renderer, camera, film, options.outliers); });
    // Before the first tile there is nothing worth replacing an old picture with. That of a shard is for merge.
    if (!has_samples(stats) || !options.shard.is_whole()) return;
    const Denoised none;
    const Denoised* denoised = &none;
    if (options.denoise && !stats.partial) {
        denoised = timed(stats, "denoise", [&] { return &passes.denoised(); });
        stats.denoised = !denoised->pixels.empty();
        // An interrupt leaves the noisy picture, which is not what was asked for.
        stats.partial = !stats.denoised;
        // Where that error has stopped the render it is told already.
        if (stats.denoised && stats.stopped_by != name_of(Stop::error)) passes.tell_error_of_denoised();
    }
    timed(stats, "write", [&] { write(content_of(film, *denoised, picture_)); });
}

// The picture is worth more than its place: where it cannot be written, others are tried.
void Run::write(const PictureContent& picture)
{
    const RenderOptions& options = asked_.options;
    try {
        write_outputs(options.outputs, picture);
        written_ = options.outputs;
    } catch (const Error& problem) {
        has_failed_ = true;
        written_ = rescue_outputs(options.outputs, picture);
        if (written_.empty()) throw;
        print_problem(problem.what());
        for (const std::string& name : written_) print_note("the picture is rescued as " + in_quotes(name));
    }
}

void Run::write_stats()
{
    if (asked_.options.stats.empty()) return;
    picture_.stats.peak_memory_bytes = peak_memory_bytes();
    try {
        write_text(asked_.options.stats, to_json(picture_.stats));
    } catch (const Error& problem) {
        has_failed_ = true;
        print_problem(problem.what());
    }
}

// Of a frame: whether all its pictures are there, with the identity that they would get.
bool Run::is_finished()
{
    const RenderOptions& options = asked_.options;
    if (!options.picture.scene.frame) return false;
    RunStats& s = picture_.stats;
    s.context = describe_context(options);
    s.scene.content_hash = asked_.prepared.description.content_hash;
    s.settings.render = asked_.settings, s.settings.crop = asked_.crop;
    s.settings.identity = frame_identity(options, s, asked_.output);
    return film_ && film_->skips_finished &&
           std::all_of(options.outputs.begin(), options.outputs.end(),
                       [&](const std::string& path) { return is_finished_picture(path, s.settings.identity); });
}

// The scene as it is now, with what the frame before left of it.
std::shared_ptr<const Renderer> Run::build()
{
    Prepared& prepared = asked_.prepared;
    if (film_ && is_same_scene(*film_, prepared)) return renderer_of_film(*film_, prepared, diagnostics_);
    timed(picture_.stats, "build scene", [&] { begin_prepared(prepared, diagnostics_); });
    prepared.description.meshes.clear();  // the scene has its own copy; two would be held for the whole render
    std::shared_ptr<const Renderer> renderer = timed(picture_.stats, "build accelerator", [&](PhaseClock& clock) {
        return make_renderer(
            prepared, asked_.options.picture, asked_.options.batch, diagnostics_, [&] { clock.next("finish scene"); },
            film_ ? film_->renderer.get() : nullptr);
    });
    if (film_) keep_for_film(*film_, prepared, renderer);
    return renderer;
}

FrameEnd Run::execute()
{
    probe_outputs(asked_.options);
    load();
    if (is_finished()) return {exit_done, true};
    with_threads(asked_.prepared.threads, [&] {
        const std::shared_ptr<const Renderer> renderer = build();
        asked_.settings.accel = renderer->accelerator_kind();  // not automatic any more
        describe_run(asked_.options, asked_.prepared, *renderer, picture_.stats);
        describe_settings(*renderer);
        if (asked_.options.verbose) print_start(picture_.stats, asked_.settings);
        choose_curve(*renderer);
        render(*renderer);
    });
    return {report(), false};
}

// After the render; returns the exit code.
int Run::report()
{
    const RenderOptions& options = asked_.options;
    const RunStats& stats = picture_.stats;
    if (options.shard.is_whole() ? stats.phases.back().name != "write" : !has_samples(stats) && pixels_ > 0) {
        // A batch system that waits for a code to go on is told to begin again: loading may take long.
        const bool begins_again = !options.shard.is_whole() || !options.checkpoint.empty();
        print_problem(std::string("error: interrupted before the first sample; nothing is written") +
                      (begins_again ? ": to begin again, run the same command" : ""));
        return begins_again ? exit_unfinished : exit_interrupted;
    }
    if (!options.shard.is_whole() && !can_go_on_) has_failed_ = true;
    write_stats();
    print_dropped_samples(stats, asked_.settings, options.picture.scene);
    if (stats.error_sources && !options.quiet)
        print_error_sources(*stats.error_sources, asked_.settings, options.picture.scene);
    if (!options.quiet) print_summary(stats, options, log_->last());
    if (!options.write_scene.empty()) written_.insert(written_.begin(), options.write_scene);
    print_written(written_);
    if (log_->is_behind()) {
        has_failed_ = true;
        print_problem("error: the error log could not be written");
    }
    if (!stats.partial) return has_failed_ ? exit_failed : exit_done;
    const bool goes_on_by_itself = options.resume == "auto" || options.resume == options.checkpoint;
    const std::string how =
        goes_on_by_itself ? "run the same command" : "add --resume " + in_shell_quotes(options.checkpoint);
    print_problem(format_text("warning: interrupted: the %s partial (%.1f of %u samples per pixel%s)%s",
                              options.shard.is_whole() ? "pictures are" : "shard is", samples_per_pixel(stats, pixels_),
                              asked_.settings.spp, options.denoise ? ", not denoised" : "",
                              can_go_on_ ? ("; to go on, " + how).c_str() : ""));
    return has_failed_ ? exit_failed : can_go_on_ ? exit_unfinished : exit_interrupted;
}

}  // namespace

FrameEnd render_frame(const RenderOptions& options, Signals& signals, FrameCache* film)
{
    return Run(options, signals, film).execute();
}

int run_render(int argc, char** argv)
{
    const auto options = parse_render(argc, argv);
    if (!options) return exit_done;
    Signals signals;
    if (!options->frames) return render_frame(*options, signals).code;
    // A frame that fails, or is interrupted, ends them.
    int code = exit_done;
    for (uint64_t frame = options->frames->first; frame <= options->frames->last && code == exit_done; ++frame)
        code = render_frame(options_of_frame(*options, static_cast<uint32_t>(frame)), signals).code;
    return code;
}

}  // namespace lancer
