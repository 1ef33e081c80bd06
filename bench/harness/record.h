// The rays of a real render: the product's kernel traces through an accelerator that writes down what it is asked. In
// the order of the render, with its batches.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "harness/stage.h"

namespace lancer::bench {

struct Recording {
    struct Batch {
        bool occlusion;  // else the nearest hit was asked for
        Coherence coherence;
        uint32_t depth;       // 0: camera rays, and the shadow rays of what they met
        size_t first, count;  // in rays
    };
    std::vector<Ray> rays;
    std::vector<Batch> batches;
};

// Renders the tiles, one after another, with samples [0, spp) and this integrator; ends after the tile with which
// `enough` says yes. Spoilt rays, which nobody traces, are left out.
Recording record(const Stage& stage, const AnyIntegrator& integrator, std::span<const Tile> tiles, uint32_t spp,
                 const std::function<bool(const Recording&)>& enough = {});

// Rays of one kind, as many as were wanted or as the picture had.
struct RaySet {
    std::string_view kind;
    bool occlusion;
    Coherence coherence;
    std::vector<Ray> rays;
};
inline constexpr std::array<std::string_view, 5> ray_kinds{"primary", "shadow", "ao", "bounce1", "bounce2"};

// Up to `count` rays of each kind in the order of ray_kinds, from tiles all over the picture. shadow: of the first
// surfaces. ao: of the integrator `ao`. A kind of which there are none is left out.
std::vector<RaySet> record_kinds(const Stage& stage, size_t count);

}  // namespace lancer::bench
