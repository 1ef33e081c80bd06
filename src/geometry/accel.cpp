#include "geometry/accel.h"

#include "geometry/embree.h"
#include "geometry/list.h"

namespace lancer {

std::unique_ptr<Accelerator> make_accelerator(AccelKind kind, const Geometry& geometry, const std::string& isa)
{
    if (kind == AccelKind::list) return std::make_unique<List>(geometry);
    return make_embree(geometry, isa);
}

}  // namespace lancer
