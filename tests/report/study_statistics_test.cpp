#include "report/study/statistics.h"

#include <gtest/gtest.h>

#include "report/study/curve.h"
#include "synthetic_study.h"

namespace lancer {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

MethodFigures first_figures(const Study& study) { return figures_of(study, study.scenes[0], study.methods[0]); }

TEST(StudyCurve, IsAPowerLawBetweenMeasurements)
{
    const ErrorCurve curve{{1, 4, 16}, {1, 0.25, 0.0625}};
    EXPECT_NEAR(error_at(curve, 2), 0.5, 1e-15);
    EXPECT_NEAR(error_at(curve, 8), 0.125, 1e-15);
    EXPECT_EQ(error_at(curve, 1), 1);
    EXPECT_EQ(error_at(curve, 16), 0.0625);
    EXPECT_TRUE(std::isnan(error_at(curve, 0.99)));
    EXPECT_TRUE(std::isnan(error_at(curve, 16.01)));
    EXPECT_TRUE(std::isnan(error_at({}, 1)));
}

TEST(StudyCurve, InfiniteAndZeroErrorsAreTheWorseOfTwo)
{
    const ErrorCurve curve{{1, 2, 4}, {infinity, 0.5, 0}};
    EXPECT_EQ(error_at(curve, 1.5), infinity);
    EXPECT_EQ(error_at(curve, 3), 0.5);
    EXPECT_NEAR(log_reached(curve, 0.6), std::log(2), 1e-15);
    EXPECT_NEAR(log_reached(curve, 0.1), std::log(4), 1e-15);
}

TEST(StudyCurve, AnErrorIsReachedWhereItStays)
{
    const ErrorCurve curve{{1, 2, 4, 8}, {1, 0.1, 0.4, 0.1}};
    EXPECT_NEAR(std::exp(log_reached(curve, 0.2)), 4 * std::sqrt(2), 1e-12);  // not 2^0.7, where it was for a moment
    EXPECT_EQ(log_reached(curve, 0.05), infinity);
    EXPECT_EQ(log_reached(curve, 1), -infinity);
}

TEST(StudyCurve, ExtrapolatesNoFurtherThanItWasMeasured)
{
    const ErrorCurve curve{{1, 2, 4, 8}, {1, 0.5, 0.25, 0.125}};
    EXPECT_NEAR(std::exp(log_extrapolated(curve, 0.02)), 50, 1e-9);
    EXPECT_EQ(log_extrapolated(curve, 0.0156), infinity);  // at 64.1
    EXPECT_NEAR(std::exp(log_extrapolated(curve, 0.25)), 4, 1e-12);
    EXPECT_EQ(log_extrapolated({{1, 2, 4}, {1, 2, 4}}, 0.5), infinity);
}

TEST(StudyCurve, LeavesOutWhatIsNoTimeOrNoError)
{
    StudyRun run;
    for (const double seconds : {0.0, 1.0, 1.0, 2.0, 4.0, 8.0}) {
        ErrorPoint p;
        p.wall_s = seconds;
        if (seconds != 4) p.relmse = 1 - seconds;
        run.points.push_back(p);
    }
    const ErrorCurve curve = curve_of(run, Along::time, &ErrorPoint::relmse);
    EXPECT_EQ(curve.x, (std::vector<double>{1, 2, 8}));
    EXPECT_EQ(curve.y, (std::vector<double>{0, 0, 0}));  // 1 - 2 is below 0
}

TEST(StudyStatistics, ExactLawsAreFoundExactly)
{
    const Study study = synthetic_study({{"path", 0.5, -1, 0, 0.25, 0, 1024}}, 1);
    Study even = study;
    for (StudyRun& run : even.runs)
        for (ErrorPoint& p : run.points) p.wall_s = 0.25 * p.spp;
    const MethodFigures f = first_figures(even);
    EXPECT_EQ(f.runs, 8u);
    EXPECT_EQ(f.failed, 0u);
    EXPECT_EQ(f.first_s, 0.25);
    EXPECT_EQ(f.last_s, 256);
    ASSERT_TRUE(f.slope_samples && f.slope_time);
    for (const Slope& s : {*f.slope_samples, *f.slope_time}) {
        EXPECT_NEAR(s.exponent, -0.5, 1e-12);
        EXPECT_NEAR(s.interval.low, -0.5, 1e-12);
        EXPECT_NEAR(s.interval.high, -0.5, 1e-12);
    }
    ASSERT_EQ(f.times.size(), 3u);
    const double seconds[] = {1.25, 12.5, 125};  // 0.125 / target
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(f.times[i].reach, Reach::measured);
        EXPECT_NEAR(f.times[i].seconds / seconds[i], 1, 1e-12);
        EXPECT_NEAR(f.times[i].interval.low / seconds[i], 1, 1e-12);
        EXPECT_NEAR(f.times[i].interval.high / seconds[i], 1, 1e-12);
    }
    // Ten doublings in half steps, both ends among them.
    ASSERT_EQ(f.time.size(), 21u);
    for (const CurvePoint& p : f.time) EXPECT_NEAR(p.median * p.x, 0.125, 1e-13);
    ASSERT_EQ(f.samples.size(), 11u);
    EXPECT_EQ(f.samples.back().x, 1024);
    EXPECT_NEAR(f.samples.back().median, 0.5 / 1024, 1e-15);
    const ErrorsAt at = errors_at(even, even.scenes[0], even.methods[0], 16);
    EXPECT_NEAR(at.relmse, 0.125 / 16, 1e-15);
    EXPECT_NEAR(at.relmse_trimmed, 0.1 / 16, 1e-15);
    EXPECT_NEAR(at.rmse, 0.3 * std::sqrt(0.125 / 16), 1e-15);
    EXPECT_TRUE(std::isnan(at.flip));
    EXPECT_EQ(f.flip_time.reach, Reach::not_measured);
    for (StudyRun& run : even.runs)
        for (ErrorPoint& p : run.points) p.flip = 0.4 / std::sqrt(p.wall_s);
    const TimeToError flip = first_figures(even).flip_time;
    EXPECT_EQ(flip.reach, Reach::measured);
    EXPECT_NEAR(flip.seconds, 16, 1e-12);
    even.runs[3].points.clear();
    EXPECT_EQ(first_figures(even).flip_time.reach, Reach::measured) << "a run without points is none";
}

