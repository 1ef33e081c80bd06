// The rays of a real render: the kernel traces through an accelerator that writes down what it is asked. In the order
// of the render, with its batches. `lancer bench` and the programs of bench/ measure with them.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "render/renderer.h"
#include "scene/camera.h"

namespace lancer {

// What is rendered to find rays. All must outlive their use.
struct RaySource {
    const Renderer& renderer;
    const KernelSettings& kernel;
    const Camera& camera;
    PictureSize size;

    Tile whole() const { return {0, 0, size.width, size.height}; }
    // The whole picture, in tiles as `lancer render` makes them.
    std::vector<Tile> tiles() const;
};

struct RayRecording {
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
RayRecording record_rays(const RaySource& source, const AnyIntegrator& integrator, std::span<const Tile> tiles,
                         uint32_t spp, const std::function<bool(const RayRecording&)>& enough = {});

// Rays of one kind, as many as were wanted or as the picture had.
struct RaySet {
    std::string_view kind;
    bool occlusion;
    Coherence coherence;
    std::vector<Ray> rays;
};
inline constexpr auto ray_set_kinds =
    std::to_array<std::string_view>({"primary", "shadow", "ao", "bounce1", "bounce2", "bounce3", "random"});

// Up to `count` rays of each of the kinds, in the order of ray_set_kinds, from tiles all over the picture. shadow: of
// the first surfaces. ao: of the integrator `ao`. random: from anywhere in the box around most triangles, in any
// direction. A kind of which there are none is left out. most: rays that are looked at for those that are rare.
std::vector<RaySet> find_rays(const RaySource& source, size_t count, std::span<const std::string_view> kinds,
                              size_t most = 8'000'000);

// The rays in an order in which any stretch has batches from all over the set: as costly as any other.
void deal(RaySet& set);

// Of all that tells rays apart.
uint64_t hash_of(const RaySet& set);

}  // namespace lancer
