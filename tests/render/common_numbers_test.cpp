// Random numbers that neighbours have in common, and what their differences tell.
#include "render/common_numbers.h"

#include <gtest/gtest.h>

#include "support/shoot.h"

namespace lancer {
namespace {

SplitVertex floor_at(float x, float width = 0.01f) { return {{0, 1, 0}, {x, 0, 0}, width, 3, {0.5f, 0.25f, 1}}; }

std::vector<Found> square_of(size_t n, const SplitVertex& at, uint32_t seed = 1)
{
    std::vector<Found> square;
    for (uint32_t i = 0; i < n; ++i) {
        const Sampler numbers(SamplerKind::independent, seed, i, 0, 0);
        const Vec2 u = numbers.get2(0, Dim::pixel), v = numbers.get2(1, Dim::pixel);
        square.push_back({{i % 8, i / 8, 0}, {u.x, u.y, v.x}, {v.y - 0.5f, u.x - v.x, u.y - 0.5f}, at});
    }
    return square;
}

// The best linear prediction from what it is the best one of: W = Cov(error, D) Cov(D)^-1, by Gauss elimination.
std::vector<double> best_prediction(const std::vector<Found>& square)
{
    const size_t n = square.size();
    const auto alike = [&](size_t i, size_t j) {
        return double{likeness} * double{kinship(square[i].at, square[j].at)};
    };
    std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1));
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j < n; ++j) rows[i][j] = i == j ? 2 : alike(i, j);
        rows[i][n] = 2 * double{square[i].difference.g};
    }
    for (size_t k = 0; k < n; ++k)
        for (size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            const double f = rows[i][k] / rows[k][k];
            for (size_t j = k; j <= n; ++j) rows[i][j] -= f * rows[k][j];
        }
    std::vector<double> light;
    for (size_t i = 0; i < n; ++i) {
        double error = 0;  // Cov(error_i, D_j) = (s^2 [i = j] - s^2 r_ij) / 2
        for (size_t j = 0; j < n; ++j) error -= i == j ? 0 : 0.5 * alike(i, j) * rows[j][n] / rows[j][j];
        light.push_back(double{square[i].light.g} - error);
    }
    return light;
}

// Places of which each is told apart from all others, so that all are pivots; and any number that are the same.
TEST(CommonNumbers, TellWhatTheBestLinearPredictionTells)
{
    for (const size_t n : {1u, 2u, 7u, 8u, 9u, 64u})
        for (const bool same : {true, false}) {
            std::vector<Found> square = square_of(n, floor_at(0));
            if (!same) square.resize(std::min<size_t>(n, 16));
            for (size_t i = 0; i < square.size() && !same; ++i) square[i].at = floor_at(static_cast<float>(i) * 0.21f);
            const auto light = light_of_square(square).light;
            const std::vector<double> best = best_prediction(square);
            for (size_t i = 0; i < square.size(); ++i)
                EXPECT_NEAR(double{light[i].g}, best[i], 4e-6) << n << " " << same;
        }
}

// Of places on a ball and a wall behind it, some are pivots and tell of the others: nearly as well as each would.
TEST(CommonNumbers, FewPlacesTellOfTheOthers)
{
    std::vector<Found> square = square_of(64, floor_at(0));
    for (size_t i = 0; i < 64; ++i) {
        const float x = 0.01f * static_cast<float>(i % 8), y = 0.01f * static_cast<float>(i / 8), r = x * x + y * y;
        square[i].at = floor_at(0);
        square[i].at.p = {x, y, r < 0.004f ? std::sqrt(0.004f - r) : -1};
        square[i].at.n = r < 0.004f ? normalize(square[i].at.p) : Vec3{0, 0, 1};
    }
    const auto light = light_of_square(square).light;
    const std::vector<double> best = best_prediction(square);
    double moved = 0, missed = 0;
    for (size_t i = 0; i < 64; ++i) {
        const double found = double{square[i].light.g};
        moved += (best[i] - found) * (best[i] - found);
        missed += (best[i] - double{light[i].g}) * (best[i] - double{light[i].g});
    }
    EXPECT_LT(missed, 0.05 * moved);
}

