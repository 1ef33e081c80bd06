#include "scene/lights/tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/lanes/prefetch.h"

namespace lancer {
namespace {

constexpr uint32_t bins = 12;

Vec3d center_of(const LightBounds& b) { return b.box.center(); }

LightBounds bounds_of(std::span<const uint32_t> ids, std::span<const LightBounds> lights)
{
    LightBounds all;
    for (const uint32_t id : ids) all.include(lights[id]);
    return all;
}

// Number of groups of at most `most` lights that hold `count`.
size_t groups_in(size_t lights, size_t most) { return (lights + most - 1) / most; }

// Splits a group of two or more at about the lowest cost of both parts; returns the size of the first part. Each part
// must fit into groups of at most `most`, with `spare` groups more than the whole needs, and fill nodes above the
// lowest level.
size_t cut(std::span<uint32_t> ids, std::span<const LightBounds> lights, size_t most, size_t spare)
{
    const size_t n = ids.size();
    Bounds centers;
    for (const uint32_t id : ids) centers.grow(center_of(lights[id]));
    const Vec3d extent = centers.upper - centers.lower;
    const int axis = largest_axis(extent);
    size_t first = n / 2;
    if (extent[axis] > 0 && n > 4) {
        std::array<LightBounds, bins> in;
        std::array<size_t, bins> count{};
        for (const uint32_t id : ids) {
            const double at = (center_of(lights[id])[axis] - centers.lower[axis]) / extent[axis];
            const uint32_t bin = std::min(bins - 1, static_cast<uint32_t>(at * bins));
            in[bin].include(lights[id]);
            ++count[bin];
        }
        std::array<double, bins> above{};  // cost of the bins from i on
        LightBounds so_far;
        for (uint32_t i = bins - 1; i > 0; --i) {
            so_far.include(in[i]);
            above[i] = so_far.box.empty() ? 0 : so_far.cost(axis);
        }
        so_far = {};
        double least = std::numeric_limits<double>::infinity();
        size_t below = 0;
        for (uint32_t i = 1; i < bins; ++i) {
            so_far.include(in[i - 1]);
            below += count[i - 1];
            if (below == 0 || below == n) continue;
            const double cost = so_far.cost(axis) + above[i];
            if (cost < least) least = cost, first = below;
        }
    }
    const size_t step = n > float_lanes ? float_lanes : 1, wanted = first;
    const auto fits = [&](size_t count) {
        // A light much stronger than the others gets its own group; otherwise the others would hardly be selected.
        const bool fills = count % step == 0 || (count == wanted && (count == 1 || count == n - 1));
        return count > 0 && count < n && fills &&
               groups_in(count, most) + groups_in(n - count, most) <= groups_in(n, most) + spare;
    };
    // The nearest valid split.
    for (size_t off = 0; !fits(first); ++off) first = off % 2 == 0 ? first + off + 1 : first - off - 1;
    const auto end = ids.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(ids.begin(), end, ids.end(), [&](uint32_t a, uint32_t b) {
        const double x = center_of(lights[a])[axis], y = center_of(lights[b])[axis];
        return x != y ? x < y : a < b;
    });
    return first;
}

}  // namespace

LightTree::LightTree(std::span<const LightBounds> lights) : place_of_(lights.size(), none)
{
    std::vector<uint32_t> ids;
    double total = 0;
    for (uint32_t id = 0; id < lights.size(); ++id) {
        if (!(lights[id].power > 0)) continue;
        ids.push_back(id);
        total += lights[id].power;
    }
    if (ids.empty()) return;
    scale_ = 1 / total;
    build(ids, lights, none);
}

uint32_t LightTree::build(std::span<uint32_t> ids, std::span<const LightBounds> lights, uint32_t parent)
{
    const auto number = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    parent_.push_back(parent);
    has_cones_.push_back(0);
    // Limits the lights per child, so that the depth is minimal for any arrangement of lights.
    size_t most = 1;
    while (most * float_lanes < ids.size()) most *= float_lanes;
    // Splits the largest group until there are eight.
    std::array<std::span<uint32_t>, float_lanes> groups;
    groups[0] = ids;
    size_t count = 1, spare = groups.size() - groups_in(ids.size(), most);
    while (count < groups.size()) {
        const auto largest = std::max_element(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(count),
                                              [](const auto& a, const auto& b) { return a.size() < b.size(); });
        // Groups that fit into a node stay whole: a level costs more than one more importance.
        if (largest->size() <= (most > 1 ? float_lanes : 1)) break;
        const std::span<uint32_t> whole = *largest;
        const size_t first = cut(whole, lights, most, spare);
        *largest = whole.first(first);
        groups[count++] = whole.subspan(first);
        spare += groups_in(whole.size(), most);
        spare -= groups_in(first, most) + groups_in(whole.size() - first, most);
    }
    for (size_t i = 0; i < count; ++i) {
        const auto point = static_cast<uint32_t>(number * float_lanes + i);
        set(number, i, bounds_of(groups[i], lights));
        if (groups[i].size() == 1) {
            nodes_[number].child[i] = is_leaf | groups[i][0];
            place_of_[groups[i][0]] = point;
        } else {
            const uint32_t child = build(groups[i], lights, point);
            nodes_[number].child[i] = child;
        }
    }
    return number;
}

void LightTree::set(size_t number, size_t lane, const LightBounds& b)
{
    Node& node = nodes_[number];
    const Vec3d c = b.box.center(), half = (b.box.upper - b.box.lower) / 2.0;
    const auto to = [lane](Float8& of, double x) { of[lane] = static_cast<float>(x); };
    to(node.center.x, c.x), to(node.center.y, c.y), to(node.center.z, c.z);
    to(node.axis.x, b.normals.axis.x), to(node.axis.y, b.normals.axis.y), to(node.axis.z, b.normals.axis.z);
    to(node.radius, length(half));
    to(node.cos_angle, std::cos(b.normals.angle)), to(node.sin_angle, std::sin(b.normals.angle));
    // Even the weakest light keeps a probability above 0.
    to(node.power, std::max(b.power * scale_, 1e-30));
    node.both_sides[lane] = b.both_sides ? -1 : 0;
    if (b.normals.angle > 0) has_cones_[number] = 1;
}

// Importance of each child: power over squared distance, times the cosines at both ends, computed as distances along
// the normals. For every point in the sphere the distance is at most larger by the radius, so that the importance of a
// visible light is never 0. The mean squared distance of the sphere's points is about that of the centre plus that of
// the points from the centre.
inline Float8 LightTree::importances(size_t number, Vec3 point, Vec3 normal) const
{
    const Node& node = nodes_[number];
    const Float8 zero{};
    const Vec3x8 to = node.center - broadcast(point);
    const Float8 distance2 = dot(to, to), along = -dot(to, node.axis);
    Float8 at_light = select(node.both_sides, abs(along), along);
    if (has_cones_[number]) {
        // For the normal of the cone that faces the point most.
        const Float8 distance = sqrt(distance2), across = sqrt(max(zero, distance2 - at_light * at_light));
        at_light =
            select(at_light > distance * node.cos_angle, distance, at_light * node.cos_angle + across * node.sin_angle);
    }
    at_light = max(zero, at_light + node.radius);
    const Float8 cos_at_place = normal == Vec3{} ? sqrt(distance2) : abs(dot(to, broadcast(normal)));
    const Float8 at_place = cos_at_place + node.radius;
    const Float8 inverse =
        broadcast(1.0f) / max(distance2 + node.radius * node.radius, broadcast(std::numeric_limits<float>::min()));
    return node.power * (at_light * inverse) * (at_place * inverse);
}

namespace {

// Cumulative sums of the lanes. In double: beside a strong light float sums would lose lights weaker by 2^-24, which
// may be the only visible ones.
struct Edges {
    Double4 low, high;
    double end;

