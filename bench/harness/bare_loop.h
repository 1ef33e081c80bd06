// The least that a path tracer can be: matt surfaces, triangles of light or a constant sky, next-event estimation with
// multiple importance sampling, one path at a time on bare Embree, with the product's sampler, camera and filter. What
// a render should come close to in spite of all that it can do besides.
#pragma once

#include <optional>
#include <vector>

#include "core/distribution.h"
#include "core/film.h"
#include "geometry/embree/bare_embree.h"
#include "harness/stage.h"

namespace lancer::bench {

class BareLoop {
public:
    // Nothing where the scene has what this cannot draw: anything but flat meshes as they are, plain diffuse materials,
    // emission and a constant sky. All must outlive the loop.
    static std::optional<BareLoop> make(const SceneDescription& description, const Stage& stage,
                                        const BareEmbree& embree);

    // Radiance of one sample: the same light as the product's, by other random numbers.
    Color sample(uint32_t x, uint32_t y, uint32_t index, uint64_t seed) const;
    // Samples [0, spp) of all pixels. In parallel.
    Film render(uint32_t spp, uint64_t seed) const;

private:
    struct Face {
        Color albedo, emission;
        uint32_t light = none;
    };
    struct Corners {
        Vec3 a, b, c;
        Vec3 normal() const { return cross(b - a, c - a); }  // twice the area long
    };
    static constexpr uint32_t none = UINT32_MAX;

    BareLoop(const Stage& stage, const BareEmbree& embree);
    bool take_meshes(const SceneDescription& description);
    bool take_light(const SceneDescription& description);
    Corners corners(uint32_t mesh, uint32_t triangle) const;
    // Light at a place with a unit normal that one shadow ray finds, times pi over the albedo.
    Color direct(Vec3 p, Vec3 error, Vec3 n, const Sampler& sampler, uint32_t depth) const;

    const Stage* stage_;
    const BareEmbree* embree_;
    uint32_t max_depth_, roulette_depth_;
    Color sky_{};
    std::vector<std::vector<Face>> faces_;         // of each mesh, of each triangle
    std::vector<std::array<uint32_t, 2>> lights_;  // mesh and triangle
    Discrete chosen_;                              // by what they send out
};

}  // namespace lancer::bench
