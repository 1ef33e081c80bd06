#include "render/bias_ledger.h"

#include <algorithm>

#include "integrators/integrator.h"
#include "render/estimators/stop_rule.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

// "max_depth=3" of numbers, "legacy" of a switch that is on, "no_direct" of one that is off.
std::string entry_of(const RenderSettings& settings, const RenderOption& option)
{
    const std::string name(option.name), value = value_text(settings, option);
    if (!option.is_switch()) return name + "=" + value;
    return value == "true" ? name : "no_" + name;
}

// As readers find it in the documentation.
std::string shown_entry_of(const RenderOption& option)
{
    const std::string name(option.name);
    if (!option.is_switch()) return name + "=N";
    return value_text({}, option) == "true" ? "no_" + name : name;
}

}  // namespace

std::string bias_ledger(const RenderSettings& settings, const LedgerEvents& events)
{
    std::string ledger;
    const auto add = [&](const std::string& entry) { ledger += (ledger.empty() ? "" : ", ") + entry; };
    for (const IntegratorBias& bias : biases_of(settings.integrator)) add(std::string(bias.entry));
    for (const RenderOption& option : render_options())
        if (is_biased(settings, option)) add(entry_of(settings, option));
    if (events.no_scattering) add("no_scattering");
    if (clamps_samples(settings)) add("clamp");
    if (!events.stopped_by.empty()) add("stopped_by_" + events.stopped_by);
    if (events.dropped) add("dropped=" + std::to_string(events.dropped));
    if (events.denoised) add("denoised");
    if (events.caught_shadows) add("shadow_ratio");
    return ledger.empty() ? "none" : ledger;
}

std::vector<LedgerEntry> all_ledger_entries()
{
    std::vector<LedgerEntry> all;
    // One entry for all integrators that have the same bias.
    for (size_t i = 0; i < enum_names<IntegratorKind>.size(); ++i) {
        const auto kind = static_cast<IntegratorKind>(i);
        const std::string name = "`" + std::string(name_of(kind)) + "`";
        for (const IntegratorBias& bias : biases_of(kind)) {
            const auto known =
                std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.entry == bias.entry; });
            if (known == all.end())
                all.push_back({std::string(bias.entry), name, std::string(bias.effect)});
            else
                known->when += ", " + name;
        }
    }
    for (const RenderOption& option : render_options())
        if (!option.bias.effect.empty())
            all.push_back({shown_entry_of(option), std::string(option.bias.when), std::string(option.bias.effect)});
    all.push_back({"no_scattering", "`whitted`, `random-decision`, `ao`, in scenes with media that scatter",
                   "media only absorb: what they would scatter goes straight on"});
    all.push_back({"clamp", "`legacy` and a classic integrator", "samples count at most 1 in each channel"});
    all.push_back({"stopped_by_time, stopped_by_error", "`--time`, `--error`",
                   "the render ended by its clock or by its estimated error, which look at the samples that count"});
    all.push_back({"dropped=N", "samples that were not finite numbers",
                   "such a sample does not count; counted, and the first is named"});
    all.push_back({"denoised", "`--denoise`, `lancer denoise`",
                   "noise is filtered: details that it hides are smoothed, less with more samples"});
    all.push_back({"shadow_ratio", "`shadow_catcher` with `--background transparent` or `opaque-glass`",
                   "alpha of a shadow is a quotient of two sums over the samples of a pixel, whose mean is off by "
                   "something like one over their number; light that objects send to the surface is missing"});
    return all;
}

}  // namespace lancer
