// Plastic at up to eight places at once, with the bits of PlasticBsdf at each. Places of plastic lie between others:
// they are moved side by side, since of doubles four are computed together.
#pragma once

#include "core/vec_lanes.h"
#include "materials/plastic.h"

namespace lancer {

// As in BsdfValue, but for colours as vectors.
struct BsdfValueLanes {
    Vec3x8 f_cos;
    Float8 pdf;
};
// As in BsdfSample, in the lanes that `found` names; eta is 1.
struct BsdfSampleLanes {
    Vec3x8 wi, weight;
    Float8 pdf;
    uint32_t found, delta;
};

// What goes in and out is by lane; in lanes that are not plastic it is anything.
class PlasticLanes {
public:
    void clear()
    {
        const Float8 zero{}, one = all_lanes(1.0f);
        count_ = lanes_ = 0;
        // No arithmetic trips over what is not set.
        base_ = specular_ = {zero, zero, zero};
        eta_ = mean_through_ = one, alpha_ = zero;
        facets_ = {};
        from_ = to_ = UInt8{};
    }
    void set(uint32_t lane, const PlasticBsdf& bsdf)
    {
        const Color base = bsdf.base(), specular = bsdf.specular();
        const PlasticBsdf::Coat& coat = bsdf.coat();
        const uint32_t k = count_++;
        lanes_ |= 1u << lane;
        from_[k] = lane, to_[lane] = k;
        set_lane(base_, k, {base.r, base.g, base.b});
        set_lane(specular_, k, {specular.r, specular.g, specular.b});
        eta_[k] = coat.eta, alpha_[k] = coat.alpha, mean_through_[k] = coat.mean_through;
        facets_[k / 4][k % 4] = coat.facets;
    }
    uint32_t lanes() const { return lanes_; }  // that are plastic

    // Before anything is asked: wo, local and unit.
    void see(const Vec3x8& wo)
    {
        wo_ = permuted(wo, from_);
        const auto largest = [](const Vec3x8& c) { return larger(c.x, larger(c.y, c.z)); };
        const Float8 specular = largest(specular_), base = largest(base_);
        if (count_ <= 4) seen_[1].through = seen_[1].choice = Float4{};
        for_fours([&](size_t k, auto four) { seen_[k] = coat(four, k).seen(four(wo_), four(specular), four(base)); });
    }
    // wi: local, unit.
    BsdfValueLanes eval(const Vec3x8& wi) const
    {
        const Vec3x8 w = permuted(wi, from_);
        const Float8 zero{};
        const Mask8 is_lit = (wo_.z > zero) & (w.z > zero) & (~is_black(base_) | (alpha_ > zero));
        const BsdfValueLanes f = eval_lobes(w);
        return {permuted(select(is_lit, f.f_cos, {zero, zero, zero}), to_), permuted(select(is_lit, f.pdf, zero), to_)};
    }
    // u chooses the lobe, v the direction; cosine: square_to_cosine_hemisphere() of v.
    BsdfSampleLanes sample(const Float8& u, const Vec2x8& v, const Vec3x8& cosine) const
    {
        const Float8 zero{}, choice = joined(seen_[0].choice, seen_[1].choice);
        const Mask8 by_coat = permuted(u, from_)<choice, is_rough = alpha_> zero, is_delta = by_coat & ~is_rough;
        Vec3x8 wi = permuted(cosine, from_);
        if (bits(by_coat & is_rough) != 0)
            wi = select(by_coat, reflected({permuted(v.x, from_), permuted(v.y, from_)}), wi);
        const BsdfValueLanes f = eval_lobes(wi);
        const Mask8 found = (wo_.z > zero) & (is_delta | ((wi.z > zero) & (f.pdf > zero)));
        const Float8 sent = (1.0f - joined(seen_[0].through, seen_[1].through)) / choice;
        return {permuted(select(is_delta, {-wo_.x, -wo_.y, wo_.z}, wi), to_),
                permuted(select(is_delta, specular_ * sent, f.f_cos / f.pdf), to_),
                permuted(select(is_delta, choice, f.pdf), to_), by_lane(found), by_lane(found & is_delta)};
    }

private:
    using Facets = std::array<AlbedoTable::Row, 4>;
    using Coat = PlasticCoat<Float4, Facets>;

    // f(k, four) for as many fours as there are places; four: takes those of eight.
    template <class F>
    void for_fours(const F& f) const
    {
        f(size_t{0}, [](const auto& x) { return lower(x); });
        if (count_ > 4) f(size_t{1}, [](const auto& x) { return upper(x); });
    }
    template <class Four>
    Coat coat(const Four& four, size_t k) const
    {
        return {four(eta_), four(alpha_), four(mean_through_), facets_[k]};
    }
    uint32_t by_lane(Mask8 m) const { return bits(permuted(m, to_)) & lanes_; }
    BsdfValueLanes eval_lobes(const Vec3x8& wi) const
    {
        std::array<Coat::Value, 2> of{};
        for_fours([&](size_t k, auto four) { of[k] = coat(four, k).eval(seen_[k], four(wi)); });
        return {base_ * joined(of[0].base, of[1].base) + specular_ * joined(of[0].coat, of[1].coat),
                joined(of[0].pdf, of[1].pdf)};
    }
    // Directions that facets send the light to; some lie below the surface.
    Vec3x8 reflected(const Vec2x8& v) const
    {
        const SinCosT<Float8> phi = sin_cos_2pi(v.x);
        std::array<Vec3T<Float4>, 2> wi{};
        for_fours([&](size_t k, auto four) {
            const GgxT<Double4> facets{to_double(four(alpha_))};
            const Vec3T<Double4>& wo = seen_[k].wo;
            const Vec3T<Double4> h =
                facets.sample_visible(wo, to_double(four(v.y)), {to_double(four(phi.sin)), to_double(four(phi.cos))});
            wi[k] = to_float(mirrored(wo, h));
        });
        return joined(wi[0], wi[1]);
    }

    uint32_t count_, lanes_;
    UInt8 from_, to_;  // lane of each place, place of each lane
    // Of each place.
    Vec3x8 base_, specular_;  // the base as it is under the coat
    Float8 eta_, alpha_, mean_through_;
    std::array<Facets, 2> facets_;
    Vec3x8 wo_;
    std::array<Coat::Seen, 2> seen_;
};

}  // namespace lancer