// With nine seeds, as many studies as two standard deviations below 95 % would leave.
TEST(StudyStatistics, IntervalsHoldTheTruthAsOftenAsTheySay)
{
    int slope = 0, time = 0, band = 0;
    for (uint64_t k = 0; k < 100; ++k) {
        const Study study = synthetic_study({{"path", 1, -1, 0, 1, 0.1, 256}}, 100 + k, 9);
        const MethodFigures f = first_figures(study);
        slope += f.slope_samples->interval.contains(-0.5);
        // The machine is slower than planned by a factor whose median is exp(0.2 * 0.6745), nearly.
        time += time_to_error(study, study.scenes[0], study.methods[0], 1e-2).interval.contains(100 * 1.144);
        band += f.samples[4].band.contains(1.0 / 16);
    }
    EXPECT_GE(slope, 90);
    EXPECT_GE(time, 90);
    EXPECT_GE(band, 90);
}

TEST(StudyStatistics, TellsHowAnErrorIsReached)
{
    // From 1 down to 1/256 in 1 to 256 s, evenly.
    Study study = synthetic_study({{"path", 1, -1, 0, 1, 0, 256}}, 3);
    const auto reach = [&](double target) { return time_to_error(study, study.scenes[0], study.methods[0], target); };
    EXPECT_EQ(reach(1.5).reach, Reach::at_once);
    EXPECT_GE(reach(1.5).seconds, 1);
    EXPECT_EQ(reach(1e-2).reach, Reach::measured);
    EXPECT_EQ(reach(1e-3).reach, Reach::extrapolated);
    const TimeToError inside = reach(1e-2), outside = reach(1e-3);
    EXPECT_NEAR(outside.seconds / inside.seconds, 10, 1e-9);
    EXPECT_EQ(reach(1e-6).reach, Reach::not_reached);  // 4000 times as far as was measured

    study.methods[0].biases = {"clamp 10"};
    EXPECT_EQ(reach(1e-2).reach, Reach::measured);
    EXPECT_EQ(reach(1e-3).reach, Reach::not_reached);
    EXPECT_TRUE(std::isnan(reach(1e-3).seconds));
    study.methods[0].biases.clear();

    study.scenes[0].reference_noise_relmse = 4.9e-3;
    EXPECT_EQ(reach(1e-2).reach, Reach::measured);
    study.scenes[0].reference_noise_relmse = 5e-3;
    EXPECT_EQ(reach(1e-2).reach, Reach::below_noise);
    EXPECT_EQ(reach(1e-3).reach, Reach::below_noise);
    study.runs.clear();
    EXPECT_EQ(reach(1e-2).reach, Reach::not_measured);
}

