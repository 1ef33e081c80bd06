// Embree without anything of ours around it, in the modes that renders do not use as well: what benchmarks measure
// every other speed against. bench/ and `lancer bench` call it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "geometry/accel.h"

namespace lancer {

struct BareMode {
    bool robust = true;  // as renders; else the fast mode, which loses rays
    bool high = true;    // build quality; else medium
    std::string isa = "avx2";
};
// "embree-robust-high-avx2"
std::string name_of(const BareMode& mode);

// How many rays one call is given.
enum class Way { single, packet8, packet16 };
const char* name_of(Way way);

// The widest instruction set that this CPU has for Embree: avx512, avx2, avx or sse4.2.
std::string widest_isa();
// Whether packets of 16 are traced as such, and not as two of 8.
bool has_native_16(const std::string& isa);
// Whether the library that is loaded was compiled with its assertions.
bool embree_has_asserts();

// Meshes and instances as renders build them; spheres, planes and holes are left out.
class BareEmbree {
public:
    // The geometry must outlive this. Throws Error (failed).
    BareEmbree(const Geometry& geometry, const BareMode& mode);
    ~BareEmbree();
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    double build_seconds() const;
    uint64_t bytes() const;

    // Each ray is laid out for Embree, traced, and read back: t, primitive and uv as Embree says, not refined.
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Way way, Coherence coherence) const;
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded, Way way, Coherence coherence) const;

    // One ray at a time.
    Hit closest(const Ray& ray) const;
    bool any(const Ray& ray) const;

    // Nanoseconds of this thread's CPU within Embree alone, for rays that were laid out before, in chunks that stay in
    // the cache.
    double replay_closest_ns(std::span<const Ray> rays, Coherence coherence) const;
    double replay_any_ns(std::span<const Ray> rays) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lancer
