// What every material must obey, whatever it is: sample(), eval() and the densities speak of the same thing, nothing
// gains energy, light may travel both ways. Over every alternative of Material.
#include <gtest/gtest.h>

#include "core/ray.h"
#include "materials/alternatives.h"
#include "materials/samples.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

struct Names {
    template <class M>
    static std::string GetName(int)
    {
        return std::string(name_of(M::type));
    }
};
template <class M>
class MaterialLaws : public testing::Test {
};
TYPED_TEST_SUITE(MaterialLaws, Alternatives<Material>::Types, Names);

// Both sides of the laws below are a handful of products and quotients.
constexpr float rounding = gamma(16);
constexpr std::array channels{&Color::r, &Color::g, &Color::b};

// The five nodes and weights of Gauss and Legendre on [0, 1].
constexpr std::array<double, 5> node{0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                     0.95308992296933200};
constexpr std::array<double, 5> node_weight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                            0.23931433524968324, 0.11846344252809454};

// The sphere of directions in cells of equal size in phi and in the root of cos(theta), so that they are small near the
// horizon, where lobes seen from grazing are thin.
constexpr size_t rings = 32, sectors = 24;

size_t cell_of(Vec3 w)
{
    const double z = 0.5 * (1 + std::copysign(std::sqrt(std::abs(static_cast<double>(w.z))), static_cast<double>(w.z)));
    const double phi = static_cast<double>(std::atan2(w.y, w.x)) / (2 * std::numbers::pi);
    const auto at = [](double x, size_t n) { return std::min(n - 1, static_cast<size_t>(x * static_cast<double>(n))); };
    return at(z, rings) * sectors + at(phi < 0 ? phi + 1 : phi, sectors);
}

// Integral of f(wi) over a piece of the sphere: `root` and `turn` are the coordinates that the cells divide, from -1 to
// 1 and from 0 to 1. In quarters, and these again, until that changes nearly nothing: near grazing lobes have thin
// peaks. Where one division changes 1e-5, the next changes a small part of that.
struct Piece {
    double root, turn, root_size, turn_size;
};
template <class F>
double integrate_once(const F& f, const Piece& p)
{
    double sum = 0;
    for (size_t b = 0; b < 5; ++b) {
        const double phi = 2 * std::numbers::pi * (p.turn + node[b] * p.turn_size);
        const double cos = std::cos(phi), sin = std::sin(phi);
        for (size_t a = 0; a < 5; ++a) {
            const double root = p.root + node[a] * p.root_size, z = root * std::abs(root), r = std::sqrt(1 - z * z);
            sum += node_weight[a] * node_weight[b] * std::abs(root) * f(to_float(Vec3d{r * cos, r * sin, z}));
        }
    }
    return sum * 4 * std::numbers::pi * p.root_size * p.turn_size;
}
template <class F>
double integrate_piece(const F& f, const Piece& p, double whole, int depth)
{
    const double h = 0.5 * p.root_size, w = 0.5 * p.turn_size;
    std::array<Piece, 4> quarters;
    std::array<double, 4> parts;
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) {
        quarters[i] = {p.root + (i & 1 ? h : 0), p.turn + (i & 2 ? w : 0), h, w};
        sum += parts[i] = integrate_once(f, quarters[i]);
    }
    if (depth == 0 || std::abs(sum - whole) < 1e-5) return sum;
    sum = 0;
    for (size_t i = 0; i < 4; ++i) sum += integrate_piece(f, quarters[i], parts[i], depth - 1);
    return sum;
}

// Over each cell.
template <class F>
std::vector<double> integrate_cells(const F& f)
{
    std::vector<double> cells(rings * sectors);
    for (size_t i = 0; i < rings; ++i)
        for (size_t j = 0; j < sectors; ++j) {
            const Piece p{2.0 * static_cast<double>(i) / rings - 1, static_cast<double>(j) / sectors, 2.0 / rings,
                          1.0 / sectors};
            cells[i * sectors + j] = integrate_piece(f, p, integrate_once(f, p), 6);
        }
    return cells;
}

double sum(const std::vector<double>& v)
{
    double s = 0;
    for (const double x : v) s += x;
    return s;
}

