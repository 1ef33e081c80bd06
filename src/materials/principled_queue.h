// Batched evaluation of principled points, with the bits of PrincipledBsdf; but not of those whose clear part is
// smooth, thin or under a film.
#pragma once

#include <cassert>

#include "materials/lane_queue.h"
#include "materials/principled_bsdf.h"
#include "materials/rough_glass.h"

namespace lancer {

class PrincipledQueue : public LaneQueue {
public:
    // Inlined, as the call would cost as much as a part of what is copied.
    [[gnu::always_inline]] void add(Eight& of, uint32_t lane, const PrincipledBsdf& bsdf)
    {
        assert(bsdf.is_queued);
        const uint32_t k = add_to(of, lane);
        if (k % 4 == 0) points_[k / 4].begin();
        points_[k / 4].set(k % 4, bsdf);
    }
    // With another turn than its own.
    void add(Eight& of, uint32_t lane, const PrincipledBsdf& bsdf, Vec2 turn)
    {
        add(of, lane, bsdf);
        const uint32_t k = count_ - 1;
        points_[k / 4].turn_cos[k % 4] = turn.x, points_[k / 4].turn_sin[k % 4] = turn.y;
    }

    // After put_wo(), before all else.
    void see()
    {
        for (size_t k = 0; k < count_; k += 4) {
            Four::Seen& s = seen_[k / 4];
            s = {.wo = wo_.four(k), .o = unit_in_double(wo_.four(k))};
            lancer::see(points_[k / 4], s);
        }
    }

    // Of points with other than delta lobes.
    void eval()
    {
        const Float4 zero{};
        for (size_t k = 0; k < count_; k += 4) {
            const Four& points = points_[k / 4];
            const Vec3T<Float4> wi = wi_.four(k);
            Mask4f is_lit = wi.z > zero;
            if (points.kinds.clear) is_lit |= (wi.z < zero) & (points.clear > zero);
            is_lit &= wo_.z.four(k) > zero;
            if (!any_lane(is_lit)) {
                color_.set_four(k, {}), pdf_.set_four(k, zero);
                continue;
            }
            const Value f = eval_lobes(points, seen_[k / 4], wi);
            set_value(k, f, is_lit);
        }
    }

    void put_numbers(const Eight& of, const Float8& u, const Vec2x8& v, const Vec3x8& cosine)
    {
        LaneQueue::put_numbers(of, u, v, cosine);
        wi_.put(of, cosine);
        const SinCosT<Float8> phi = sin_cos_2pi(v.x);
        sin_.put(of, phi.sin), cos_.put(of, phi.cos);
    }
    void sample()
    {
        for (size_t k = 0; k < count_; k += 4) sample_four(k);
    }
    BsdfSampleLanes sampled(const Eight& of) const { return LaneQueue::sampled(of, eta_.of(of)); }

private:
    using Value = BsdfValueT<Vec3T<Float4>, Float4>;

    struct Four : PrincipledLayers<Float4> {
        RoughGlass4 glass{};  // what is let through, but for its tint

        // Of a group that is not full, no other point is asked.
        void begin()
        {
            fuzz = coat = Float4{};
            if (!kinds.any) return;
            if (kinds.clear) glass = {};
            static_cast<PrincipledExtras<Float4>&>(*this) = {};
            static_cast<PrincipledRows<Float4>&>(*this) = {};
            kinds = {};
        }
        void set(size_t i, const PrincipledBsdf& bsdf)
        {
            set_numbers<PrincipledNumbers>(i, bsdf);
            coat_row[i] = bsdf.coat_row, dielectric_row[i] = bsdf.dielectric_row, metal_row[i] = bsdf.metal_row;
            if (!bsdf.kinds.any) return;
            kinds.add(bsdf.kinds);
            if (bsdf.kinds.tint) set_numbers<PrincipledTint>(i, bsdf);
            if (bsdf.kinds.fuzz) set_numbers<PrincipledFuzz>(i, bsdf), fuzz_row[i] = bsdf.fuzz_row;
            if (bsdf.kinds.film) set_numbers<PrincipledFilm>(i, bsdf), film_table[i] = bsdf.film_table;
            if (bsdf.kinds.rough_body) set_numbers<PrincipledRoughBody>(i, bsdf);
            if (bsdf.kinds.clear) set_numbers<PrincipledClear>(i, bsdf), glass.set(i, bsdf.glass);
            if (bsdf.kinds.wide) {
                set_numbers<PrincipledWide>(i, bsdf);
                wide_dielectric[i] = bsdf.wide_dielectric, wide_metal[i] = bsdf.wide_metal;
            }
        }

    private:
        template <template <class> class Numbers>
        void set_numbers(size_t i, const Numbers<float>& one)
        {
            Numbers<Float4>& four = *this;
            static_assert(sizeof four == 4 * sizeof one);
            const auto* from = reinterpret_cast<const float*>(&one);
            auto* to = reinterpret_cast<float*>(&four) + i;
            for (size_t n = 0; n < sizeof one / sizeof(float); ++n) to[4 * n] = from[n];
        }
    };

