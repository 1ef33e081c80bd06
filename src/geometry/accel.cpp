#include "geometry/accel.h"

#include "geometry/box.h"
#include "geometry/bvh2.h"
#include "geometry/bvh8.h"
#include "geometry/embree.h"
#include "geometry/list.h"
#include "geometry/median.h"
#include "geometry/tree_accelerator.h"

namespace lancer {

std::unique_ptr<Accelerator> make_accelerator(AccelKind kind, const Geometry& geometry, const std::string& isa)
{
    switch (kind) {
        case AccelKind::list:
            return std::make_unique<List>(geometry);
        case AccelKind::box:
            return std::make_unique<TreeAccelerator<Box>>(geometry);
        case AccelKind::median:
            return std::make_unique<TreeAccelerator<Median>>(geometry);
        case AccelKind::bvh2:
            return std::make_unique<TreeAccelerator<Bvh2>>(geometry);
        case AccelKind::bvh8:
            return std::make_unique<TreeAccelerator<Bvh8>>(geometry);
        case AccelKind::embree:
            break;
    }
    return make_embree(geometry, isa);
}

}  // namespace lancer
