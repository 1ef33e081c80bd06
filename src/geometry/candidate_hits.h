// What accelerators decide of candidate hits, each in the order of its own traversal: whether the alpha test lets the
// ray pass, and which of two at the same distance counts.
#pragma once

#include <tuple>

#include "geometry/geometry.h"

namespace lancer {

// hit: of a triangle.
inline bool passes_through(const Geometry& g, const Ray& ray, const Hit& hit)
{
    if (!g.alpha_test.passes_through || g.alpha_test.meshes[hit.geometry].empty()) return false;
    return g.alpha_test.meshes[hit.geometry][hit.primitive] &&
           g.alpha_test.passes_through(g.alpha_test.context, ray, refine(g, ray, hit));
}

// Of equal distances the hit that a loop over all primitives would find first wins. best: the nearest hit so far, if
// any.
inline bool is_nearer(const Hit& hit, const Hit& best)
{
    const auto place = [](const Hit& h) { return std::tuple(h.kind, h.instance, h.geometry, h.primitive); };
    return !best || hit.t < best.t || (hit.t == best.t && place(hit) < place(best));
}

}  // namespace lancer
