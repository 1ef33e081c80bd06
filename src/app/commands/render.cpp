// lancer render: a scene into pictures, in passes that double, so that an interrupted render is a picture too.
#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/paths.h"
#include "app/prepare.h"
#include "app/render/checkpoints.h"
#include "app/render/content.h"
#include "app/render/describe.h"
#include "app/render/error_log.h"
#include "app/render/frames.h"
#include "app/render/header_camera.h"
#include "app/render/identity.h"
#include "app/render/limits.h"
#include "app/render/live_view.h"
#include "app/render/outputs.h"
#include "app/render/phase_clock.h"
#include "app/render/progress.h"
#include "app/render/recipe.h"
#include "app/render/render_frame.h"
#include "app/render/render_memory.h"
#include "app/render/shard.h"
#include "app/render/summary.h"
#include "app/signals.h"
#include "app/system_info.h"
#include "app/write_scene.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/image/jpeg.h"
#include "io/scene/scene_file.h"
#include "render/denoise/film_halves.h"
#include "render/estimators/auto_exposure.h"
#include "report/metrics/error_estimate.h"
#include "report/metrics/held_out_error.h"
#include "scene/camera.h"

namespace lancer {
namespace {

// Number of samples if only time or error stops a render.
constexpr uint32_t unlimited_spp = 1u << 28;

// One run of the command. Its figures grow as it goes.
class Run {
public:
    // film: of the frames before, or null.
    Run(const RenderOptions& options, Signals& signals, FrameCache* film)
        : options_(options), signals_(signals), film_(film)
    {
    }
    FrameEnd execute();

private:
    template <class F>
    auto timed(const char* phase, F&& f);
    void load();
    bool is_finished();
    std::shared_ptr<const Renderer> build();
    int report();
    void check_ocio() const;
    void hold_samples_out();
    void describe_settings(const Renderer& renderer);
    void render(const Renderer& renderer);
    void add_samples(const Film& film, const Counters& counters, const RenderLimits& limits);
    void end_pass(const Film& film, bool complete, SampleRange range, const RenderLimits& limits);
    void log_error(const Film& film, const RenderLimits& limits);
    double samples_per_pixel() const
    {
        return static_cast<double>(stats_.samples) / static_cast<double>(std::max<uint64_t>(pixels_, 1));
    }
    bool has_samples() const { return stats_.samples + stats_.counters.dropped > 0; }
    void write_snapshot(const Film& film, Progress& progress);
    void estimate_error(const Film& film);
    void end_at(Stop stop, uint32_t spp);
    std::string hash_with(uint32_t spp) const;
    void go_on_from(const RenderState& state, const Film& film, RenderLimits& limits);
    PictureRecipe recipe() const;
    RenderState state(SampleRange pass, const std::vector<Tile>& left, const RenderLimits& limits) const;
    void choose_curve(const Renderer& renderer);
    std::optional<double> error_to_judge(const Film& film, uint32_t spp, RenderLimits& limits);
    void tell_error_of_denoised(const Film& film);
    // Both arguments must outlive the result. denoised: empty where only the noisy picture is written.
    PictureContent picture_of(const Film& film, const Denoised& denoised) const
    {
        return content_of(film, denoised, recipe());
    }
    void write(const PictureContent& picture);
    void write_stats();
    void read_output_settings();
    void write_scene();

