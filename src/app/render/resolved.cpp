#include "app/render/resolved.h"

#include <algorithm>

#include "app/console.h"
#include "app/paths.h"
#include "app/render/limits.h"
#include "app/render/outputs.h"
#include "app/write_scene.h"
#include "core/names.h"
#include "io/atomic_file.h"
#include "io/image/jpeg.h"
#include "io/scene/scene_file.h"

namespace lancer {
namespace {

// --error with --denoise asks for the error of the denoised picture, which samples tell that are held out of it.
void hold_samples_out(ResolvedRender& r)
{
    constexpr uint32_t least = 4, usual = 8;
    if (r.settings.replicates >= least) return;
    if (r.settings.replicates > 1)
        throw Error(ErrorKind::usage, {},
                    format_text("--error: with --denoise it needs --replicates %u or more", least));
    r.settings.replicates = r.prepared.settings.replicates = usual;  // the renderer is made of the latter
    if (!r.options.quiet)
        print_note(format_text("--replicates %u, so that the error of the denoised picture can be told", usual));
}

// The command line comes before the scene.
void read_output_settings(ResolvedRender& r, Diagnostics& diagnostics)
{
    const SceneChoice& scene = r.options.picture.scene;
    const std::optional<uint32_t> frame = scene.turntable ? std::nullopt : scene.frame;
    r.output = read_output(scene.file, scene.definitions, diagnostics, frame);
    if (r.options.exposure) r.output.exposure = r.options.exposure;
    if (r.options.tonemap) r.output.tonemap = r.options.tonemap;
    if (r.options.denoise) r.output.denoise = true;
    r.options.denoise = r.output.denoise.value_or(false);
    if (!r.output.exposure) r.output.exposure = usual_exposure(scene.file, r.settings);
}

void write_scene(const ResolvedRender& r)
{
    if (r.options.write_scene.empty()) return;
    const SceneChoice& scene = r.options.picture.scene;
    write_text(r.options.write_scene, completed_scene_text(scene, r.prepared.added.text, *r.prepared.description.camera,
                                                           r.options.picture.render, r.output));
    if (const std::string root = asset_root_for(r.options.write_scene, scene); !root.empty())
        print_note("to render " + r.options.write_scene + ", add --asset-root " + in_shell_quotes(root));
}

// What is wrong with it is told before the render.
void check_ocio(const RenderOptions& options)
{
    const OcioView view = open_ocio(options.ocio);
    if (!options.quiet)
        print_note("OpenColorIO: from " + in_quotes(view.input) + " to the display " + in_quotes(view.choice.display) +
                   ", view " + in_quotes(view.choice.view));
}

// What works with what.
void check_choices(const ResolvedRender& r)
{
    if (r.options.denoise || r.options.denoise_sets || r.options.guides) require_denoisable(r.settings);
    if (r.options.divides_light()) require_layers(r.settings);
    if (!r.options.shard.is_whole() && r.settings.stop)
        throw Error(ErrorKind::usage, {}, "--shard: is not for stop=true, where samples depend on each other");
}

void choose_crop(ResolvedRender& r)
{
    const uint32_t width = r.settings.size.width, height = r.settings.size.height;
    r.crop = r.options.crop.value_or(Tile{0, 0, width, height});
    if (r.crop.x1 > width || r.crop.y1 > height)
        throw Error(ErrorKind::usage, {}, format_text("--crop: reaches beyond the picture of %ux%u", width, height));
    for (const std::string& path : r.options.outputs)
        if (std::max(r.crop.width(), r.crop.height()) > max_jpeg_side &&
            format_of(path, r.options.format) == PictureFormat::jpg)
            throw Error(ErrorKind::usage, {},
                        format_text("--output: a JPEG has at most %u pixels across and down", max_jpeg_side));
}

}  // namespace

ResolvedRender resolve_render(const RenderOptions& options, Diagnostics& diagnostics, FrameCache* film)
{
    ResolvedRender r{.options = options,
                     .prepared = load_prepared(options.picture, diagnostics, options.quiet, film),
                     .settings = {},
                     .crop = {},
                     .output = {}};
    refuse_input_as_output(options, r.prepared.description);
    r.settings = r.prepared.settings;
    read_output_settings(r, diagnostics);
    write_scene(r);
    const bool has_spp = options.picture.render.is_given(&RenderSettings::spp);
    if ((options.time || options.error) && !has_spp) r.settings.spp = unlimited_spp;
    check_choices(r);
    if (r.options.denoise && options.error) hold_samples_out(r);
    choose_crop(r);
    if (options.ocio.is_given()) check_ocio(options);
    return r;
}

}  // namespace lancer
