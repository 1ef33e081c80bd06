#include "app/render/content.h"

#include "app/render/layer_names.h"
#include "render/aov.h"
#include "render/denoise/film_halves.h"
#include "render/light_layers.h"

namespace lancer {
namespace {

void append(std::vector<ImagePlane>& to, std::vector<ImagePlane> planes)
{
    for (ImagePlane& p : planes) to.push_back(std::move(p));
}

void add_halves(const Film& film, PictureContent& content)
{
    HalfPlanes halves = halves_of(film);
    for (size_t h = 0; h < 2; ++h)
        content.metadata.push_back({std::string(names_of_samples[h]), double{halves.samples[h]}});
    append(content.planes, planes_of(std::move(halves)));
}

}  // namespace

std::vector<ImagePlane> layers_of_denoised(const Image& noisy, const Denoised& denoised)
{
    std::vector<ImagePlane> planes{{"noisy.R", {}}, {"noisy.G", {}}, {"noisy.B", {}}};
    for (ImagePlane& p : planes) p.values.reserve(noisy.pixels.size());
    for (const Color& c : noisy.pixels) {
        planes[0].values.push_back(c.r);
        planes[1].values.push_back(c.g);
        planes[2].values.push_back(c.b);
    }
    planes.push_back({"denoise_error.V", denoised.error});
    return planes;
}

PictureContent content_of(const Film& film, const Denoised& denoised, const PictureRecipe& recipe)
{
    const RenderOptions& options = recipe.options;
    Metadata metadata;
    if (!options.no_metadata) metadata = make_metadata(recipe.stats, options.reproducible);
    if (options.background != BackgroundChoice::keep && !options.no_metadata)
        metadata.emplace_back("background", std::string(name_of(options.background)));
    PictureContent content{.image = denoised.pixels.empty() ? rows_of(film) : rows_of(film, denoised.pixels),
                           .planes = aov_planes(film, options.aovs, recipe.normalisation),
                           .metadata = std::move(metadata),
                           .style = {.format = options.format,
                                     .curve = recipe.curve,
                                     .dither = options.dither,
                                     .ascii_ppm = options.ascii_ppm,
                                     .jpeg_quality = options.jpeg_quality,
                                     .ocio = options.ocio,
                                     .exr = {.half = options.half,
                                             .compression = options.compression,
                                             .tile = options.exr_tile,
                                             .is_multipart = options.exr_multipart,
                                             .camera = options.no_metadata ? std::nullopt : recipe.camera,
                                             .space = options.space}}};
    append(content.planes, layer_planes(film, recipe.light_groups, denoised.layers));
    if (options.mattes) {
        append(content.planes, matte_planes(film));
        content.style.exr.attributes = attributes_of(recipe.manifests);
    }
    if (options.background != BackgroundChoice::keep) content.planes.push_back(alpha_of(film));
    if (options.denoise_sets) add_halves(film, content);
    if (options.guides) append(content.planes, guide_planes(film));
    if (!denoised.pixels.empty()) append(content.planes, layers_of_denoised(to_image(film), denoised));
    for (ImagePlane& plane : content.planes) plane.name = layer_name(plane.name, options.layer_names);
    return content;
}

}  // namespace lancer
