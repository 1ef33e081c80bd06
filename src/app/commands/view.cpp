// lancer view: a scene in a window, where its camera, lights and materials are moved by hand.
#include <algorithm>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/prepare.h"
#include "app/signals.h"
#include "app/version.h"
#include "app/view/controller.h"
#include "app/view/latency.h"
#include "app/view/screen_bytes.h"
#include "app/view/window.h"
#include "app/write_scene.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/input_text.h"
#include "io/scene/scene_file.h"
#include "render/estimators/auto_exposure.h"

namespace lancer {
namespace {

constexpr double idle_seconds = 0.5, moving_seconds = 1.0 / 60, longest_still_seconds = 0.1;

// Copies a file to a name that there is none of yet, and returns it: FILE.bak, FILE.bak2 and so on.
std::string keep_copy(const std::string& file)
{
    std::string copy = file + ".bak";
    for (int i = 2; std::filesystem::exists(copy); ++i) copy = file + ".bak" + std::to_string(i);
    std::error_code problem;
    std::filesystem::copy_file(file, copy, problem);
    if (problem) throw Error(ErrorKind::failed, {copy}, "cannot be written: " + problem.message());
    return copy;
}

// What cannot be written is said; the window stays, with all that was changed in it.
template <class F>
void keep_window(const F& f)
{
    try {
        f();
    } catch (const Error& problem) {
        print_problem(problem.what());
    }
}

// One run of the command.
class ViewRun {
public:
    explicit ViewRun(const ViewOptions& options) : options_(options.render), path_options_(options) {}
    int execute();

private:
    DisplayCurve curve_of(const Prepared& prepared, const Renderer& renderer, const OutputDescription& output) const;
    ControllerHost host(ViewWindow& window) const;
    void write_picture(const Film& film, const DisplayCurve& curve) const;
    void save_scene(const std::string& text) const;
    std::string save_over(const std::string& text) const;
    KeyFrames read_path() const;
    void run(Controller& controller, ViewWindow& window);
    void end(const Controller& controller) const;

