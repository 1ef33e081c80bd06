// Studies as JSON and as CSV.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "report/study/csv.h"
#include "report/study/json.h"
#include "synthetic_study.h"

namespace lancer {
namespace {

// With everything that a study can say, and texts that quote.
Study full_study()
{
    Study study = synthetic_study({{"plain", 1, -1, 0, 0.1, 0.2, 8}, {"other", 0.3, -1, 0, 1. / 3, 0.2, 16}}, 21, 2);
    study.title = "Title, \"quoted\"";
    study.scenes[0].reference_noise_relmse = 1.1e-7;
    study.methods[0].description = "one\nline";
    study.methods[1].biases = {"clamp 10", "depth, 4"};
    study.methods[1].peer = true;
    study.not_comparable = {"load 7"};
    study.runs[0].points[1].relmse = std::numeric_limits<double>::infinity();
    study.runs[0].points[2].flip = 0.125;
    study.runs[1].seed = std::numeric_limits<uint64_t>::max();
    study.runs[2].points[0].cpu_s = std::numeric_limits<double>::quiet_NaN();
    study.runs[2].points[0].relmse = -1e-9;
    study.runs[3] = {"box", "other", 7, {}, true, "it said \"no\", twice\nand left"};
    return study;
}

void expect_same(double a, double b) { EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " " << b; }

void expect_same(const std::vector<StudyRun>& a, const std::vector<StudyRun>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (size_t r = 0; r < a.size(); ++r) {
        EXPECT_EQ(a[r].scene, b[r].scene);
        EXPECT_EQ(a[r].method, b[r].method);
        EXPECT_EQ(a[r].seed, b[r].seed);
        EXPECT_EQ(a[r].failed, b[r].failed);
        EXPECT_EQ(a[r].problem, b[r].problem);
        ASSERT_EQ(a[r].points.size(), b[r].points.size());
        for (size_t i = 0; i < a[r].points.size(); ++i) {
            const ErrorPoint &p = a[r].points[i], &q = b[r].points[i];
            EXPECT_EQ(p.spp, q.spp);
            EXPECT_EQ(p.rays_camera, q.rays_camera);
            EXPECT_EQ(p.rays_bounce, q.rays_bounce);
            EXPECT_EQ(p.rays_shadow, q.rays_shadow);
            for (const auto member : {&ErrorPoint::wall_s, &ErrorPoint::cpu_s, &ErrorPoint::rmse, &ErrorPoint::relmse,
                                      &ErrorPoint::relmse_trimmed, &ErrorPoint::smape, &ErrorPoint::flip})
                expect_same(p.*member, q.*member);
        }
    }
}

std::string message_of(const auto& what)
{
    try {
        what();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
        return e.what();
    }
    return "nothing is wrong";
}
std::string json_message(const std::string& json)
{
    return message_of([&] { read_study("s.json", json); });
}
std::string csv_message(const std::string& csv)
{
    return message_of([&] { read_study_csv("s.csv", csv); });
}

TEST(StudyJson, ComesBackAsItWas)
{
    const Study a = full_study(), b = read_study("s.json", to_json(a));
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.baseline, b.baseline);
    EXPECT_EQ(a.machine, b.machine);
    EXPECT_EQ(a.not_comparable, b.not_comparable);
    ASSERT_EQ(b.scenes.size(), 1u);
    EXPECT_EQ(a.scenes[0].name, b.scenes[0].name);
    EXPECT_EQ(a.scenes[0].description, b.scenes[0].description);
    EXPECT_EQ(a.scenes[0].reference, b.scenes[0].reference);
    EXPECT_EQ(a.scenes[0].reference_noise_relmse, b.scenes[0].reference_noise_relmse);
    ASSERT_EQ(b.methods.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(a.methods[i].name, b.methods[i].name);
        EXPECT_EQ(a.methods[i].description, b.methods[i].description);
        EXPECT_EQ(a.methods[i].biases, b.methods[i].biases);
        EXPECT_EQ(a.methods[i].peer, b.methods[i].peer);
        EXPECT_EQ(a.methods[i].version, b.methods[i].version);
    }
    expect_same(a.runs, b.runs);
}

TEST(StudyJson, HoldsTheMeansOverAllScenes)
{
    const Study study = synthetic_study({{"plain", 1, -1, 0, 1, 0, 256}, {"better", 0.5, -1, 0, 0.8, 0, 256}}, 21);
    const auto means = nlohmann::json::parse(to_json(study)).at("geometric_means");
    ASSERT_EQ(means.size(), 2u);
    EXPECT_EQ(means[0].at("method"), "better");
    EXPECT_EQ(means[0].at("of"), "time to equal error");
    EXPECT_NEAR(means[0].at("baseline_over_method").get<double>(), 2.5, 0.1);
    EXPECT_LT(means[0].at("interval")[0].get<double>(), 2.5);
    EXPECT_EQ(means[0].at("verdict"), "faster");
    EXPECT_EQ(means[1].at("verdict"), "not ranked: ranked on no scene") << "FLIP was not measured";
    EXPECT_TRUE(means[1].at("interval").is_null());
}

TEST(StudyJson, SaysWhereItIsBroken)
{
    const std::string good = to_json(full_study());
    EXPECT_EQ(json_message(good), "nothing is wrong");
    EXPECT_EQ(json_message("{\n \"schema\": oops}"), "s.json:2:12: error: not JSON");
    EXPECT_NE(json_message(good.substr(0, good.size() / 2)).find("not JSON: it ends too early"), std::string::npos);
    EXPECT_EQ(json_message("[]"), "s.json: error: not an object");
    EXPECT_EQ(json_message("{}"), "s.json: error: no \"schema\"");
    EXPECT_EQ(json_message(R"({"schema":"lancer.stats/1"})"),
              "s.json: error: schema: 'lancer.stats/1', not 'lancer.study/1': not a study that this version reads");
    const auto changed = [&](const char* pointer, const nlohmann::json& value) {
        nlohmann::json json = nlohmann::json::parse(good);
        json[nlohmann::json::json_pointer(pointer)] = value;
        return json_message(json.dump());
    };
    EXPECT_EQ(changed("/runs/2/points/1/relmse", "much"), "s.json: error: runs[2].points[1].relmse: not a number");
    EXPECT_EQ(changed("/runs/2/points/1/spp", -1),
              "s.json: error: runs[2].points[1].spp: not a whole number of 0 or more");
    EXPECT_EQ(changed("/runs/2/points/1/spp", 1ll << 32), "s.json: error: runs[2].points[1].spp: too large");
    EXPECT_EQ(changed("/runs/0", 3), "s.json: error: runs[0]: not an object");
    EXPECT_EQ(changed("/methods/1/biases", "clamp"), "s.json: error: methods[1].biases: not an array");
    EXPECT_EQ(changed("/methods/1/peer", 1), "s.json: error: methods[1].peer: neither true nor false");
    EXPECT_EQ(changed("/title", 1), "s.json: error: title: not a text");
}

TEST(StudyJson, RefusesWhatMakesNoSense)
{
    const auto changed = [&](const auto& change) {
        Study study = full_study();
        change(study);
        return json_message(to_json(study));
    };
    const std::string run = "s.json: error: the run of 'plain' on 'box' with seed 1";
    EXPECT_EQ(changed([](Study& s) { s.baseline = "best"; }),
              "s.json: error: the baseline 'best' is none of the methods");
    EXPECT_EQ(changed([](Study& s) { s.methods[1].name = "plain"; }), "s.json: error: two methods are called 'plain'");
    EXPECT_EQ(changed([](Study& s) { s.scenes[0].name = ""; }), "s.json: error: a scene has no name");
    EXPECT_EQ(changed([](Study& s) { s.scenes[0].reference_noise_relmse = -1; }),
              "s.json: error: scene 'box': the noise of its reference is no error");
    EXPECT_EQ(changed([](Study& s) { s.runs[0].method = "none"; }),
              "s.json: error: the run of 'none' on 'box' with seed 1: there is no such method");
    EXPECT_EQ(changed([](Study& s) { s.runs[0].scene = "none"; }),
              "s.json: error: the run of 'plain' on 'none' with seed 1: there is no such scene");
    EXPECT_EQ(changed([](Study& s) { s.runs[2].seed = 1; }), run + " is there twice");
    EXPECT_EQ(changed([](Study& s) { s.runs[0].points[1].spp = 1; }),
              run + ": no more samples than before at 1 samples per pixel");
    EXPECT_EQ(changed([](Study& s) { s.runs[0].points[1].wall_s = 0; }),
              run + ": less time than before at 2 samples per pixel");
    EXPECT_EQ(changed([](Study& s) { s.runs[0].points[1].wall_s = NAN; }),
              run + ": wall seconds that are no time at 2 samples per pixel");
    EXPECT_EQ(changed([](Study& s) { s.runs[0].points[1].rmse = -1; }),
              run + ": a negative error at 2 samples per pixel");
}

TEST(StudyCsv, ComesBackAsItWas)
{
    const Study study = full_study();
    const std::string csv = to_csv(study.runs);
    expect_same(study.runs, read_study_csv("s.csv", csv));
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              "scene,method,seed,spp,wall_s,cpu_s,rays_camera,rays_bounce,rays_shadow,rmse,relmse,relmse_trimmed,smape,"
              "flip,failed,problem");
    EXPECT_NE(csv.find("\nbox,other,7,,,,,,,,,,,,yes,\"it said \"\"no\"\", twice\nand left\"\n"), std::string::npos);
    std::string windows;
    for (const char c : to_csv({study.runs[0]})) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_same({study.runs[0]}, read_study_csv("s.csv", windows));
}

