// A list of triangles with one bounding box: the simplest TriangleTree.
#pragma once

#include "geometry/slab.h"
#include "geometry/triangle_float.h"
#include "geometry/triangle_set.h"

namespace lancer {

class Box {
public:
    explicit Box(const TriangleSet& triangles);

    template <class Found>
    void closest(const Ray& ray, float& t_max, const Found& found) const
    {
        if (!meets(box_, SlabRay(ray), t_max)) return;
        const ShearedRay r(ray);
        for (const Triangle& i : triangles_) {
            const auto t = distance_to(r, i.a, i.b, i.c);
            if (t && *t >= ray.t_min && *t <= t_max && found(i.number, *t)) t_max = *t;
        }
    }
    template <class Found>
    bool any(const Ray& ray, const Found& found) const
    {
        if (!meets(box_, SlabRay(ray), ray.t_max)) return false;
        const ShearedRay r(ray);
        for (const Triangle& i : triangles_) {
            const auto t = distance_to(r, i.a, i.b, i.c);
            if (t && *t >= ray.t_min && *t <= ray.t_max && found(i.number, *t)) return true;
        }
        return false;
    }
    uint64_t bytes() const { return triangles_.size() * sizeof(Triangle); }
    double sah_cost() const { return 1 + static_cast<double>(triangles_.size()); }

private:
    struct Triangle {
        Vec3 a, b, c;
        uint32_t number;
    };
    FloatBox box_;
    std::vector<Triangle> triangles_;
};

}  // namespace lancer
