#include "app/render/outputs.h"

#include <algorithm>
#include <deque>
#include <filesystem>

#include "app/asset_files.h"
#include "app/console.h"
#include "app/paths.h"
#include "core/names.h"
#include "io/atomic_file.h"
#include "io/image/exr.h"
#include "io/image/hdr.h"
#include "io/image/jpeg.h"
#include "io/image/png.h"
#include "io/image/ppm.h"
#include "render/bias_ledger.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

Window window_of(const Tile& t)
{
    return {static_cast<int32_t>(t.x0), static_cast<int32_t>(t.y0), static_cast<int32_t>(t.x1),
            static_cast<int32_t>(t.y1)};
}

Image to_image(const ImageRows& rows)
{
    Image image = make_image(rows.display, rows.data);
    const auto width = static_cast<size_t>(rows.data.width());
    for (int32_t y = rows.data.y0; y < rows.data.y1; ++y)
        rows.fill(y, std::span(image.pixels).subspan(static_cast<size_t>(y - rows.data.y0) * width, width));
    return image;
}

MetadataValue value_of(const RenderSettings& settings, const RenderOption& option)
{
    return std::visit(
        [&]<class Field>(const Field& field) -> MetadataValue {
            if constexpr (std::is_same_v<Field, NumberField<double>>)
                return settings.*field.member;
            else if constexpr (requires { field.least; })
                return static_cast<int64_t>(settings.*field.member);
            else
                return value_text(settings, option);
        },
        option.field);
}

// Empty without an alpha channel.
std::span<const float> alpha_of(const PictureContent& picture)
{
    const auto found = std::find_if(picture.planes.begin(), picture.planes.end(),
                                    [](const ImagePlane& p) { return p.name == alpha_plane; });
    return found == picture.planes.end() ? std::span<const float>{} : std::span(found->values);
}

void write_picture(AtomicFile& file, const PictureContent& picture)
{
    const PictureStyle& style = picture.style;
    const PictureFormat format = format_of(file.path(), style.format);
    if (format == PictureFormat::exr)
        return write_exr(file, picture.image, picture.metadata, style.exr, picture.planes);
    if (format == PictureFormat::hdr) return write_hdr(file, picture.image, picture.metadata);
    Metadata of_display = picture.metadata;
    of_display.emplace_back("exposure", shortest(style.curve.exposure_stops));
    ByteOptions bytes{
        .exposure_stops = style.curve.exposure_stops, .dither = style.dither, .tonemap = style.curve.tonemap};
    if (style.ocio.is_given()) {
        OcioView view = open_ocio(style.ocio);
        of_display.emplace_back("ocio", view.choice.config);
        of_display.emplace_back("ocio_display", view.choice.display);
        of_display.emplace_back("ocio_view", view.choice.view);
        of_display.emplace_back("ocio_input", view.input);
        bytes.curve = std::move(view.curve);
    } else {
        of_display.emplace_back("tonemap", std::string(name_of(style.curve.tonemap)));
    }
    if (format == PictureFormat::png)
        write_png(file, to_image(picture.image), of_display, bytes, alpha_of(picture));
    else if (format == PictureFormat::jpg)
        write_jpeg(file, to_image(picture.image), of_display, bytes, static_cast<int>(style.jpeg_quality));
    else
        write_ppm(file, to_image(picture.image), of_display, bytes, style.ascii_ppm);
}

std::filesystem::path temporary_folder()
{
    std::error_code unknown;
    return std::filesystem::temp_directory_path(unknown);
}

// A name in a folder that is like that of the path, and that no file has; "" if there is none.
std::string unused_name(const std::string& path, const std::filesystem::path& folder)
{
    const std::filesystem::path given(path);
    for (int i = 1; i <= 100; ++i) {
        const std::string number = i == 1 ? "" : "-" + std::to_string(i);
        const auto name = folder / (given.stem().string() + "-rescued" + number + given.extension().string());
        std::error_code unknown;
        if (!std::filesystem::exists(name, unknown)) return name.string();
    }
    return "";
}

}  // namespace

void probe_outputs(const RenderOptions& options)
{
    for (const std::string& path : options.outputs) const AtomicFile probe(path);
    if (!options.stats.empty()) const AtomicFile probe(options.stats);
    if (!options.error_log.empty()) const AtomicFile probe(options.error_log);
    if (!options.write_scene.empty()) const AtomicFile probe(options.write_scene);
    if (!options.checkpoint.empty()) const AtomicFile probe(options.checkpoint);
}