TEST(StudyCsv, SaysWhereItIsBroken)
{
    const std::string head = to_csv({}), row = "box,path,1,1,0.5,1,1,2,3,1,1,1,1,,no,\n";
    EXPECT_EQ(csv_message(head + row), "nothing is wrong");
    EXPECT_NE(csv_message("").find("s.csv:1: error: not the columns of a study"), std::string::npos);
    EXPECT_NE(csv_message("a,b\n").find("s.csv:1: error: not the columns of a study"), std::string::npos);
    EXPECT_EQ(csv_message(head + row + "box,path,1\n"), "s.csv:3: error: 3 fields instead of 16");
    EXPECT_EQ(csv_message(head + "box,path,1,one,0.5,1,1,2,3,1,1,1,1,,no,\n"),
              "s.csv:2: error: 'one' in column spp is no such number");
    EXPECT_EQ(csv_message(head + "box,path,1,1,0.5s,1,1,2,3,1,1,1,1,,no,\n"),
              "s.csv:2: error: '0.5s' in column wall_s is no such number");
    EXPECT_EQ(csv_message(head + "box,path,1,1,0.5,1,1,2,3,1,1,1,1,,maybe,\n"),
              "s.csv:2: error: 'maybe' in column failed is neither yes nor no");
    EXPECT_EQ(csv_message(head + "\"a\nb\",path,1,1,0.5,1,1,2,3,1,1,1,1,,no,\nx\n"),
              "s.csv:4: error: 1 fields instead of 16");
    EXPECT_EQ(csv_message(head + "\"box\n"), "s.csv:2: error: a quote that is not closed");
    EXPECT_EQ(
        csv_message(head + row + row),
        "s.csv: error: the run of 'path' on 'box' with seed 1: no more samples than before at 1 samples per pixel");
}

}  // namespace
}  // namespace lancer
