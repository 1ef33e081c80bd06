// Rows D7, D8 and D11: lobes of microfacets and others, from mirror to matt.
#include "app/run_program.h"
#include "io/scene/scene_file.h"
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/exact_ggx.h"
#include "support/facet_cells.h"

namespace lancer::stability {
namespace {

// The largest relative error of the density of normals and of a metal's value and density.
double error_of_density(float alpha)
{
    double worst = 0;
    for (const auto& [wo, wi] : pairs_of(alpha)) {
        const Long o = unit(wo), w = unit(wi), sum{o.x + w.x, o.y + w.y, o.z + w.z};
        const long double l = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
        const long double d = exact_density({sum.x / l, sum.y / l, sum.z / l}, alpha);
        const long double lambda_o = exact_lambda(o, alpha), lambda_i = exact_lambda(w, alpha);
        const BsdfValue v = MetalBsdf({1, 1, 1}, nullptr, alpha, nullptr).eval(wo, wi);
        const auto error = [&](double found, long double exact) {
            worst = std::max(worst, static_cast<double>(std::abs(found / exact - 1)));
        };
        error(Ggx{alpha}.density(unit_in_double(wo) + unit_in_double(wi)), d);
        error(double{v.f_cos.g}, d / (4 * o.z * (1 + lambda_o + lambda_i)));
        error(double{v.pdf}, d / (4 * o.z * (1 + lambda_o)));
    }
    return worst;
}

Outcome roughness(const Setup& setup)
{
    Outcome out;
    for (const float alpha : {1e-5f, 1e-4f, 1e-3f, 0.01f, 0.1f, 0.5f, 0.999f, 1.0f})
        out.measures.push_back(at_most("alpha " + significant(double{alpha}, 3) + ", error of the density",
                                       error_of_density(alpha), 1e-5));
    Claim sampled;
    const auto count = static_cast<int>(setup.scaled(20000, 1000000, 1000000));
    const auto nodes = static_cast<uint32_t>(setup.scaled(20, 160, 160));
    for (const float alpha : {1.0f, 0.5f, 0.1f, 0.01f, 0.001f})
        for (const float cos : {1.0f, 0.7f, 0.1f, 0.01f}) {
            const Metal metal{{0.9f, 0.6f, 0.3f}, std::sqrt(alpha)};
            const Glass glass{{1, 1, 1}, 1.5f, std::sqrt(alpha)};
            for (uint64_t seed = 1; seed <= setup.scaled(1, 1, 5); ++seed) {
                sampled.add(sample_lobe(metal.at({}), alpha, cos, count, seed, nodes).p);
                if (setup.tier == Tier::A) continue;
                sampled.add(sample_lobe(glass.at({.front = seed % 2 == 0}), alpha, cos, count, seed, nodes).p);
            }
        }
    out.measures.push_back(sampled.measure("samples against density"));
    const float r = std::sqrt(1e-3f);
    const Color gilt{1, 0.6f, 0.2f}, red{0.8f, 0.4f, 0.4f};
    const double step = std::max({largest_difference<Metal>({gilt, r}, {gilt, 0}),
                                  largest_difference<Metal>({gilt, r, gold()}, {gilt, 0, gold()}),
                                  largest_difference<Glass>({{1, 1, 1}, 1.5f, r}, {{1, 1, 1}, 1.5f}),
                                  largest_difference<Plastic>(make_plastic(red, r, 1.5f), make_plastic(red, 0, 1.5f))});
    out.measures.push_back(at_most("alpha 0.001 against smooth", step, 0.02));
    // What textures bring is moved inside; what a scene says must be there.
    const float nan = std::nanf("");
    out.measures.push_back(exactly("roughness 0, 1e-7, -1 and NaN of a texture: smooth",
                                   (alpha_of_roughness(0) == 0) + (alpha_of_roughness(1e-7f) == 0) +
                                       (alpha_of_roughness(-1) == 0) + (alpha_of_roughness(nan) == 0),
                                   4));
    out.measures.push_back(
        exactly("1 and more: alpha 1", (alpha_of_roughness(1) == 1) + (alpha_of_roughness(7) == 1), 2));
    const std::vector<std::string> wrong{"1.001", "-0.001", "nan", "inf", "-inf"};
    double refused = 0;
    for (const std::string& roughness : wrong) {
        Diagnostics problems;
        parse_scene("version = 1\n[material.a]\ntype = \"metal\"\nroughness = " + roughness +
                        "\n[[sphere]]\nradius = 1\nmaterial = \"a\"\n",
                    "a.toml", {}, problems);
        refused += problems.has_errors();
    }
    out.measures.push_back(
        exactly("roughness beyond 0 and 1, and NaN, refused", refused, static_cast<double>(wrong.size())));
    return out;
}

// Cosines and numbers at the ends of their ranges, and in between.
Outcome visible_normals(const Setup& setup)
{
    Outcome out;
    double not_finite = 0, not_seen = 0, tried = 0;
    const size_t each = setup.scaled(6000, 150000, 1500000);
    constexpr float last = 1 - 0x1p-24f;
    for (const float alpha : {1.0f, 0.1f, 0.01f, 1e-3f, 1e-4f})
        for (const float cos : {0.0f, 1e-30f, 1e-7f, 1e-4f, 0.01f, 0.1f, 0.5f, 0.9f, 1 - 1e-7f, 1.0f}) {
            const Vec3 wo{std::sqrt((1 - cos) * (1 + cos)), 0, cos};
            const Vec3d w = unit_in_double(wo);
            const MetalBsdf metal({1, 1, 1}, nullptr, alpha, nullptr);
            const GlassBsdf glass{.tint = {1, 1, 1}, .eta = 1.5, .alpha = alpha};
            Random random(std::bit_cast<uint32_t>(alpha) ^ uint64_t{std::bit_cast<uint32_t>(cos)} << 32);
            for (size_t i = 0; i < each; ++i, ++tried) {
                const auto number = [&] {
                    const float u = random.unit();
                    const uint32_t which = random.below(8);
                    return which == 0 ? 0.0f : which == 1 ? last : u;
                };
                const float u = number(), x = number(), y = number();
                const Vec3d h = Ggx{alpha}.sample_visible(w, {x, y});
                not_finite += !is_finite(h) || !(std::abs(length(h) - 1) < 1e-12);
                not_seen += cos > 0 && !(h.z > 0 && dot(w, h) > 0);
                const auto look = [&](const auto& bsdf) {
                    const auto s = bsdf.sample(wo, u, {x, y});
                    if (!s) return;
                    not_finite += !is_finite(s->wi) || !is_finite(s->weight) || !std::isfinite(s->pdf) || !(s->pdf > 0);
                };
                look(metal), look(glass);
            }
        }
    out.measures = {exactly("not finite, of " + significant(tried, 2), not_finite, 0),
                    exactly("normals that cannot be seen", not_seen, 0)};
    return out;
}

// f and f', exchanged, over the larger of both; through the surface seen from the other side, over the squared index.
// Of samples that promise it: layers of principled materials do not.
template <class M>
double worst_of(size_t pairs, const std::function<void(const std::string&, double)>& tell)
{
    double worst = 0;
    for (const Sample<M>& s : samples<M>()) {
        if (s.one_way) continue;
        double most = 0;
        Random random(11);
        for (size_t i = 0; i < pairs; ++i) {
            const bool front = i % 2 == 0;
            const auto bsdf = s.material.at({.front = front});
            if (bsdf.only_delta()) break;
            Vec3 a = random.unit_vector(), b = random.unit_vector();
            a.z = std::abs(a.z);
            const float u = random.unit();
            const Vec2 v = random.unit2();
            if (i % 4 < 2)
                if (const auto w = bsdf.sample(a, u, v)) b = w->wi;
            if (a.z == 0 || b.z == 0) continue;
            const bool through = b.z < 0;
            const auto other = s.material.at({.front = front != through});
            const double eta = through ? double{eta_through(bsdf)} : 1;
            const double there = double{bsdf.eval(a, b).f_cos.g} * (eta * eta / std::abs(double{b.z})),
                         back = double{other.eval(through ? -b : b, through ? -a : a).f_cos.g} / double{a.z};
            const double larger = std::max(there, back);
            if (larger > 1e-30) most = std::max(most, std::abs(there - back) / larger);
        }
        tell(std::string(std::string(name_of(M::type))) + " " + s.name, most);
        worst = std::max(worst, most);
    }
    return worst;
}

Outcome reciprocity(const Setup& setup)
{
    Outcome out;
    const size_t pairs = setup.scaled(8000, 1000000, 1000000);
    const auto over = [&]<class M>(M*) {
        out.measures.push_back(at_most(std::string(name_of(M::type)),
                                       worst_of<M>(pairs,
                                                   [&](const std::string& name, double worst) {
                                                       if (worst > 1e-5) out.measures.push_back(told(name, worst));
                                                   }),
                                       1e-5));
    };
    [&]<class... M>(std::variant<M...>*) { (over(static_cast<M*>(nullptr)), ...); }(static_cast<Material*>(nullptr));
    return out;
}

}  // namespace

std::vector<Row> facet_rows()
{
    return {
        {"D7", "roughness 0, 1e-7, 1e-4, 1e-3, 0.999, 1, beyond, NaN", "long double, chi-square", Tier::A, false,
         roughness},
        {"D8", "normals seen at cosines from 0 to 1, numbers at their ends", "policy", Tier::A, false, visible_normals},
        {"D11", "reciprocity of every material", "closed form", Tier::A, false, reciprocity}};
}

}  // namespace lancer::stability
