// What a tree over a TriangleSet offers that takes rays by eights.
#pragma once

#include "geometry/ray_packets.h"
#include "geometry/triangle_set.h"

namespace lancer {

// The nearest triangles of eight rays.
struct PacketHits {
    static constexpr uint32_t none = UINT32_MAX;
    Float8 t;  // at first as far as the rays go
    UInt8 number = UInt8{} + none;
};

// A TriangleTree that offers, too:
//   void closest(const ShearedPacket&, PacketHits& best, const Counts& counts) const;
//       nearer ones than `best`. counts(met, number, t): which of the lanes that meet the triangle at t count it.
//   uint32_t any(const ShearedPacket&, const Counts& counts) const;
//       bit i: ray i meets one that counts
// The answer for a ray is that of the single one, whatever the others.
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
