// The seam between what is hit and everything else. An accelerator only decides *which* primitive is nearest; t and uv
// come from refine(), so that every accelerator draws the same picture. Ties go to the lowest (instance, geometry,
// primitive) where the accelerator sees them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "geometry/geometry.h"

namespace lancer {

struct AccelStats {
    double build_seconds = 0;
    uint64_t bytes = 0;   // of the structure, without the Geometry
    double sah_cost = 0;  // expected cost of a random line that meets the box of what is drawn as it is, where the
                          // structure tells: a node 1, a triangle 1
};

// Whether the rays of a batch start close together and go much the same way.
enum class Coherence { coherent, incoherent };

// Rays that are not traceable (is_traceable) hit nothing. Thread-safe after construction. The Geometry must outlive
// the accelerator.
class Accelerator {
public:
    virtual ~Accelerator() = default;

    // Nearest hit with t in [t_min, t_max], to within the accelerator's own rounding, refined; kind none on a miss.
    virtual Hit closest(const Ray& ray) const = 0;
    // Is anything in [t_min, t_max]?
    virtual bool any(const Ray& ray) const = 0;

    // The same for many rays; hits[i], occluded[i] answer rays[i]. An answer never depends on the other rays.
    virtual void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence) const
    {
        for (size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
    }
    virtual void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const
    {
        for (size_t i = 0; i < rays.size(); ++i) occluded[i] = any(rays[i]);
    }

    virtual AccelStats stats() const = 0;
};

// automatic: the one that fastest_accelerator() says.
enum class AccelKind { automatic, embree, list, list8, box, median, bvh2, bvh8 };

// All that there are.
struct AccelName {
    std::string_view name;
    AccelKind kind;
    bool tries_all = false;  // of the triangles, for each ray
};
inline constexpr std::array accelerators{
    AccelName{"embree", AccelKind::embree},     AccelName{"list", AccelKind::list, true},
    AccelName{"list8", AccelKind::list8, true}, AccelName{"box", AccelKind::box, true},
    AccelName{"median", AccelKind::median},     AccelName{"bvh2", AccelKind::bvh2},
    AccelName{"bvh8", AccelKind::bvh8},
};

// Which rays a renderer will send besides those from the camera.
enum class RayUse { all, bounces };  // bounces: none that ask whether a light is seen

// By what was measured (docs/benchmarks.md): list8 for at most 64 triangles and nothing else; bvh8, which cuts
// triangles into parts, where false_positive_box_hits() says that their boxes are in each other's way, there are at
// most 500,000 and no instances; bvh8, too, for the bounces of one to four million fine triangles, which it does not
// wait for; else Embree. Not from inside a parallel loop.
AccelKind fastest_accelerator(const Geometry& geometry, RayUse use = RayUse::all);
// "auto" of automatic; and back, automatic of what is no other's name.
std::string_view name_of(AccelKind kind);
AccelKind accelerator_of(std::string_view name);

// isa: for Embree, one of sse2, sse4.2, avx, avx2, avx512; pinned, as other instruction sets round other bits.
// Throws Error (failed) if the structure cannot be built. Not from inside a parallel loop.
std::unique_ptr<Accelerator> make_accelerator(AccelKind kind, const Geometry& geometry, const std::string& isa);

}  // namespace lancer
