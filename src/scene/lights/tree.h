// A tree over many lights that chooses one by what it may send to a place: by power, distance and both cosines, as far
// as the bounds of groups tell them. Nodes have up to eight children, which are weighed at once.
// Conty Estevez and Kulla 2018; Physically Based Rendering, 4th ed., section 12.6.3.
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
    // Lights are known by their index; at least one. Those without power are never chosen.
    explicit LightTree(std::span<const LightBounds> lights);

    struct Choice {
        uint32_t light = 0;
        float probability = 0;  // 0: nothing reaches the place
    };
    // For a place and its normal, of which the sign does not matter. u in [0, 1).
    Choice choose(Vec3 point, Vec3 normal, double u) const;
    // The same for those of eight places whose bits are set in `lanes`; the others' choices stay as they are. One place
    // need not wait for what another one waits for.
    void choose(const Vec3x8& points, const Vec3x8& normals, const std::array<double, float_lanes>& u, uint32_t lanes,
                std::array<Choice, float_lanes>& choices) const;
    // With which choose() finds a light.
    float probability(uint32_t light, Vec3 point, Vec3 normal) const;

    size_t node_count() const { return nodes_.size(); }

private:
    static constexpr uint32_t none = UINT32_MAX;

    struct alignas(64) Node {
        Vec3x8 center{}, axis{};
        Float8 radius{};                  // of a ball around the box
        Float8 cos_angle{}, sin_angle{};  // of the cone of normals
        Float8 power{};                   // 0 where there is no child
        Mask8 both_sides{};
        std::array<uint32_t, float_lanes> child{};  // a node, or is_leaf | a light
    };
    static constexpr uint32_t is_leaf = 1u << 31;

    uint32_t build(std::span<uint32_t> ids, std::span<const LightBounds> lights, uint32_t parent);
    void set(size_t node, size_t lane, const LightBounds& b);
    Float8 importances(size_t node, Vec3 point, Vec3 normal) const;

    // On the way down: a place, with what is left of its number.
    struct Descent {
        Vec3 point, normal;
        double u = 0, probability = 1;
        uint32_t at = 0;  // a node, or is_leaf | a light
    };
    // One step from a node. False if nothing below it reaches the place.
    bool descend(Descent& d) const;
    static void fetch(const Node& node);

    std::vector<Node> nodes_;
    // Of each node beside it, as these are not needed on every way:
    std::vector<uint32_t> parent_;    // its place there: node * 8 + lane
    std::vector<uint8_t> has_cones_;  // not just single normals
    std::vector<uint32_t> place_of_;  // of each light: node * 8 + lane
    double scale_ = 1;                // of powers
};

}  // namespace lancer
