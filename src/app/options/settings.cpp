#include "app/options/settings.h"

#include "app/console.h"
#include "core/names.h"
#include "core/parallel.h"

namespace lancer {

const std::vector<std::string_view> integrator_names = names_of_integrators();
const std::vector<std::string_view> sampler_names{"sobol", "independent"};
const std::vector<std::string_view> filter_names{"box", "gaussian", "blackman-harris", "narrow-gaussian", "centre"};
const std::vector<std::string_view> accel_names = [] {
    std::vector<std::string_view> names{name_of(AccelKind::automatic)};
    for (const AccelName& a : accelerators) names.push_back(a.name);
    return names;
}();
const std::vector<std::string_view> isa_names{"sse2", "sse4.2", "avx", "avx2", "avx512"};

namespace {

// The place of a name that is known to be in the list.
size_t index_of(const std::vector<std::string_view>& names, std::string_view name)
{
    return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// Takes what [render] says of a name, if it is one.
void take_name(const std::optional<std::string>& said, const char* what, const std::vector<std::string_view>& known,
               const Location& where, Diagnostics& diagnostics, std::string& value)
{
    if (!said) return;
    if (index_of(known, *said) == known.size())
        diagnostics.error(
            where, "unknown " + std::string(what) + " " + in_quotes(*said) + " in [render]" + suggestion(*said, known));
    value = *said;
}

Settings settings_of_scene(const RenderDescription& scene)
{
    Settings s;
    Diagnostics diagnostics;
    take_name(scene.integrator, "integrator", integrator_names, scene.where, diagnostics, s.integrator);
    take_name(scene.sampler, "sampler", sampler_names, scene.where, diagnostics, s.sampler);
    take_name(scene.filter, "filter", filter_names, scene.where, diagnostics, s.filter);
    diagnostics.throw_if_errors();
    if (scene.size) s.width = (*scene.size)[0], s.height = (*scene.size)[1];
    s.spp = scene.spp.value_or(s.spp);
    s.seed = scene.seed.value_or(s.seed);
    s.max_depth = scene.max_depth.value_or(s.max_depth);
    s.stop_error = scene.stop_error.value_or(s.stop_error);
    s.switches.take(scene.switches);
    return s;
}

// What belongs to the programs of the past besides their integrators: pixels, their filter, when they end, 8 bits.
// Whoever names a filter or the stop gets it.
void take_legacy(Settings& s, bool says_filter, bool says_stop)
{
    if (!s.switches[Switch::legacy]) return;
    if (!knows_legacy())
        throw Error(ErrorKind::usage, {}, "legacy: this build of lancer was made with LANCER_WITH_CLASSIC=OFF");
    if (!is_classic(s.integrator)) {
        s.grid = PixelGrid::shifted;
        s.tonemap = ToneMap::gamma22;
        if (!says_filter) s.filter = s.spp == 1 ? "centre" : "narrow-gaussian";
    } else {
        s.grid = PixelGrid::corners;
        s.tonemap = ToneMap::clamped;
        if (!says_filter) s.filter = s.spp == 1 ? "centre" : "box";
        if (!says_stop && s.spp > 1 && s.integrator == Whitted::name) s.switches.set(Switch::stop, true);
    }
}

}  // namespace

Settings resolve_settings(const PictureOptions& o, const RenderDescription& scene)
{
    Settings s = settings_of_scene(scene);
    if (o.size) s.width = (*o.size)[0], s.height = (*o.size)[1];
    s.crop = {0, 0, s.width, s.height};
    s.seed = o.seed.value_or(s.seed);
    s.max_depth = o.max_depth.value_or(s.max_depth);
    s.stop_error = o.stop_error.value_or(s.stop_error);
    s.replicates = o.replicates.value_or(s.replicates);
    s.integrator = o.integrator.value_or(s.integrator);
    s.sampler = o.sampler.value_or(s.sampler);
    s.filter = o.filter.value_or(s.filter);
    s.accel = o.accel.value_or(s.accel);
    s.isa = o.isa.value_or(s.isa);
    s.switches.take(o.switches);
    if (o.legacy) s.switches.set(Switch::legacy, true);
    s.spp = o.spp.value_or(s.spp);
    constexpr auto stop = static_cast<size_t>(Switch::stop);
    take_legacy(s, o.filter || scene.filter, o.switches[stop] || scene.switches[stop]);
    s.threads = o.threads ? *o.threads : available_threads();
    return s;
}

RenderSettings to_render_settings(const Settings& s, uint32_t batch)
{
    RenderSettings r;
    r.integrator = make_integrator(s.integrator, {.max_depth = s.max_depth, .switches = s.switches});
    r.accel = accelerator_of(s.accel);
    r.isa = s.isa;
    r.kernel.sampler = s.sampler == "independent" ? SamplerKind::independent : SamplerKind::sobol;
    r.kernel.seed = s.seed;
    r.kernel.replicates = s.replicates;
    constexpr FilterKind filters[] = {FilterKind::box, FilterKind::gaussian, FilterKind::blackman_harris,
                                      FilterKind::narrow_gaussian, FilterKind::centre};
    r.kernel.filter = Filter(filters[index_of(filter_names, s.filter)]);
    r.kernel.batch = batch;
    r.kernel.stop = stop_rule(s.integrator, s.switches);
    r.kernel.stop_error = s.stop_error;
    r.kernel.clamp = clamps_samples(s.integrator, s.switches);
    return r;
}

std::string reproducing_options(const Settings& s)
{
    std::string text = "--size " + std::to_string(s.width) + "x" + std::to_string(s.height) + " --seed " +
                       std::to_string(s.seed) + " --integrator " + s.integrator + " --max-depth " +
                       std::to_string(s.max_depth) + " --sampler " + s.sampler + " --filter " + s.filter + " --accel " +
                       s.accel + " --isa " + s.isa;
    for (size_t i = 0; i < switch_names.size(); ++i)
        if (const auto x = static_cast<Switch>(i); s.switches[x] != Switches::default_of(x))
            text += " --set " + std::string(switch_names[i]) + (s.switches[x] ? "=true" : "=false");
    if (s.switches[Switch::stop]) text += " --stop-error " + shortest(s.stop_error);
    if (s.replicates != 1) text += " --replicates " + std::to_string(s.replicates);
    return text;
}

}  // namespace lancer
