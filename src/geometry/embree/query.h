// A query of Embree: its rays, flags and the context for callbacks. All differences between Embree 3 and 4 are here and
// in the results of callbacks. Only files of embree/ include it.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "geometry/accel.h"
#include "geometry/ray_lanes.h"

static_assert(RTC_VERSION >= 31300, "Embree 3.13 or newer is required");

namespace lancer::embree {

inline constexpr uint32_t packet = 8;  // rays per call; 16 would be native only with AVX-512

#if RTC_VERSION_MAJOR >= 4
using BaseContext = RTCRayQueryContext;
#else
using BaseContext = RTCIntersectContext;
#endif

// Embree passes the base class to every callback. Inside an instance Embree's rays are in the mesh's space; here are
// the original rays, and the nearest hit of each so far, both indexed by RTCRay::id.
struct Context : BaseContext {
    const Ray* rays = nullptr;
    std::array<Hit, packet> nearest;  // of closest(): t of a triangle is Embree's, or exact after a comparison
    std::array<float, packet> slack;  // see beyond()
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

    // Up to `packet` rays of any kind for one of the two functions below.
    // extent: the largest coordinate of a mesh.
    void load(std::span<const Ray> rays, float extent, RTCRayHit8& r)
    {
        load(rays, r.ray);
        static_assert(RTC_INVALID_GEOMETRY_ID == UINT32_MAX);
        std::memset(r.hit.geomID, 0xff, sizeof r.hit.geomID);
        std::memset(r.hit.instID[0], 0xff, sizeof r.hit.instID[0]);
        context_.nearest.fill({});
        const auto largest = [](float x, float y, float z) {
            return std::max(std::max(std::abs(x), std::abs(y)), std::abs(z));
        };
        for (size_t k = 0; k < packet; ++k) {
            const float org = largest(r.ray.org_x[k], r.ray.org_y[k], r.ray.org_z[k]);
            const float dir = largest(r.ray.dir_x[k], r.ray.dir_y[k], r.ray.dir_z[k]);
            context_.slack[k] = 0x1p-22f * (std::max(extent, org) / dir);
        }
    }
    // The nearest hit of ray k, not refined; callbacks and who tests other shapes before the query set it.
    Hit& nearest(size_t k) { return context_.nearest[k]; }
    float slack(size_t k) const { return context_.slack[k]; }
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
    // Bit i of the result: lane i is occluded. known: lanes for which this is known before.
    uint32_t any(RTCScene scene, RTCRay8& r, uint32_t known)
    {
        const Mask8 bit{1, 2, 4, 8, 16, 32, 64, 128};
        Mask8 valid;
        std::memcpy(&valid, valid_.data(), sizeof valid);
        valid &= (bit & static_cast<int>(known)) == 0;
        const uint32_t wanted = movemask(valid);
        if (wanted == 0) return known;
        std::memcpy(valid_.data(), &valid, sizeof valid);
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded8(valid_.data(), scene, &r, &occluded_);
#else
        rtcOccluded8(valid_.data(), scene, &context_, &r);
#endif
        return known | (wanted & movemask(load8(r.tfar) < Float8{}));
    }

private:
    // Debian's Embree has assertions enabled: a NaN lane would end the process, so such lanes are masked. Written in
    // whole registers, as Embree reads them.
    void fill(RTCRay8& r, std::span<const Ray> rays)
    {
        const RayPacket l(rays);
        const Mask8 lanes = Mask8{0, 1, 2, 3, 4, 5, 6, 7};
        const Mask8 ok = is_traceable(l) & first_lanes(rays.size());
        const Float8 zero{}, one = broadcast(1.0f);
        const auto put = [&](float* to, Float8 x, Float8 idle) { store8(to, select(ok, x, idle)); };
        // Inactive lanes hit nothing.
        put(r.org_x, l.org.x, zero), put(r.org_y, l.org.y, zero), put(r.org_z, l.org.z, zero);
        put(r.dir_x, l.dir.x, zero), put(r.dir_y, l.dir.y, zero), put(r.dir_z, l.dir.z, one);
        put(r.tnear, l.t_min, one), put(r.tfar, l.t_max, zero);
        const auto put_all = [](auto* to, Mask8 x) { std::memcpy(to, &x, sizeof x); };
        put_all(valid_.data(), ok);
        put_all(r.time, Mask8{}), put_all(r.mask, ~Mask8{}), put_all(r.id, lanes), put_all(r.flags, Mask8{});
    }

    Context context_;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments intersect_;
    RTCOccludedArguments occluded_;
#endif
    alignas(32) std::array<int, packet> valid_;
};

}  // namespace lancer::embree
