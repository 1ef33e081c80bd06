// The concept of a triangle tree that is traversed by packets of eight rays.
#pragma once

#include "geometry/ray_packets.h"
#include "geometry/triangle_set.h"

namespace lancer {

// The nearest triangles of eight rays.
struct PacketHits {
    static constexpr uint32_t none = UINT32_MAX;
    Float8 low, high;  // bounds of the distances, equal where they are exact
    UInt8 number = UInt8{} + none;

    explicit PacketHits(Float8 t_max) : low(t_max), high(t_max) {}
    float t(size_t ray) const { return 0.5f * low[ray] + 0.5f * high[ray]; }
};

// A TriangleTree with these additional functions:
//   void closest(const ShearedPacket&, PacketHits& best, const Counts& counts) const;
//       finds hits nearer than `best`. counts(met, number, t): the lanes of `met` for which the triangle at t counts.
//   uint32_t any(const ShearedPacket&, const Counts& counts) const;
//       bit i: ray i hits a triangle that counts
// The result of a ray does not depend on the others.
template <class T>
concept PacketTree = TriangleTree<T> &&
    requires(const T t, const ShearedPacket& rays, PacketHits& best, Mask8 (*counts)(Mask8, uint32_t, Float8))
{
    t.closest(rays, best, counts);
    {
        t.any(rays, counts)
        } -> std::same_as<uint32_t>;
};

}  // namespace lancer
