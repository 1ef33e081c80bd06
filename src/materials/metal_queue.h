// Batched evaluation of rough metal with the bits of MetalBsdf.
#pragma once

#include <cassert>

#include "materials/lane_queue.h"
#include "materials/metal.h"

namespace lancer {

class MetalQueue : public LaneQueue {
public:
    void add(Eight& of, uint32_t lane, const MetalBsdf& bsdf)
    {
        assert(!bsdf.only_delta());
        const uint32_t k = add_to(of, lane);
        points_[k / 4].set(k % 4, bsdf.rough());
    }

    // After put_wo(), before all else.
    void see()
    {
        for (size_t k = 0; k < count_; k += 4) {
            const Vec3T<Float4> wo = wo_.four(k);
            seen_[k / 4] = {.o = unit_in_double(wo), .missing = points_[k / 4].missing(wo.z)};
        }
    }

    void eval()
    {
        const Float4 zero{};
        for (size_t k = 0; k < count_; k += 4) {
            const Vec3T<Float4> wi = wi_.four(k);
            const Value f = value_of(k, wi);
            const Mask4f is_lit = (wo_.z.four(k) > zero) & (wi.z > zero);
            set_value(k, f, is_lit);
        }
    }

    void sample()
    {
        for (size_t k = 0; k < count_; k += 4) sample_four(k);
    }

private:
    using Value = RoughMetal4::Value;
    // What depends on wo alone.
    struct Seen {
        Vec3T<Double4> o;
        Float4 missing;
    };

    Value value_of(size_t k, const Vec3T<Float4>& wi) const
    {
        return points_[k / 4].eval(seen_[k / 4].o, wi, seen_[k / 4].missing);
    }
    void sample_four(size_t k)
    {
        const RoughMetal4& metal = points_[k / 4];
        const Seen& seen = seen_[k / 4];
        const Float4 v_x = v_x_.four(k), v_y = v_y_.four(k), zero{};
        const Mask4f is_seen = wo_.z.four(k) > zero;
        const SinCosT<Float4> phi = sin_cos_2pi(v_x);
        const GgxT<Double4> ggx{to_double(metal.alpha)};
        const Vec3T<Double4> h = ggx.sample_visible(seen.o, to_double(v_y), {to_double(phi.sin), to_double(phi.cos)});
        Vec3T<Float4> wi = to_float(mirrored(seen.o, h));
        const Mask4f is_even = is_seen & (u_.four(k) < metal.chance_of_multiple(seen.missing));
        for_each_lane(movemask(is_even), [&](uint32_t i) {
            const Vec3 w = direction_at(metal.compensation.of(i).sample_cos(v_x[i]), v_y[i]);
            wi.x[i] = w.x, wi.y[i] = w.y, wi.z[i] = w.z;
        });
        const Value f = value_of(k, wi);
        wi_.set_four(k, wi), color_.set_four(k, f.f_cos / f.pdf), pdf_.set_four(k, f.pdf);
        found_.set_four(k, reinterpret_cast<Float4>(is_seen & (wi.z > zero) & (f.pdf > zero)));
        delta_.set_four(k, zero);
    }

    std::array<RoughMetal4, most / 4> points_{};
    std::array<Seen, most / 4> seen_{};
};

}  // namespace lancer
