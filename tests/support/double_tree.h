// The reference for accelerators on geometry that the list is too slow for: a bounding volume hierarchy of its own, in
// double throughout, with the triangle test and the ties of the list. It shares nothing with the trees of geometry/ but
// the exact shapes.
// Boxes: Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; splits by binned surface area: Wald, "On fast
// Construction of SAH-based Bounding Volume Hierarchies", 2007.
#pragma once

#include <array>
#include <numeric>
#include <tuple>
#include <vector>

#include "geometry/geometry.h"

namespace lancer {

// Triangles of one mesh, in the mesh's own space.
class DoubleMeshTree {
public:
    explicit DoubleMeshTree(const Mesh& mesh) : mesh_(&mesh)
    {
        for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const Bounds b = box_of(i);
            boxes_.push_back(b);
            if (is_finite(b.lower) && is_finite(b.upper)) order_.push_back(i);
        }
        nodes_.emplace_back();
        if (!order_.empty()) build(0, 0, static_cast<uint32_t>(order_.size()), 0);
        boxes_ = {};
    }

    // f(triangle, t) for every triangle that the line meets in [t_min, t_max], in no order, until it says true. f may
    // lower t_max.
    template <class F>
    bool visit(Vec3d org, Vec3d dir, double t_min, const double& t_max, F&& f) const
    {
        if (order_.empty()) return false;
        const Vec3d inverse{1 / dir.x, 1 / dir.y, 1 / dir.z};
        std::array<uint32_t, max_depth + 2> stack;
        size_t size = 0;
        stack[size++] = 0;
        while (size) {
            const Node& n = nodes_[stack[--size]];
            if (!meets(n.box, org, inverse, t_min, t_max)) continue;
            if (n.count == 0) {
                // The child that lies on the ray's side of the other first.
                const uint32_t far_first = dir[static_cast<int>(n.axis)] > 0;
                stack[size++] = n.first + far_first;
                stack[size++] = n.first + 1 - far_first;
                continue;
            }
            for (uint32_t k = n.first; k < n.first + n.count; ++k) {
                const auto h = intersect_plane_of(*mesh_, order_[k], org, dir);
                if (h && h->inside && h->t >= t_min && h->t <= t_max && f(order_[k], h->t)) return true;
            }
        }
        return false;
    }

private:
    static constexpr uint32_t leaf = 4, bins = 16, max_sah_depth = 64, max_depth = max_sah_depth + 32;
    // Far above all rounding of double, far below what float can tell.
    static constexpr double margin = 1e-12;

    struct Node {
        Bounds box;
        uint32_t first = 0;  // of the triangles in order_, or of the two children
        uint32_t count = 0;  // of triangles; 0: an inner node
        uint32_t axis = 0;   // along which the children were parted
    };

    // Errors of the triangle test are a part of the triangle's size, but for those that grow with the distance along
    // the ray, for which meets() has its own margin.
    Bounds box_of(uint32_t triangle) const
    {
        Bounds b;
        for (const uint32_t v : mesh_->triangles[triangle]) {
            const Vec3d p = to_double(mesh_->positions[v]);
            b.grow(p - abs(p) * margin);
            b.grow(p + abs(p) * margin);
        }
        const double own = margin * b.extent();
        return {b.lower - Vec3d{own, own, own}, b.upper + Vec3d{own, own, own}};
    }
    // NaN, from a ray within the plane of a side, limits nothing.
    static bool meets(const Bounds& b, Vec3d org, Vec3d inverse, double t_min, double t_max)
    {
        double near = t_min * (1 - margin), far = t_max * (1 + margin);
        for (int k = 0; k < 3; ++k) {
            double t0 = (b.lower[k] - org[k]) * inverse[k], t1 = (b.upper[k] - org[k]) * inverse[k];
            if (std::signbit(inverse[k])) std::swap(t0, t1);
            t1 *= 1 + margin;
            if (t0 > near) near = t0;
            if (t1 < far) far = t1;
        }
        return near <= far;
    }
    static double half_area(const Bounds& b)
    {
        if (b.empty()) return 0;
        const Vec3d d = b.upper - b.lower;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }

