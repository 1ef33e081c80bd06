// The command line, as one struct per command.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/load_scene.h"
#include "core/enum_names.h"
#include "core/film.h"
#include "io/image/color_space.h"
#include "io/image/exr_compression.h"
#include "io/image/ocio.h"
#include "io/image/picture_format.h"
#include "io/image/tonemap.h"
#include "render/aov_kind.h"
#include "scene/description/exposure.h"
#include "scene/description/render_settings.h"

namespace lancer {

// Bytes, or a part of the memory that there is.
struct MemorySize {
    double amount = 0.8;  // > 0
    bool is_part = true;
};

// What every command takes that traces rays.
struct PictureOptions {
    SceneChoice scene;
    RenderSettings render;  // what is given here overrides [render] of the scene
    std::optional<uint32_t> threads;
    MemorySize memory;  // that all pictures may take together
    bool strict = false;
};

// Paths under way at once, where nothing says how many.
inline constexpr uint32_t usual_batch = 256;

enum class ProgressKind { automatic, plain, json, none };
template <>
inline constexpr auto enum_names<ProgressKind> = std::to_array<std::string_view>({"auto", "plain", "json", "none"});

// What becomes of the light that camera rays see when they hit nothing.
enum class BackgroundChoice { keep, transparent, opaque_glass };
template <>
inline constexpr auto enum_names<BackgroundChoice> = std::to_array<std::string_view>({"keep", "transparent",
                                                                                      "opaque-glass"});

// Whose names the layers of EXR pictures have.
enum class LayerNames { lancer, nuke, blender };
template <>
inline constexpr auto enum_names<LayerNames> = std::to_array<std::string_view>({"lancer", "nuke", "blender"});

struct DisplayAddress {
    std::string host;  // name or numeric address, without brackets
    uint16_t port = 0;
};

// A part of a picture that one of several machines renders. index: from 1; 0: the whole picture, of 0 parts or of so
// many that were merged.
struct Shard {
    uint32_t index = 0, count = 0;

    bool is_whole() const { return index == 0; }
    friend bool operator==(const Shard&, const Shard&) = default;
};

// Numbered scene files, both ends included.
struct FrameRange {
    uint32_t first = 0, last = 0;
};

struct RenderOptions {
    PictureOptions picture;
    std::optional<FrameRange> frames;     // #### in the names of scene and outputs stands for the number
    std::vector<std::string> outputs;     // never empty; each ends as a format is called, or `format` is given
    std::optional<PictureFormat> format;  // of outputs whose names have no ending
    std::optional<Tile> crop;
    uint32_t tile = 16;            // side in pixels
    uint32_t batch = usual_batch;  // paths under way at once
    std::vector<Aov> aovs;         // each once, in the order of Aov
    bool light_layers = false;     // the light of each group of lights, likewise
    bool part_layers = false;      // emission, direct and indirect light, likewise
    bool lobe_layers = false;      // light by the lobe of the first surface, likewise
    bool mattes = false;           // Cryptomatte of objects and materials, likewise
    LayerNames layer_names = LayerNames::lancer;
    bool denoise = false;
    bool denoise_sets = false;  // what `lancer denoise` needs, as layers of EXR
    bool guides = false;        // what Open Image Denoise takes, likewise
    BackgroundChoice background = BackgroundChoice::keep;
    bool half = false;
    ExrCompression compression = ExrCompression::zip;
    uint32_t exr_tile = 0;  // side in pixels; 0: scan lines
    bool exr_multipart = false;
    ColorSpace space = ColorSpace::lin_rec709;  // of EXR
    bool no_metadata = false;                   // nothing about the render in the pictures' headers
    bool reproducible = false;                  // nothing in the pictures' headers that changes from run to run
    std::optional<Exposure> exposure;           // else usual_exposure()
    std::optional<ToneMap> tonemap;             // else usual_tonemap()
    OcioChoice ocio;                            // in place of the tone map
    bool dither = false;
    bool ascii_ppm = false;
    uint32_t jpeg_quality = 95;         // 1 to 100
    std::string write_scene;            // empty: none
    std::string checkpoint, resume;     // likewise; resume may be "auto"
    double checkpoint_interval = 60;    // seconds
    Shard shard;                        // the checkpoint is then the only output
    std::string stats;                  // empty: none
    std::string reference, reference2;  // empty: none
    std::string error_log;              // likewise
    uint32_t outliers = 0;              // number of them to list; 0: none
    std::optional<double> time, error;  // at which the render stops: seconds, square root of the relative error
    std::optional<DisplayAddress> display;
    ProgressKind progress = ProgressKind::automatic;
    bool quiet = false, verbose = false;
    std::string command_line;  // as it was given

