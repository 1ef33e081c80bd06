// The accelerator around a hand-written tree of triangles: instances of meshes, spheres, planes, holes, and which of
// two equal hits wins. One tree holds the triangles of all meshes that are drawn as they are; each instanced mesh has
// one in its own space.
#pragma once

#include <chrono>
#include <optional>

#include "geometry/accel.h"
#include "geometry/triangle_set.h"

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
        build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    Hit closest(const Ray& ray) const override
    {
        Hit best;
        if (!is_traceable(ray)) return best;
        Ray rest = ray;
        shapes<Kind::sphere>(g_.spheres.size(), rest, best);
        shapes<Kind::plane>(g_.planes.size(), rest, best);
        const auto space = [&](const Space& s, const Ray& local, uint32_t instance) {
            s.tree.closest(local, rest.t_max, [&](uint32_t number, float t) {
                const TriangleSet::Id id = s.triangles.id(number);
                const Hit hit{t, instance, id.mesh, id.triangle, {}, Kind::triangle};
                if (best && !(t < best.t) && !(t == best.t && precedes(hit, best))) return false;
                if (lets_pass(ray, hit)) return false;
                best = hit;
                return true;
            });
        };
        each_space(ray, [&](const Space& s, const Ray& local, uint32_t instance) {
            space(s, local, instance);
            return false;
        });
        return refine(g_, ray, best);
    }
    bool any(const Ray& ray) const override
    {
        if (!is_traceable(ray)) return false;
        Hit best;
        Ray rest = ray;
        shapes<Kind::sphere>(g_.spheres.size(), rest, best);
        if (!best) shapes<Kind::plane>(g_.planes.size(), rest, best);
        return best || each_space(ray, [&](const Space& s, const Ray& local, uint32_t instance) {
                   return s.tree.any(local, [&](uint32_t number, float t) {
                       const TriangleSet::Id id = s.triangles.id(number);
                       return !lets_pass(ray, {t, instance, id.mesh, id.triangle, {}, Kind::triangle});
                   });
               });
    }
    void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence) const override
    {
        for (size_t i = 0; i < rays.size(); ++i) hits[i] = TreeAccelerator::closest(rays[i]);
    }
    void any(std::span<const Ray> rays, std::span<uint8_t> occluded) const override
    {
        for (size_t i = 0; i < rays.size(); ++i) occluded[i] = TreeAccelerator::any(rays[i]);
    }
    AccelStats stats() const override
    {
        AccelStats s{build_seconds_, 0};
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
    // f(space, ray in it, instance) until it says true; whether it did.
    template <class F>
    bool each_space(const Ray& ray, F&& f) const
    {
        if (plain_ && f(*plain_, ray, Hit::no_instance)) return true;
        for (uint32_t i = 0; i < g_.instances.size(); ++i) {
            const auto& space = placed_[g_.instances[i].mesh];
            if (!space) continue;
            const Transform& m = g_.instances[i].to_mesh;
            Ray local = ray;
            local.org = to_float(m.point(to_double(ray.org))), local.dir = to_float(m.vector(to_double(ray.dir)));
            if (is_traceable(local) && f(*space, local, i)) return true;
        }
        return false;
    }
    template <Kind kind>
    void shapes(size_t count, Ray& rest, Hit& best) const
    {
        for (uint32_t i = 0; i < count; ++i) {
            const Hit hit = first_stop<kind>(g_, i, rest);
            if (!hit || (best && hit.t == best.t)) continue;
            best = hit;
            rest.t_max = hit.t;
        }
    }

    const Geometry& g_;
    std::optional<Space> plain_;
    std::vector<std::optional<Space>> placed_;  // of each mesh
    double build_seconds_ = 0;
};

}  // namespace lancer
