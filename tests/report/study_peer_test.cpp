#include "report/study/peer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "report/study/error_rows.h"

namespace lancer {
namespace {

using Samples = std::vector<uint32_t>;

TEST(StudyPeer, SamplesGrowFourfoldUntilTheTimeIsUsedUp)
{
    EXPECT_EQ(peer_samples(0.1, 1.0, {}, false), (Samples{2, 10}));
    EXPECT_EQ(peer_samples(0.1, 1.5, {}, false), (Samples{3, 15}));
    EXPECT_EQ(peer_samples(0.1, 1.6, {}, false), (Samples{1, 4, 16}));
    EXPECT_EQ(peer_samples(0.1, {}, 16, false), (Samples{1, 4, 16}));
    EXPECT_EQ(peer_samples(0.1, 1.5, 8, false), (Samples{2, 8}));
    EXPECT_EQ(peer_samples(10, 1.0, {}, false), (Samples{1}));
    EXPECT_EQ(peer_samples(0.1, 10.0, {}, true), (Samples{1, 4, 25, 100}));
    EXPECT_EQ(peer_samples(0.1, 1.0, {}, true), (Samples{1, 9}));
    EXPECT_EQ(peer_samples(0, 1.0, {}, false).back(), 1u << 28);
}

TEST(StudyPeer, SamplesAscendAndEndWithinTheTime)
{
    for (double seconds = 1e-4; seconds < 10; seconds *= 1.37)
        for (const bool squares : {false, true}) {
            const Samples samples = peer_samples(seconds, 8.0, {}, squares);
            for (size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i], samples[i - 1]);
            EXPECT_LE(samples.back() * seconds, std::max(8.0, seconds) * (1 + 1e-12));
            EXPECT_GE((std::sqrt(samples.back()) + 1) * (std::sqrt(samples.back()) + 1) * seconds, 8.0);
            for (const uint32_t n : samples)
                if (squares) {
                    EXPECT_EQ(std::sqrt(n), std::floor(std::sqrt(n)));
                }
        }
}

std::string what_of(const std::string& lines, const Samples& asked)
{
    try {
        read_peer_records("fake", lines, asked);
    } catch (const Error& e) {
        return e.what();
    }
    return "nothing";
}

TEST(StudyPeer, RecordsAreReadAndAnythingElseIsRefused)
{
    const std::string two = R"({"peer":"x","spp":1,"render_wall_s":0.5,"render_cpu_s":null,"biases":["a","b"]}
{"spp":4,"render_wall_s":2,"render_cpu_s":3.5,"biases":[]}
)";
    const auto records = read_peer_records("fake", two, {1, 4});
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0].biases, (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(std::isnan(records[0].render_cpu_s));
    EXPECT_EQ(records[1].render_cpu_s, 3.5);
    EXPECT_EQ(what_of(two, {1}), "error: fake told of 2 pictures and was asked for 1");
    EXPECT_EQ(what_of(two, {1, 5}), "error: fake told of 4 samples and was asked for 5");
    const std::string no_json = "error: fake printed invalid peer JSON: ";
    EXPECT_EQ(what_of("[1]\n", {1}), no_json + "[1]");
    EXPECT_EQ(what_of("Traceback\n", {1}), no_json + "Traceback");
    const std::string negative = R"({"spp":1,"render_wall_s":-1,"render_cpu_s":null,"biases":[]})";
    EXPECT_EQ(what_of(negative, {1}), "error: fake reported invalid seconds");
    for (const char* const spp : {"4294967297", "-4294967295", "1e300"}) {
        const std::string wrong =
            R"({"render_wall_s":1,"render_cpu_s":null,"biases":[],"spp":)" + std::string(spp) + "}";
        EXPECT_EQ(what_of(wrong, {1}), "error: fake told of 0 samples and was asked for 1") << spp;
    }
    EXPECT_THROW(read_peer_about("fake", "{\"version\":\"1\"}"), Error);
    EXPECT_TRUE(read_peer_about("fake", R"({"version":"1","seeds":true,"squares":false})").seeds);
}

TEST(ErrorRows, ComeBackAsTheyWere)
{
    ErrorRow row;
    row.spp = 4.5, row.wall_s = 0.1, row.camera_rays = uint64_t{1} << 60, row.relmse = 1.0 / 3;
    row.relmse_unbiased = -1e-7;
    const auto rows = read_error_rows("e.csv", error_rows_head() + to_csv(row) + to_csv(ErrorRow{}));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(to_csv(rows[0]), to_csv(row));
    EXPECT_EQ(rows[0].relmse, row.relmse);
    EXPECT_EQ(rows[0].camera_rays, row.camera_rays);
    EXPECT_TRUE(std::isnan(rows[1].wall_s));
    EXPECT_EQ(point_of(rows[0]).relmse, -1e-7);
    const auto what = [](const std::string& csv) -> std::string {
        try {
            read_error_rows("e.csv", csv);
        } catch (const Error& e) {
            return e.what();
        }
        return "nothing";
    };
    EXPECT_EQ(what("spp\n"), "e.csv:1: error: not the columns of a log of errors");
    EXPECT_EQ(what(error_rows_head() + "1,2\n"), "e.csv:2: error: 2 fields instead of 15");
    EXPECT_EQ(what(error_rows_head() + "x" + to_csv(row)), "e.csv:2: error: 'x4.5' in column spp is no such number");
}

}  // namespace
}  // namespace lancer
