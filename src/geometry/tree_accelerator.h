// The accelerator around a hand-written tree of triangles: instances of meshes, spheres, planes, holes, and which of
// two equal hits wins. One tree holds the triangles of all meshes that are drawn as they are; each instanced mesh has
// one in its own space; a binary tree holds the boxes of instances and spheres. Planes have none and are a list.
#pragma once

#include <chrono>
#include <optional>
#include <tuple>

#include "geometry/accel.h"
#include "geometry/binary_builder.h"
#include "geometry/object_boxes.h"
#include "geometry/refine_all.h"

namespace lancer {

template <TriangleTree Tree>
class TreeAccelerator final : public Accelerator {
public:
    explicit TreeAccelerator(const Geometry& geometry) : g_(geometry)
    {
        const auto start = std::chrono::steady_clock::now();
        std::vector<uint32_t> plain;
        placed_.resize(g_.meshes.size());
        for (uint32_t i = 0; i < g_.meshes.size(); ++i) {
            if (g_.meshes[i].triangles.empty()) continue;
            if (g_.meshes[i].instanced)
                placed_[i].emplace(g_, std::vector{i});
            else
                plain.push_back(i);
        }
        if (!plain.empty()) plain_.emplace(g_, std::move(plain));
        build_objects();
        build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    Hit closest(const Ray& ray) const override { return refine(g_, ray, find(ray)); }
    bool any(const Ray& ray) const override
    {
        if (!is_traceable(ray)) return false;
        const auto space = [&](const Space& s, const Ray& local, uint32_t instance) {
            return s.tree.any(local, [&](uint32_t number, float t) {
                const TriangleSet::Id id = s.triangles.id(number);
                return !lets_pass(ray, {t, instance, id.mesh, id.triangle, {}, Kind::triangle});
            });
        };
        for (uint32_t i = 0; i < g_.planes.size(); ++i)
            if (first_stop<Kind::plane>(g_, i, ray)) return true;
        if (plain_ && space(*plain_, ray, Hit::no_instance)) return true;
        return objects_.any(ray, [&](uint32_t object, uint32_t) {
            if (is_sphere(object)) return static_cast<bool>(first_stop<Kind::sphere>(g_, sphere(object), ray));
            const Ray local = into_mesh(ray, object);
            return is_traceable(local) && space(*placed_[g_.instances[object].mesh], local, object);
        });
    }
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence) const override
    {
        for (size_t i = 0; i < rays.size(); ++i) hits[i] = find(rays[i]);
        refine_all(g_, rays, hits);
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        for (size_t i = 0; i < rays.size(); ++i) occluded[i] = TreeAccelerator::any(rays[i]);
    }
    AccelStats stats() const override
    {
        AccelStats s{build_seconds_, objects_.bytes()};
        if (plain_) s.bytes += plain_->tree.bytes(), s.sah_cost = plain_->tree.sah_cost();
        for (const auto& p : placed_)
            if (p) s.bytes += p->tree.bytes();
        return s;
    }

private:
    struct Space {
        TriangleSet triangles;
        Tree tree;
        Space(const Geometry& g, std::vector<uint32_t> meshes) : triangles(g, std::move(meshes)), tree(triangles) {}
    };

    // What closest() finds, not refined.
    Hit find(const Ray& ray) const
    {
        Hit best;
        if (!is_traceable(ray)) return best;
        Ray rest = ray;
        const auto is_nearer = [&](const Hit& hit) {
            return !best || hit.t < best.t || (hit.t == best.t && precedes(hit, best));
        };
        const auto shape = [&](const Hit& hit) {
            if (!hit || !is_nearer(hit)) return;
            best = hit;
            rest.t_max = hit.t;
        };
        const auto space = [&](const Space& s, const Ray& local, uint32_t instance) {
            s.tree.closest(local, rest.t_max, [&](uint32_t number, float t) {
                const TriangleSet::Id id = s.triangles.id(number);
                const Hit hit{t, instance, id.mesh, id.triangle, {}, Kind::triangle};
                if (!is_nearer(hit) || lets_pass(ray, hit)) return false;
                best = hit;
                return true;
            });
        };
        for (uint32_t i = 0; i < g_.planes.size(); ++i) shape(first_stop<Kind::plane>(g_, i, rest));
        if (plain_) space(*plain_, ray, Hit::no_instance);
        objects_.closest(ray, rest.t_max, [&](uint32_t object, uint32_t, float) {
            if (is_sphere(object))
                shape(first_stop<Kind::sphere>(g_, sphere(object), rest));
            else if (Ray local = into_mesh(ray, object); is_traceable(local))
                space(*placed_[g_.instances[object].mesh], local, object);
            return rest.t_max;
        });
        return best;
    }

    // Of equally far hits the one that a loop over everything would come by first wins.
    static bool precedes(const Hit& a, const Hit& b)
    {
        const auto place = [](const Hit& h) { return std::tuple(h.kind, h.instance, h.geometry, h.primitive); };
        return place(a) < place(b);
    }
    bool lets_pass(const Ray& ray, const Hit& hit) const
    {
        if (!g_.holes.let_pass || g_.holes.meshes[hit.geometry].empty()) return false;
        return g_.holes.meshes[hit.geometry][hit.primitive] &&
               g_.holes.let_pass(g_.holes.context, ray, refine(g_, ray, hit));
    }
    // Objects are numbered: first the instances, then the spheres.
    bool is_sphere(uint32_t object) const { return object >= g_.instances.size(); }
    uint32_t sphere(uint32_t object) const { return object - static_cast<uint32_t>(g_.instances.size()); }
    void build_objects()
    {
        std::vector<FloatBox> meshes(g_.meshes.size());
        for (size_t i = 0; i < placed_.size(); ++i)
            if (placed_[i]) meshes[i] = box_of(placed_[i]->triangles);
        std::vector<BoxedPrimitive> boxes;
        uint32_t object = 0;
        for (const Instance& i : g_.instances) {
            if (!meshes[i.mesh].empty()) boxes.emplace_back(box_of(meshes[i.mesh], i.to_world), object);
            ++object;
        }
        for (const Sphere& s : g_.spheres) boxes.emplace_back(box_of(s), object++);
        BuiltTree built = build_sah(std::move(boxes), 1);
        built.tree.relabel_leaves([&](uint32_t first, uint32_t) { return built.order[first]; });
        objects_ = std::move(built.tree);
    }
    Ray into_mesh(const Ray& ray, uint32_t instance) const
    {
        const Transform& m = g_.instances[instance].to_mesh;
        Ray local = ray;
        local.org = to_float(m.point(to_double(ray.org)));
        local.dir = to_float(m.vector(to_double(ray.dir)));
        return local;
    }

    const Geometry& g_;
    std::optional<Space> plain_;
    std::vector<std::optional<Space>> placed_;  // of each mesh
    BinaryTree objects_;                        // `first` of a leaf: the object
    double build_seconds_ = 0;
};

}  // namespace lancer