// Errors drawn as they are believed to be: what is said of the variances is so, and less is left than was found.
TEST(CommonNumbers, SayHowMuchErrorIsLeft)
{
    for (const uint32_t n : {2u, 40u}) {
        stats::Tally told, said, found, said_found, together;
        for (uint32_t trial = 0; trial < 4000; ++trial) {
            std::vector<Found> square = square_of(n, floor_at(0), trial);
            const Sampler numbers(SamplerKind::independent, 77, trial, 0, 0);
            const auto noise = [&](uint32_t i) {
                const Vec2 u = numbers.get2(i, Dim::light);
                return std::sqrt(-2 * std::log(1 - u.x)) * std::cos(6.2831853f * u.y);
            };
            const float shared = noise(1000);
            for (uint32_t i = 0; i < n; ++i) {
                const float scale = 1 + 0.1f * static_cast<float>(i % 7), alike = i % 3 ? 0.9f : 0.3f;
                square[i].at = floor_at(0.004f * static_cast<float>(i % 20));
                square[i].at.scale = Color{1, 1, 1} * scale;
                const float own = scale * noise(2 * i);
                const float common = scale * (std::sqrt(alike) * shared + std::sqrt(1 - alike) * noise(2 * i + 1));
                square[i].light = Color{1, 1, 1} * (own + common);
                square[i].difference = Color{1, 1, 1} * (own - common);
            }
            const SquareLight s = light_of_square(square);
            double left = 0, before = 0, sum = 0, of_sum = s.variance;
            for (size_t i = 0; i < n; ++i) {
                sum += double{luminance(s.light[i])}, of_sum += s.together[i];
                left += double{luminance(s.light[i])} * double{luminance(s.light[i])};
                before += double{luminance(square[i].light)} * double{luminance(square[i].light)};
            }
            told.add(left - s.variance), said.add(s.variance);
            found.add(before - s.found_variance), said_found.add(s.found_variance);
            together.add(sum * sum - of_sum);
        }
        EXPECT_GT(stats::mean_p(told, 0), 1e-4);
        EXPECT_GT(stats::mean_p(found, 0), 1e-4);
        EXPECT_GT(stats::mean_p(together, 0), 1e-4);
        EXPECT_LT(said.mean, (n == 2 ? 1 : 0.8) * said_found.mean);
    }
}

// Where a texture is half as bright, so is what a pixel errs by.
TEST(CommonNumbers, TellOfLightNotOfTheSurface)
{
    std::vector<Found> bright = square_of(16, floor_at(0)), dim = bright;
    for (size_t i = 0; i < 16; i += 3) {
        const float by = i % 2 ? 0.5f : 0.125f;
        dim[i].light *= by, dim[i].difference *= by, dim[i].at.scale *= by;
    }
    const auto of_bright = light_of_square(bright).light, of_dim = light_of_square(dim).light;
    for (size_t i = 0; i < 16; ++i) {
        const float by = i % 3 ? 1 : i % 2 ? 0.5f : 0.125f;
        EXPECT_TRUE(of_dim[i] == of_bright[i] * by) << i;
    }
}

TEST(CommonNumbers, TellNothingOfPlacesThatAreNotAlike)
{
    std::vector<Found> square = square_of(16, floor_at(0));
    square[3].at.material = 4;
    square[5].at = {};
    square[6].difference.g = std::numeric_limits<float>::quiet_NaN();
    square[7].light.r = std::numeric_limits<float>::infinity();
    square[8].at.width = 0;
    const auto light = light_of_square(square).light;
    for (const size_t alone : {3u, 5u, 6u, 7u, 8u}) EXPECT_TRUE(light[alone] == square[alone].light) << alone;
    std::vector<Found> others;
    for (const size_t i : {0u, 1u, 2u, 4u, 9u, 10u, 11u, 12u, 13u, 14u, 15u}) others.push_back(square[i]);
    const auto without = light_of_square(others).light;
    EXPECT_NEAR(light[0].g, without[0].g, 1e-6f);
    EXPECT_NEAR(light[15].g, without[10].g, 1e-6f);
    EXPECT_FALSE(light[0] == square[0].light);
    // Whatever these found, the others do not change a bit.
    for (const size_t i : {3u, 5u, 8u}) square[i].light = {9, 8, 7}, square[i].difference = {5, -6, 4};
    square[6].difference.g = -square[6].difference.g, square[7].light.r = -square[7].light.r;
    const auto changed = light_of_square(square).light;
    for (const size_t i : {0u, 1u, 2u, 4u, 9u, 10u, 11u, 12u, 13u, 14u, 15u}) EXPECT_TRUE(changed[i] == light[i]) << i;
}