    RenderOptions options_;
    Signals& signals_;
    FrameCache* film_;
    Diagnostics diagnostics_;
    Prepared prepared_;
    RenderSettings settings_;  // resolved
    Tile crop_;
    OutputDescription output_;  // of the scene, and over it of the command line
    DisplayCurve curve_;
    RunStats stats_;
    HalfBuffers halves_;
    std::optional<ErrorLog> log_;
    std::vector<std::string> written_;       // pictures
    bool has_failed_ = false;                // something could not be written as it was asked for
    bool can_go_on_ = false;                 // the last checkpoint is written
    uint64_t pixels_ = 0;                    // of the picture, or of the shard
    Normalisation normalisation_;            // of the scene, once it is built
    std::vector<std::string> light_groups_;  // likewise
    std::vector<MatteManifest> manifests_;
    std::optional<ExrCamera> camera_;  // likewise
};

template <class F>
auto Run::timed(const char* phase, F&& f)
{
    PhaseClock clock(stats_, phase);
    if constexpr (std::is_invocable_v<F, PhaseClock&>)
        return f(clock);
    else
        return f();
}

void Run::load()
{
    timed("load", [&] { prepared_ = load_prepared(options_.picture, diagnostics_, options_.quiet, film_); });
    refuse_input_as_output(options_, prepared_.description);
    settings_ = prepared_.settings;
    read_output_settings();
    write_scene();
    const bool has_spp = options_.picture.render.is_given(&RenderSettings::spp);
    if ((options_.time || options_.error) && !has_spp) settings_.spp = unlimited_spp;
    if (options_.denoise || options_.denoise_sets || options_.guides) require_denoisable(settings_);
    if (options_.divides_light()) require_layers(settings_);
    if (options_.denoise && options_.error) hold_samples_out();
    if (!options_.shard.is_whole() && settings_.stop)
        throw Error(ErrorKind::usage, {}, "--shard: is not for stop=true, where samples depend on each other");
    const uint32_t width = settings_.size.width, height = settings_.size.height;
    crop_ = options_.crop.value_or(Tile{0, 0, width, height});
    if (crop_.x1 > width || crop_.y1 > height)
        throw Error(ErrorKind::usage, {}, format_text("--crop: reaches beyond the picture of %ux%u", width, height));
    for (const std::string& path : options_.outputs)
        if (std::max(crop_.x1 - crop_.x0, crop_.y1 - crop_.y0) > max_jpeg_side &&
            format_of(path, options_.format) == PictureFormat::jpg)
            throw Error(ErrorKind::usage, {},
                        format_text("--output: a JPEG has at most %u pixels across and down", max_jpeg_side));
    if (options_.ocio.is_given()) check_ocio();
    log_.emplace(options_);
    if (log_->is_wanted()) log_->require_size(to_image(Film(width, height, crop_)));
    log_->warn_of_shared_samples(settings_.seed);
}

// What is wrong with it is told before the render.
void Run::check_ocio() const
{
    const OcioView view = open_ocio(options_.ocio);
    if (!options_.quiet)
        print_note("OpenColorIO: from " + in_quotes(view.input) + " to the display " + in_quotes(view.choice.display) +
                   ", view " + in_quotes(view.choice.view));
}

// --error with --denoise asks for the error of the denoised picture, which samples tell that are held out of it.
void Run::hold_samples_out()
{
    constexpr uint32_t least = 4, usual = 8;
    if (settings_.replicates >= least) return;
    if (settings_.replicates > 1)
        throw Error(ErrorKind::usage, {},
                    format_text("--error: with --denoise it needs --replicates %u or more", least));
    settings_.replicates = prepared_.settings.replicates = usual;  // the renderer is made of the latter
    if (!options_.quiet)
        print_note(format_text("--replicates %u, so that the error of the denoised picture can be told", usual));
}

// The command line comes before the scene.
void Run::read_output_settings()
{
    const SceneChoice& scene = options_.picture.scene;
    const std::optional<uint32_t> frame = scene.turntable ? std::nullopt : scene.frame;
    output_ = read_output(scene.file, scene.definitions, diagnostics_, frame);
    if (options_.exposure) output_.exposure = options_.exposure;
    if (options_.tonemap) output_.tonemap = options_.tonemap;
    if (options_.denoise) output_.denoise = true;
    options_.denoise = output_.denoise.value_or(false);
    if (!output_.exposure) output_.exposure = usual_exposure(scene.file, settings_);
}

// Before the render, which may take long or be interrupted.
void Run::write_scene()
{
    if (options_.write_scene.empty()) return;
    const SceneChoice& scene = options_.picture.scene;
    write_text(options_.write_scene, completed_scene_text(scene, prepared_.added.text, *prepared_.description.camera,
                                                          options_.picture.render, output_));
    if (const std::string root = asset_root_for(options_.write_scene, scene); !root.empty())
        print_note("to render " + options_.write_scene + ", add --asset-root " + in_shell_quotes(root));
}

void Run::describe_settings(const Renderer& renderer)
{
    stats_.settings = {.render = settings_,
                       .crop = crop_,
                       .threads = prepared_.threads,
                       .tile = options_.tile,
                       .batch = options_.batch,
                       .kernel = std::string(name_of(renderer.profile())),
                       .hash = hash_with(settings_.spp),
                       .options = reproducing_options(settings_) + options_text(options_.picture.scene),
                       .identity = stats_.settings.identity};
}

std::string Run::hash_with(uint32_t spp) const
{
    RenderSettings settings = settings_;
    settings.spp = spp;
    return settings_hash(settings, options_.picture.scene.camera + view_options_text(options_.picture.scene));
}

void Run::go_on_from(const RenderState& state, const Film& film, RenderLimits& limits)
{
    const uint32_t reached = state.pass.end;
    if (reached > settings_.spp)
        throw Error(ErrorKind::usage, {},
                    format_text("--resume: the checkpoint has up to %u samples per pixel, more than the %u of --spp",
                                reached, settings_.spp));
    limits.begin_with(state.wall_s, state.cpu_s);
    stats_.passes = state.passes;
    halves_ = HalfBuffers(state.halves, state.error);
    if (!state.error_log.empty()) log_->begin_with(state.error_log);
    add_samples(film, state.counters, limits);
    if (state.left.empty()) estimate_error(film);
    if (!options_.quiet) print_note(format_text("going on after %.1f samples per pixel", samples_per_pixel()));
}

PictureRecipe Run::recipe() const
{
    return {.options = options_,
            .stats = stats_,
            .curve = curve_,
            .normalisation = normalisation_,
            .light_groups = light_groups_,
            .manifests = manifests_,
            .camera = camera_,
            .keeps_blocks_open = options_.time || options_.error || Checkpoints::are_wanted(options_)};
}

RenderState Run::state(SampleRange pass, const std::vector<Tile>& left, const RenderLimits& limits) const
{
    return {.shard = options_.shard,
            .held = options_.shard.is_whole() ? std::vector{crop_} : tiles_of(options_.shard, crop_),
            .pass = pass,
            .left = left,
            .counters = stats_.counters,
            .wall_s = limits.wall_seconds(),
            .cpu_s = limits.cpu_seconds(),
            .passes = stats_.passes,
            .halves = halves_.halves(),
            .error = halves_.rel_mse(),
            .error_log = log_->is_wanted() ? log_->text() : ""};
}

void Run::estimate_error(const Film& film)
{
    if (settings_.spp > 1) halves_.look(film);
    if (const auto error = halves_.rel_mse()) stats_.estimated_error = std::sqrt(*error);
    if (film.replicates.empty()) return;
    const auto from_replicates = estimate_from_replicates(film, settings_.replicates);
    if (!from_replicates) return;
    stats_.estimated_error = std::sqrt(from_replicates->rel_mse);
    stats_.estimated_interval = {std::sqrt(from_replicates->interval.low), std::sqrt(from_replicates->interval.high)};
}

// Of a pass, or of the part of it up to a snapshot.
void Run::add_samples(const Film& film, const Counters& counters, const RenderLimits& limits)
{
    stats_.counters += counters;
    stats_.render_s = limits.wall_seconds();
    stats_.samples = 0;
    for (size_t i = 0; i < film.pixels.size(); ++i) stats_.samples += film.whole(i).n;
    // Computed from the film: an interrupt may come after the last tile of a pass.
    const uint64_t wanted =
        options_.shard.is_whole() ? samples_wanted(film, settings_.spp) : uint64_t{settings_.spp} * pixels_;
    stats_.partial = stats_.samples + stats_.counters.dropped < wanted;
}

void Run::end_pass(const Film& film, bool complete, SampleRange range, const RenderLimits& limits)
{
    // If no pixel needs more samples, the film is final.
    const uint32_t spp = stats_.partial ? range.end : settings_.spp;
    estimate_error(film);
    if (!complete) return;
    stats_.passes.push_back({spp, stats_.render_s, stats_.estimated_error});
    if (limits.is_mark(spp) && log_->is_wanted()) log_error(film, limits);
}

// A row of the error log: of the denoised picture where that is what will be written. What denoising it takes is part
// of its time, what denoising earlier ones took is not.
void Run::log_error(const Film& film, const RenderLimits& limits)
{
    if (!options_.denoise || samples_per_pixel() < 2) return log_->add(to_image(film), stats_, limits.cpu_seconds());
    const double wall = wall_seconds(), cpu = cpu_seconds();
    const Denoised denoised = denoise_film(film);
    RunStats stats = stats_;
    stats.render_s += wall_seconds() - wall;
    log_->add(to_image(film, denoised.pixels), stats, limits.cpu_seconds() + (cpu_seconds() - cpu));
}

// Ends the render before spp; the picture is complete.
void Run::end_at(Stop stop, uint32_t spp)
{
    stats_.partial = false;
    if (stop != Stop::samples) stats_.stopped_by = name_of(stop);
    if (stop == Stop::samples && settings_.spp != unlimited_spp) return;
    stats_.settings.render.spp = spp;
    stats_.settings.hash = hash_with(spp);
}

void Run::render(const Renderer& renderer)
{
    const RenderSettings& s = settings_;
    const uint32_t width = s.size.width, height = s.size.height;
    const Camera camera(prepared_.description, renderer.scene().normalisation, width, height, pixel_grid(s));
    normalisation_ = renderer.scene().normalisation;
    light_groups_ = renderer.scene().light_groups.names;
    if (options_.mattes) manifests_ = matte_manifests(renderer.scene());
    camera_ = header_camera(camera, normalisation_, width, height);
    const std::vector<Tile> tiles =
        options_.shard.is_whole() ? make_tiles(crop_, options_.tile) : tiles_of(options_.shard, crop_);
    pixels_ = pixels_of(tiles);
    RenderLimits limits(
        {.spp = s.spp, .time = options_.time, .error = options_.error, .looks_early = log_->is_wanted()});
    require_memory(recipe());
    Film film = empty_film(recipe());
    LiveView live_view(options_, film, stats_.scene.warnings);
    Checkpoints checkpoints(recipe(), film);
    SampleRange range;
    std::vector<Tile> left;
    if (std::optional<RenderState> before = checkpoints.resume(film)) {
        go_on_from(*before, film, limits);
        range = before->pass, left = std::move(before->left);
        // Of merged shards some may be missing.
        if (std::vector<Tile> missing = tiles_without(before->held, film.crop);
            options_.shard.is_whole() && !missing.empty())
            range.begin = 0, left = std::move(missing);
    }
    timed("render", [&] {
        Progress progress(options_.quiet ? ProgressKind::none : options_.progress, s.spp == unlimited_spp ? 0 : s.spp,
                          pixels_, options_.time);
        std::stop_source enough;
        const std::stop_callback on_interrupt(signals_.stop(), [&] { enough.request_stop(); });
        const auto tile_done = [&](const Tile& tile) {
            signals_.poll();
            live_view.tile_done(film, tile, progress);
            if (limits.is_out_of_time()) enough.request_stop();
            progress.tile_done();
        };
        signals_.poll();
        while (!left.empty() || (range.end < s.spp && !tiles.empty())) {
            if (left.empty()) range = {range.end, limits.next_end(range.end)}, left = tiles;
            progress.begin_pass(range, left.size());
            limits.begin_pass();
            while (!left.empty() && !enough.stop_requested()) {
                if (has_samples() && signals_.take_snapshot_request()) {
                    limits.pause();
                    write_snapshot(film, progress);
                    limits.resume();
                }
                if (has_samples() && checkpoints.are_due()) {
                    limits.pause();
                    checkpoints.begin_write(recipe(), state(range, left, limits), film);
                    limits.resume();
                }
                std::stop_source halt;
                const std::stop_callback on_enough(enough.get_token(), [&] { halt.request_stop(); });
                PassResult result = renderer.pass(camera, film, left, range, halt.get_token(), [&](const Tile& tile) {
                    tile_done(tile);
                    if (signals_.snapshot_requested() || checkpoints.are_due()) halt.request_stop();
                });
                add_samples(film, result.counters, limits);
                left = std::move(result.left);
            }
            limits.end_pass();
            end_pass(film, left.empty(), range, limits);
            if (signals_.interrupted()) break;
            const uint32_t spp = range.end;
            // If no pixel needs more samples, the render is done.
            if (!stats_.partial) progress.begin_pass(range = {s.spp, s.spp}, tiles.size());
            progress.end_pass(stats_.estimated_error, stats_.rays());
            if (const auto stop = limits.reached(range.end, error_to_judge(film, range.end, limits))) {
                end_at(*stop, spp);
                if (*stop != Stop::samples && log_->is_wanted() && !(left.empty() && limits.is_mark(spp)))
                    log_error(film, limits);
                break;
            }
        }
        // Here, as the plan is computed in the first pass.
        progress.clear();
        if (options_.verbose) print_sampling_plan(renderer.integrator(), *renderer.plan(camera, width, height));
    });
    if (tiles.empty()) range = {0, s.spp};  // more shards than pixels
    if (has_samples() || tiles.empty()) {
        can_go_on_ = checkpoints.write(recipe(), state(range, left, limits), film);
        if (can_go_on_ && !options_.shard.is_whole()) written_ = {options_.checkpoint};
        // All that a shard has rendered is in there.
        if (!can_go_on_ && !options_.shard.is_whole())
            written_ = checkpoints.rescue(recipe(), state(range, left, limits), film);
    }
    if (options_.outliers > 0 && !signals_.interrupted())
        stats_.error_sources =
            timed("find outliers", [&] { return find_error_sources(renderer, camera, film, options_.outliers); });
    // Before the first tile there is nothing worth replacing an old picture with. That of a shard is for merge.
    if (!has_samples() || !options_.shard.is_whole()) return;
    Denoised denoised;
    if (options_.denoise && !stats_.partial) {
        denoised = timed("denoise", [&] { return denoise_film(film); });
        stats_.denoised = true;
        // Where that error has stopped the render it is told already.
        if (stats_.stopped_by != name_of(Stop::error)) tell_error_of_denoised(film);
    }
    timed("write", [&] { write(picture_of(film, denoised)); });
}

// The error that --error is about; nothing while it is not known.
std::optional<double> Run::error_to_judge(const Film& film, uint32_t spp, RenderLimits& limits)
{
    if (options_.denoise && options_.error) {
        if (!limits.looks_at_denoised(spp)) return {};
        tell_error_of_denoised(film);
        const auto& interval = stats_.denoised_interval;
        if (!interval) return {};
        // What few samples tell may be far off: the error must be likely to be near what is asked for.
        constexpr double most_above = 1.2;
        return std::max(*stats_.denoised_error, interval->high / most_above);
    }
    // Samples that all agree may all have missed the same light.
    return stats_.estimated_error > 0.0 ? stats_.estimated_error : std::nullopt;
}

void Run::tell_error_of_denoised(const Film& film)
{
    if (film.deal.count() != 4) return;
    timed("error of denoised", [&] {
        const auto error = held_out_error(film, denoise_film(film, UsedSets::without_held_out).pixels);
        if (!error) return;
        const auto root = [](double x) { return std::sqrt(std::max(0.0, x)); };
        stats_.denoised_error = root(error->rel_mse);
        stats_.denoised_interval = {root(error->interval.low), root(error->interval.high)};
    });
}

// Before the first sample, so that snapshots and interrupted renders have the exposure of the finished picture.
void Run::choose_curve(const Renderer& renderer)
{
    curve_.tonemap = output_.tonemap.value_or(usual_tonemap(settings_));
    const Exposure exposure = *output_.exposure;
    curve_.exposure_stops = exposure.stops;
    if (!exposure.is_automatic || (options_.shard.is_whole() && !has_display_output(options_))) return;
    timed("choose exposure", [&] {
        curve_.exposure_stops = auto_exposure(renderer, prepared_.metered, settings_.size, pixel_grid(settings_));
    });
    if (!options_.quiet)
        print_note("PNG, PPM and JPEG: --exposure " + shortest(curve_.exposure_stops) + ", chosen from the picture");
}

// The picture is worth more than its place: where it cannot be written, others are tried.
void Run::write(const PictureContent& picture)
{
    try {
        write_outputs(options_.outputs, picture);
        written_ = options_.outputs;
    } catch (const Error& problem) {
        has_failed_ = true;
        written_ = rescue_outputs(options_.outputs, picture);
        if (written_.empty()) throw;
        print_problem(problem.what());
        for (const std::string& name : written_) print_note("the picture is rescued as " + in_quotes(name));
    }
}

void Run::write_snapshot(const Film& film, Progress& progress)
{
    progress.clear();
    try {
        write_outputs(options_.outputs, picture_of(film, {}));
    } catch (const Error& problem) {
        return print_as_warning(problem, "the render goes on without this snapshot");
    }
    print_note(format_text("snapshot written at %.1f spp", samples_per_pixel()));
}

void Run::write_stats()
{
    if (options_.stats.empty()) return;
    stats_.peak_memory_bytes = peak_memory_bytes();
    try {
        write_text(options_.stats, to_json(stats_));
    } catch (const Error& problem) {
        has_failed_ = true;
        print_problem(problem.what());
    }
}

// Of a frame: whether all its pictures are there, with the identity that they would get.
bool Run::is_finished()
{
    if (!options_.picture.scene.frame) return false;
    RunStats& s = stats_;
    s.context = describe_context(options_);
    s.scene.content_hash = prepared_.description.content_hash;
    s.settings.render = settings_, s.settings.crop = crop_;
    s.settings.identity = frame_identity(options_, s, output_);
    return film_ && film_->skips_finished &&
           std::all_of(options_.outputs.begin(), options_.outputs.end(),
                       [&](const std::string& path) { return is_finished_picture(path, s.settings.identity); });
}

// The scene as it is now, with what the frame before left of it.
std::shared_ptr<const Renderer> Run::build()
{
    if (film_ && is_same_scene(*film_, prepared_)) return renderer_of_film(*film_, prepared_, diagnostics_);
    timed("build scene", [&] { begin_prepared(prepared_, diagnostics_); });
    prepared_.description.meshes.clear();  // the scene has its own copy; two would be held for the whole render
    std::shared_ptr<const Renderer> renderer = timed("build accelerator", [&](PhaseClock& clock) {
        return make_renderer(
            prepared_, options_.picture, options_.batch, diagnostics_, [&] { clock.next("finish scene"); },
            film_ ? film_->renderer.get() : nullptr);
    });
    if (film_) keep_for_film(*film_, prepared_, renderer);
    return renderer;
}

FrameEnd Run::execute()
{
    probe_outputs(options_);
    load();
    if (is_finished()) return {exit_done, true};
    with_threads(prepared_.threads, [&] {
        const std::shared_ptr<const Renderer> renderer = build();
        settings_.accel = renderer->accelerator_kind();  // not automatic any more
        describe_run(options_, prepared_, *renderer, stats_);
        describe_settings(*renderer);
        if (options_.verbose) print_start(stats_, settings_);
        choose_curve(*renderer);
        render(*renderer);
    });
    return {report(), false};
}

// After the render; returns the exit code.
int Run::report()
{
    if (options_.shard.is_whole() ? stats_.phases.back().name != "write" : !has_samples() && pixels_ > 0) {
        // A batch system that waits for a code to go on is told to begin again: loading may take long.
        const bool begins_again = !options_.shard.is_whole() || !options_.checkpoint.empty();
        print_problem(std::string("error: interrupted before the first sample; nothing is written") +
                      (begins_again ? ": to begin again, run the same command" : ""));
        return begins_again ? exit_unfinished : exit_interrupted;
    }
    if (!options_.shard.is_whole() && !can_go_on_) has_failed_ = true;
    write_stats();
    print_dropped_samples(stats_, settings_, options_.picture.scene);
    if (stats_.error_sources && !options_.quiet)
        print_error_sources(*stats_.error_sources, settings_, options_.picture.scene);
    if (!options_.quiet) print_summary(stats_, options_, log_->last());
    if (!options_.write_scene.empty()) written_.insert(written_.begin(), options_.write_scene);
    print_written(written_);
    if (log_->is_behind()) {
        has_failed_ = true;
        print_problem("error: the error log could not be written");
    }
    if (!stats_.partial) return has_failed_ ? exit_failed : exit_done;
    const bool goes_on_by_itself = options_.resume == "auto" || options_.resume == options_.checkpoint;
    const std::string how =
        goes_on_by_itself ? "run the same command" : "add --resume " + in_shell_quotes(options_.checkpoint);
    print_problem(format_text("warning: interrupted: the %s partial (%.1f of %u samples per pixel)%s",
                              options_.shard.is_whole() ? "pictures are" : "shard is", samples_per_pixel(),
                              settings_.spp, can_go_on_ ? ("; to go on, " + how).c_str() : ""));
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
