// A light tree: selects one of many lights by its estimated contribution at a point (power, distance and both cosines,
// by the bounds of groups). Nodes have up to eight children, whose importances are computed at once. Conty Estevez and
// Kulla 2018; Physically Based Rendering, 4th ed., section 12.6.3.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lanes/vec.h"
#include "scene/lights/bounds.h"

namespace lancer {

class LightTree {
public:
    // Lights are identified by their index; at least one. Lights without power are never selected.
    explicit LightTree(std::span<const LightBounds> lights);

    struct Choice {
        uint32_t light = 0;
        float probability = 0;  // 0: no light reaches the point
    };
    // Selects a light for a point and its normal, whose sign does not matter, or 0 for a point that all directions
    // light alike; u in [0, 1).
    Choice choose(Vec3 point, Vec3 normal, double u) const;
    // The same for the lanes in `lanes` of eight points; the choices of other lanes stay unchanged. The descents are
    // interleaved so that their cache misses overlap.
    void choose(const Vec3x8& points, const Vec3x8& normals, const std::array<double, float_lanes>& u, uint32_t lanes,
                std::array<Choice, float_lanes>& choices) const;
    // Probability with which choose() selects a light.
    float probability(uint32_t light, Vec3 point, Vec3 normal) const;

    size_t node_count() const { return nodes_.size(); }

private:
    static constexpr uint32_t none = UINT32_MAX;

    struct alignas(64) Node {
        Vec3x8 center{}, axis{};
        Float8 radius{};                  // of a sphere around the box
        Float8 cos_angle{}, sin_angle{};  // of the cone of normals
        Float8 power{};                   // 0 where there is no child
        Mask8 both_sides{};
        std::array<uint32_t, float_lanes> child{};  // a node, or is_leaf | a light
    };
    static constexpr uint32_t is_leaf = 1u << 31;

    uint32_t build(std::span<uint32_t> ids, std::span<const LightBounds> lights, uint32_t parent);
    void set(size_t node, size_t lane, const LightBounds& b);
    Float8 importances(size_t node, Vec3 point, Vec3 normal) const;

    // State of a descent.
    struct Descent {
        Vec3 point, normal;
        double u = 0, probability = 1;
        uint32_t at = 0;  // a node, or is_leaf | a light
    };
    // One step down. Returns false if nothing below the node reaches the point.
    bool descend(Descent& d) const;
    static void fetch(const Node& node);

    std::vector<Node> nodes_;
    // Per node, apart from it because they are needed less often:
    std::vector<uint32_t> parent_;    // position in the parent: node * 8 + lane
    std::vector<uint8_t> has_cones_;  // not only single normals
    std::vector<uint32_t> place_of_;  // position of each light: node * 8 + lane
    double scale_ = 1;                // scale of powers
};

}  // namespace lancer
