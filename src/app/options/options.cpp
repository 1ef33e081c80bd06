#include "app/options/options.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

#include "app/console.h"
#include "app/options/option_parser.h"
#include "app/options/option_values.h"
#include "app/options/shared_options.h"
#include "app/paths.h"
#include "app/render/shard.h"
#include "io/image/exr.h"

namespace lancer {
namespace {

const char* const exit_codes =
    "Exit codes: 0 done; 1 failed at run time; 2 wrong usage; 65 scene or asset invalid; 66 input missing;\n"
    "71 the pictures need more than --memory; ";
const char* const interrupted = "130 interrupted.\n";
const char* const interrupted_render =
    "75 interrupted, to go on with --resume; 130 interrupted without\n--checkpoint. Both write the picture so far, "
    "marked partial.\n";

// FILE or FILE,T; a comma that no duration follows belongs to the name.
void take_checkpoint(const std::string& text, RenderOptions& o)
{
    o.checkpoint = text;
    const size_t comma = text.rfind(',');
    if (comma == std::string::npos || comma + 1 == text.size() || text[comma + 1] < '0' || text[comma + 1] > '9')
        return;
    o.checkpoint = text.substr(0, comma);
    o.checkpoint_interval = to_seconds("--checkpoint", text.substr(comma + 1));
}

void add_format(OptionParser& p, std::optional<PictureFormat>& format)
{
    p.value("--format", listed(enum_names<PictureFormat>),
            "What pictures are whose names have no ending: a pipe, or - for the standard output",
            [&](const std::string& t) { format = to_enum<PictureFormat>("--format", t); });
}

void add_jpeg_quality(OptionParser& p, uint32_t& quality)
{
    p.value("--jpeg-quality", "N", "JPEG: 1, small, to 100 (95)",
            [&](const std::string& t) { quality = to_count("--jpeg-quality", t, 1, 100); });
}

void add_ocio(OptionParser& p, OcioChoice& o)
{
    p.value("--ocio", "CONFIG", "PNG, PPM and JPEG by a view of this OpenColorIO configuration, not by a tone map",
            [&](const std::string& t) { o.config = t; });
    p.value("--ocio-display", "NAME", "Its display (the default of the configuration)",
            [&](const std::string& t) { o.display = t; });
    p.value("--ocio-view", "NAME", "Its view (the default of the display)", [&](const std::string& t) { o.view = t; });
}

// given: the options that were.
void check_ocio(const std::vector<std::string>& given, const OcioChoice& o)
{
    const auto is_given = [&](const char* name) { return std::find(given.begin(), given.end(), name) != given.end(); };
    for (const char* name : {"--ocio-display", "--ocio-view"})
        if (is_given(name) && !o.is_given()) fail_usage(std::string(name) + ": needs --ocio CONFIG");
    if (is_given("--ocio") && !o.is_given()) fail_usage("--ocio: needs the name of a configuration");
    if (o.is_given() && is_given("--tonemap")) fail_usage("--tonemap: has no use with --ocio, which takes its place");
}

// is_film: each frame is a picture.
void add_render_options(OptionParser& p, RenderOptions& o, bool is_film = false)
{
    add_picture_options(p, o.picture);
    p.value("--progress", listed(enum_names<ProgressKind>), "auto is a line on a terminal, else plain (auto)",
            [&](const std::string& t) { o.progress = to_enum<ProgressKind>("--progress", t); });
    p.value("--display-server", "HOST[:PORT]",
            "Show the picture while it grows in tev, an image viewer that listens there (port 14158)",
            [&](const std::string& t) { o.display = to_display_address(t); });
    p.value("--time", "T", "Stop after T of rendering: 60s, 5m, 2h; loading does not count. Without -s only this stops",
            [&](const std::string& t) { o.time = to_seconds("--time", t); });
    p.value("--error", "X",
            "Stop when the error, the root of the relative mean squared one, is estimated at X or less: 0.02. Without "
            "-s only this stops",
            [&](const std::string& t) { o.error = to_number<double>("--error", t, 1e-9, 1e9, "a number"); });
    p.value("--tile", "N", "Side of a tile in pixels; pictures do not depend on it (16)",
            [&](const std::string& t) { o.tile = to_count("--tile", t, 1, 4096); });
    p.value("--batch", "N", "Paths traced together; pictures do not depend on it (256)",
            [&](const std::string& t) { o.batch = to_count("--batch", t, 1, 1 << 20); });
    p.flag("-q,--quiet", "Only warnings and errors", o.quiet);
    p.flag("-v,--verbose", "Also say what was loaded and with what settings", o.verbose);
    p.group("What is written");
    p.values("-o,--output", "FILE",
             is_film
                 ? "Pictures of the frames, #### in their names stands for the number; a name in .mp4 is a movie, made "
                   "by ffmpeg; may be given several times (NAME.####.exr in this folder)"
                 : "Picture, .exr, .png, .ppm, .jpg or .hdr; may be given several times (NAME.exr in this folder)",
             [&](const std::string& t) { o.outputs.push_back(t); });
    add_format(p, o.format);
    p.value("--shard", "K/N|auto",
            is_film ? "Only each Nth frame, from the Kth on. auto: as Slurm, Open MPI or PMI say"
                    : "Only part K of N of the picture, for lancer merge: -o names it, and it is its own checkpoint "
                      "(NAME.%k-of-%n.lancer; %k and %n stand for K and N). auto: as Slurm, Open MPI or PMI say",
            [&](const std::string& t) { o.shard = to_shard(t, [](const char* name) { return std::getenv(name); }); });
    p.value("--frames", "A-B",
            is_film ? "Only these frames (all)"
                    : "Scene files one after the other: #### in names stands for the number, 0001 for 1",
            [&](const std::string& t) { o.frames = to_frames("--frames", t); });
    p.value("--crop", "x0,y0,x1,y1", "Only these pixels; x1 and y1 are exclusive",
            [&](const std::string& t) { o.crop = to_crop(t); });
    p.values("--aov", "NAME,...",
             "More channels of EXR pictures: " + listed(enum_names<Aov>) +
                 "|all; also lights, a layer for each group of lights, parts, emission, direct and indirect light, "
                 "lobes, light by diffuse and glossy reflection and by transmission, "
                 "cryptomatte, which objects and materials a pixel shows, "
                 "denoise, what lancer denoise needs, and oidn, what Open Image Denoise takes",
             [&](const std::string& t) { add_aovs(t, o); });
    p.value("--background", listed(enum_names<BackgroundChoice>),
            "transparent: an alpha channel in EXR and PNG, and no sky where camera rays reach it, also through smooth "
            "glass; opaque-glass: glass shows the sky (keep)",
            [&](const std::string& t) { o.background = to_enum<BackgroundChoice>("--background", t); });
    p.flag("--denoise", "The picture is denoised when it is complete; EXR keeps the noisy one as layer noisy",
           o.denoise);
    p.value("--layer-names", listed(enum_names<LayerNames>), "EXR: whose names the layers have (lancer)",
            [&](const std::string& t) { o.layer_names = to_enum<LayerNames>("--layer-names", t); });
    p.flag("--half", "EXR with 16-bit floats; AOVs keep 32 bits", o.half);
    p.value("--exr-compression", listed(enum_names<ExrCompression>),
            "EXR: how it is compressed; dwaa and dwab lose what is hardly seen (zip)",
            [&](const std::string& t) { o.compression = to_enum<ExrCompression>("--exr-compression", t); });
    p.value("--exr-tiles", "N", "EXR: tiles of N by N pixels, 16 to 1024, in place of scan lines",
            [&](const std::string& t) { o.exr_tile = to_count("--exr-tiles", t, least_exr_tile, most_exr_tile); });
    p.flag("--exr-multipart", "EXR: a part for each layer; R, G, B and A are the first", o.exr_multipart);
    p.value("--color-space", listed(enum_names<ColorSpace>),
            "EXR: what its colours are, as the header says, too: linear Rec. 709 or ACEScg (lin_rec709)",
            [&](const std::string& t) { o.space = to_enum<ColorSpace>("--color-space", t); });
    p.flag("--no-metadata", "Pictures whose headers say nothing of how they were made", o.no_metadata);
    p.flag("--reproducible",
           "Pictures without times, threads and command line in their headers: of two runs the same bytes",
           o.reproducible);
    add_jpeg_quality(p, o.jpeg_quality);
    p.value(
        "--tonemap", listed(enum_names<ToneMap>),
        "PNG, PPM and JPEG: the sRGB curve, cut off at 1; AgX, which rolls off; linear values; a power of 1/2.2 or no "
        "curve with steps that round down (srgb; with --legacy one of the last two)",
        [&](const std::string& t) { o.tonemap = to_enum<ToneMap>("--tonemap", t); });
    add_ocio(p, o.ocio);
    p.flag("--ascii-ppm", "PPM as text", o.ascii_ppm);
    p.value("--exposure", "STOPS|auto",
            "PNG, PPM and JPEG are brightened by 2^STOPS; auto: so that objects are of a middle brightness (0; of a "
            "mesh auto)",
            [&](const std::string& t) { o.exposure = to_exposure("--exposure", t); });
    p.flag("--dither", "PNG, PPM and JPEG with a fixed dither pattern against banding", o.dither);
    p.value("--reference", "FILE", "Picture that the render is measured against as it goes",
            [&](const std::string& t) { o.reference = t; });
    p.value("--reference2", "FILE", "A second one, independent of the first: their noise then cancels out",
            [&](const std::string& t) { o.reference2 = t; });
    p.value("--error-log", "FILE", "Seconds, rays and errors each time that samples have doubled, as CSV",
            [&](const std::string& t) { o.error_log = t; });
    p.value("--outliers", "N",
            "Also list the N samples with the largest part of the error, and what paths the error comes from",
            [&](const std::string& t) { o.outliers = to_count("--outliers", t, 1, 1000); });
    p.value("--write-scene", "FILE.toml",
            "The scene with what was added to it, and with these options: renders the same picture",
            [&](const std::string& t) {
                if (extension_of(t) != ".toml") fail_usage("--write-scene: " + in_quotes(t) + " must end in .toml");
                o.write_scene = t;
            });
    p.value("--stats", "FILE", "Figures of the run as JSON", [&](const std::string& t) { o.stats = t; });
    p.value(
        "--checkpoint", "FILE[,T]",
        "Every T (60s), first after 10 s, and at the end write what --resume needs; the one before stays as FILE.old",
        [&](const std::string& t) { take_checkpoint(t, o); });
    p.value(
        "--resume", "FILE|auto",
        "Go on from a checkpoint, with the same bits; also with more samples. auto: from the one of --checkpoint, if "
        "it is there",
        [&](const std::string& t) { o.resume = t; });
}

// With links followed as far as there are files: two names of one file are equal. Absolute first: of a relative path
// that does not exist, weakly_canonical would leave a relative one.
std::filesystem::path place_of(const std::string& path)
{
    std::error_code problem;
    const std::filesystem::path place = std::filesystem::weakly_canonical(std::filesystem::absolute(path), problem);
    return problem ? std::filesystem::path(path).lexically_normal() : place;
}

void refuse_doubles(const std::vector<std::string>& files)
{
    for (size_t i = 0; i < files.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (place_of(files[i]) == place_of(files[j]))
                fail_usage("--output: " + in_quotes(files[i]) + " is named twice");
}

std::string with_numbers(std::string text, const Shard& shard)
{
    for (const auto& [mark, number] : {std::pair("%k", shard.index), {"%n", shard.count}})
        for (size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
            text.replace(at, 2, std::to_string(number));
    return text;
}

// Frames must not overwrite each other.
void require_numbers(const RenderOptions& o, bool of_scenes)
{
    std::vector<std::string> names = o.outputs;
    std::erase(names, standard_output);  // a pipe takes one picture after the other
    if (of_scenes) names.push_back(o.picture.scene.file);
    for (const std::string& name : {o.checkpoint, o.stats, o.error_log, o.write_scene})
        if (!name.empty()) names.push_back(name);
    for (const std::string& name : names)
        if (name.find('#') == std::string::npos)
            fail_usage((of_scenes ? "--frames: " : "lancer film: ") + in_quotes(name) + " has no #### for the number");
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
    const std::string name = o.outputs.empty()
                                 ? std::filesystem::path(o.picture.scene.file).stem().string() + ".%k-of-%n.lancer"
                                 : o.outputs[0];
    if (extension_of(name) != ".lancer")
        fail_usage("--output: with --shard " + in_quotes(name) + " must end in .lancer");
    o.checkpoint = with_numbers(name, o.shard);
    o.outputs.clear();
}

// What the options of a picture mean together. given: those that were. o: with its outputs.
void complete_picture_options(const std::vector<std::string>& given, RenderOptions& o)
{
    take_environment(o.picture.threads);
    check_ocio(given, o.ocio);
    if (o.space != ColorSpace::lin_rec709 && o.denoise_sets)
        fail_usage("--color-space: lancer denoise takes linear Rec. 709; use --denoise");
    take_outputs(o.outputs, o.format);
    const auto format = [&](const std::string& path) { return format_of(path, o.format); };
    const auto is_exr = [&](const std::string& path) { return format(path) == PictureFormat::exr; };
    if (o.background != BackgroundChoice::keep)
        for (const std::string& path : o.outputs)
            if (!is_exr(path) && format(path) != PictureFormat::png)
                fail_usage("--background: " + in_quotes(path) + " cannot hold an alpha channel; .exr and .png can");
    if (o.shard.is_whole() && (!o.aovs.empty() || o.divides_light() || o.mattes || o.denoise_sets || o.guides) &&
        std::none_of(o.outputs.begin(), o.outputs.end(), is_exr))
        fail_usage("--aov: its channels are written to EXR pictures; add -o NAME.exr");
    if (o.mattes && (o.compression == ExrCompression::dwaa || o.compression == ExrCompression::dwab))
        fail_usage("--exr-compression: dwaa and dwab would destroy the names of cryptomatte");
    std::vector<std::string> files = o.outputs;
    if (!o.stats.empty()) files.push_back(o.stats);
    if (!o.error_log.empty()) files.push_back(o.error_log);
    if (!o.write_scene.empty()) files.push_back(o.write_scene);
    if (!o.checkpoint.empty()) files.push_back(o.checkpoint);
    if (o.resume == "auto" && o.checkpoint.empty()) fail_usage("--resume: auto needs --checkpoint FILE");
    refuse_doubles(files);
    if (!o.reference2.empty() && o.reference.empty()) fail_usage("--reference2: needs --reference");
    for (const std::string& reference : {o.reference, o.reference2})
        for (const std::string& file : files)
            if (!reference.empty() && place_of(reference) == place_of(file))
                fail_usage("--reference: " + in_quotes(reference) + " would be overwritten");
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
                   exit_codes + std::string(interrupted_render) +
                       "Signals: SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR2 interrupt; a second SIGINT or "
                       "SIGTERM exits at once;\nSIGUSR1 writes a snapshot and goes on.\n\n"
                       "Examples:\n  lancer render scene.toml -s 256 -o picture.exr -o picture.png\n"
                       "  lancer mesh.obj --size 640x360\n");
    add_render_options(p, o);
    if (!p.parse(argc, argv)) return {};
    if (!o.shard.is_whole())
        take_part(p.given(), o);
    else if (o.outputs.empty())
        o.outputs.push_back(std::filesystem::path(o.picture.scene.file).stem().string() + ".exr");
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
        exit_codes + std::string("75 interrupted, to go on with the same command; 130\ninterrupted where only a "
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
    if (r.outputs.empty() && o.movie.empty())
        r.outputs.push_back(std::filesystem::path(r.picture.scene.file).stem().string() + ".####.exr");
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
                   exit_codes + std::string(interrupted) +
                       "\nThe key H shows all keys.\n\nExample:\n  lancer view scene.toml -o picture.exr\n");
    add_picture_options(p, o.picture);
    p.flag("-q,--quiet", "Only warnings and errors", o.quiet);
    p.flag("-v,--verbose", "At the end, say how long the hand waited for pictures", o.verbose);
    p.group("What is written");
    p.values("-o,--output", "FILE",
             "What R, Shift+R, Ctrl+R and O write: .exr, .png, .ppm, .jpg or .hdr; may be given several times "
             "(output.png; with --legacy output.ppm)",
             [&](const std::string& t) { o.outputs.push_back(t); });
    p.value("--write-scene", "FILE", "What Ctrl+S writes (NAME.view.toml in this folder)",
            [&](const std::string& t) { o.write_scene = t; });
    p.value("--path", "FILE",
            "Key frames: read at the beginning, if it is there, and written at the end (NAME.path.toml)",
            [&](const std::string& t) { view.path = t; });
    p.value("--tonemap", listed(enum_names<ToneMap>), "As of lancer render, to begin with",
            [&](const std::string& t) { o.tonemap = to_enum<ToneMap>("--tonemap", t); });
    p.value("--exposure", "STOPS|auto", "As of lancer render, to begin with",
            [&](const std::string& t) { o.exposure = to_exposure("--exposure", t); });
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    const std::string name = std::filesystem::path(o.picture.scene.file).stem().string();
    if (o.outputs.empty()) o.outputs.push_back(o.picture.render.legacy ? "output.ppm" : "output.png");
    take_outputs(o.outputs, {});
    if (o.write_scene.empty()) o.write_scene = name + ".view.toml";
    view.reads_path = !view.path.empty();
    if (view.path.empty()) view.path = name + ".path.toml";
    std::vector<std::string> files = o.outputs;
    files.insert(files.end(), {o.write_scene, view.path});
    refuse_doubles(files);
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
    p.values("-o,--output", "FILE", "Denoised picture, .exr, .png, .ppm, .jpg or .hdr; may be given several times",
             [&](const std::string& t) { o.outputs.push_back(t); });
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
    p.values("-o,--output", "FILE",
             "Picture, .exr, .png, .ppm, .jpg or .hdr, or all parts as one, .lancer; may be given several times",
             [&](const std::string& t) { o.outputs.push_back(t); });
    add_format(p, o.format);
    p.flag("--allow-missing", "Write the picture although parts are missing: black, and marked partial",
           o.allow_missing);
    add_threads(p, o.threads);
    if (!p.parse(argc, argv)) return {};
    if (o.outputs.empty()) fail_usage("--output: is missing; add -o NAME.exr");
    for (std::string& path : o.outputs)
        if (extension_of(path) != ".lancer") path = to_output(path, o.format);
    refuse_doubles(o.outputs);
    for (const std::string& part : o.parts)
        for (const std::string& output : o.outputs)
            if (place_of(part) == place_of(output))
                fail_usage("--output: " + in_quotes(output) + " is one of the parts");
    take_environment(o.threads);
    return o;
}

void check_study_options(const std::vector<std::string>& words)
{
    for (const std::string& word : words)
        if (word == "-h" || word == "--help" || word == "--version")
            fail_usage(in_quotes(word) + " is not for studies");
    PictureOptions picture;
    OptionParser safe("lancer render", "", "");
    add_picture_options(safe, picture);
    RenderOptions render;
    OptionParser all("lancer render", "", "");
    add_render_options(all, render);
    std::vector<std::string> with_scene{"scene.toml"};
    with_scene.insert(with_scene.end(), words.begin(), words.end());
    all.parse(std::move(with_scene));
    constexpr std::string_view more[] = {"--tile", "--batch", "--crop", "--denoise", "--time", "--error", "--quiet"};
    for (const std::string& name : all.given())
        if (!safe.knows(name) && std::find(std::begin(more), std::end(more), name) == std::end(more))
            fail_usage(in_quotes(name) + " is not for studies: it does not say what is rendered");
}

PictureOptions parse_picture_options(std::vector<std::string> words)
{
    PictureOptions o;
    OptionParser p("lancer render", "", "");
    add_picture_options(p, o);
    if (!p.parse(std::move(words))) fail_usage("asks for help");
    return o;
}

std::optional<VerifyOptions> parse_verify(int argc, char** argv)
{
    VerifyOptions o;
    OptionParser p("lancer verify",
                   "Trace pixels of a picture again, from what its header says, and compare every bit: whether this "
                   "program drew this picture of this scene.",
                   "Exit codes: 0 all pixels are the same; 1 some differ; 2 wrong usage; 65 the picture does not say "
                   "how it was made,\nor scene or asset invalid; 66 input missing.\n\n"
                   "Example:\n  lancer verify picture.exr scene.toml\n");
    p.argument("PICTURE", "EXR of lancer render or lancer merge", [&](const std::string& t) { o.picture = t; });
    p.argument(
        "SCENE", "Its scene (the one that the picture names)", [&](const std::string& t) { o.scene = t; }, false);
    p.value("--pixels", "N|all", "How many, drawn at random (200)",
            [&](const std::string& t) { o.pixels = t == "all" ? 0 : to_count("--pixels", t, 1); });
    p.value("--asset-root", "FOLDER", "Files that the scene names may lie anywhere in here (as the picture says)",
            [&](const std::string& t) { o.asset_root = t; });
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.threads);
    return o;
}

std::optional<SlurmOptions> parse_slurm(int argc, char** argv)
{
    SlurmOptions o;
    OptionParser p(
        "lancer slurm",
        "Print a job script that renders a scene in shards on a Slurm cluster and merges them: docs/farm.md.",
        "Exit codes: 0 done; 2 wrong usage.\n\n"
        "Example:\n  lancer slurm scene.toml --shards 16 -o picture.exr --render='-s 4096' > job.sh\n  sh job.sh\n");
    p.argument("SCENE", "Scene file (.toml) or mesh (.obj, .ply)", [&](const std::string& t) { o.scene = t; });
    p.value("-o,--output", "FILE", "Picture, .exr, .png, .ppm, .jpg or .hdr (NAME.exr in this folder)",
            [&](const std::string& t) { o.output = to_output(t, {}); });
    p.value("--shards", "N", "Parts of each picture (1)",
            [&](const std::string& t) { o.shards = to_count("--shards", t, 1, 1u << 20); });
    p.value("--frames", "A-B",
            "Frames of an [animation], or numbered scene files, where the name of the scene has ####",
            [&](const std::string& t) { o.frames = to_frames("--frames", t); });
    p.values("--render", "OPTIONS", "More options of lancer render: --render='-s 4096 --aov albedo'",
             [&](const std::string& t) { o.render.push_back(t); });
    if (!p.parse(argc, argv)) return {};
    if (o.output.empty()) o.output = std::filesystem::path(o.scene).stem().string() + ".exr";
    if (o.frames && o.output.find('#') == std::string::npos)
        fail_usage("--frames: " + in_quotes(o.output) + " has no #### for the number");
    return o;
}

std::optional<CheckOptions> parse_check(int argc, char** argv)
{
    CheckOptions o;
    OptionParser p(
        "lancer check", "Print every problem of a scene and its files, one line each, and count them.",
        "Exit codes: 0 no errors; 2 wrong usage; 65 errors, or with --strict warnings; 66 a file is missing; "
        "71 the\npictures need more than --memory.\n\n"
        "Example:\n  lancer check scene.toml --strict\n");
    add_scene_options(p, o.scene);
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    p.flag("--strict", "Exit with 65 if there is a warning", o.strict);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.threads);
    return o;
}

std::optional<InfoOptions> parse_info(int argc, char** argv)
{
    InfoOptions o;
    OptionParser p("lancer info", "Print what is in a scene, and what it costs, or what a picture says of its making.",
                   "Exit codes: 0 done; 2 wrong usage; 65 scene, asset or picture invalid; 66 input missing; "
                   "71 the\npictures need more than --memory.\n\n"
                   "Examples:\n  lancer info scene.toml\n  lancer info scene.toml --plan\n  lancer info picture.exr\n");
    add_scene_options(p, o.scene, "Scene file (.toml), mesh (.obj, .ply) or picture (.exr, .png, ...)");
    add_threads(p, o.threads);
    add_memory(p, o.memory);
    p.flag("--plan", "Also what a pilot learns of the scene: splitting, where and which light is sampled", o.plan);
    p.value("--plan-map", "FILE.png",
            "That, and a map of how often light is sampled: white always, black never or nothing",
            [&](const std::string& t) {
                if (extension_of(t) != ".png") fail_usage("--plan-map: " + in_quotes(t) + " must end in .png");
                o.plan = true, o.plan_map = t;
            });
    if (!p.parse(argc, argv)) return {};
    // What a picture says takes one thread and little memory, whatever a script allows.
    if (!is_scene(o.scene.file))
        for (const std::string& name : p.given())
            if (name != "--threads" && name != "--memory")
                fail_usage(name + ": is for scenes, and " + in_quotes(o.scene.file) +
                           " does not end in .toml, .obj or .ply");
    take_environment(o.threads);
    return o;
}

std::optional<ExportOptions> parse_export(int argc, char** argv)
{
    ExportOptions o;
    OptionParser p(
        "lancer export",
        "Write a scene as other renderers can read it: scene.json, with every name resolved, a plain OBJ file of "
        "triangles for each mesh, and EXR files of linear numbers for textures and the environment. A scene with "
        "anything that these cannot say is refused.",
        "Exit codes: 0 done; 1 cannot write; 2 wrong usage; 65 scene or asset invalid, or more than can be "
        "exported; 66 input missing.\n\nExample:\n  lancer export scene.toml -o exported --size 512x512\n");
    add_picture_options(p, o.picture);
    p.group("What is written");
    p.value("-o,--output", "FOLDER", "Where to; made if it is not there", [&](const std::string& t) { o.folder = t; });
    if (!p.parse(argc, argv)) return {};
    if (o.folder.empty()) fail_usage("--output: no folder to write into; say -o FOLDER");
    take_environment(o.picture.threads);
    return o;
}

std::optional<TuneOptions> parse_tune(int argc, char** argv)
{
    TuneOptions o;
    OptionParser p("lancer tune",
                   "Measure what each estimator gives on a scene: small pictures with it and without it, in turns. "
                   "Ratios are of the other value to that of the settings, with 95 % intervals.",
                   exit_codes + std::string(interrupted) + "\nExample:\n  lancer tune scene.toml --time 2m\n");
    add_picture_options(p, o.picture);
    p.value("--time", "T", "No round begins after T: 60s, 5m, 2h; at least three are drawn (30s)",
            [&](const std::string& t) { o.seconds = to_seconds("--time", t); });
    p.flag("-q,--quiet", "Only warnings, errors and the result", o.quiet);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    return o;
}

std::optional<PixelOptions> parse_pixel(int argc, char** argv)
{
    PixelOptions o;
    OptionParser p(
        "lancer pixel", "Trace one sample of a pixel again, with the same bits, and print every vertex.",
        exit_codes + std::string(interrupted) + "\nExample:\n  lancer pixel scene.toml 231 40 17 --seed 3\n");
    add_picture_options(p, o.picture);
    p.argument("X", "Pixel, from the left of the whole picture",
               [&](const std::string& t) { o.x = to_count("X", t, 0); });
    p.argument("Y", "Pixel, from the top of the whole picture",
               [&](const std::string& t) { o.y = to_count("Y", t, 0); });
    p.argument(
        "SAMPLE", "Number of the sample (0)", [&](const std::string& t) { o.sample = to_count("SAMPLE", t, 0); },
        false);
    if (!p.parse(argc, argv)) return {};
    take_environment(o.picture.threads);
    return o;
}

std::optional<StudyOptions> parse_study(int argc, char** argv)
{
    StudyOptions o;
    OptionParser p("lancer study",
                   "Measure error against run time: methods on scenes with many seeds, as one HTML page.",
                   "An interrupt ends a study; the same command goes on where it ended.\n\n"
                   "Exit codes: 0 done; 1 a run failed; 2 wrong usage; 65 study or scene invalid; 66 input missing;\n"
                   "130 interrupted.\n\nExample:\n  lancer study study.toml -o study\n");
    p.argument("STUDY", "Study file (.toml); docs/measuring.md tells its keys",
               [&](const std::string& t) { o.study = t; });
    p.flag("--allow-peers", "Let the study start the other programs that it names", o.allow_peers);
    p.value("-o,--output", "FOLDER", "Where pictures, figures and index.html go (named as the study)",
            [&](const std::string& t) { o.folder = t; });
    add_threads(p, o.threads);
    if (!p.parse(argc, argv)) return {};
    if (o.folder.empty()) o.folder = std::filesystem::path(o.study).stem();
    take_environment(o.threads);
    return o;
}

std::optional<OptionsOptions> parse_options(int argc, char** argv)
{
    OptionsOptions o;
    OptionParser p("lancer options", "Print the render settings as a table in Markdown: the keys of [render].",
                   "Exit codes: 0 done; 2 wrong usage.\n\nExample:\n  lancer options --biases\n");
    p.flag("--biases", "The bias ledger instead: the entries of lancer:bias in picture headers", o.biases);
    if (!p.parse(argc, argv)) return {};
    return o;
}

std::optional<CompareOptions> parse_compare(int argc, char** argv)
{
    CompareOptions o;
    OptionParser p(
        "lancer compare",
        "Print how far a picture is from a reference, draw where, and say whether it is more than noise.",
        "Exit codes: 0 done, or within the limit; 1 beyond it; 2 wrong usage; 65 unreadable or not of the same size;\n"
        "66 missing.\n\nThe last line is a verdict. For more than errors both pictures must be EXR of render --aov "
        "variance, of\n"
        "different --seed.\n\nExamples:\n  lancer compare picture.exr reference.exr --fail-above 0.01\n"
        "  lancer compare picture.exr reference.exr -o where.png\n");
    p.argument("PICTURE", "Picture: EXR, PNG, HDR, JPEG, TIFF, ...", [&](const std::string& t) { o.picture = t; });
    p.argument("REFERENCE", "What it should be", [&](const std::string& t) { o.reference = t; });
    const auto second = [&](const std::string& t) { o.reference2 = t; };
    p.argument("REFERENCE2", "The same as --reference2", second, false);
    p.value("--reference2", "FILE", "A second, independent reference: noise of the references cancels out", second);
    p.value("--metric", listed(enum_names<Metric>),
            "What the limit is for (relmse; with two references its unbiased form)",
            [&](const std::string& t) { o.metric = to_enum<Metric>("--metric", t); });
    p.flag("--steps", "Compare what 8-bit pictures hold, 0 to 255, as it stands in the files: no linear light",
           o.steps);
    p.value("--fail-above", "X", "Exit with 1 if the error is above X or not a number", [&](const std::string& t) {
        o.fail_above = to_number<double>("--fail-above", t, 0, std::numeric_limits<double>::max(), "a number");
    });
    p.values("-o,--output", "FILE",
             "Map of the errors: .png, .ppm or .jpg in colours, .exr or .hdr as numbers; may be given several times",
             [&](const std::string& t) { o.outputs.push_back(t); });
    add_format(p, o.format);
    p.value("--map", listed(enum_names<ErrorMap>),
            "What the map shows: FLIP from 0 to 1, or the relative squared error in powers of ten from 1e-5 to 10 "
            "(flip)",
            [&](const std::string& t) { o.map = to_enum<ErrorMap>("--map", t); });
    if (!p.parse(argc, argv)) return {};
    take_outputs(o.outputs, o.format);
    refuse_doubles(o.outputs);
    return o;
}

}  // namespace lancer