    // As PrincipledBsdf::eval_lobes().
    static Value eval_lobes(const Four& points, const Four::Seen& s, const Vec3T<Float4>& wi)
    {
        Value f = eval_above(points, s, wi, unit_in_double(wi));
        if (!points.kinds.clear) return f;
        const Float4 zero{};
        const Mask4f is_above = wi.z > zero;
        f = {select(is_above, f.f_cos, {}), select(is_above, f.pdf, zero)};
        const Value g = eval_rough_glass(points.glass, s.o, wi);
        const Mask4f is_clear = (points.clear > zero) & (g.pdf > zero);
        const Vec3T<Float4> factor =
            product(s.under_coat, select(wi.z < zero, points.transmittance, points.specular)) * points.clear;
        f.f_cos += select(is_clear, product(g.f_cos, factor), {});
        f.pdf += select(is_clear, s.glass_chance * g.pdf, zero);
        return f;
    }

    // As PrincipledBsdf::sample().
    void sample_four(size_t k)
    {
        const Four& points = points_[k / 4];
        const Four::Seen& s = seen_[k / 4];
        const Float4 u = u_.four(k), zero{};
        const Value mirror = mirrored_by(points, s);
        const Float4 coat = select(points.coat_alpha > 0.0f, s.coat_chance, zero);
        const Float4 facets = select(points.facet_alpha > 0.0f, s.facet_chance, zero);
        const Float4 smooth = s.diffuse_chance + coat + facets + s.glass_chance;
        const Mask4f is_delta = (mirror.pdf > 0.0f) & ((u < mirror.pdf) | ~(smooth > 0.0f));
        // What is left of the number behind the lobes before.
        const Float4 at = u - mirror.pdf, by_others = at - s.diffuse_chance, by_base = by_others - coat;
        const Mask4f by_diffuse = (at < s.diffuse_chance) | ~(coat + facets + s.glass_chance > 0.0f);
        const Mask4f by_coat = (by_others < coat) | ~(facets + s.glass_chance > 0.0f);
        const Mask4f by_glass = ~is_delta & ~by_diffuse & ~by_coat & (s.glass_chance > zero) & ~(by_base < facets);
        const Mask4f by_facets = ~by_diffuse & ~is_delta & ~by_glass;
        const Mask4f by_wide = by_facets & ~by_coat & (points.across > zero);
        const SinCosT<Double4> phi{to_double(sin_.four(k)), to_double(cos_.four(k))};
        const Double4 v = to_double(v_y_.four(k));
        Vec3T<Float4> wi = wi_.four(k);
        if (any_lane(by_facets & ~by_wide)) {
            const GgxT<Double4> ggx{to_double(select(by_coat, points.coat_alpha, points.facet_alpha))};
            wi = select(by_facets, to_float(mirrored(s.o, ggx.sample_visible(s.o, v, phi))), wi);
        }
        if (any_lane(by_wide)) wi = select(by_wide, to_float(points.sample_wide(s.o, v, phi)), wi);
        Mask4f is_sent = wi.z > zero;
        Float4 eta = zero + 1.0f;
        if (any_lane(by_glass)) {
            const Float4 left = larger(zero, (by_base - facets) / s.glass_chance);
            const auto sent = sample_rough_glass(points.glass, s.o, s.wo.z, smaller(zero + last_number, left),
                                                 v_x_.four(k), v_y_.four(k), phi, by_glass);
            wi = select(by_glass, sent.wi, wi);
            is_sent = (by_glass & sent.found) | (~by_glass & is_sent);
            eta = select(by_glass & (wi.z < zero), to_float(points.glass.eta), eta);
        }
        const Value f = eval_lobes(points, s, wi);
        const Mask4f is_found = (s.wo.z > 0.0f) & (is_delta | ((smooth > 0.0f) & is_sent & (f.pdf > 0.0f)));
        const Float4 pdf = select(is_delta, mirror.pdf, f.pdf);
        wi_.set_four(k, select(is_delta, {-s.wo.x, -s.wo.y, s.wo.z}, wi));
        color_.set_four(k, select(is_delta, mirror.f_cos, f.f_cos) / pdf);
        pdf_.set_four(k, pdf), eta_.set_four(k, eta);
        found_.set_four(k, reinterpret_cast<Float4>(is_found)), delta_.set_four(k, reinterpret_cast<Float4>(is_delta));
    }

    static constexpr float last_number = 1 - 0x1p-24f;

    std::array<Four, most / 4> points_{};
    std::array<Four::Seen, most / 4> seen_{};
    Numbers<Float8> sin_{}, cos_{}, eta_{};
};

}  // namespace lancer