    struct Split {
        double cost, at;
        int axis;
    };
    Split best_split(uint32_t first, uint32_t last, const Bounds& centers) const
    {
        Split best{Bounds::inf, 0, 0};
        for (int axis = 0; axis < 3; ++axis) {
            const double from = centers.lower[axis], width = (centers.upper[axis] - from) / bins;
            if (!(width > 0)) continue;
            std::array<Bounds, bins> box;
            std::array<uint32_t, bins> count{};
            for (uint32_t k = first; k < last; ++k) {
                const double at = (boxes_[order_[k]].center()[axis] - from) / width;
                const auto bin = std::min(bins - 1, static_cast<uint32_t>(at));
                box[bin].grow(boxes_[order_[k]]);
                ++count[bin];
            }
            std::array<double, bins> right{};  // cost of what lies in this bin and above
            Bounds all;
            uint32_t n = 0;
            for (uint32_t i = bins; i-- > 1;) {
                all.grow(box[i]);
                n += count[i];
                right[i] = half_area(all) * n;
            }
            all = {}, n = 0;
            for (uint32_t i = 1; i < bins; ++i) {
                all.grow(box[i - 1]);
                n += count[i - 1];
                const double cost = half_area(all) * n + right[i];
                if (cost < best.cost) best = {cost, from + width * i, axis};
            }
        }
        return best;
    }
    void build(uint32_t node, uint32_t first, uint32_t last, uint32_t depth)
    {
        Bounds box, centers;
        for (uint32_t k = first; k < last; ++k) {
            box.grow(boxes_[order_[k]]);
            centers.grow(boxes_[order_[k]].center());
        }
        nodes_[node].box = box;
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        if (last - first <= leaf) return;
        const Split split = best_split(first, last, centers);
        const auto begin = order_.begin() + first, end = order_.begin() + last;
        auto middle = begin;
        if (split.cost < Bounds::inf)
            middle = std::partition(begin, end, [&](uint32_t i) { return boxes_[i].center()[split.axis] < split.at; });
        if (middle == begin || middle == end || depth >= max_sah_depth) {
            middle = begin + (end - begin) / 2;
            std::nth_element(begin, middle, end, [&](uint32_t a, uint32_t b) {
                const double x = boxes_[a].center()[split.axis], y = boxes_[b].center()[split.axis];
                return std::tie(x, a) < std::tie(y, b);
            });
        }
        const auto cut = static_cast<uint32_t>(middle - order_.begin());
        const auto child = static_cast<uint32_t>(nodes_.size());
        nodes_.resize(child + 2);
        nodes_[node].first = child;
        nodes_[node].count = 0;
        nodes_[node].axis = static_cast<uint32_t>(split.axis);
        build(child, first, cut, depth + 1);
        build(child + 1, cut, last, depth + 1);
    }

    const Mesh* mesh_;
    std::vector<Bounds> boxes_;  // of each triangle, while building
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

// A whole Geometry: answers what the list answers, in its order of ties. Instances, spheres and planes are tried one
// after the other. The Geometry must outlive it.
class DoubleTree {
public:
    explicit DoubleTree(const Geometry& geometry) : g_(geometry)
    {
        for (const Mesh& m : g_.meshes) trees_.emplace_back(m);
    }

    Hit closest(const Ray& ray) const
    {
        if (!is_traceable(ray)) return {};
        Hit best;
        double t_max = beyond(ray.t_max);
        each_triangle(ray, t_max, [&](const Hit& hit) {
            if (!(best && !precedes(hit, best)) && !passes_through(ray, hit)) {
                best = hit;
                t_max = beyond(hit.t);
            }
            return false;
        });
        shapes<Kind::sphere>(g_.spheres.size(), ray, best);
        shapes<Kind::plane>(g_.planes.size(), ray, best);
        return refine(g_, ray, best);
    }
    bool any(const Ray& ray) const
    {
        if (!is_traceable(ray)) return false;
        const double t_max = beyond(ray.t_max);
        if (each_triangle(ray, t_max, [&](const Hit& hit) { return !passes_through(ray, hit); })) return true;
        Hit best;
        shapes<Kind::sphere>(g_.spheres.size(), ray, best);
        shapes<Kind::plane>(g_.planes.size(), ray, best);
        return static_cast<bool>(best);
    }
    // How many triangles the ray meets in [t_min, t_max].
    uint64_t crossings(const Ray& ray) const
    {
        uint64_t n = 0;
        each_triangle(ray, beyond(ray.t_max), [&](const Hit&) {
            ++n;
            return false;
        });
        return n;
    }

private:
    // A bound in double for what is at most t once it is stored in float.
    static double beyond(float t) { return static_cast<double>(t) * (1 + 0x1p-22); }

    static bool precedes(const Hit& a, const Hit& b)
    {
        return std::tie(a.t, a.kind, a.instance, a.geometry, a.primitive) <
               std::tie(b.t, b.kind, b.instance, b.geometry, b.primitive);
    }
    bool passes_through(const Ray& ray, const Hit& hit) const
    {
        if (!g_.alpha_test.passes_through || g_.alpha_test.meshes[hit.geometry].empty()) return false;
        return g_.alpha_test.meshes[hit.geometry][hit.primitive] &&
               g_.alpha_test.passes_through(g_.alpha_test.context, ray, refine(g_, ray, hit));
    }
    // f(hit), t as it is stored, until it says true; whether it did.
    template <class F>
    bool each_triangle(const Ray& ray, const double& t_max, F&& f) const
    {
        const Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
        const auto mesh = [&](uint32_t instance, uint32_t index, Vec3d o, Vec3d d) {
            return trees_[index].visit(o, d, 0, t_max, [&](uint32_t triangle, double t) {
                return reaches(ray, t) && f(Hit{static_cast<float>(t), instance, index, triangle, {}, Kind::triangle});
            });
        };
        for (uint32_t i = 0; i < g_.instances.size(); ++i) {
            const Transform& m = g_.instances[i].to_mesh;
            if (mesh(i, g_.instances[i].mesh, m.point(org), m.vector(dir))) return true;
        }
        for (uint32_t i = 0; i < g_.meshes.size(); ++i)
            if (!g_.meshes[i].instanced && mesh(Hit::no_instance, i, org, dir)) return true;
        return false;
    }
    template <Kind kind>
    void shapes(size_t count, const Ray& ray, Hit& best) const
    {
        for (uint32_t i = 0; i < count; ++i) {
            const Hit hit = first_opaque_hit<kind>(g_, i, ray);
            if (hit && (!best || precedes(hit, best))) best = hit;
        }
    }

    const Geometry& g_;
    std::vector<DoubleMeshTree> trees_;
};

}  // namespace lancer
