// The output files of a render and their metadata.
#pragma once

#include "app/options/options.h"
#include "core/image.h"
#include "io/image/exr.h"
#include "render/denoise/denoise.h"
#include "report/stats_json.h"
#include "scene/description/description.h"

namespace lancer {

// Throws Error (failed) if a file could not be written; changes nothing.
void probe_outputs(const RenderOptions& options);

// Throws Error (usage) if an output, be it through a link, is a file that the scene was read from.
void refuse_input_as_output(const RenderOptions& options, const SceneDescription& scene);

// The mean of each pixel's samples; pixels without samples are black.
Image to_image(const Film& film);
Image to_image(const Film& film, const std::vector<Color>& pixels);  // other pixels in the film's place
// The same, row by row; the film must outlive the result.
ImageRows rows_of(const Film& film);
// Other pixels in the film's place, which must outlive the result.
ImageRows rows_of(const Film& film, const std::vector<Color>& pixels);

// Where the header of a picture with halves says how many samples of a pixel they have, on average.
inline constexpr std::array<std::string_view, 2> names_of_samples{"denoise_samples_a", "denoise_samples_b"};

// The metadata of a picture. Pixels are the same for the same scene and settings; metadata are only if reproducible.
Metadata make_metadata(const RunStats& stats, bool reproducible);

// Whether one of them is for displays: PNG, PPM or JPEG.
bool has_display_output(const RenderOptions& options);

// How light becomes code values in formats for displays; EXR and HDR keep the light.
struct DisplayCurve {
    float exposure_stops = 0;
    ToneMap tonemap = ToneMap::srgb;
};

// How pictures become files.
struct PictureStyle {
    std::optional<PictureFormat> format;  // of names without an ending
    DisplayCurve curve;                   // in formats for displays; their headers tell of it
    bool dither = false, ascii_ppm = false;
    uint32_t jpeg_quality = 95;
    OcioChoice ocio{};  // in place of the tone map
    ExrOptions exr{};
};
// The name of the plane that is the alpha channel, also of PNG. Colours are multiplied by it, in PNG divided again.
inline constexpr const char* alpha_plane = "A";
// What a picture file holds.
struct PictureContent {
    ImageRows image;
    std::vector<ImagePlane> planes;  // in EXR only, but for alpha
    Metadata metadata;
    PictureStyle style;
};

// Tells the names of what was written on the standard output, unless a picture went there.
void print_written(const std::vector<std::string>& paths);
// Writes a picture under each name, all or none. Throws Error (failed).
void write_outputs(const std::vector<std::string>& paths, const PictureContent& picture);
// Names that no file has, for what cannot be written under its own: beside it, and in the folder for temporary files.
std::vector<std::string> rescue_names(const std::string& path);
// For pictures that write_outputs() could not write: each is written under a new name beside its own, else in the
// folder for temporary files. No file is replaced. Returns the names of what could be written.
std::vector<std::string> rescue_outputs(const std::vector<std::string>& paths, const PictureContent& picture);

}  // namespace lancer
