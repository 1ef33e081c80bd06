// The list of materials, of which only names are known here: what holds materials and does not look at them needs not
// be compiled anew when one of them changes. Who looks at one includes materials/material.h.
#pragma once

#include <variant>

namespace lancer {

struct Lambert;
struct Translucent;
struct Mirror;
struct Metal;
struct Glass;
struct Plastic;
struct Interface;
struct Principled;

using Material = std::variant<Lambert, Translucent, Mirror, Metal, Glass, Plastic, Interface, Principled>;

}  // namespace lancer
