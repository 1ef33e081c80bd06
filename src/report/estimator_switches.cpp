#include "report/estimator_switches.h"

namespace lancer {
namespace {

bool RenderSettings::*member_of(Estimator estimator) { return std::get<SwitchField>(estimator->field).member; }

}  // namespace

std::vector<Estimator> estimators()
{
    std::vector<Estimator> all;
    for (const RenderOption& option : render_options())
        if (option.is_switch() && option.bias.effect.empty()) all.push_back(&option);
    return all;
}

bool is_on(const RenderSettings& settings, Estimator estimator) { return settings.*member_of(estimator); }

RenderSettings switched_over(RenderSettings settings, Estimator estimator)
{
    settings.give(member_of(estimator), !is_on(settings, estimator));
    return settings;
}

}  // namespace lancer
