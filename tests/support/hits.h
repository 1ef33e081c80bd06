// When two answers to one ray mean the same, and when a difference is no more than float's rounding.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/geometry.h"

namespace lancer {

inline bool same_primitive(const Hit& a, const Hit& b)
{
    if (!a || !b) return !a && !b;
    return a.kind == b.kind && a.instance == b.instance && a.geometry == b.geometry && a.primitive == b.primitive;
}
bool same_bits(const Hit& a, const Hit& b);

// Distance of a ray's line to the nearest edge of a triangle, over the size of the coordinates involved, in ulps of
// float: an accelerator that computes in float may decide either way within a few.
double ulps_from_edge(const Geometry& g, const Ray& ray, const Hit& hit);

// How far along the ray float can tell where the hit is: 16 ulps of the coordinates, across the surface. A ray that
// only grazes a triangle goes further within them.
double doubt(const Geometry& g, const Ray& ray, const Hit& hit);

// Two answers to one ray that name different primitives are both right where float cannot tell which is nearer, or
// whether the ray passes the nearer one's edge.
bool explainable(const Geometry& g, const Ray& ray, const Hit& a, const Hit& b);

}  // namespace lancer
