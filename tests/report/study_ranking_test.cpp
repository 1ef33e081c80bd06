#include "report/study/ranking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_study.h"

namespace lancer {
namespace {

// Half the error for each sample, at 0.8 times the cost: 2.5 times as efficient.
const SyntheticMethod plain{"plain", 1, -1, 0, 1, 0.1, 256};
const SyntheticMethod better{"better", 0.5, -1, 0, 0.8, 0.1, 256};

Efficiency gain_of(const Study& study, size_t method = 1)
{
    return efficiency_of(study, study.scenes[0], study.methods[method]);
}
Comparison speed_up_of(const Study& study, double target = 1e-2)
{
    return speed_up(study, study.scenes[0], study.methods[1], target);
}

TEST(StudyRanking, IntervalsHoldTheKnownRatioMostly)
{
    int gain = 0, speed = 0, faster = 0;
    for (uint64_t k = 0; k < 100; ++k) {
        const Study study = synthetic_study({plain, better}, 1000 + k);
        const Efficiency e = gain_of(study);
        const Comparison s = speed_up_of(study);
        gain += e.gain.interval.contains(2.5);
        speed += s.interval.contains(2.5);
        faster += e.gain.rank == Rank::faster && s.rank == Rank::faster;
        EXPECT_LE(e.gain.interval.low, e.gain.ratio);
        EXPECT_GE(e.gain.interval.high, e.gain.ratio);
    }
    EXPECT_GE(gain, 90);
    EXPECT_GE(speed, 90);
    EXPECT_EQ(faster, 100);
}

// Two names of one method: a difference is found in about 5 of 100 studies, by chance.
TEST(StudyRanking, EqualMethodsAreSeldomToldApart)
{
    int told = 0;
    for (uint64_t k = 0; k < 100; ++k) {
        SyntheticMethod twin = plain;
        twin.name = "twin";
        told += gain_of(synthetic_study({plain, twin}, 3000 + k)).gain.rank != Rank::no_difference;
    }
    EXPECT_LE(told, 10);
}

// On a machine that is disturbed seed by seed, pairs tell what whole groups could not.
TEST(StudyRanking, PairsSeeThroughADisturbedMachine)
{
    SyntheticMethod a = plain, b = plain;
    b.name = "b";
    a.noise = b.noise = 0;
    b.seconds_per_spp = 0.85;
    Study study = synthetic_study({a, b}, 77, 12);
    const Comparison c = speed_up_of(study);
    EXPECT_EQ(c.rank, Rank::faster);
    EXPECT_TRUE(c.interval.contains(1 / 0.85));
    EXPECT_LT(c.interval.high / c.interval.low, 1.2);
}

TEST(StudyRanking, EfficiencyIsThatAtOneTime)
{
    SyntheticMethod a = plain, b = better;
    a.noise = b.noise = 0;
    Study study = synthetic_study({a, b}, 5);
    for (StudyRun& run : study.runs)
        for (ErrorPoint& p : run.points) p.wall_s = p.spp * (run.method == "plain" ? 1 : 0.8);
    const Efficiency e = gain_of(study);
    EXPECT_NEAR(e.seconds, 204.8, 1e-12);  // where the shorter one ends
    EXPECT_NEAR(e.value, 2.5, 1e-12);      // 1 / (0.5 / 256 * 204.8)
    EXPECT_NEAR(e.baseline, 1, 1e-12);
    EXPECT_NEAR(e.gain.ratio, 2.5, 1e-12);
    EXPECT_EQ(e.gain.rank, Rank::faster);
    EXPECT_EQ(gain_of(study, 0).gain.rank, Rank::baseline);
    EXPECT_EQ(gain_of(study, 0).gain.ratio, 1);
    study.baseline = "better";
    EXPECT_EQ(gain_of(study, 0).gain.rank, Rank::slower);
    EXPECT_NEAR(gain_of(study, 0).gain.ratio, 0.4, 1e-12);
}

TEST(StudyRanking, RefusesWhatIsNotAlike)
{
    const Study study = synthetic_study({plain, better}, 9);
    ASSERT_EQ(gain_of(study).gain.rank, Rank::faster);
    const auto refused = [&](const std::string& reason, const auto& change) {
        Study other = study;
        change(other);
        for (const Comparison& c : {gain_of(other).gain, speed_up_of(other)}) {
            EXPECT_EQ(c.rank, Rank::not_ranked);
            EXPECT_EQ(rank_text(c), "not ranked: " + reason);
        }
    };
    refused("biased, the baseline is not", [](Study& s) { s.methods[1].biases = {"clamp 10"}; });
    refused("unbiased, the baseline is not", [](Study& s) { s.methods[0].biases = {"clamp 10"}; });
    refused("biased in another way", [](Study& s) {
        s.methods[0].biases = {"clamp 10"};
        s.methods[1].biases = {"clamp 10", "depth 4"};
    });
    refused("not comparable", [](Study& s) { s.not_comparable = {"load 7 is above 2.5"}; });
    refused("1 run failed", [](Study& s) { s.runs[3].failed = true; });
    refused("the baseline: 1 run failed", [](Study& s) { s.runs[2].failed = true; });
    refused("only 5 seeds in common, of 6 that an interval of 95 % wants", [](Study& s) { s.runs.resize(10); });
    refused("only 4 seeds in common, of 6 that an interval of 95 % wants", [](Study& s) {
        for (StudyRun& run : s.runs)
            if (run.method == "better") run.seed += 4;
    });
    refused("no baseline", [](Study& s) { s.baseline = "none"; });
}

TEST(StudyRanking, EqualBiasesAreRanked)
{
    Study study = synthetic_study({plain, better}, 9);
    study.methods[0].biases = {"clamp 10", "depth 4"};
    study.methods[1].biases = {"depth 4", "clamp 10"};
    EXPECT_EQ(gain_of(study).gain.rank, Rank::faster);
}

// A plateau of the reference's noise looks like a bias, and a bias below it like none.
TEST(StudyRanking, NothingIsRankedBelowTheNoiseOfTheReference)
{
    SyntheticMethod a = plain, b = better;
    a.last_spp = b.last_spp = 16384;
    a.plateau = b.plateau = 1e-3;
    b.plateau = 1.2e-3;
    Study study = synthetic_study({a, b}, 11);
    for (StudyMethod& m : study.methods) m.biases = {"depth 4"};
    EXPECT_EQ(gain_of(study).gain.rank, Rank::slower);  // with a reference that is taken for exact
    study.scenes[0].reference_noise_relmse = 1e-3;
    const Efficiency e = gain_of(study);
    EXPECT_EQ(rank_text(e.gain), "not ranked: below the noise of the reference");
    EXPECT_TRUE(std::isnan(e.value) && std::isnan(e.gain.ratio));
    EXPECT_EQ(rank_text(speed_up_of(study, 1e-3)), "not ranked: below the noise of the reference");
    EXPECT_EQ(speed_up_of(study, 1e-2).rank, Rank::faster);
}

TEST(StudyRanking, TimesAreMeasuredNotExtrapolated)
{
    Study study = synthetic_study({plain, better}, 12);  // down to 1/256 and 1/512
    EXPECT_EQ(rank_text(speed_up_of(study, 1e-3)), "not ranked: reached only beyond the measurements");
    EXPECT_EQ(rank_text(speed_up_of(study, 3e-3)), "not ranked: the baseline: reached only beyond the measurements");
    EXPECT_EQ(rank_text(speed_up_of(study, 0.9)), "not ranked: reached before the first measurement");
    EXPECT_EQ(rank_text(speed_up_of(study, 1e-9)), "not ranked: not reached");
}

TEST(StudyRanking, WithoutACommonTimeThereIsNoGain)
{
    SyntheticMethod quick = better;
    quick.seconds_per_spp = 1e-3;
    const Study study = synthetic_study({plain, quick}, 13);
    const Efficiency e = gain_of(study);
    EXPECT_EQ(rank_text(e.gain), "not ranked: no time at which both were measured");
    EXPECT_TRUE(std::isnan(e.seconds));
    EXPECT_TRUE(std::isnan(e.gain.ratio));
}

// The study of two scenes: on the second one the method needs a quarter of the time for the same samples.
Study two_scenes(double noise, uint64_t seed, double faster = 0.25)
{
    SyntheticMethod a = plain, b = better, quick = better;
    a.noise = b.noise = quick.noise = noise;
    quick.seconds_per_spp *= faster;
    Study study = synthetic_study({a, b}, seed, 8, "box");
    const Study other = synthetic_study({a, quick}, seed + 1, 8, "hall");
    study.scenes.push_back(other.scenes[0]);
    study.runs.insert(study.runs.end(), other.runs.begin(), other.runs.end());
    return study;
}

TEST(StudyRanking, AnEqualErrorIsTheLeastRoundOneThatAllReach)
{
    SyntheticMethod a = plain, b = better;
    a.noise = b.noise = 0;
    Study study = synthetic_study({a, b}, 5);
    const auto error = [&] { return equal_error(study, study.scenes[0], study.methods[1]); };
    EXPECT_DOUBLE_EQ(error(), 5e-3);  // the baseline ends at 1/256
    study.runs[6].points.resize(7);   // at 1/64
    EXPECT_DOUBLE_EQ(error(), 2e-2);
    study.scenes[0].reference_noise_relmse = 2.5e-2;  // at twice the noise nothing is ranked
    EXPECT_DOUBLE_EQ(error(), 1e-1);
    study.runs.clear();
    EXPECT_TRUE(std::isnan(error()));
}

TEST(StudyRanking, FlipIsComparedAtEqualTime)
{
    Study study = two_scenes(0, 5);
    const auto flip = [&] { return flip_at_equal_time(study, study.scenes[0], study.methods[1]); };
    EXPECT_EQ(rank_text(flip().ratio), "not ranked: FLIP was not measured");
    for (StudyRun& run : study.runs)
        for (ErrorPoint& p : run.points) p.flip = 0.5 * std::sqrt(p.relmse);
    const FlipAtTime f = flip();
    EXPECT_EQ(f.seconds, efficiency_of(study, study.scenes[0], study.methods[1]).seconds);
    EXPECT_NEAR(f.baseline / f.method, std::sqrt(2.5), 0.1);
    EXPECT_NEAR(f.ratio.ratio, std::sqrt(2.5), 0.1);
    EXPECT_EQ(f.ratio.rank, Rank::faster);
    study.methods[1].biases = {"clamp 10"};
    EXPECT_EQ(rank_text(flip().ratio), "not ranked: biased, the baseline is not");
}

TEST(StudyRanking, TheGeometricMeanIsThatOfTheRankedScenes)
{
    const auto of_scenes = [](const Study& study) {
        std::vector<Comparison> all;
        for (const StudyScene& scene : study.scenes) all.push_back(speed_up(study, scene, study.methods[1], 1e-2));
        return all;
    };
    std::vector<Comparison> all = of_scenes(two_scenes(0, 5));
    Comparison mean = geometric_mean_of(all);
    EXPECT_NEAR(mean.ratio, 5, 0.2);  // of 2.5 and 10
    EXPECT_EQ(mean.rank, Rank::faster);
    all.emplace_back().reason = "left out";
    EXPECT_EQ(geometric_mean_of(all).ratio, mean.ratio);
    EXPECT_EQ(rank_text(geometric_mean_of({all[2]})), "not ranked: ranked on no scene");
    // Twice as fast on one scene and half as fast on the other.
    all = of_scenes(two_scenes(0, 5, 6.25));
    EXPECT_EQ(all[0].rank, Rank::faster);
    EXPECT_EQ(all[1].rank, Rank::slower);
    EXPECT_EQ(geometric_mean_of(all).rank, Rank::no_difference);
    int holds = 0;
    for (uint64_t k = 0; k < 100; ++k)
        holds += geometric_mean_of(of_scenes(two_scenes(0.1, 5000 + 2 * k))).interval.contains(5);
    EXPECT_GE(holds, 90);
}

}  // namespace
}  // namespace lancer
