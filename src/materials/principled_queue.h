// Batched evaluation of principled points that PrincipledLayers has all of, with the bits of PrincipledBsdf.
#pragma once

#include <cassert>

#include "materials/lane_queue.h"
#include "materials/principled_bsdf.h"

namespace lancer {

class PrincipledQueue : public LaneQueue {
public:
    // The BSDF must outlive the queue's use.
    void add(Eight& of, uint32_t lane, const PrincipledBsdf& bsdf)
    {
        assert(bsdf.has_only_layers);
        const uint32_t k = add_to(of, lane);
        // Of a group that is not full, no other point is asked.
        if (k % 4 == 0) points_[k / 4].fuzz = points_[k / 4].coat = Float4{}, points_[k / 4].has_tint = false;
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

    // Four points. What neither layers nor tables of facets have is asked of them one by one.
    struct Four : PrincipledLayers<Float4> {
        std::array<const PrincipledBsdf*, 4> of{};
        bool has_tint = false;

        void set(size_t i, const PrincipledBsdf& bsdf)
        {
            const PrincipledNumbers<float>& one = bsdf;
            PrincipledNumbers<Float4>& four = *this;
            static_assert(sizeof four == 4 * sizeof one);
            const auto* from = reinterpret_cast<const float*>(&one);
            auto* to = reinterpret_cast<float*>(&four) + i;
            for (size_t n = 0; n < sizeof one / sizeof(float); ++n) to[4 * n] = from[n];
            coat_row[i] = bsdf.coat_row, dielectric_row[i] = bsdf.dielectric_row, metal_row[i] = bsdf.metal_row;
            of[i] = &bsdf;
            has_tint = has_tint || bsdf.has_tinted_coat();
        }
        Float4 fuzz_albedo(Float4 cos) const
        {
            Float4 albedo{};
            for_each_lane(movemask(fuzz > 0.0f), [&](uint32_t i) { albedo[i] = of[i]->fuzz_albedo(cos[i]); });
            return albedo;
        }
        Float4 fuzz_value(const Vec3T<Float4>& wo, const Vec3T<Float4>& wi) const
        {
            Float4 f{};
            for_each_lane(movemask((fuzz > 0.0f) & (wi.z > 0.0f)), [&](uint32_t i) {
                f[i] = of[i]->fuzz_value({wo.x[i], wo.y[i], wo.z[i]}, {wi.x[i], wi.y[i], wi.z[i]});
            });
            return f;
        }
        Vec3T<Float4> tint_of_coat(Float4 cos) const
        {
            Vec3T<Float4> tint = grey(one());
            if (!has_tint) return tint;
            for_each_lane(movemask(coat > 0.0f), [&](uint32_t i) {
                const Color c = of[i]->tint_of_coat(cos[i]);
                tint.x[i] = c.r, tint.y[i] = c.g, tint.z[i] = c.b;
            });
            return tint;
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
        if (any_lane(~by_diffuse & ~is_delta)) {
            const GgxT<Double4> ggx{to_double(select(by_coat, points.coat_alpha, points.facet_alpha))};
            const Vec3T<Double4> h =
                ggx.sample_visible(s.o, to_double(v_y_.four(k)), {to_double(sin_.four(k)), to_double(cos_.four(k))});
            wi = select(by_diffuse, wi, to_float(mirrored(s.o, h)));
        }
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
