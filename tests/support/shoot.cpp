#include "support/shoot.h"

namespace lancer {

Film shoot(const SceneDescription& d, const Shot& shot)
{
    RenderRequest r = request_of(shot);
    r.threads = 2;
    r.images = shot.images;
    Rendered out = render(d, r);
    EXPECT_EQ(out.counters.dropped, 0u) << "samples that are no numbers";
    return std::move(out.film);
}

Path without_roulette(Path path)
{
    path.roulette_depth = no_roulette;
    path.roulette_by_pixel = false;
    return path;
}

stats::Tally tally(const Pixel& p)
{
    stats::Tally t;
    t.n = p.n;
    t.mean = (0.2126 * p.sum[0] + 0.7152 * p.sum[1] + 0.0722 * p.sum[2]) / p.n;
    t.m2 = std::max(0.0, p.sum_sq - t.n * t.mean * t.mean);
    return t;
}

stats::Tally tally(const Film& film)
{
    Pixel all;
    for (const Pixel& p : film.pixels) all += p;
    return tally(all);
}

void expect_all_equal(const Film& film, Color expected, float relative, const std::string& what)
{
    for (const Pixel& p : film.pixels) {
        const Color c = p.mean();
        ASSERT_NEAR(c.r, expected.r, relative * expected.r) << what;
        ASSERT_NEAR(c.g, expected.g, relative * expected.g) << what;
        ASSERT_NEAR(c.b, expected.b, relative * expected.b) << what;
    }
}

bool same_bits(const Film& a, const Film& b)
{
    for (size_t i = 0; i < a.pixels.size(); ++i)
        if (a.pixels[i].sum != b.pixels[i].sum || a.pixels[i].n != b.pixels[i].n) return false;
    return a.pixels.size() == b.pixels.size();
}

double detectable_bias(std::span<const TilesOverSeeds> ways)
{
    double worst = 0;
    for (size_t a = 0; a < ways.size(); ++a)
        for (size_t b = a + 1; b < ways.size(); ++b)
            worst = std::max(worst,
                             4 * std::hypot(ways[a].whole().error(), ways[b].whole().error()) / ways[a].whole().mean);
    return worst;
}

double add_until_detectable(std::span<TilesOverSeeds> ways, const OneMean& claim)
{
    double worst = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 8 && !(worst < claim.detectable); ++round) {
        for (TilesOverSeeds& way : ways) way.add(claim.pictures);
        worst = detectable_bias(ways);
    }
    return worst;
}

std::array<Suspect, 2> suspects_among(std::span<const TilesOverSeeds> ways, double rounding)
{
    std::array<Suspect, 2> least;
    for (size_t a = 0; a < ways.size(); ++a)
        for (size_t b = a + 1; b < ways.size(); ++b) {
            const auto &x = ways[a].tallies(), &y = ways[b].tallies();
            for (size_t t = 0; t < x.size(); ++t) {
                Suspect& s = least[t + 1 == x.size()];
                const double p = stats::welch_p(x[t], y[t], rounding);
                s.tests++;
                if (!(p >= s.p)) s.p = p, s.a = a, s.b = b, s.tile = t;
            }
        }
    return least;
}

double expect_one_mean(std::vector<TilesOverSeeds> ways, const OneMean& claim, const std::string& name)
{
    const double worst = add_until_detectable(ways, claim), mean = ways.at(0).whole().mean;
    EXPECT_LT(worst, claim.detectable) << name << ": too noisy to tell";
    std::printf("%s: biases above %.2g %% would show, of %.2g %% asked\n", name.c_str(), 100 * worst,
                100 * claim.detectable);
    const auto name_of = [&](size_t way) {
        return way < claim.names.size() ? claim.names[way] : "way " + std::to_string(way + 1);
    };
    for (const Suspect& s : suspects_among(ways, claim.rounding)) {
        if (is_salted()) std::printf("p = %.3g: %s\n", -std::expm1(double(s.tests) * std::log1p(-s.p)), name.c_str());
        if (!s.is_red()) continue;
        std::array pair{ways[s.a], ways[s.b]};
        for (TilesOverSeeds& way : pair) {
            const auto taken = static_cast<uint32_t>(way.whole().n);
            way.begin_again();
            way.add(2 * taken);
        }
        const stats::Tally &a = pair[0].tallies()[s.tile], &b = pair[1].tallies()[s.tile];
        EXPECT_GT(stats::welch_p(a, b, claim.rounding), 0.001)
            << name << ": " << name_of(s.a) << " " << a.mean << ", " << name_of(s.b) << " " << b.mean
            << (s.tile + 1 == ways[s.a].tallies().size() ? ", as a whole" : ", in tile " + std::to_string(s.tile));
    }
    return mean;
}

}  // namespace lancer
