// The command lines of the commands that render or write pictures.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/console.h"
#include "app/options/file_kinds.h"
#include "app/options/option_values.h"
#include "app/options/picture_options.h"
#include "app/options/shared_options.h"
#include "app/paths.h"
#include "app/render/shard.h"

namespace lancer {
namespace {

const char* const interrupted_render_help =
    "75 interrupted, to go on with --resume; 130 interrupted without\n--checkpoint. Both write the picture so far, "
    "marked partial.\n";

std::string with_numbers(std::string text, const Shard& shard)
{
    for (const auto& [mark, number] : {std::pair("%k", shard.index), {"%n", shard.count}})
        for (size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
            text.replace(at, 2, std::to_string(number));
    return text;
}

// Frames must not overwrite each other: a.png is refused, with the name that a.####.png would be.
void require_numbers(const RenderOptions& o, bool of_scenes)
{
    std::vector<std::string> names = o.outputs;
    std::erase(names, standard_output);  // a pipe takes one picture after the other
    if (of_scenes) names.push_back(o.picture.scene.file);
    for (const std::string& name : {o.checkpoint, o.stats, o.error_log, o.write_scene})
        if (!name.empty()) names.push_back(name);
    for (const std::string& name : names) {
        if (name.find('#') != std::string::npos) continue;
        const auto ending = std::filesystem::path(name).extension();
        const std::string better = std::filesystem::path(name).replace_extension(".####" + ending.string());
        fail_usage((of_scenes ? "--frames: " : "lancer film: ") + in_quotes(name) +
                   " has no #### for the number; did you mean " + in_quotes(better) + "?");
    }
}

// The output of a shard is its checkpoint. given: the options that were.
void take_part(const std::vector<std::string>& given, RenderOptions& o)
{
    for (const char* name : {"--time", "--error", "--error-log", "--reference", "--outliers", "--checkpoint"})
        if (std::find(given.begin(), given.end(), name) != given.end())
            fail_usage("--shard: " + std::string(name) +
                       (name == std::string("--checkpoint") ? " has no use: the part is the checkpoint"
                                                            : " needs the whole picture"));
    if (o.outputs.size() > 1) fail_usage("--shard: a shard has one output");
    const std::string name =
        o.outputs.empty() ? scene_name_of(o.picture.scene.file) + ".%k-of-%n.lancer" : o.outputs[0];
    if (extension_of(name) != ".lancer")
        fail_usage("--output: with --shard " + in_quotes(name) + " must end in .lancer");
    o.checkpoint = with_numbers(name, o.shard);
    o.outputs.clear();
}

// As it was given.
std::string command_line_of(const char* command, int argc, char** argv)
{
    std::string line = command;
    for (int i = 1; i < argc; ++i) line += " " + in_shell_quotes(argv[i]);
    return line;
}

}  // namespace

std::optional<RenderOptions> parse_render(int argc, char** argv)
{
    RenderOptions o;
    OptionParser p("lancer render", "Render a scene into pictures.",
                   exit_codes_help + std::string(interrupted_render_help) +
                       "Signals: SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR2 interrupt; a second SIGINT or "
                       "SIGTERM exits at once;\nSIGUSR1 writes a snapshot and goes on.\n\n"
                       "Examples:\n  lancer render scene.toml -s 256 -o picture.exr -o picture.png\n"
                       "  lancer mesh.obj --size 640x360\n");
    add_render_options(p, o);
    if (!p.parse(argc, argv)) return {};
    if (!o.shard.is_whole())
        take_part(p.given(), o);
    else if (o.outputs.empty())
        o.outputs.push_back(scene_name_of(o.picture.scene.file) + ".exr");
    complete_picture_options(p.given(), o);
    if (o.frames) require_numbers(o, true);
    o.command_line = command_line_of("lancer render", argc, argv);
    return o;
}

std::optional<FilmOptions> parse_film(int argc, char** argv)
{
    FilmOptions o;
    OptionParser p(
        "lancer film",
        "Render the frames of a scene's [animation], or of a turntable. Frames that are finished are not drawn "
        "again: the same command goes on where it was stopped.",
        exit_codes_help + std::string("75 interrupted, to go on with the same command; 130\ninterrupted where only a "
                                      "movie was asked for.\n\n"
                                      "Examples:\n  lancer film scene.toml -o frame.####.exr -o film.mp4\n"
                                      "  lancer film mesh.obj --turntable 48 -o turn.####.png\n"));
    add_render_options(p, o.render, true);
    p.value("--fps", "X", "Of the movie: frames per second (as [animation] says, else 24)",
            [&](const std::string& t) { o.fps = to_number<double>("--fps", t, 0.001, 1000, "a number"); });
    p.flag("--again", "Draw frames again that are finished", o.again);
    if (!p.parse(argc, argv)) return {};
    RenderOptions& r = o.render;
    if (r.picture.scene.frame) fail_usage("--frame: is for one picture; --frames A-B are some of a film");
    o.shard = std::exchange(r.shard, {});
    for (const std::string& name : r.outputs)
        if (extension_of(name) == ".mp4") {
            if (!o.movie.empty()) fail_usage("--output: there can be one movie");
            o.movie = name;
        }
    std::erase(r.outputs, o.movie);
    if (!o.movie.empty() && !o.shard.is_whole()) fail_usage("--shard: a movie needs all frames; give it pictures");
    if (r.outputs.empty() && o.movie.empty()) r.outputs.push_back(scene_name_of(r.picture.scene.file) + ".####.exr");
    complete_picture_options(p.given(), r);
    require_numbers(r, false);
    r.command_line = command_line_of("lancer film", argc, argv);
    return o;
}

std::optional<ViewOptions> parse_view(int argc, char** argv)
{
    ViewOptions view;
    RenderOptions& o = view.render;
    OptionParser p("lancer view",
                   "Show a scene in a window while it renders, and move its camera, lights and materials by hand.",
                   exit_codes_help + std::string(interrupted_help) +
                       "\nThe key H shows all keys.\n\nExample:\n  lancer view scene.toml -o picture.exr\n");
    add_picture_options(p, o.picture);
    p.flag("-q,--quiet", "Only warnings and errors", o.quiet);
    p.flag("-v,--verbose", "At the end, say how long the hand waited for pictures", o.verbose);
    p.group("What is written");
    p.values("-o,--output", "FILE",
             "What R, Shift+R, Ctrl+R and O write: .exr, .png, .ppm, .jpg or .hdr; may be given several times "
             "(output.png; with --legacy output.ppm)",
             [&](const std::string& t) { o.outputs.push_back(t); });
    p.takes_files(files::written_pictures);
    p.value("--write-scene", "FILE", "What Ctrl+S writes (NAME.view.toml in this folder)",
            [&](const std::string& t) { o.write_scene = t; });
    p.takes_files(files::toml);
    p.value("--path", "FILE",
            "Key frames: read at the beginning, if it is there, and written at the end (NAME.path.toml)",
            [&](const std::string& t) { view.path = t; });
    p.takes_files(files::toml);
    p.value("--tonemap", listed(enum_names<ToneMap>), "As of lancer render, to begin with",
            [&](const std::string& t) { o.tonemap = to_enum<ToneMap>("--tonemap", t); });
    p.value("--exposure", "STOPS|auto", "As of lancer render, to begin with",
            [&](const std::string& t) { o.exposure = to_exposure("--exposure", t); });
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    const std::string name = scene_name_of(o.picture.scene.file);
    if (o.outputs.empty()) o.outputs.push_back(o.picture.render.legacy ? "output.ppm" : "output.png");
    take_outputs(o.outputs, {});
    if (o.write_scene.empty()) o.write_scene = name + ".view.toml";
    view.reads_path = !view.path.empty();
    if (view.path.empty()) view.path = name + ".path.toml";
    std::vector<std::string> files = o.outputs;
    files.insert(files.end(), {o.write_scene, view.path});
    refuse_doubles(files);
    view.render.picture.scene.still = true;
    return view;
}

std::optional<DenoiseOptions> parse_denoise(int argc, char** argv)
{
    DenoiseOptions o;
    OptionParser p("lancer denoise", "Remove the noise of a picture that carries two halves of its samples.",
                   "Exit codes: 0 done; 2 wrong usage; 65 unreadable or without halves; 66 missing.\n\n"
                   "Example:\n  lancer render scene.toml -s 16 --aov denoise -o noisy.exr\n"
                   "  lancer denoise noisy.exr -o picture.exr -o picture.png\n");
    p.argument("PICTURE", "EXR of lancer render --aov denoise", [&](const std::string& t) { o.picture = t; });
    p.takes_files(files::exr);
    p.values("-o,--output", "FILE", "Denoised picture, .exr, .png, .ppm, .jpg or .hdr; may be given several times",
             [&](const std::string& t) { o.outputs.push_back(t); });
    p.takes_files(files::written_pictures);
    add_format(p, o.format);
    add_jpeg_quality(p, o.jpeg_quality);
    p.value("--tonemap", listed(enum_names<ToneMap>), "PNG, PPM and JPEG: as of lancer render (srgb)",
            [&](const std::string& t) { o.tonemap = to_enum<ToneMap>("--tonemap", t); });
    p.value("--exposure", "STOPS", "PNG, PPM and JPEG are brightened by 2^STOPS (0)", [&](const std::string& t) {
        o.exposure = static_cast<float>(to_number<double>("--exposure", t, -100, 100, "a number"));
    });
    add_ocio(p, o.ocio);
    add_threads(p, o.threads);
    if (!p.parse(argc, argv)) return {};
    check_ocio(p.given(), o.ocio);
    if (o.outputs.empty()) fail_usage("--output: is missing; add -o NAME.exr");
    take_outputs(o.outputs, o.format);
    refuse_doubles(o.outputs);
    take_environment(o.threads);
    return o;
}

std::optional<MergeOptions> parse_merge(int argc, char** argv)
{
    MergeOptions o;
    OptionParser p("lancer merge", "Join the shards of a picture. It has the bits of one that was rendered as a whole.",
                   "Exit codes: 0 done; 1 failed at run time; 2 wrong usage; 65 a part is damaged or of another "
                   "picture; 66 a part\nis not there; 75 parts are missing or unfinished.\n\n"
                   "Example:\n  lancer render scene.toml --shard 1/2 -o 1.lancer\n"
                   "  lancer render scene.toml --shard 2/2 -o 2.lancer\n"
                   "  lancer merge 1.lancer 2.lancer -o picture.exr\n");
    p.arguments("PART", "Files of lancer render --shard, and of earlier merges, in any order",
                [&](const std::string& t) { o.parts.push_back(t); });
    p.takes_files(files::checkpoints);
    p.values("-o,--output", "FILE",
             "Picture, .exr, .png, .ppm, .jpg or .hdr, or all parts as one, .lancer; may be given several times",
             [&](const std::string& t) { o.outputs.push_back(t); });
    p.takes_files(files::merged);
    add_format(p, o.format);
    p.flag("--allow-missing", "Write the picture although parts are missing: black, and marked partial",
           o.allow_missing);
    add_threads(p, o.threads);
    add_json(p, o.json);
    if (!p.parse(argc, argv)) return {};
    if (o.outputs.empty()) fail_usage("--output: is missing; add -o NAME.exr");
    for (std::string& path : o.outputs)
        if (extension_of(path) != ".lancer") path = to_output(path, o.format);
    if (o.json && std::find(o.outputs.begin(), o.outputs.end(), standard_output) != o.outputs.end())
        fail_usage("--output: with --json the standard output holds the result; name a file");
    refuse_doubles(o.outputs);
    for (const std::string& part : o.parts)
        for (const std::string& output : o.outputs)
            if (place_of(part) == place_of(output))
                fail_usage("--output: " + in_quotes(output) + " is one of the parts");
    take_environment(o.threads);
    return o;
}

}  // namespace lancer
