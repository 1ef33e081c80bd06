// One query of Embree: its rays, its flags, and what callbacks can see of it. All differences between Embree 3 and 4
// are here and in what callbacks answer. Only embree*.{h,cpp} include this.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>

#include "geometry/accel.h"

static_assert(RTC_VERSION >= 31300, "Embree 3.13 or newer is required");

namespace lancer::embree {

inline constexpr uint32_t packet = 8;  // lanes of one call; 16 are native only with AVX-512

#if RTC_VERSION_MAJOR >= 4
using BaseContext = RTCRayQueryContext;
#else
using BaseContext = RTCIntersectContext;
#endif

// Embree hands the base to every callback. Inside an instance its rays are those of the mesh's space; here are the ones
// that were asked for, at RTCRay::id.
struct Context : BaseContext {
    const Ray* rays = nullptr;
};
inline const Ray& original_ray(const BaseContext* context, uint32_t id)
{
    return static_cast<const Context*>(context)->rays[id];
}

class Query {
public:
    explicit Query(Coherence coherence)
    {
#if RTC_VERSION_MAJOR >= 4
        rtcInitRayQueryContext(&context_);
        const auto flags =
            coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        rtcInitIntersectArguments(&intersect_);
        rtcInitOccludedArguments(&occluded_);
        intersect_.flags = occluded_.flags = flags;
        intersect_.context = occluded_.context = &context_;
#else
        rtcInitIntersectContext(&context_);
        context_.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                          : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
    }
    Query(const Query&) = delete;  // arguments point to the context
    Query& operator=(const Query&) = delete;

    // Up to `packet` rays, of any kind, for one of the two below.
    void load(std::span<const Ray> rays, RTCRayHit8& r)
    {
        load(rays, r.ray);
        for (uint32_t i = 0; i < packet; ++i) r.hit.geomID[i] = r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    void load(std::span<const Ray> rays, RTCRay8& r)
    {
        fill(r, rays);
        context_.rays = rays.data();
    }
    void closest(RTCScene scene, RTCRayHit8& r)
    {
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect8(valid_.data(), scene, &r, &intersect_);
#else
        rtcIntersect8(valid_.data(), scene, &context_, &r);
#endif
    }
    // Bit i of the answer: lane i is occluded. known: of which lanes this is known before.
    uint32_t any(RTCScene scene, RTCRay8& r, uint32_t known)
    {
        uint32_t wanted = 0;
        for (uint32_t i = 0; i < packet; ++i) {
            if (known >> i & 1) valid_[i] = 0;
            wanted |= static_cast<uint32_t>(valid_[i] & 1) << i;
        }
        if (wanted == 0) return known;
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded8(valid_.data(), scene, &r, &occluded_);
#else
        rtcOccluded8(valid_.data(), scene, &context_, &r);
#endif
        for (uint32_t i = 0; i < packet; ++i)
            if (wanted >> i & 1 && r.tfar[i] < 0) known |= 1u << i;
        return known;
    }

private:
    // Debian's Embree has its assertions on: one NaN lane would end the process, so such lanes are masked out.
    void fill(RTCRay8& r, std::span<const Ray> rays)
    {
        constexpr Ray idle{{0, 0, 0}, 1, {0, 0, 1}, 0};  // meets nothing whoever looks
        for (uint32_t i = 0; i < packet; ++i) {
            const bool ok = i < rays.size() && is_traceable(rays[i]);
            const Ray& ray = ok ? rays[i] : idle;
            valid_[i] = ok ? -1 : 0;
            r.org_x[i] = ray.org.x, r.org_y[i] = ray.org.y, r.org_z[i] = ray.org.z, r.tnear[i] = ray.t_min;
            r.dir_x[i] = ray.dir.x, r.dir_y[i] = ray.dir.y, r.dir_z[i] = ray.dir.z, r.tfar[i] = ray.t_max;
            r.time[i] = 0, r.mask[i] = 0xFFFFFFFFu, r.id[i] = i, r.flags[i] = 0;
        }
    }

    Context context_;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments intersect_;
    RTCOccludedArguments occluded_;
#endif
    alignas(32) std::array<int, packet> valid_;
};

}  // namespace lancer::embree
