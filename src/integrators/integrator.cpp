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

// Whether each name that a user may choose has an integrator.
template <size_t... i>
constexpr bool has_all_kinds(std::index_sequence<i...>)
{
    for (size_t kind = 0; kind < enum_names<IntegratorKind>.size(); ++kind)
        if (!((std::variant_alternative_t<i, AnyIntegrator>::kind == static_cast<IntegratorKind>(kind)) || ...))
            return false;
    return true;
}
static_assert(has_all_kinds(std::make_index_sequence<std::variant_size_v<AnyIntegrator>>{}));

}  // namespace

bool knows_legacy()
{
    bool found = false;
    for_each_integrator([&]<class Integrator>(const Integrator&) { found = found || is_legacy<Integrator>(); });
    return found;
}

AnyIntegrator make_integrator(const RenderSettings& settings)
{
    AnyIntegrator found;
    for_each_integrator([&]<class Integrator>(Integrator integrator) {
        static_assert(is_classic(Integrator::kind) == std::is_base_of_v<Classic, Integrator>);
        if (settings.integrator != Integrator::kind || (is_legacy<Integrator>() && !settings.legacy)) return;
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

std::span<const IntegratorBias> biases_of(IntegratorKind kind)
{
    std::span<const IntegratorBias> found;
    for_each_integrator([&]<class Integrator>(const Integrator&) {
        if constexpr (requires { Integrator::biases; })
            if (kind == Integrator::kind) found = Integrator::biases;
    });
    return found;
}

}  // namespace lancer
