// What integrators may compute of several vertices at once, before it is known what happens there. An integrator that
// does has
//   struct Ahead;                                             what it then knows of eight vertices
//   void ahead(const View&, const Vertices&, Ahead&) const;
//   void hit(View, State, Surface, Sampler, const Ahead&, uint32_t lane, Steps&) const;   in place of hit() without
// Only the numbers of a vertex itself may go into its lane.
#pragma once

#include <array>

#include "core/lanes/lanes.h"
#include "core/sampler.h"
#include "integrators/steps.h"

namespace lancer {

struct VertexAhead {
    const State* state = nullptr;  // null: there is none in this lane
    const Surface* surface = nullptr;
    const Sampler* sampler = nullptr;
};
using Vertices = std::array<VertexAhead, float_lanes>;

template <class Integrator>
concept LooksAhead = requires
{
    typename Integrator::Ahead;
};

// f(vertex) of each lane that has one, else 0.
template <class F>
inline Vec3T<Float8> gather(const Vertices& vertices, F&& f)
{
    alignas(32) std::array<std::array<float, float_lanes>, 3> of;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        const Vec3 v = vertices[i].state ? f(vertices[i]) : Vec3{};
        of[0][i] = v.x, of[1][i] = v.y, of[2][i] = v.z;
    }
    return {_mm256_load_ps(of[0].data()), _mm256_load_ps(of[1].data()), _mm256_load_ps(of[2].data())};
}
// Two numbers of the sampler at each vertex, as x and y.
inline Vec3T<Float8> gather(const Vertices& vertices, Dim dim)
{
    return gather(vertices, [dim](const VertexAhead& v) {
        const Vec2 u = v.sampler->get2(v.state->depth, dim);
        return Vec3{u.x, u.y, 0};
    });
}
inline Vec3 lane(const Vec3T<Float8>& v, uint32_t i) { return {v.x[i], v.y[i], v.z[i]}; }

}  // namespace lancer
