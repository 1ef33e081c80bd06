// What the tests of accelerators share: the list of them, and geometry to trace.
#pragma once

#include <gtest/gtest.h>

#include <ostream>

#include "geometry/accel.h"
#include "support/hits.h"
#include "support/meshes.h"
#include "support/random.h"

namespace lancer {

struct AccelMaker {
    std::string_view name;
    AccelKind kind;

    std::unique_ptr<Accelerator> operator()(const Geometry& g) const { return make_accelerator(kind, g, "avx2"); }
    friend void PrintTo(const AccelMaker& m, std::ostream* out) { *out << m.name; }
};
// Every law holds for every accelerator there is.
inline const std::vector<AccelMaker> accel_makers = [] {
    std::vector<AccelMaker> makers;
    for (const AccelName& a : accelerators) makers.push_back({a.name, a.kind});
    return makers;
}();

inline std::string accel_name(const testing::TestParamInfo<AccelMaker>& info) { return std::string(info.param.name); }

// Meshes, a soup of triangles, instances turned, stretched and mirrored, spheres in and out of each other, planes.
Geometry random_geometry(uint64_t seed);

// A ray of the kind that path tracing makes, or one aimed at a vertex, an axis-parallel one, one from far away.
Ray random_ray(Random& random, const Geometry& g);

}  // namespace lancer
