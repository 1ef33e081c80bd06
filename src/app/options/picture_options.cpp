#include "app/options/picture_options.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "app/console.h"
#include "app/options/file_kinds.h"
#include "app/options/option_values.h"
#include "app/options/shared_options.h"
#include "app/paths.h"
#include "app/render/shard.h"
#include "io/image/exr.h"

namespace lancer {
namespace {

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

}  // namespace

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
    p.takes_files(files::ocio);
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
void add_render_options(OptionParser& p, RenderOptions& o, bool is_film)
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
    p.takes_files(is_film ? files::written_frames : files::written_pictures);
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
    const std::vector<std::string_view> channels = aov_words();
    p.takes_list({channels.begin(), channels.end()});
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
    p.takes_files(files::exr);
    p.value("--reference2", "FILE", "A second one, independent of the first: their noise then cancels out",
            [&](const std::string& t) { o.reference2 = t; });
    p.takes_files(files::exr);
    p.value(
        "--error-log", "FILE",
        "Seconds, rays and errors each time that samples have doubled, as CSV; with --denoise those of the denoised "
        "picture, and the seconds that it takes",
        [&](const std::string& t) { o.error_log = t; });
    p.takes_files(files::csv);
    p.value("--outliers", "N",
            "Also list the N samples with the largest part of the error, and what paths the error comes from",
            [&](const std::string& t) { o.outliers = to_count("--outliers", t, 1, 1000); });
    p.value("--write-scene", "FILE.toml",
            "The scene with what was added to it, and with these options: renders the same picture",
            [&](const std::string& t) {
                if (extension_of(t) != ".toml") fail_usage("--write-scene: " + in_quotes(t) + " must end in .toml");
                o.write_scene = t;
            });
    p.takes_files(files::toml);
    p.value("--stats", "FILE", "Figures of the run as JSON", [&](const std::string& t) { o.stats = t; });
    p.takes_files(files::json);
    p.value(
        "--checkpoint", "FILE[,T]",
        "Every T (60s), first after 10 s, and at the end write what --resume needs; the one before stays as FILE.old",
        [&](const std::string& t) { take_checkpoint(t, o); });
    p.takes_files(files::checkpoints);
    p.value(
        "--resume", "FILE|auto",
        "Go on from a checkpoint, with the same bits; also with more samples. auto: from the one of --checkpoint, if "
        "it is there",
        [&](const std::string& t) { o.resume = t; });
    p.takes_files(files::checkpoints);
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

}  // namespace lancer
