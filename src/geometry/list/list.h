// The loop over all primitives, in double: the reference for every other accelerator.
#pragma once

#include "geometry/accel.h"

namespace lancer {

class List final : public Accelerator {
public:
    explicit List(const Geometry& geometry) : g_(geometry) {}

    using Accelerator::any;
    using Accelerator::closest;
    Hit closest(const Ray& ray) const override
    {
        return is_traceable(ray) ? refine(g_, ray, nearest<false>(ray)) : Hit{};
    }
    bool any(const Ray& ray) const override { return is_traceable(ray) && nearest<true>(ray); }
    AccelStats stats() const override { return {}; }

private:
    // In order of instance, mesh and primitive, so that the first of equal hits wins; with first_will_do any hit ends
    // the loop.
    template <bool first_will_do>
    Hit nearest(const Ray& ray) const
    {
        Hit best;
        Ray rest = ray;
        const auto mesh = [&](uint32_t instance, uint32_t index, Vec3d org, Vec3d dir) {
            const Mesh& m = g_.meshes[index];
            const bool has_holes = g_.alpha_test.passes_through && !g_.alpha_test.meshes[index].empty();
            for (uint32_t i = 0; i < m.triangles.size(); ++i) {
                const auto h = intersect_plane_of(m, i, org, dir);
                if (!h || !h->inside || !reaches(ray, h->t)) continue;
                const auto t = static_cast<float>(h->t);
                if (best && !(t < best.t)) continue;
                const Hit hit{t, instance, index, i, {}, Kind::triangle};
                if (has_holes && g_.alpha_test.meshes[index][i] &&
                    g_.alpha_test.passes_through(g_.alpha_test.context, ray, refine(g_, ray, hit)))
                    continue;
                best = hit;
                rest.t_max = t;
                if (first_will_do) return;
            }
        };
        const Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
        for (uint32_t i = 0; i < g_.instances.size(); ++i) {
            const InstanceAt placed = g_.instance_at(i, ray.time);
            mesh(i, placed->mesh, placed->to_mesh.point(org), placed->to_mesh.vector(dir));
            if (first_will_do && best) return best;
        }
        for (uint32_t i = 0; i < g_.meshes.size(); ++i) {
            if (!g_.meshes[i].instanced) mesh(Hit::no_instance, i, org, dir);
            if (first_will_do && best) return best;
        }
        shapes<Kind::sphere, first_will_do>(g_.spheres.size(), rest, best);
        if (first_will_do && best) return best;
        shapes<Kind::plane, first_will_do>(g_.planes.size(), rest, best);
        return best;
    }

    template <Kind kind, bool first_will_do>
    void shapes(size_t count, Ray& rest, Hit& best) const
    {
        for (uint32_t i = 0; i < count; ++i) {
            const Hit hit = first_opaque_hit<kind>(g_, i, rest);
            if (!hit || (best && hit.t == best.t)) continue;
            best = hit;
            rest.t_max = hit.t;
            if (first_will_do) return;
        }
    }

    const Geometry& g_;
};

}  // namespace lancer