void refuse_input_as_output(const RenderOptions& options, const SceneDescription& scene)
{
    const std::vector<std::string> inputs = input_files(scene);
    const auto check = [&](const std::string& option, const std::string& path) {
        std::error_code absent;
        for (const std::string& input : inputs)
            if (std::filesystem::equivalent(path, input, absent))
                throw Error(ErrorKind::usage, {},
                            option + ": " + in_quotes(path) + " would overwrite the input " + in_quotes(input));
    };
    for (const std::string& path : options.outputs) check("--output", path);
    if (!options.stats.empty()) check("--stats", options.stats);
    if (!options.error_log.empty()) check("--error-log", options.error_log);
    if (!options.write_scene.empty()) check("--write-scene", options.write_scene);
    if (!options.checkpoint.empty()) check("--checkpoint", options.checkpoint);
}

ImageRows rows_of(const Film& film)
{
    return {window_of({0, 0, film.width, film.height}), window_of(film.crop), [&film](int32_t y, std::span<Color> row) {
                const size_t first = film.index(film.crop.x0, static_cast<uint32_t>(y));
                for (size_t i = 0; i < row.size(); ++i) row[i] = film.whole(first + i).mean();
            }};
}

ImageRows rows_of(const Film& film, const std::vector<Color>& pixels)
{
    ImageRows rows = rows_of(film);
    rows.fill = [&film, &pixels](int32_t y, std::span<Color> row) {
        const size_t first = film.index(film.crop.x0, static_cast<uint32_t>(y));
        std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(first), row.size(), row.begin());
    };
    return rows;
}

Image to_image(const Film& film) { return to_image(rows_of(film)); }
Image to_image(const Film& film, const std::vector<Color>& pixels) { return to_image(rows_of(film, pixels)); }

Metadata make_metadata(const RunStats& s, bool reproducible)
{
    const auto integer = [](uint64_t x) { return static_cast<int64_t>(x); };
    Metadata all{{"software", "lancer " + s.context.version},
                 {"scene", s.scene.file},
                 {"scene_hash", to_hex(s.scene.content_hash)},
                 {"settings_hash", s.settings.hash},
                 {"options", s.settings.options}};
    if (!s.settings.identity.empty()) all.emplace_back("identity", s.settings.identity);
    if (!s.scene.added_light.empty()) all.emplace_back("light", s.scene.added_light);
    // The picture has its size, and the ledger lists the switches that bias it.
    for (const RenderOption& option : render_options())
        if (!option.is_switch() && !std::holds_alternative<SizeField>(option.field))
            all.emplace_back(option.name, value_of(s.settings.render, option));
    all.emplace_back("spp_done", integer(s.passes.empty() ? 0 : s.passes.back().spp));
    all.emplace_back("rays", integer(s.rays()));
    all.emplace_back("dropped_samples", integer(s.counters.dropped));
    all.emplace_back("bias", bias_ledger(s.settings.render, {.stopped_by = s.stopped_by,
                                                             .dropped = s.counters.dropped,
                                                             .denoised = s.denoised,
                                                             .caught_shadows = s.scene.catches_shadows,
                                                             .no_scattering = s.scene.ignores_scattering}));
    all.emplace_back("partial", integer(s.partial ? 1 : 0));
    all.emplace_back("embree", s.context.embree);
    if (!reproducible) {
        all.emplace_back("threads", integer(s.settings.threads));
        all.emplace_back("seconds", s.render_s);
        all.emplace_back("command_line", s.context.command_line);
    }
    if (s.estimated_error) all.push_back({"estimated_error", *s.estimated_error});
    if (s.denoised_error) all.push_back({"denoised_error", *s.denoised_error});
    return all;
}

bool has_display_output(const RenderOptions& options)
{
    return std::any_of(options.outputs.begin(), options.outputs.end(),
                       [&](const std::string& path) { return is_for_displays(format_of(path, options.format)); });
}

void print_written(const std::vector<std::string>& paths)
{
    if (std::find(paths.begin(), paths.end(), standard_output) != paths.end()) return;
    for (const std::string& path : paths) print_path(path);
}

void write_outputs(const std::vector<std::string>& paths, const PictureContent& picture)
{
    // All are complete before the first takes its name: a disk that is full at the last leaves every old file alone.
    std::deque<AtomicFile> files;
    for (const std::string& path : paths) {
        AtomicFile& file = files.emplace_back(path);
        write_picture(file, picture);
        file.finish();
    }
    for (AtomicFile& file : files) file.commit();
}

std::vector<std::string> rescue_names(const std::string& path)
{
    std::vector<std::string> names;
    for (const auto& folder : {std::filesystem::path(path).parent_path(), temporary_folder()})
        if (std::string name = unused_name(path, folder); !name.empty()) names.push_back(std::move(name));
    return names;
}

std::vector<std::string> rescue_outputs(const std::vector<std::string>& paths, const PictureContent& picture)
{
    std::vector<std::string> written;
    for (const std::string& path : paths)
        for (const std::string& name : rescue_names(path)) {
            try {
                AtomicFile file(name);
                write_picture(file, picture);
                file.commit();
            } catch (const Error&) {
                continue;
            }
            written.push_back(name);
            break;
        }
    return written;
}

}  // namespace lancer