// Smooth lobes by cell, delta lobes by side, and what is absorbed: how often each happens is what the densities say.
TYPED_TEST(MaterialLaws, FrequenciesAreThoseOfTheDensities)
{
    constexpr int count = 100000;
    stats::Family family;
    Random random(1);
    for_each_bsdf<TypeParam>([&](const std::string& name, const auto& sample, const Place& p, const auto& bsdf) {
        if (sample.narrow) return;
        const auto from = seen(bsdf, p.wo);
        std::vector<double> expected =
            integrate_cells([&](Vec3 wi) { return static_cast<double>(bsdf.eval(from, wi).pdf); });
        std::vector<uint64_t> observed(expected.size());
        std::array<double, 2> delta_pdf{};
        std::array<uint64_t, 2> delta_count{};
        uint64_t absorbed = 0;
        for (int i = 0; i < count; ++i) {
            const float u = random.unit();
            const auto s = bsdf.sample(from, u, random.unit2());
            if (!s) {
                ++absorbed;
            } else if (s->delta) {
                const size_t side = s->wi.z < 0 ? 1 : 0;
                EXPECT_TRUE(delta_count[side] == 0 || delta_pdf[side] == static_cast<double>(s->pdf)) << name;
                delta_pdf[side] = static_cast<double>(s->pdf);
                ++delta_count[side];
            } else {
                ++observed[cell_of(s->wi)];
            }
        }
        const double smooth = sum(expected), total = smooth + delta_pdf[0] + delta_pdf[1];
        EXPECT_LE(total, 1 + 1e-5) << name;
        for (double& e : expected) e *= count;
        for (size_t side = 0; side < 2; ++side) {
            expected.push_back(count * delta_pdf[side]);
            observed.push_back(delta_count[side]);
        }
        // Where nothing is absorbed, not one sample may be.
        expected.push_back(count * (total < 1 - 1e-5 ? 1 - total : sample.sheds ? 1e-5 : 0));
        observed.push_back(absorbed);
        family.add(chi_square_test(observed, expected).p, name);
    });
}

TYPED_TEST(MaterialLaws, WeightIsValueOverDensity)
{
    Random random(2);
    for_each_bsdf<TypeParam>([&](const std::string& name, const auto&, const Place& p, const auto& bsdf) {
        for (int i = 0; i < 1000; ++i) {
            const float u = random.unit();
            const auto s = bsdf.sample(p.wo, u, random.unit2());
            if (!s) continue;
            ASSERT_GT(s->pdf, 0) << name;
            ASSERT_NEAR(length(s->wi), 1, gamma(16)) << name;
            if (s->delta) {
                ASSERT_LE(s->pdf, 1) << name;
                continue;
            }
            const BsdfValue v = bsdf.eval(p.wo, s->wi);
            ASSERT_NEAR(s->pdf, v.pdf, rounding * v.pdf) << name;
            for (const auto channel : channels)
                ASSERT_NEAR(s->weight.*channel * v.pdf, v.f_cos.*channel, rounding * v.f_cos.*channel) << name;
        }
    });
}

TYPED_TEST(MaterialLaws, LobesAreWhereTheyAreSaidToBe)
{
    Random random(3);
    for_each_bsdf<TypeParam>([&](const std::string& name, const auto&, const Place& p, const auto& bsdf) {
        bool smooth = false, through = false;
        for (int i = 0; i < 1000; ++i) {
            const float u = random.unit();
            const auto s = bsdf.sample(p.wo, u, random.unit2());
            const Vec3 wi = s && !s->delta ? s->wi : random.unit_vector();
            const bool shines = bsdf.eval(p.wo, wi).pdf > 0;
            smooth = smooth || (s && !s->delta) || shines;
            through = through || (shines && wi.z < 0);
        }
        EXPECT_EQ(bsdf.only_delta(), !smooth) << name;
        // Seen from above nothing is reflected totally.
        if (through || p.wo.z > 0.9f) {
            EXPECT_EQ(bsdf.transmits(), through) << name;
        }
    });
}

// The diffuse part is a part of the value, does not depend on the azimuth, and shines on wo's side alone.
TYPED_TEST(MaterialLaws, TheDiffusePartIsAPartAndEvenAllRound)
{
    Random random(7);
    for_each_bsdf<TypeParam>([&](const std::string& name, const auto& sample, const Place& p, const auto& bsdf) {
        for (int i = 0; i < 300; ++i) {
            Vec3 wi = random.unit_vector();
            if (const auto s = bsdf.sample(p.wo, random.unit(), random.unit2()); i % 2 == 0 && s) wi = s->wi;
            const Color some = bsdf.eval_diffuse(p.wo, wi), all = bsdf.eval(p.wo, wi).f_cos;
            const Color turned = bsdf.eval_diffuse(p.wo, {-wi.y, wi.x, wi.z});
            for (const auto channel : channels) {
                ASSERT_GE(some.*channel, 0) << name;
                ASSERT_LE(some.*channel, all.*channel * (1 + rounding)) << name;
                if (!sample.uneven) {
                    ASSERT_NEAR(some.*channel, turned.*channel, rounding * some.*channel) << name;
                }
            }
            if (wi.z < 0) {
                ASSERT_EQ(some, Color{}) << name;
            }
        }
    });
}

