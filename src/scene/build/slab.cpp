#include "scene/build/slab.h"

#include <algorithm>

#include "core/bounds.h"

namespace lancer {
namespace {

constexpr double parallel = 0.999;      // cosine of normals of one side
constexpr double least_of_sides = 0.9;  // part of the area that the two sides have; the rest are edges and bevels
constexpr double same_size = 0.02;      // relative difference of areas of the two sides
constexpr double uneven = 0.25;         // how far a corner of a side may lie within the slab, over its thickness
constexpr double flat_side = 1e-3;      // how far corners of flat faces may lie apart along the normal, over the width

std::vector<Vec3d> corners_of(const WeldedFaces& faces, std::span<const uint32_t> part)
{
    std::vector<uint32_t> vertices;
    for (const uint32_t f : part) vertices.insert(vertices.end(), faces.corners[f].begin(), faces.corners[f].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<Vec3d> points;
    for (const uint32_t v : vertices) points.push_back(faces.positions[v]);
    return points;
}

// Andrew, "Another Efficient Algorithm for Convex Hulls in Two Dimensions", 1979.
std::vector<Vec2d> hull_of(std::vector<Vec2d> points)
{
    const auto before = [](Vec2d a, Vec2d b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(points.begin(), points.end(), before);
    std::vector<Vec2d> hull;
    const auto turns_left = [](Vec2d o, Vec2d a, Vec2d b) {
        return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x) > 0;
    };
    for (const bool back : {false, true}) {
        const size_t begin = hull.size();
        for (const Vec2d p : points) {
            while (hull.size() >= begin + 2 && !turns_left(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        if (!back) std::reverse(points.begin(), points.end());
    }
    return hull;
}

double height_range(std::span<const Vec3d> points, Vec3d n)
{
    double low = Bounds::inf, high = -Bounds::inf;
    for (const Vec3d& p : points) low = std::min(low, dot(n, p)), high = std::max(high, dot(n, p));
    return high - low;
}

}  // namespace

double least_width(std::span<const Vec3d> points, Vec3d n)
{
    const Vec3d u = normalize(std::abs(n.x) > 0.9 ? cross(n, Vec3d{0, 1, 0}) : cross(n, Vec3d{1, 0, 0}));
    const Vec3d v = cross(n, u);
    std::vector<Vec2d> seen;
    for (const Vec3d& p : points) seen.push_back({dot(p, u), dot(p, v)});
    const std::vector<Vec2d> hull = hull_of(std::move(seen));
    // The narrowest strip has an edge of the hull on its border.
    double least = Bounds::inf;
    for (size_t i = 0; i < hull.size(); ++i) {
        const Vec2d a = hull[i], b = hull[(i + 1) % hull.size()];
        const double dx = b.x - a.x, dy = b.y - a.y, edge = std::hypot(dx, dy);
        if (!(edge > 0)) continue;
        double width = 0;
        for (const Vec2d p : hull) width = std::max(width, std::abs((p.x - a.x) * dy - (p.y - a.y) * dx) / edge);
        least = std::min(least, width);
    }
    return least == Bounds::inf ? 0 : least;
}

std::optional<SplitSlab> split_slab(const WeldedFaces& faces, std::span<const uint32_t> body, double thinnest)
{
    uint32_t largest = body[0];
    double area = 0, largest_area = 0;
    for (const uint32_t f : body) {
        const double a = length(faces.normal(f));
        area += a;
        if (a > largest_area) largest = f, largest_area = a;
    }
    if (!(largest_area > 0)) return {};
    const Vec3d n = normalize(faces.normal(largest));
    const std::vector<Vec3d> points = corners_of(faces, body);
    const double thickness = height_range(points, n);
    Bounds box;
    for (const Vec3d& p : points) box.grow(p);
    if (thickness > thinnest * 2 * box.radius()) return {};
    double top = -Bounds::inf;
    for (const Vec3d& p : points) top = std::max(top, dot(n, p));
    SplitSlab split;
    double of_front = 0, of_back = 0;
    for (const uint32_t f : body) {
        const Vec3d normal = faces.normal(f);
        const double a = length(normal), cos = dot(normal, n);
        const bool front = cos > parallel * a, back = cos < -parallel * a;
        (front ? split.front : split.rest).push_back(f);
        if (!front && !back) continue;
        (front ? of_front : of_back) += a;
        for (const uint32_t v : faces.corners[f]) {
            const double below = top - dot(n, faces.positions[v]);
            if (front ? below > uneven * thickness : below < (1 - uneven) * thickness) return {};
        }
    }
    if (of_front + of_back < least_of_sides * area || std::abs(of_front - of_back) > (1 - least_of_sides) * of_front)
        return {};
    if (!(thickness < thinnest * least_width(corners_of(faces, split.front), n))) return {};
    return split;
}

std::optional<FlatFaces> as_flat(const WeldedFaces& faces, std::span<const uint32_t> part)
{
    FlatFaces all;
    Vec3d sum{};
    double area = 0;
    for (const uint32_t f : part) {
        const Vec3d normal = faces.normal(f);
        const double a = length(normal);
        sum += normal, area += a;
        for (const uint32_t v : faces.corners[f]) all.center += faces.positions[v] * (a / 3);
    }
    if (!(length(sum) > parallel * area)) return {};
    all.n = normalize(sum), all.area = area / 2, all.center = all.center / area;
    const std::vector<Vec3d> points = corners_of(faces, part);
    all.width = least_width(points, all.n);
    return height_range(points, all.n) <= flat_side * all.width ? std::optional(all) : std::nullopt;
}

bool are_sides_of_slab(const FlatFaces& a, const FlatFaces& b, double thinnest)
{
    if (!(dot(a.n, b.n) < -parallel) || std::abs(a.area - b.area) > same_size * a.area) return false;
    const Vec3d way = b.center - a.center;
    const double behind = -dot(way, a.n), width = std::min(a.width, b.width);
    const double aside = length(way + a.n * behind);
    return behind > 0 && behind < thinnest * width && aside < thinnest * width &&
           std::abs(a.width - b.width) <= same_size * a.width;
}

}  // namespace lancer