    const RenderOptions& options_;
    const ViewOptions& path_options_;
    Signals signals_;
    Latency latency_;
};

DisplayCurve ViewRun::curve_of(const Prepared& prepared, const Renderer& renderer,
                               const OutputDescription& output) const
{
    DisplayCurve curve;
    curve.tonemap = options_.tonemap.value_or(output.tonemap.value_or(usual_tonemap(prepared.settings)));
    const Exposure exposure = options_.exposure.value_or(
        output.exposure.value_or(usual_exposure(options_.picture.scene.file, prepared.settings)));
    curve.exposure_stops = exposure.is_automatic ? auto_exposure(renderer, prepared.metered, prepared.settings.size,
                                                                 pixel_grid(prepared.settings))
                                                 : exposure.stops;
    return curve;
}

// Runs on the session's thread.
void ViewRun::write_picture(const Film& film, const DisplayCurve& curve) const
{
    const int64_t samples = film.pixels.empty() ? 0 : film.whole(0).n;
    const PictureContent content{.image = rows_of(film),
                                 .planes = {},
                                 .metadata = {{"software", std::string("lancer ") + LANCER_VERSION},
                                              {"scene", options_.picture.scene.file},
                                              {"spp_done", samples}},
                                 .style = {.format = {}, .curve = curve, .ascii_ppm = options_.picture.render.legacy}};
    write_outputs(options_.outputs, content);
    print_written(options_.outputs);
    flush_results();
    ViewWindow::wake();
}

void ViewRun::save_scene(const std::string& text) const
{
    write_text(options_.write_scene, text);
    print_written({options_.write_scene});
    flush_results();
    if (const std::string root = asset_root_for(options_.write_scene, options_.picture.scene); !root.empty())
        print_note("to render " + options_.write_scene + ", add --asset-root " + in_shell_quotes(root));
}

std::string ViewRun::save_over(const std::string& text) const
{
    const std::string& file = options_.picture.scene.file;
    const auto refuse = [&](const std::string& why) {
        print_note(file + " stays as it is: " + why + "; Ctrl+S writes " + options_.write_scene);
        return std::string();
    };
    if (is_mesh(file)) return refuse("it is a mesh");
    Diagnostics none;
    if (read_animation(file, options_.picture.scene.definitions, none)) return refuse("its [animation] would be lost");
    const std::string old = keep_copy(file);
    write_text(file, text);
    print_written({file});
    flush_results();
    return old;
}

ControllerHost ViewRun::host(ViewWindow& window) const
{
    return {.print = [](const std::string& text) { print_result(text), flush_results(); },
            .say =
                [this](const std::string& text) {
                    if (!options_.quiet) print_note(text);
                },
            .copy = [&window](const std::string& text) { window.copy(text); },
            .save_scene = [this](const std::string& text) { keep_window([&] { save_scene(text); }); },
            .save_over =
                [this](const std::string& text) {
                    std::string old;
                    keep_window([&] { old = save_over(text); });
                    return old;
                },
            .write_picture = [this](const Film& film, const Renderer&,
                                    const DisplayCurve& curve) { write_picture(film, curve); }};
}

KeyFrames ViewRun::read_path() const
{
    KeyFrames frames;
    if (path_options_.reads_path && std::filesystem::exists(path_options_.path))
        frames.read(read_input_text(path_options_.path), path_options_.path);
    return frames;
}

void ViewRun::run(Controller& controller, ViewWindow& window)
{
    ShownPicture picture;
    ScreenBytes bytes;
    WindowFrame frame;
    while (!controller.wants_close() && !frame.should_close && !signals_.interrupted()) {
        const bool is_new = controller.take(picture);
        // What would be drawn while an image is on its way only delays it.
        frame.is_drawn = is_new || picture.sight >= controller.shown_number() ||
                         frame.seconds - frame.drawn_seconds > longest_still_seconds;
        if (frame.is_drawn) {
            const auto [first, end] = bytes.update(picture, controller.curve(), is_new);
            frame.rgb = bytes.rgb().data(), frame.first_row = first, frame.end_row = end;
            frame.width = picture.image.data.width(), frame.height = picture.image.data.height();
            controller.draw(picture, frame);
        }
        frame.wait_seconds = controller.is_moving() ? moving_seconds : idle_seconds;
        window.turn(frame);
        if (frame.is_drawn) {
            latency_.drawn(picture.sight, frame.drawn_seconds);
            for (const Widget& widget : frame.widgets)
                if (widget.is_changed) controller.change(widget);
        }
        for (const InputEvent& event : frame.events) {
            const uint64_t before = controller.shown_number();
            controller.handle(event);
            if (controller.shown_number() != before) latency_.asked(controller.shown_number(), event.seconds);
        }
        controller.tick(frame.seconds);
    }
}

void ViewRun::end(const Controller& controller) const
{
    if (controller.has_new_frames()) {
        write_text(path_options_.path, controller.key_frames().text());
        print_written({path_options_.path});
    }
    std::vector<double> seconds = latency_.seconds();
    if (!options_.verbose || seconds.empty()) return;
    std::sort(seconds.begin(), seconds.end());
    print_note(format_text("from input to image: median %.0f ms, longest %.0f ms, of %zu",
                           1e3 * seconds[seconds.size() / 2], 1e3 * seconds.back(), seconds.size()));
}

int ViewRun::execute()
{
    Diagnostics diagnostics;
    Prepared p = load_prepared(options_.picture, diagnostics, options_.quiet);
    refuse_input_as_output(options_, p.description);
    const SceneChoice& scene = options_.picture.scene;
    const OutputDescription output = read_output(scene.file, scene.definitions, diagnostics);
    const KeyFrames frames = read_path();
    const PictureSize size = p.settings.size;
    ViewWindow window({.title = "lancer " + scene.file,
                       .picture_width = static_cast<int32_t>(size.width),
                       .picture_height = static_cast<int32_t>(size.height)});
    std::unique_ptr<Renderer> renderer;
    DisplayCurve curve;
    with_threads(p.threads, [&] {
        begin_prepared(p, diagnostics);
        renderer = make_renderer(p, options_.picture, options_.batch, diagnostics);
        curve = curve_of(p, *renderer, output);
    });
    EditedScene document(scene, p.added.text, p.description, options_.picture.render, p.settings);
    const Sight first{*p.description.camera, document.scene(), p.settings};
    Session session({.renderer = std::move(renderer),
                     .rebuild = {p.images->source(), p.memory, options_.batch},
                     .threads = p.threads,
                     .on_news = ViewWindow::wake},
                    first);
    Controller controller(session, std::move(document), first, curve, frames, host(window));
    run(controller, window);
    end(controller);
    return signals_.interrupted() ? exit_interrupted : exit_done;
}

}  // namespace

int run_view(int argc, char** argv)
{
    const auto options = parse_view(argc, argv);
    if (!options) return exit_done;
    return ViewRun(*options).execute();
}

}  // namespace lancer
