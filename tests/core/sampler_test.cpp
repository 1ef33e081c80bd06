// What every number must be, whichever sampler gives it: addressed, in [0, 1), uniform, and a stranger to the others.
#include "core/sampler.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/random.h"
#include "support/statistics/chi_square.h"

namespace lancer {
namespace {

constexpr std::array kinds{SamplerKind::sobol, SamplerKind::independent};
constexpr std::array dims{Dim::pixel, Dim::lens, Dim::light, Dim::bsdf, Dim::roulette};

struct Address {
    uint64_t seed = 0, pixel = 0;
    uint32_t sample = 0, branch = 0, bounce = 0;
    Dim dim = Dim::pixel;
};
std::array<float, 3> numbers_at(SamplerKind kind, const Address& a)
{
    const Sampler s(kind, a.seed, a.pixel, a.sample, a.branch);
    const Vec2 uv = s.get2(a.bounce, a.dim);
    return {uv.x, uv.y, s.get1(a.bounce, a.dim)};
}

TEST(Sampler, ANumberIsAFunctionOfItsAddress)
{
    Random random(30);
    for (const SamplerKind kind : kinds)
        for (int i = 0; i < 20000; ++i) {
            const Address a{random.bits() >> random.below(64),
                            random.below(1u << 26),
                            random.below(1u << 16),
                            random.below(4),
                            random.below(64),
                            dims[random.below(5)]};
            const auto here = numbers_at(kind, a);
            ASSERT_EQ(here, numbers_at(kind, a));
            for (const float x : here) ASSERT_TRUE(x >= 0 && x < 1);
            const uint64_t far = 1 + random.below(1u << 20);
            for (const uint64_t step : {uint64_t{1}, uint64_t{256}, far}) {
                const auto step32 = static_cast<uint32_t>(step);
                std::array<Address, 5> others{a, a, a, a, a};
                others[0].seed += step;
                others[1].pixel += step;
                others[2].sample += step32;
                others[3].branch += step32;
                others[4].bounce += step32;
                for (size_t k = 0; k < others.size(); ++k) ASSERT_NE(here, numbers_at(kind, others[k])) << k;
            }
            for (const Dim d : dims) {
                Address other = a;
                other.dim = d;
                ASSERT_EQ(here == numbers_at(kind, other), d == a.dim);
            }
        }
}

// Eight at once, fewer, and those of one sampler after another say what each alone says.
TEST(Sampler, NumbersPreparedForManyAreThoseOfEach)
{
    Random random(31);
    for (const SamplerKind kind : kinds)
        for (int round = 0; round < 2000; ++round) {
            std::vector<Sampler> samplers, alone;
            std::vector<uint32_t> bounces;
            const uint32_t n = 1 + random.below(16);
            const Dim dim = dims[random.below(5)];
            for (uint32_t i = 0; i < n; ++i) {
                samplers.emplace_back(kind, 7, random.below(1u << 26), random.below(1u << 20), random.below(3));
                bounces.push_back(random.below(32));
            }
            alone = samplers;
            SampleRequests<16> asked(dim);
            for (uint32_t i = 0; i < n; ++i) asked.add(samplers[i], bounces[i]);
            asked.prepare();
            for (uint32_t i = 0; i < n; ++i)
                for (const Dim d : dims) ASSERT_EQ(samplers[i].get2(bounces[i], d), alone[i].get2(bounces[i], d));
        }
}

// One number of each of many addresses that differ in one part only: uniform in 1-D and in every pair.
TEST(Sampler, NumbersOfDifferentAddressesAreUniform)
{
    constexpr uint32_t n = 1 << 16;
    const std::array<std::function<Address(uint32_t)>, 4> ways{
        [](uint32_t i) { return Address{.pixel = i}; },
        [](uint32_t i) { return Address{.pixel = i, .sample = 37, .bounce = 2, .dim = Dim::bsdf}; },
        [](uint32_t i) { return Address{.seed = i, .sample = 5, .dim = Dim::light}; },
        [](uint32_t i) { return Address{.pixel = 12345, .bounce = i, .dim = Dim::roulette}; }};
    const double level = sidak(claim_level, kinds.size() * ways.size() * 6);
    for (const SamplerKind kind : kinds)
        for (size_t way = 0; way < ways.size(); ++way) {
            std::array<std::vector<uint64_t>, 6> counts;
            for (auto& c : counts) c.resize(256);
            for (uint32_t i = 0; i < n; ++i) {
                const auto u = numbers_at(kind, ways[way](i));
                const auto cell = [&](size_t k, float m) { return static_cast<size_t>(u[k] * m); };
                for (size_t k = 0; k < 3; ++k) {
                    ++counts[k][cell(k, 256)];
                    ++counts[3 + k][cell(k, 16) * 16 + cell((k + 1) % 3, 16)];
                }
            }
            for (size_t k = 0; k < 6; ++k) EXPECT_GT(chi_square_uniform(counts[k]).p, level) << way << " " << k;
        }
}

// Correlation coefficients of uniform numbers, times sqrt(n), are standard normal: 4 is 6e-5 to either side.
TEST(Sampler, PixelsBouncesAndGroupsAreUncorrelated)
{
    constexpr uint32_t n = 1 << 16;
    const Address a{.sample = 3, .bounce = 1, .dim = Dim::bsdf};
    const auto shifted = [&](auto change) {
        Address b = a;
        change(b);
        return b;
    };
    const std::array others{shifted([](Address& x) { x.pixel += 1; }),  shifted([](Address& x) { x.pixel += 1920; }),
                            shifted([](Address& x) { x.bounce += 1; }), shifted([](Address& x) { x.dim = Dim::light; }),
                            shifted([](Address& x) { x.branch += 1; }), shifted([](Address& x) { x.seed += 1; })};
    for (const SamplerKind kind : kinds)
        for (size_t k = 0; k < others.size(); ++k)
            for (size_t i = 0; i < 3; ++i)
                for (size_t j = 0; j < 3; ++j) {
                    double sum = 0;
                    for (uint32_t p = 0; p < n; ++p) {
                        Address here = a, there = others[k];
                        here.pixel += 7 * p, there.pixel += 7 * p;
                        sum += (static_cast<double>(numbers_at(kind, here)[i]) - 0.5) *
                               (static_cast<double>(numbers_at(kind, there)[j]) - 0.5) * 12;
                    }
                    EXPECT_LT(std::abs(sum / std::sqrt(n)), 4) << k << " " << i << " " << j;
                }
}

// Within a pixel, over its samples: groups are padded by shuffling, which must leave no trace between them.
// Correlations of many pixels have mean 0; times sqrt(n) their mean square is 1 for independent numbers. For Sobol'
// points it is up to 2: a shuffle that keeps every aligned block together moves neighbours in the finest block as a
// pair.
TEST(Sampler, GroupsOfOnePixelAreUncorrelatedOverItsSamples)
{
    constexpr uint32_t n = 256, pixels = 400;
    const std::array<std::pair<Address, Address>, 4> pairs{{
        {{.dim = Dim::pixel}, {.dim = Dim::lens}},
        {{.dim = Dim::light}, {.dim = Dim::bsdf}},
        {{.bounce = 1, .dim = Dim::bsdf}, {.bounce = 2, .dim = Dim::bsdf}},
        {{.dim = Dim::bsdf}, {.dim = Dim::roulette}},
    }};
    const double level = sidak(claim_level, kinds.size() * pairs.size() * 9);
    for (const SamplerKind kind : kinds)
        for (size_t k = 0; k < pairs.size(); ++k) {
            std::array<std::array<double, 3>, 3> total{}, total_sq{};
            for (uint32_t p = 0; p < pixels; ++p) {
                std::array<std::array<double, 3>, 3> sum{};
                for (uint32_t s = 0; s < n; ++s) {
                    Address a = pairs[k].first, b = pairs[k].second;
                    a.pixel = b.pixel = p, a.sample = b.sample = s;
                    const auto x = numbers_at(kind, a), y = numbers_at(kind, b);
                    for (size_t i = 0; i < 3; ++i)
                        for (size_t j = 0; j < 3; ++j)
                            sum[i][j] += (static_cast<double>(x[i]) - 0.5) * (static_cast<double>(y[j]) - 0.5) * 12;
                }
                for (size_t i = 0; i < 3; ++i)
                    for (size_t j = 0; j < 3; ++j) {
                        const double r = sum[i][j] / std::sqrt(n);
                        total[i][j] += r, total_sq[i][j] += r * r;
                    }
            }
            const double most = kind == SamplerKind::sobol ? 2 : 1;
            for (size_t i = 0; i < 3; ++i)
                for (size_t j = 0; j < 3; ++j) {
                    // The square of a standard normal variable is chi-square of one degree.
                    const double z = total[i][j] / std::sqrt(total_sq[i][j]);
                    EXPECT_GT(chi_square_survival(z * z, 1), level) << k << " " << i << " " << j << " " << z;
                    EXPECT_GT(chi_square_survival(total_sq[i][j] / most, pixels), level)
                        << k << " " << i << " " << j << " " << total_sq[i][j] / pixels;
                }
        }
}

}  // namespace
}  // namespace lancer
