// All materials. A new material is a header here, a name in materials/material_type.h and an alternative of the variant
// in materials/material_variant.h; the tests in tests/materials then cover it. A material is a set of parameters; at a
// hit it becomes a BSDF, a small value with all textures evaluated, which may refer to the material.
#pragma once

#include <type_traits>
#include <utility>

#include "materials/glass.h"
#include "materials/interface.h"
#include "materials/lambert.h"
#include "materials/material_variant.h"
#include "materials/metal.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/principled.h"
#include "materials/traits.h"
#include "materials/translucent.h"

namespace lancer {

// Any BSDF.
template <class... M>
std::variant<decltype(std::declval<const M&>().at(std::declval<const ShadingPoint&>()))...> bsdf_of(
    const std::variant<M...>&);
using AnyBsdf = decltype(bsdf_of(std::declval<const Material&>()));

// f.operator()<M>() for the struct of each type of material, that of the mix included.
template <class F>
constexpr void for_each_material_type(const F& f)
{
    [&]<class... M>(std::type_identity<std::variant<M...>>) {
        (f.template operator()<M>(), ...);
    }(std::type_identity<Material>{});
    f.template operator()<Mix>();
}
// Every word of MaterialType is the type of one of them.
static_assert([] {
    size_t found = 0;
    for_each_material_type([&]<class M> { found += size_t{1} << static_cast<size_t>(M::type); });
    return found == (size_t{1} << enum_names<MaterialType>.size()) - 1;
}());

}  // namespace lancer
