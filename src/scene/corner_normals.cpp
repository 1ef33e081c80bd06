#include "scene/corner_normals.h"

#include "core/octahedral.h"

namespace lancer {

Vec3 CornerNormals::decoded(uint32_t named) const
{
    const uint32_t code = codes[named];
    return code == no_octahedral ? of_flat() : from_octahedral(code);
}

}  // namespace lancer