// No direction sends back more than it got, in energy: radiance grows by eta^2 where light enters what is denser.
// What loses nothing is exactly white.
TYPED_TEST(MaterialLaws, WhiteFurnace)
{
    stats::Family family;
    Random random(4);
    for_each_bsdf<TypeParam>(
        [&](const std::string& name, const Sample<TypeParam>& sample, const Place& p, const auto& bsdf) {
            // Lobes may differ in their hues, so that each channel is judged by itself.
            std::array<stats::Tally, 3> energy;
            const auto from = seen(bsdf, p.wo);
            for (int i = 0; i < 10000; ++i) {
                const float u = random.unit();
                const auto s = bsdf.sample(from, u, random.unit2());
                const Color e = s ? s->weight * (s->eta * s->eta) : Color{};
                for (size_t c = 0; c < 3; ++c) energy[c].add(double{e.*channels[c]});
            }
            const double bound = sample.tolerance + static_cast<double>(rounding);
            for (const stats::Tally& e : energy) {
                EXPECT_LE(e.mean - 5 * e.error(), 1 + bound) << name;
                if (sample.lossless) family.add(stats::mean_p(e, 1, bound), name);
            }
            if (sample.narrow) return;
            const float eta = eta_through(bsdf);
            const auto albedo = [&](const auto& part) {
                return sum(integrate_cells([&](Vec3 wi) {
                    const float e = part(bsdf.eval(from, wi).f_cos);
                    return static_cast<double>(wi.z < 0 ? e * (eta * eta) : e);
                }));
            };
            // The largest channel of each direction bounds all three; of several hues it may exceed them.
            const double smooth_bound = 1 + 1e-5 + sample.tolerance;
            const double smooth = albedo([](Color c) { return max_component(c); });
            if (smooth > smooth_bound) {
                for (const auto channel : channels)
                    EXPECT_LE(albedo([&](Color c) { return c.*channel; }), smooth_bound) << name;
            }
            if (bsdf.only_delta()) {
                EXPECT_EQ(smooth, 0) << name;
            }
        });
    if (std::none_of(samples<TypeParam>().begin(), samples<TypeParam>().end(),
                     [](const auto& s) { return s.lossless; }))
        family.add(1, "no lossless parameter set");
}

// Also through the surface: seen from the other side its z axis is turned round, and what f says of radiance it says of
// radiance over the squared index.
TYPED_TEST(MaterialLaws, SmoothLobesAreReciprocal)
{
    Random random(5);
    for (const Sample<TypeParam>& s : samples<TypeParam>()) {
        if (s.one_way) continue;
        int lit = 0;
        for (int i = 0; i < 20000; ++i) {
            const bool front = i % 2 == 0;
            const auto bsdf = s.material.at({.front = front});
            Vec3 a = random.unit_vector(), b = random.unit_vector();
            a.z = std::abs(a.z);
            if (const auto w = bsdf.sample(a, random.unit(), {0.3f, 0.6f}); i % 4 < 2 && w) b = w->wi;
            if (a.z == 0 || b.z == 0) continue;
            const bool through = b.z < 0;
            const auto other = s.material.at({.front = front != through});
            const Vec3 from = through ? -b : b, to = through ? -a : a;
            const float eta = through ? eta_through(bsdf) : 1;
            const Color there = bsdf.eval(a, b).f_cos * (eta * eta / std::abs(b.z));
            const Color back = other.eval(from, to).f_cos / a.z;
            lit += is_black(there) ? 0 : 1;
            // 1 / ior is rounded: a step aside for a narrow lobe, and much near the critical angle of a facet.
            const float smallest = std::numeric_limits<float>::min();  // what is less has fewer bits
            const float floor = is_black(there) || !through ? smallest : 1e-6f + 4e-7f / alpha_of(bsdf) * there.g;
            for (const auto channel : channels)
                ASSERT_NEAR(there.*channel, back.*channel, rounding * there.*channel + floor)
                    << s.name << " " << a.z << " " << b.z;
        }
        const auto bsdf = s.material.at({});
        if (!is_black(bsdf.reflectance()) && !bsdf.only_delta()) {
            EXPECT_GT(lit, 5000) << s.name;
        }
    }
}