TEST(StudyStatistics, AnIntervalMayReachBeyondTheMeasurements)
{
    Study study = synthetic_study({{"path", 1, -1, 0, 1, 0, 256}}, 3, 7);
    for (size_t i = 0; i < 3; ++i) {
        study.runs[i].points.resize(5);  // ends at 1/16
        study.methods[0].biases = {"clamp 10"};
    }
    const TimeToError t = time_to_error(study, study.scenes[0], study.methods[0], 1e-2);
    EXPECT_EQ(t.reach, Reach::measured);
    EXPECT_EQ(t.interval.high, infinity);
    EXPECT_GT(t.interval.low, 99);
}

TEST(StudyStatistics, NoiseOfTheReferenceHasNoSlope)
{
    // Down to the noise of 1e-3, where the curve flattens.
    Study study = synthetic_study({{"path", 1, -1, 1e-3, 1, 0, 16384}}, 5);
    const double bent = first_figures(study).slope_samples->exponent;
    EXPECT_GT(bent, -0.3);
    study.scenes[0].reference_noise_relmse = 1e-3;
    const double kept = first_figures(study).slope_samples->exponent;
    EXPECT_LT(kept, -0.45);  // a tenth less, at most
    EXPECT_GT(kept, -0.5);
    study.scenes[0].reference_noise_relmse = 0.1;
    EXPECT_FALSE(first_figures(study).slope_samples);
}

TEST(StudyStatistics, FailedRunsAreCountedNotUsed)
{
    Study study = synthetic_study({{"path", 1, -1, 0, 1, 0, 256}}, 6);
    study.runs[2].failed = true;
    for (ErrorPoint& p : study.runs[2].points) p.relmse = 1e6;
    const MethodFigures f = first_figures(study);
    EXPECT_EQ(f.runs, 7u);
    EXPECT_EQ(f.failed, 1u);
    EXPECT_LT(f.samples.front().band.high, 1.001);
    for (StudyRun& run : study.runs) run.failed = true;
    const MethodFigures none = first_figures(study);
    EXPECT_EQ(none.runs, 0u);
    EXPECT_TRUE(std::isnan(none.last_s));
    EXPECT_TRUE(none.time.empty() && none.samples.empty() && !none.slope_time);
}

TEST(StudyStatistics, SameStudySameFigures)
{
    const Study study = synthetic_study({{"path", 1, -1, 0, 1, 0.2, 256}}, 7);
    const MethodFigures a = first_figures(study), b = first_figures(study);
    ASSERT_EQ(a.time.size(), b.time.size());
    for (size_t i = 0; i < a.time.size(); ++i) {
        EXPECT_EQ(a.time[i].band.low, b.time[i].band.low);
        EXPECT_LE(a.time[i].band.low, a.time[i].median);
        EXPECT_GE(a.time[i].band.high, a.time[i].median);
    }
}

}  // namespace
}  // namespace lancer