    bool divides_light() const { return light_layers || part_layers || lobe_layers; }
};

struct FilmOptions {
    RenderOptions render;  // of each frame: #### in the names of outputs stands for its number; shard: none
    Shard shard;           // frames are dealt to shards
    std::string movie;     // .mp4; empty: none, and then outputs are not
    std::optional<double> fps;
    bool again = false;  // draws frames that are finished, too
};

struct DenoiseOptions {
    std::string picture;
    std::vector<std::string> outputs;     // never empty; as of RenderOptions
    std::optional<PictureFormat> format;  // likewise
    std::optional<uint32_t> threads;
    float exposure = 0;  // stops; formats for displays
    uint32_t jpeg_quality = 95;
    ToneMap tonemap = ToneMap::srgb;
    OcioChoice ocio;  // in place of the tone map
};

struct MergeOptions {
    std::vector<std::string> parts, outputs;  // neither is empty; outputs are as of RenderOptions, or end in .lancer
    std::optional<PictureFormat> format;
    bool allow_missing = false;
    bool json = false;
    std::optional<uint32_t> threads;
};

struct SlurmOptions {
    std::string scene, output;
    uint32_t shards = 1;
    std::optional<FrameRange> frames;
    std::vector<std::string> render;  // more options of lancer render
};

struct VerifyOptions {
    std::string picture;
    std::string scene;       // empty: the one that the picture names
    std::string asset_root;  // empty: as the picture says
    uint32_t pixels = 200;   // 0: all
    bool json = false;
    std::optional<uint32_t> threads;
    MemorySize memory;
};

struct CheckOptions {
    SceneChoice scene;
    std::optional<uint32_t> threads;
    MemorySize memory;
    bool strict = false;
    bool json = false;
};

struct InfoOptions {
    SceneChoice scene;  // or a picture
    std::optional<uint32_t> threads;
    MemorySize memory;
    bool plan = false;
    std::string plan_map;  // a file; empty: none
    bool json = false;
};

struct PixelOptions {
    PictureOptions picture;
    uint32_t x = 0, y = 0, sample = 0;
};

struct ViewOptions {
    RenderOptions render;  // what pictures are written with
    std::string path;      // of key frames
    bool reads_path = false;
};

struct TuneOptions {
    PictureOptions picture;
    double seconds = 30;
    bool quiet = false;
};

struct ExportOptions {
    PictureOptions picture;
    std::string folder;
};

struct StudyOptions {
    std::string study, folder;
    bool allow_peers = false;  // may start programs that the study names
    std::optional<uint32_t> threads;
};

struct BenchOptions {
    PictureOptions picture;            // its render settings are the scene's
    double seconds = 120;              // that all of it takes
    double error = 0.02;               // of pictures: the root of their relative mean square
    std::vector<std::string> methods;  // the baseline first; see app/bench/methods.h
    std::vector<std::string> rays;     // kinds, in the order of ray_set_kinds
    std::string folder, against;       // empty: none
    bool json = false, quiet = false;
};

struct OptionsOptions {
    bool biases = false;
    std::string pages;  // a folder
};

enum class Metric { rmse, relmse, smape, flip };
template <>
inline constexpr auto enum_names<Metric> = std::to_array<std::string_view>({"rmse", "relmse", "smape", "flip"});
enum class ErrorMap { flip, relmse };
template <>
inline constexpr auto enum_names<ErrorMap> = std::to_array<std::string_view>({"flip", "relmse"});

struct CompareOptions {
    std::string picture, reference;
    std::string reference2;  // empty: one reference
    Metric metric = Metric::relmse;
    bool steps = false;
    std::optional<double> fail_above;
    std::vector<std::string> outputs;     // of the map; as of RenderOptions
    std::optional<PictureFormat> format;  // likewise
    ErrorMap map = ErrorMap::flip;
    bool json = false;
};

// argv[0] is the name of the command, or of the program where it was left out. Nothing if help or version was asked
// for; it has then been printed. Throws Error (usage).
std::optional<RenderOptions> parse_render(int argc, char** argv);
std::optional<FilmOptions> parse_film(int argc, char** argv);
std::optional<ViewOptions> parse_view(int argc, char** argv);
std::optional<DenoiseOptions> parse_denoise(int argc, char** argv);
std::optional<MergeOptions> parse_merge(int argc, char** argv);
// Throws Error (usage) unless these are options of lancer render that say what is rendered, and neither write files nor
// connect: what a study file, perhaps from a stranger, may give.
void check_study_options(const std::vector<std::string>& words);
// What a picture was rendered with. words: as after "lancer render", the scene first. Throws Error (usage).
PictureOptions parse_picture_options(std::vector<std::string> words);
std::optional<VerifyOptions> parse_verify(int argc, char** argv);
std::optional<SlurmOptions> parse_slurm(int argc, char** argv);
std::optional<CheckOptions> parse_check(int argc, char** argv);
std::optional<InfoOptions> parse_info(int argc, char** argv);
std::optional<PixelOptions> parse_pixel(int argc, char** argv);
std::optional<TuneOptions> parse_tune(int argc, char** argv);
std::optional<ExportOptions> parse_export(int argc, char** argv);
std::optional<StudyOptions> parse_study(int argc, char** argv);
std::optional<BenchOptions> parse_bench(int argc, char** argv);
std::optional<OptionsOptions> parse_options(int argc, char** argv);
std::optional<CompareOptions> parse_compare(int argc, char** argv);

}  // namespace lancer