// The way back of a delta lobe: from where it went it returns where it came from, as likely, and, in energy, with the
// same weight. Seen from the other side the local z axis turns round.
TYPED_TEST(MaterialLaws, DeltaLobesAreReciprocal)
{
    Random random(6);
    for_each_bsdf<TypeParam>(
        [&](const std::string& name, const Sample<TypeParam>& sample, const Place& p, const auto& bsdf) {
            if (sample.one_way) return;
            for (int i = 0; i < 50; ++i) {
                const auto there = bsdf.sample(p.wo, random.unit(), random.unit2());
                if (!there || !there->delta) continue;
                const bool through = there->wi.z < 0;
                const Vec3 from = through ? Vec3{there->wi.x, there->wi.y, -there->wi.z} : there->wi;
                const Vec3 home = through ? Vec3{p.wo.x, p.wo.y, -p.wo.z} : p.wo;
                const auto other = sample.material.at({.front = p.point.front != through});
                // u at the same place within the lobe, reflection first.
                const auto back = other.sample(from, through ? 1 - 0x1p-24f : 0, {});
                ASSERT_TRUE(back && back->delta) << name;
                // By Snell's law cos_t changes by cos_i / (cos_t eta^2) times what cos_i does; here the way back is
                // looked at.
                const float stretch = through ? from.z / std::abs(home.z) * (there->eta * there->eta) : 1;
                const float bound = gamma(16) * (1 + stretch);
                ASSERT_LE(length(back->wi - home), bound) << name;
                // Near grazing a reflectance changes by up to 4 / cos times what the cosine does; and with it the
                // weight of what shares chances with other lobes.
                const float grazing = bound + gamma(16) / std::min(from.z, std::abs(home.z));
                ASSERT_NEAR(back->pdf, there->pdf, grazing) << name;
                ASSERT_NEAR(back->eta * there->eta, 1, gamma(4)) << name;
                for (const auto channel : channels)
                    ASSERT_NEAR(back->weight.*channel * back->eta * back->eta,
                                there->weight.*channel * there->eta * there->eta, grazing)
                        << name;
            }
        });
}

TYPED_TEST(MaterialLaws, NothingIsNotANumberNorOnTheWrongSide)
{
    constexpr float tiny = 0x1p-149f;
    for (const Sample<TypeParam>& m : samples<TypeParam>())
        for (const bool front : {true, false})
            for (const float z :
                 {1.0f, 0.999999f, 0.3f, 1e-3f, 1e-7f, 1e-20f, 1e-30f, tiny, 0.0f, -0.0f, -1e-7f, -1.0f}) {
                const auto bsdf = m.material.at({.front = front});
                const Vec3 wo{std::sqrt(std::max(0.0f, 1 - z * z)), 0, z};
                for_each_extreme_number([&](float u, Vec2 v) {
                    const auto s = bsdf.sample(wo, u, v);
                    if (z <= 0) {
                        ASSERT_FALSE(s) << m.name << " sampled from below";
                        return;
                    }
                    if (!s) return;
                    ASSERT_TRUE(is_finite(s->wi) && is_finite(s->weight) && std::isfinite(s->eta)) << m.name << z;
                    ASSERT_TRUE(std::isfinite(s->pdf) && s->pdf > 0 && s->eta > 0) << m.name << z;
                    ASSERT_TRUE(m.transmits || s->wi.z > 0) << m.name << z;
                    ASSERT_NE(s->wi.z, 0) << m.name << z;
                    ASSERT_TRUE(s->eta == 1 || s->wi.z < 0) << m.name << z;
                    const BsdfValue e = bsdf.eval(wo, s->wi);
                    ASSERT_TRUE(is_finite(e.f_cos) && std::isfinite(e.pdf) && e.pdf >= 0) << m.name << z;
                });
                for (const float other : {1.0f, 1e-7f, 1e-20f, tiny, 0.0f, -0.0f, -1e-20f, -1.0f}) {
                    const Vec3 wi{0, std::sqrt(std::max(0.0f, 1 - other * other)), other};
                    const BsdfValue e = bsdf.eval(wo, wi);
                    ASSERT_TRUE(is_finite(e.f_cos) && std::isfinite(e.pdf) && e.pdf >= 0) << m.name << z << other;
                    if (!m.transmits && (z <= 0 || other <= 0)) {
                        ASSERT_TRUE(is_black(e.f_cos) && e.pdf == 0) << m.name << z << other;
                    }
                }
            }
}

}  // namespace
}  // namespace lancer
