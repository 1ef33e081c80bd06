// Batched evaluation of rough glass with the bits of GlassBsdf.
#pragma once

#include <cassert>

#include "materials/glass.h"
#include "materials/lane_queue.h"

namespace lancer {

class GlassQueue : public LaneQueue {
public:
    void add(Eight& of, uint32_t lane, const GlassBsdf& bsdf)
    {
        assert(bsdf.is_rough_boundary());
        const uint32_t k = add_to(of, lane);
        points_[k / 4].set(k % 4, bsdf);
    }

    // After put_wo(), before all else.
    void see()
    {
        for (size_t k = 0; k < count_; k += 4) wo_in_double_[k / 4] = unit_in_double(wo_.four(k));
    }

    void eval()
    {
        const Float4 zero{};
        for (size_t k = 0; k < count_; k += 4) {
            const Vec3T<Float4> wi = wi_.four(k);
            const Value f = eval_rough_glass(points_[k / 4], wo_in_double_[k / 4], wi);
            const Mask4f is_lit = (wo_.z.four(k) > zero) & (wi.z != zero);
            set_value(k, f, is_lit);
        }
    }

    void sample()
    {
        for (size_t k = 0; k < count_; k += 4) sample_four(k);
    }
    BsdfSampleLanes sampled(const Eight& of) const { return LaneQueue::sampled(of, eta_.of(of)); }

private:
    using Value = BsdfValueT<Vec3T<Float4>, Float4>;

    void sample_four(size_t k)
    {
        const RoughGlass4& glass = points_[k / 4];
        const Vec3T<Double4>& wo = wo_in_double_[k / 4];
        const Float4 cos_o = wo_.z.four(k), v_x = v_x_.four(k), zero{};
        const Mask4f is_seen = cos_o > zero;
        const SinCosT<Float4> phi = sin_cos_2pi(v_x);
        const auto sent = sample_rough_glass(glass, wo, cos_o, u_.four(k), v_x, v_y_.four(k),
                                             {to_double(phi.sin), to_double(phi.cos)}, is_seen);
        const Vec3T<Float4>& wi = sent.wi;
        const Value f = eval_rough_glass(glass, wo, wi);
        wi_.set_four(k, wi), color_.set_four(k, f.f_cos / f.pdf), pdf_.set_four(k, f.pdf);
        eta_.set_four(k, select(wi.z < zero, to_float(glass.eta), zero + 1.0f));
        found_.set_four(k, reinterpret_cast<Float4>(is_seen & sent.found & (f.pdf > zero)));
        delta_.set_four(k, zero);
    }

    std::array<RoughGlass4, most / 4> points_{};
    std::array<Vec3T<Double4>, most / 4> wo_in_double_{};
    Numbers<Float8> eta_{};
};

}  // namespace lancer
