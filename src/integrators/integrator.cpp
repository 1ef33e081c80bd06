#include "integrators/integrator.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace lancer {
namespace {

// Some names stand for two integrators: the second one does what the first does in the ways of the past.
template <class Integrator>
constexpr bool is_legacy()
{
    if constexpr (requires { Integrator::is_legacy; })
        return Integrator::is_legacy;
    else
        return false;
}

// f(i) for each alternative of the list, default constructed, in order.
template <class F, size_t... i>
void for_each_integrator(const F& f, std::index_sequence<i...>)
{
    (f(std::variant_alternative_t<i, AnyIntegrator>{}), ...);
}
template <class F>
void for_each_integrator(const F& f)
{
    for_each_integrator(f, std::make_index_sequence<std::variant_size_v<AnyIntegrator>>{});
}

}  // namespace

std::vector<std::string_view> names_of_integrators()
{
    std::vector<std::string_view> names;
    for_each_integrator([&]<class Integrator>(const Integrator&) {
        if (!is_legacy<Integrator>()) names.push_back(Integrator::name);
    });
    return names;
}

bool knows_legacy()
{
    bool found = false;
    for_each_integrator([&]<class Integrator>(const Integrator&) { found = found || is_legacy<Integrator>(); });
    return found;
}

bool is_classic(std::string_view name)
{
    bool found = false;
    for_each_integrator([&]<class Integrator>(const Integrator&) {
        found = found || (name == Integrator::name && std::is_base_of_v<Classic, Integrator>);
    });
    return found;
}

AnyIntegrator make_integrator(std::string_view name, const IntegratorSettings& settings)
{
    AnyIntegrator found;
    for_each_integrator([&]<class Integrator>(Integrator integrator) {
        if (name != Integrator::name || (is_legacy<Integrator>() && !settings.switches[Switch::legacy])) return;
        if constexpr (requires { integrator.take(settings); }) integrator.take(settings);
        found = integrator;
    });
    return found;
}

uint32_t max_depth_of(const AnyIntegrator& integrator)
{
    return std::visit(
        []<class Integrator>(const Integrator& concrete) -> uint32_t {
            if constexpr (requires { concrete.max_depth; })
                return concrete.max_depth;
            else
                return 0;
        },
        integrator);
}

std::vector<std::string> biases_of(const AnyIntegrator& integrator)
{
    return std::visit(
        []<class Integrator>(const Integrator&) -> std::vector<std::string> {
            if constexpr (requires { Integrator::biases; })
                return {Integrator::biases.begin(), Integrator::biases.end()};
            else
                return {};
        },
        integrator);
}

}  // namespace lancer
