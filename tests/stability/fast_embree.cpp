#include "stability/fast_embree.h"

#include "geometry/embree/bare_embree.h"

namespace lancer::stability {
namespace {

class FastEmbree final : public Accelerator {
public:
    explicit FastEmbree(const Geometry& geometry)
        : geometry_(geometry), embree_(geometry, {.robust = false, .high = true, .isa = "avx2"})
    {
    }

    Hit closest(const Ray& ray) const override
    {
        const Hit hit = is_traceable(ray) ? embree_.closest(ray) : Hit{};
        return hit ? refine(geometry_, ray, hit) : hit;
    }
    bool any(const Ray& ray) const override { return is_traceable(ray) && embree_.any(ray); }
    AccelStats stats() const override
    {
        return {.build_seconds = embree_.build_seconds(), .bytes = embree_.bytes(), .sah_cost = 0};
    }

private:
    const Geometry& geometry_;
    BareEmbree embree_;
};

}  // namespace

std::unique_ptr<Accelerator> make_fast_embree(const Geometry& geometry)
{
    return std::make_unique<FastEmbree>(geometry);
}

}  // namespace lancer::stability