    explicit Edges(Float8 weights)
    {
        const Double4 a = sums_of(lower(weights)), b = sums_of(upper(weights)), half = broadcast(a[3]);
        low = shift_up_1(a), high = shift_up_1(b) + half, end = a[3] + b[3];
    }
    double operator[](size_t i) const { return i < 4 ? low[i] : high[i - 4]; }
    // Number of parts that begin at or before x >= 0.
    size_t count_to(double x) const
    {
        const Double4 at = broadcast(x);
        return static_cast<size_t>(std::popcount(movemask(low <= at)) + std::popcount(movemask(high <= at)));
    }

private:
    // Prefix sums.
    static Double4 sums_of(Float4 weights)
    {
        Double4 x = to_double(weights);
        x += shift_up_1(x);
        return x + shift_up_2(x);
    }
};

}  // namespace

inline bool LightTree::descend(Descent& d) const
{
    const Float8 weights = importances(d.at, d.point, d.normal);
    const Edges edges(weights);
    if (!(edges.end > 0) || !(edges.end < std::numeric_limits<double>::infinity())) return false;
    const double x = d.u * edges.end;
    // Without branches, which could not be predicted. Steps back if x was rounded up to the end.
    size_t lane = edges.count_to(x) - 1;
    while (!(weights[lane] > 0)) --lane;
    const auto weight = static_cast<double>(weights[lane]);
    d.u = std::clamp((x - edges[lane]) / weight, 0.0, 1 - 0x1p-53);
    d.probability *= weight / edges.end;
    d.at = nodes_[d.at].child[lane];
    return true;
}

LightTree::Choice LightTree::choose(Vec3 point, Vec3 normal, double u) const
{
    if (nodes_.empty()) return {};
    Descent d{point, normal, u};
    do {
        if (!descend(d)) return {};
    } while (!(d.at & is_leaf));
    return {d.at & ~is_leaf, static_cast<float>(d.probability)};
}

// Prefetches what descend() reads.
inline void LightTree::fetch(const Node& node)
{
    const auto* bytes = reinterpret_cast<const char*>(&node);
    for (size_t at = 0; at < sizeof node; at += 64) prefetch(bytes + at);
}

void LightTree::choose(const Vec3x8& points, const Vec3x8& normals, const std::array<double, float_lanes>& u,
                       uint32_t lanes, std::array<Choice, float_lanes>& choices) const
{
    for_each_lane(lanes, [&](uint32_t i) { choices[i] = {}; });
    if (nodes_.empty()) return;
    std::array<Descent, float_lanes> descents;
    for_each_lane(lanes, [&](uint32_t i) { descents[i] = {lancer::lane(points, i), lancer::lane(normals, i), u[i]}; });
    // One level for all points before the next level, so that their cache misses overlap.
    while (lanes != 0) {
        uint32_t further = 0;
        for_each_lane(lanes, [&](uint32_t i) {
            Descent& d = descents[i];
            const bool reaches = descend(d), ends = (d.at & is_leaf) != 0;
            if (reaches && ends) choices[i] = {d.at & ~is_leaf, static_cast<float>(d.probability)};
            const bool goes_on = reaches && !ends;
            if (goes_on) fetch(nodes_[d.at]);
            further |= static_cast<uint32_t>(goes_on) << i;
        });
        lanes = further;
    }
}

float LightTree::probability(uint32_t light, Vec3 point, Vec3 normal) const
{
    double probability = 1;
    for (uint32_t at = place_of_[light]; at != none; at = parent_[at / float_lanes]) {
        const Float8 weights = importances(at / float_lanes, point, normal);
        const double sum = Edges(weights).end;
        if (!(sum > 0)) return 0;
        probability *= static_cast<double>(weights[at % float_lanes]) / sum;
    }
    return place_of_[light] == none ? 0 : static_cast<float>(probability);
}

}  // namespace lancer
