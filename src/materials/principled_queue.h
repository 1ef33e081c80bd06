// Batched evaluation of principled points that PrincipledLayers has all of, with the bits of PrincipledBsdf.
#pragma once

#include <cassert>

#include "materials/lane_queue.h"
#include "materials/principled_bsdf.h"

namespace lancer {

class PrincipledQueue : public LaneQueue {
public:
    void add(Eight& of, uint32_t lane, const PrincipledBsdf& bsdf)
    {
        assert(bsdf.has_only_layers);
        const uint32_t k = add_to(of, lane);
        if (k % 4 == 0) points_[k / 4].begin();
        points_[k / 4].set(k % 4, bsdf);
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
            const Vec3T<Float4> wi = wi_.four(k);
            const Mask4f is_lit = (wo_.z.four(k) > zero) & (wi.z > zero);
            if (!any_lane(is_lit)) {
                color_.set_four(k, {}), pdf_.set_four(k, zero);
                continue;
            }
            const Value f = eval_above(points_[k / 4], seen_[k / 4], wi, unit_in_double(wi));
            color_.set_four(k, select(is_lit, f.f_cos, {}));
            pdf_.set_four(k, select(is_lit, f.pdf, zero));
        }
    }

    // u selects the lobe, v the direction; cosine: square_to_cosine_hemisphere() of v.
    void put_numbers(const Eight& of, const Float8& u, const Vec2x8& v, const Vec3x8& cosine)
    {
        u_.put(of, u), v_y_.put(of, v.y), wi_.put(of, cosine);
        const SinCosT<Float8> phi = sin_cos_2pi(v.x);
        sin_.put(of, phi.sin), cos_.put(of, phi.cos);
    }
    void sample()
    {
        for (size_t k = 0; k < count_; k += 4) sample_four(k);
    }

private:
    using Value = BsdfValueT<Vec3T<Float4>, Float4>;

    struct Four : PrincipledLayers<Float4> {
        // Of a group that is not full, no other point is asked.
        void begin()
        {
            fuzz = coat = Float4{};
            if (!kinds.any()) return;
            static_cast<PrincipledExtras<Float4>&>(*this) = {};
            static_cast<PrincipledRows<Float4>&>(*this) = {};
            kinds = {};
        }
        void set(size_t i, const PrincipledBsdf& bsdf)
        {
            set_numbers<PrincipledNumbers>(i, bsdf);
            coat_row[i] = bsdf.coat_row, dielectric_row[i] = bsdf.dielectric_row, metal_row[i] = bsdf.metal_row;
            if (!bsdf.kinds.any()) return;
            kinds.add(bsdf.kinds);
            set_numbers<PrincipledExtras>(i, bsdf);
            fuzz_row[i] = bsdf.fuzz_row, film_table[i] = bsdf.film_table;
            if (bsdf.kinds.wide) wide_dielectric[i] = bsdf.wide_dielectric, wide_metal[i] = bsdf.wide_metal;
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

    // As PrincipledBsdf::sample() without what goes through.
    void sample_four(size_t k)
    {
        const Four& points = points_[k / 4];
        const Four::Seen& s = seen_[k / 4];
        const Float4 u = u_.four(k), zero{};
        const Value mirror = mirrored_by(points, s);
        const Float4 coat = select(points.coat_alpha > 0.0f, s.coat_chance, zero);
        const Float4 facets = select(points.facet_alpha > 0.0f, s.facet_chance, zero);
        const Float4 smooth = s.diffuse_chance + coat + facets;
        const Mask4f is_delta = (mirror.pdf > 0.0f) & ((u < mirror.pdf) | ~(smooth > 0.0f));
        const Float4 at = u - mirror.pdf, behind = at - s.diffuse_chance;
        const Mask4f by_diffuse = (at < s.diffuse_chance) | ~(coat + facets > 0.0f);
        const Mask4f by_coat = (behind < coat) | ~(facets > 0.0f);
        Vec3T<Float4> wi = wi_.four(k);
        const Mask4f by_facets = ~by_diffuse & ~is_delta, by_wide = by_facets & ~by_coat & (points.across > zero);
        const SinCosT<Double4> phi{to_double(sin_.four(k)), to_double(cos_.four(k))};
        const Double4 v = to_double(v_y_.four(k));
        if (any_lane(by_facets & ~by_wide)) {
            const GgxT<Double4> ggx{to_double(select(by_coat, points.coat_alpha, points.facet_alpha))};
            wi = select(by_facets, to_float(mirrored(s.o, ggx.sample_visible(s.o, v, phi))), wi);
        }
        if (any_lane(by_wide)) wi = select(by_wide, to_float(points.sample_wide(s.o, v, phi)), wi);
        const Value f = eval_above(points, s, wi, unit_in_double(wi));
        const Mask4f is_found = (s.wo.z > 0.0f) & (is_delta | ((smooth > 0.0f) & (wi.z > 0.0f) & (f.pdf > 0.0f)));
        const Float4 pdf = select(is_delta, mirror.pdf, f.pdf);
        wi_.set_four(k, select(is_delta, {-s.wo.x, -s.wo.y, s.wo.z}, wi));
        color_.set_four(k, select(is_delta, mirror.f_cos, f.f_cos) / pdf);
        pdf_.set_four(k, pdf);
        found_.set_four(k, reinterpret_cast<Float4>(is_found)), delta_.set_four(k, reinterpret_cast<Float4>(is_delta));
    }

    std::array<Four, most / 4> points_{};
    std::array<Four::Seen, most / 4> seen_{};
    Numbers<Float8> v_y_{}, sin_{}, cos_{};
};

}  // namespace lancer
