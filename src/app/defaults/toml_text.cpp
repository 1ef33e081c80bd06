#include "app/defaults/toml_text.h"

#include "app/console.h"

namespace lancer {
namespace {

template <class Number>
std::string vector_text(Number x, Number y, Number z)
{
    return "[" + shortest(x) + ", " + shortest(y) + ", " + shortest(z) + "]";
}

}  // namespace

std::string to_toml(Vec3d v) { return vector_text(v.x, v.y, v.z); }
std::string to_toml(Color c) { return vector_text(c.r, c.g, c.b); }

}  // namespace lancer