TEST(CommonNumbers, KinshipFallsWithDistanceAndAngleWhateverTheScale)
{
    const SplitVertex a = floor_at(0);
    EXPECT_EQ(kinship(a, a), 1);
    float before = 1;
    for (const float x : {0.01f, 0.02f, 0.1f, 1.0f}) {
        const float k = kinship(a, floor_at(x));
        EXPECT_LT(k, before);
        EXPECT_EQ(k, kinship(floor_at(x), a));
        EXPECT_EQ(k, kinship(floor_at(0, 0.01f * 0x1p9f), floor_at(x * 0x1p9f, 0.01f * 0x1p9f))) << "of another size";
        before = k;
    }
    before = 1;
    for (const float angle : {0.1f, 0.5f, 1.5f}) {
        SplitVertex b = a;
        b.n = {std::sin(angle), std::cos(angle), 0};
        EXPECT_LT(kinship(a, b), before);
        before = kinship(a, b);
    }
}

// Squares lie in the picture as they lie, wherever tiles, crops, batches and passes end.
TEST(CommonNumbers, GiveTheSamePictureInAnyPieces)
{
    for (const auto& [name, d] : all_test_scenes()) {
        RenderRequest r;
        r.width = 22, r.height = 15, r.spp = {5}, r.aovs = all_aovs();
        const Film whole = render(d, r).film;
        for (const uint32_t tile : {1u, 5u, 64u})
            for (const uint32_t batch : {1u, 7u, 4096u}) {
                r.tile = tile, r.settings.kernel.batch = batch;
                EXPECT_TRUE(same_bits(render(d, r).film, whole)) << name << " " << tile << " " << batch;
            }
        r.crop = {3, 5, 14, 10}, r.spp = {1, 2, 2}, r.tile = 6;
        const Film crop = render(d, r).film;
        for (uint32_t y = 5; y < 10; ++y)
            for (uint32_t x = 3; x < 14; ++x)
                ASSERT_EQ(crop.whole(crop.index(x, y)).sum, whole.whole(whole.index(x, y)).sum) << name;
    }
}

// What they are for: half of the light of this room comes by its walls.
TEST(CommonNumbers, LeaveLessErrorInAsManyRays)
{
    const SceneDescription d = cornell_scene();
    const auto picture = [&](bool common, uint32_t spp, uint64_t seed) {
        Path path{.max_depth = 8};
        path.common = common;
        return shoot(d, {.integrator = path, .width = 64, .height = 64, .spp = spp, .seed = seed});
    };
    const Film exact = picture(false, 1024, 99);
    const auto squared_error = [&](bool common) {
        double sum = 0;
        for (uint64_t seed = 0; seed < 8; ++seed) {
            const Film film = picture(common, 4, seed);
            for (size_t i = 0; i < film.pixels.size(); ++i) {
                const double a = double{luminance(film.pixels[i].mean())},
                             b = double{luminance(exact.pixels[i].mean())};
                sum += (a - b) * (a - b) / (b * b + 0.01);
            }
        }
        return sum;
    };
    EXPECT_LT(squared_error(true), 0.85 * squared_error(false));
}

// Pixels of a square err together, and what the film says of their variances must not hide it: over many pictures the
// means of squares scatter as it says. Of a variance from 4 squares of 100 pictures, the standard error is 7 %.
TEST(CommonNumbers, VariancesOfPixelsAddUpToThatOfTheirSquare)
{
    const SceneDescription d = cornell_scene();
    constexpr int pictures = 100;
    std::array<stats::Tally, 4> means;
    double told = 0;
    for (uint64_t seed = 0; seed < pictures; ++seed) {
        const Film film = shoot(d, {.integrator = Path{.max_depth = 8},
                                    .width = 16,
                                    .height = 16,
                                    .spp = 16,
                                    .sampler = SamplerKind::independent,
                                    .seed = seed});
        for (uint32_t square = 0; square < 4; ++square) {
            double mean = 0;
            for (uint32_t i = 0; i < 64; ++i) {
                const Pixel& p = film.at(square % 2 * 8 + i % 8, square / 2 * 8 + i / 8);
                const double y = double{luminance(p.mean())};
                mean += y / 64;
                told += (p.sum_sq / p.n - y * y) / (p.n - 1) / 4096 / (4 * pictures);
            }
            means[square].add(mean);
        }
    }
    double found = 0;
    for (const stats::Tally& t : means) found += t.variance() / 4;
    EXPECT_NEAR(told / found, 1, 0.28);
}

}  // namespace
}  // namespace lancer
