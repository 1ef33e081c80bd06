#include "app/render/recipe.h"

#include "app/options/shared_options.h"
#include "app/whole_film.h"
#include "core/hash.h"
#include "render/aov.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

template <class Stream, class AnySettings>
void visit_settings(Stream& stream, AnySettings& settings)
{
    for (const RenderOption& option : render_options()) {
        std::string text = Stream::loads ? "" : value_text(settings, option);
        stream(text);
        if constexpr (Stream::loads) read_setting(option, text, settings);
    }
}

template <class Stream, class AnyOptions>
void visit_options(Stream& stream, AnyOptions& o)
{
    stream.each(o.aovs, [&](auto& aov) { visit_enum(stream, aov, enum_names<Aov>.size()); });
    for (auto* flag : {&o.light_layers, &o.part_layers, &o.lobe_layers, &o.mattes, &o.denoise, &o.denoise_sets,
                       &o.guides, &o.half, &o.dither, &o.ascii_ppm, &o.reproducible, &o.no_metadata, &o.exr_multipart})
        visit_flag(stream, *flag);
    stream(o.jpeg_quality), stream(o.exr_tile);
    for (auto* text : {&o.ocio.config, &o.ocio.display, &o.ocio.view}) stream(*text);
    visit_enum(stream, o.space, enum_names<ColorSpace>.size());
    visit_enum(stream, o.background, enum_names<BackgroundChoice>.size());
    visit_enum(stream, o.layer_names, enum_names<LayerNames>.size());
    visit_enum(stream, o.compression, enum_names<ExrCompression>.size());
}

template <class Stream, class AnyStats>
void visit_stats(Stream& stream, AnyStats& s)
{
    for (auto* text : {&s.context.version, &s.context.embree, &s.context.command_line, &s.scene.file,
                       &s.scene.added_light, &s.settings.hash, &s.settings.options})
        stream(*text);
    stream(s.scene.content_hash), stream(s.settings.threads), visit_flag(stream, s.scene.catches_shadows);
    visit_flag(stream, s.scene.ignores_scattering);
    visit_settings(stream, s.settings.render);
    auto& crop = s.settings.crop;
    stream(crop.x0), stream(crop.y0), stream(crop.x1), stream(crop.y1);
}

template <class Stream, class AnyRecipe>
void visit_recipe(Stream& stream, AnyRecipe& r)
{
    visit_options(stream, r.options);
    visit_stats(stream, r.stats);
    stream(r.curve.exposure_stops), visit_enum(stream, r.curve.tonemap, enum_names<ToneMap>.size());
    auto& [center, scale] = r.normalisation;
    stream(center.x), stream(center.y), stream(center.z), stream(scale);
    stream.each(r.light_groups, [&](auto& name) { stream(name); });
    stream.each(r.manifests, [&](auto& m) { stream(m.layer), stream(m.names); });
    bool has_camera = r.camera.has_value();
    visit_flag(stream, has_camera);
    if constexpr (Stream::loads)
        if (has_camera) r.camera.emplace();
    if (r.camera)
        for (auto* matrix : {&r.camera->world_to_camera, &r.camera->world_to_ndc})
            for (auto& row : *matrix)
                for (auto& x : row) stream(x);
    visit_flag(stream, r.keeps_blocks_open);
}

// A stream that keeps nothing but the hash.
struct HashStream {
    static constexpr bool loads = false;
    uint64_t hash = 0;

    void operator()(uint32_t x) { (*this)(std::to_string(x)); }
    void operator()(const std::string& text) { hash = hash_bytes(text, hash); }
    template <class T, class F>
    void each(const std::vector<T>& all, const F& visit)
    {
        (*this)(static_cast<uint32_t>(all.size()));
        for (const T& x : all) visit(x);
    }
};

}  // namespace

std::optional<SetDeal> sets_of(const RenderOptions& o, const RenderSettings& s)
{
    if (!o.denoise && !o.denoise_sets && !o.guides) return {};
    return SetDeal{.replicates = s.replicates};
}

uint64_t hash_of_contents(const RenderOptions& options)
{
    HashStream stream;
    visit_options(stream, options);
    return stream.hash;
}

Film empty_film(const PictureRecipe& recipe)
{
    const RenderOptions& o = recipe.options;
    const RenderSettings& s = recipe.stats.settings.render;
    Film film(s.size.width, s.size.height, recipe.stats.settings.crop);
    film.hides_background = o.background != BackgroundChoice::keep;
    AovLayout layout = layout_of(o.aovs);
    if (film.hides_background)
        add_alpha_sums(o.background == BackgroundChoice::transparent, recipe.stats.scene.catches_shadows, layout);
    if (o.mattes) layout.add(AovSum::samples), film.keep_mattes();
    film.keep_aovs(layout);
    keep_for_settings(s, film);
    if (const auto sets = sets_of(o, s)) film.keep_sets(*sets);
    film.keep_layers({.groups = o.light_layers ? static_cast<uint32_t>(recipe.light_groups.size()) : 0,
                      .has_segments = o.part_layers,
                      .has_lobes = o.lobe_layers});
    if (recipe.keeps_blocks_open) film.keep_blocks_open();
    return film;
}

void save_recipe(Saver& to, const PictureRecipe& recipe) { visit_recipe(to, recipe); }

PictureRecipe load_recipe(Loader& from)
{
    PictureRecipe recipe;
    try {
        visit_recipe(from, recipe);
    } catch (const Error& problem) {
        if (problem.kind() == ErrorKind::invalid_input) throw;
        from.fail_damaged();
    }
    const RenderSettings& s = recipe.stats.settings.render;
    const Tile& crop = recipe.stats.settings.crop;
    if (crop.x0 >= crop.x1 || crop.y0 >= crop.y1 || crop.x1 > s.size.width || crop.y1 > s.size.height)
        from.fail_damaged();
    return recipe;
}

}  // namespace lancer
