// The accelerator interface. An accelerator only decides which primitive is nearest; t and uv are computed by refine(),
// so that every accelerator gives the same picture. Ties go to the lowest (instance, geometry, primitive).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "geometry/accel_kind.h"
#include "geometry/geometry.h"

namespace lancer {

struct AccelStats {
    double build_seconds = 0;
    uint64_t bytes = 0;  // memory of the structure, without the Geometry
    // SAH cost of the tree of the non-instanced meshes, with cost 1 for a node and for a triangle; 0 if unknown.
    double sah_cost = 0;
};

// Whether the rays of a batch have similar origins and directions.
enum class Coherence { coherent, incoherent };

// Rays that are not traceable (is_traceable) hit nothing. Thread-safe after construction. The Geometry must outlive the
// accelerator.
class Accelerator {
public:
    virtual ~Accelerator() = default;

    // The nearest hit with t in [t_min, t_max], within the accelerator's rounding error, refined. kind is none on a
    // miss.
    virtual Hit closest(const Ray& ray) const = 0;
    // Whether anything is hit with t in [t_min, t_max].
    virtual bool any(const Ray& ray) const = 0;

    // The same for many rays; hits[i] and occluded[i] belong to rays[i]. A result never depends on the other rays.
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

// Rays that a renderer traces besides camera rays.
enum class RayUse { all, bounces };  // bounces: no shadow rays

// The accelerator that was fastest in benchmarks (docs/benchmarks.md): list8 for at most 64 triangles and nothing else;
// bvh8, which splits triangles, if false_positive_box_hits() is high, there are at most 500,000 triangles and no
// instances; bvh8 also for bounce rays in one to four million small triangles, where it hides memory latency, and
// for a million instances, of which Embree keeps an object each; else Embree. Must not be called inside a parallel
// loop.
AccelKind fastest_accelerator(const Geometry& geometry, RayUse use = RayUse::all);

// Builds an accelerator. isa: instruction set of Embree, one of sse2, sse4.2, avx, avx2, avx512; it is fixed because
// others round differently. Throws Error (failed) if the structure cannot be built. Must not be called inside a
// parallel loop.
std::unique_ptr<Accelerator> make_accelerator(AccelKind kind, const Geometry& geometry, const std::string& isa);

}  // namespace lancer
