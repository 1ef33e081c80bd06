// A tree of ours without the accelerator around it, as BareEmbree is Embree alone: no instances, no holes, no refine.
#pragma once

#include <vector>

#include "geometry/triangle_set.h"

namespace lancer::bench {

template <TriangleTree Tree>
struct BareTree {
    TriangleSet triangles;
    Tree tree;

    explicit BareTree(const Geometry& g) : triangles(g, drawn(g)), tree(triangles) {}

    static std::vector<uint32_t> drawn(const Geometry& g)
    {
        std::vector<uint32_t> meshes;
        for (uint32_t i = 0; i < g.meshes.size(); ++i)
            if (!g.meshes[i].instanced && !g.meshes[i].triangles.empty()) meshes.push_back(i);
        return meshes;
    }
    Hit closest(const Ray& ray) const
    {
        uint32_t nearest = UINT32_MAX;
        float t_max = ray.t_max, distance = t_max;
        tree.closest(ray, t_max, [&](uint32_t number, float t) {
            nearest = number, distance = t;
            return true;
        });
        if (nearest == UINT32_MAX) return {};
        const TriangleSet::Id id = triangles.id(nearest);
        return {distance, Hit::no_instance, id.mesh, id.triangle, {}, Kind::triangle};
    }
    bool any(const Ray& ray) const
    {
        return tree.any(ray, [](uint32_t, float) { return true; });
    }
};

}  // namespace lancer::bench
