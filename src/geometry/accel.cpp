#include "geometry/accel.h"

#include "core/error.h"
#include "geometry/box_overlap.h"
#include "geometry/bvh2/bvh2.h"
#include "geometry/bvh2/median.h"
#include "geometry/bvh8/bvh8.h"
#include "geometry/embree/embree.h"
#include "geometry/list/box.h"
#include "geometry/list/list.h"
#include "geometry/list/list8.h"
#include "geometry/tree_accelerator.h"

namespace lancer {

std::unique_ptr<Accelerator> make_accelerator(AccelKind kind, const Geometry& geometry, const std::string& isa)
{
    switch (kind) {
        case AccelKind::automatic:
            return make_accelerator(fastest_accelerator(geometry), geometry, isa);
        case AccelKind::list:
            return std::make_unique<List>(geometry);
        case AccelKind::list8:
            return std::make_unique<TreeAccelerator<List8>>(geometry);
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
    if (geometry.motion.moves())
        throw Error(ErrorKind::usage, {},
                    "--accel embree: what moves while the shutter is open is for the other accelerators alone: leave "
                    "the choice to lancer, or take bvh8");
    return make_embree(geometry, isa);
}

AccelKind fastest_accelerator(const Geometry& g, RayUse use)
{
    size_t triangles = 0;
    for (const Mesh& mesh : g.meshes) triangles += mesh.triangles.size();
    if (g.motion.moves()) return AccelKind::bvh8;  // Embree knows none
    const bool is_plain = g.instances.empty() && g.spheres.empty() && g.planes.empty();
    if (is_plain && triangles <= List8::part_size) return AccelKind::list8;
    // For more triangles spatial splits take seconds.
    constexpr size_t most_cut = 500'000;
    constexpr double too_many_boxes = 4;
    // Fewer triangles fit into the caches; with more overlap than in a scan Embree's packets lose less.
    constexpr size_t least_far = 1'000'000, most_far = 4'000'000;
    constexpr double hardly_any_boxes = 0.25;
    const bool may_cut = triangles <= most_cut;
    const bool is_far = triangles >= least_far && triangles <= most_far && use == RayUse::bounces;
    // Embree keeps an object of 300 bytes for each instance and makes them one after the other.
    constexpr size_t many_instances = 1'000'000;
    if (g.instances.size() >= many_instances && triangles <= most_far) return AccelKind::bvh8;
    if (!g.instances.empty() || !(may_cut || is_far)) return AccelKind::embree;
    const double boxes = false_positive_box_hits(g);
    return (may_cut && boxes > too_many_boxes) || (is_far && boxes < hardly_any_boxes) ? AccelKind::bvh8
                                                                                       : AccelKind::embree;
}

}  // namespace lancer
