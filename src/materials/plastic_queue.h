// Batched evaluation of plastic with the bits of PlasticBsdf.
#pragma once

#include "materials/lane_queue.h"
#include "materials/plastic.h"

namespace lancer {

class PlasticQueue : public LaneQueue {
public:
    void add(Eight& of, uint32_t lane, const PlasticBsdf& bsdf)
    {
        const PlasticBsdf::Coat& coat = bsdf.coat();
        const uint32_t k = add_to(of, lane);
        base_.set(k, bsdf.base()), specular_.set(k, bsdf.specular());
        eta_[k] = coat.eta, alpha_[k] = coat.alpha, mean_through_[k] = coat.mean_through;
        facets_[k / 4][k % 4] = coat.facets;
    }

    // After put_wo(), before all else.
    void see()
    {
        const auto largest = [](const Vec3T<Float4>& c) { return larger(c.x, larger(c.y, c.z)); };
        for (size_t k = 0; k < count_; k += 4)
            seen_[k / 4] = coat(k).seen(wo_.four(k), largest(specular_.four(k)), largest(base_.four(k)));
    }

    void eval()
    {
        const Float8 zero{};
        for (size_t k = 0; k < count_; k += float_lanes) {
            const Vec3x8 wi = wi_.eight(k);
            const Mask8 is_lit =
                (wo_.z.eight(k) > zero) & (wi.z > zero) & (~is_black(base_.eight(k)) | (alpha_.eight(k) > zero));
            const BsdfValueLanes f = eval_lobes(k, wi);
            color_.set_eight(k, select(is_lit, f.f_cos, {zero, zero, zero}));
            pdf_.set_eight(k, select(is_lit, f.pdf, zero));
        }
    }

    void put_numbers(const Eight& of, const Float8& u, const Vec2x8& v, const Vec3x8& cosine)
    {
        LaneQueue::put_numbers(of, u, v, cosine);
        wi_.put(of, cosine);
    }
    void sample()
    {
        const Float8 zero{};
        for (size_t k = 0; k < count_; k += float_lanes) {
            const Float8 choice = concat(seen_[k / 4].choice, seen_[k / 4 + 1].choice);
            const Mask8 by_coat = u_.eight(k)<choice, is_rough = alpha_.eight(k)> zero, is_delta = by_coat & ~is_rough;
            const Vec3x8 wo = wo_.eight(k);
            Vec3x8 wi = wi_.eight(k);
            if (movemask(by_coat & is_rough) != 0) wi = select(by_coat, reflected(k), wi);
            const BsdfValueLanes f = eval_lobes(k, wi);
            const Float8 sent = (1.0f - concat(seen_[k / 4].through, seen_[k / 4 + 1].through)) / choice;
            wi_.set_eight(k, select(is_delta, {-wo.x, -wo.y, wo.z}, wi));
            color_.set_eight(k, select(is_delta, specular_.eight(k) * sent, f.f_cos / f.pdf));
            pdf_.set_eight(k, select(is_delta, choice, f.pdf));
            found_.set_eight(k, (wo.z > zero) & (is_delta | ((wi.z > zero) & (f.pdf > zero))));
            delta_.set_eight(k, is_delta);
        }
    }

private:
    using Facets = std::array<AlbedoTable::Row, 4>;
    using Coat = PlasticCoat<Float4, Facets>;

    // Calls f for the groups of four that contain points of the eight from k on.
    template <class F>
    void for_fours(size_t k, const F& f) const
    {
        f(size_t{0}, k, [](const auto& x) { return lower(x); });
        if (k + 4 < count_) f(size_t{1}, k + 4, [](const auto& x) { return upper(x); });
    }
    Coat coat(size_t k) const { return {eta_.four(k), alpha_.four(k), mean_through_.four(k), facets_[k / 4]}; }
    BsdfValueLanes eval_lobes(size_t k, const Vec3x8& wi) const
    {
        std::array<Coat::Value, 2> of{};
        for_fours(k, [&](size_t i, size_t at, auto four) { of[i] = coat(at).eval(seen_[at / 4], four(wi)); });
        return {base_.eight(k) * concat(of[0].base, of[1].base) + specular_.eight(k) * concat(of[0].coat, of[1].coat),
                concat(of[0].pdf, of[1].pdf)};
    }
    // Directions sampled from facets; some lie below the surface.
    Vec3x8 reflected(size_t k) const
    {
        const SinCosT<Float8> phi = sin_cos_2pi(v_x_.eight(k));
        std::array<Vec3T<Float4>, 2> wi{};
        for_fours(k, [&](size_t i, size_t at, auto four) {
            const GgxT<Double4> facets{to_double(alpha_.four(at))};
            const Vec3T<Double4>& wo = seen_[at / 4].wo;
            const Vec3T<Double4> h = facets.sample_visible(wo, to_double(v_y_.four(at)),
                                                           {to_double(four(phi.sin)), to_double(four(phi.cos))});
            wi[i] = to_float(mirrored(wo, h));
        });
        return concat(wi[0], wi[1]);
    }

    Vectors base_{}, specular_{};  // base colour under the coat
    Numbers<Float8> eta_{}, alpha_{}, mean_through_{};
    std::array<Facets, most / 4> facets_{};
    std::array<Coat::Seen, most / 4> seen_{};
};

}  // namespace lancer
