// Error against run time from the shell: the log, what stops a render, and what is said of it.
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/run_program.h"

namespace lancer {
namespace {

class ErrorLog : public AppTest {
protected:
    // As render(), but nothing is said of samples.
    Said render_until(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {"render", "scene.toml", "--size", "24x16"});
        return run(arguments);
    }
};

// The table by rows of named fields.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv)
{
    std::istringstream lines(csv);
    std::string line, field;
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(lines, line)) {
        std::istringstream fields(line + ",");
        std::map<std::string, std::string> row;
        for (size_t i = 0; std::getline(fields, field, ','); ++i) {
            if (rows.empty() && names.size() <= i)
                names.push_back(field);
            else
                row[names.at(i)] = field;
        }
        if (names.empty() || row.empty()) continue;
        rows.push_back(row);
    }
    return rows;
}

// A disk may be full, a folder removed: hours of rendering are not lost for that.
TEST_F(ErrorLog, OneThatCannotBeWrittenCostsNoPicture)
{
    for (const bool is_interrupted : {false, true}) {
        std::filesystem::create_directory(file("logs"));
        Program program(folder_, {"scene.toml", "-s", is_interrupted ? "2000000000" : "8000", "--size", "32x32", "-o",
                                  "a.exr", "--error-log", "logs/e.csv", "--progress", "json"});
        ASSERT_TRUE(program.wait_for_message("\"spp\":16"));
        // Renamed, not removed: the program may be writing into the folder at this moment.
        std::filesystem::rename(file("logs"), file(is_interrupted ? "logs-2" : "logs-1"));
        if (is_interrupted) {
            ASSERT_TRUE(program.wait_for_message("goes on without its log"));
            program.send(SIGTERM);
        }
        const Said said = program.wait();
        EXPECT_EQ(said.code, 1) << said.err;
        expect_words(said.err, "logs/e.csv: warning: cannot write");
        expect_words(said.err, "error: the error log could not be written");
        EXPECT_EQ(metadata("a.exr", "partial"), is_interrupted ? "1" : "0");
    }
}

TEST_F(ErrorLog, HasARowAtEveryDoublingAndNoOtherBits)
{
    ASSERT_EQ(render({"-o", "reference.exr", "-s", "300", "--seed", "5"}).code, 0);
    ASSERT_EQ(render({"-o", "plain.exr", "-s", "40"}).code, 0);
    const Said said = run({"render", "scene.toml", "--size", "24x16", "-o", "logged.exr", "-s", "40", "--reference",
                           "reference.exr", "--error-log", "e.csv"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_NE(said.err.find("against reference.exr: rmse "), std::string::npos) << said.err;
    EXPECT_TRUE(same_pixels(image("plain.exr"), image("logged.exr")));
    const auto rows = rows_of(read_bytes(file("e.csv")));
    ASSERT_EQ(rows.size(), 7u);
    const std::array<const char*, 7> spp{"1", "2", "4", "8", "16", "32", "40"};
    double seconds = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].at("spp"), spp[i]);
        EXPECT_GE(std::stod(rows[i].at("wall_s")), seconds);
        seconds = std::stod(rows[i].at("wall_s"));
        EXPECT_EQ(std::stoul(rows[i].at("camera_rays")), 24u * 16 * std::stoul(spp[i]));
        EXPECT_GT(std::stod(rows[i].at("relmse")), 0);
        EXPECT_LE(std::stod(rows[i].at("relmse_trimmed")), std::stod(rows[i].at("relmse")));
        EXPECT_EQ(rows[i].at("relmse_unbiased"), "");
    }
    EXPECT_EQ(rows[0].at("estimated_error"), "");
    EXPECT_GT(std::stod(rows[1].at("estimated_error")), 0);
    EXPECT_LT(std::stod(rows[6].at("relmse")), std::stod(rows[0].at("relmse")));
    const Said compared = run({"compare", "logged.exr", "reference.exr"});
    EXPECT_NE(compared.out.find(std::string("rmse") + std::string(17, ' ') + rows[6].at("rmse").substr(0, 6)),
              std::string::npos)
        << compared.out << rows[6].at("rmse");
}

// Of the picture that would be written then, with the time that it takes.
TEST_F(ErrorLog, IsOfTheDenoisedPicture)
{
    ASSERT_EQ(render({"-o", "reference.exr", "-s", "200", "--seed", "5"}).code, 0);
    const auto log_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"-o",          "x.exr",         "-s",          "16",
                                       "--reference", "reference.exr", "--error-log", "e.csv"};
        words.insert(words.end(), more.begin(), more.end());
        const Said said = render(words);
        EXPECT_EQ(said.code, 0) << said.err;
        return rows_of(read_bytes(file("e.csv")));
    };
    const auto noisy = log_of({}), denoised = log_of({"--denoise"});
    ASSERT_EQ(denoised.size(), noisy.size());
    EXPECT_EQ(denoised[0].at("relmse"), noisy[0].at("relmse")) << "one sample has no halves";
    for (const uint32_t spp : {4u, 16u}) {
        ASSERT_EQ(render({"-o", "until.exr", "-s", std::to_string(spp), "--denoise"}).code, 0);
        const auto& row = denoised[static_cast<size_t>(std::countr_zero(spp))];
        const Said compared = run({"compare", "until.exr", "reference.exr", "--json"});
        EXPECT_NEAR(nlohmann::json::parse(compared.out)["metrics"]["relmse"].get<double>(), std::stod(row.at("relmse")),
                    1e-12)
            << spp;
        EXPECT_EQ(row.at("estimated_error"), noisy[static_cast<size_t>(std::countr_zero(spp))].at("estimated_error"));
    }
    EXPECT_TRUE(same_pixels(image("x.exr"), image("until.exr"))) << "a log changes no bit";
}

TEST_F(ErrorLog, TwoReferencesGiveTheUnbiasedError)
{
    ASSERT_EQ(render({"-o", "r1.exr", "-s", "64", "--seed", "5"}).code, 0);
    ASSERT_EQ(render({"-o", "r2.exr", "-s", "64", "--seed", "6"}).code, 0);
    const Said said =
        render({"-o", "x.exr", "-s", "4", "--reference", "r1.exr", "--reference2", "r2.exr", "--error-log", "e.csv"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_NE(rows_of(read_bytes(file("e.csv"))).back().at("relmse_unbiased"), "");
}

TEST_F(ErrorLog, WarnsOfSamplesInCommon)
{
    ASSERT_EQ(render({"-o", "r1.exr", "--seed", "5"}).code, 0);
    ASSERT_EQ(render({"-o", "r2.png", "--seed", "5"}).code, 0);
    ASSERT_EQ(render({"-o", "r3.exr", "--seed", "6"}).code, 0);
    const auto said = [&](const char* seed, const char* r1, const char* r2) {
        return render({"-o", "x.exr", "--seed", seed, "--reference", r1, "--reference2", r2}).err;
    };
    expect_words(said("5", "r1.exr", "r3.exr"), "warning: this picture and 'r1.exr' share their samples (seed 5)");
    expect_words(said("6", "r1.exr", "r3.exr"), "warning: this picture and 'r3.exr' share their samples (seed 6)");
    expect_words(said("7", "r1.exr", "r2.png"), "warning: 'r1.exr' and 'r2.png' share their samples (seed 5)");
    EXPECT_EQ(said("7", "r1.exr", "r3.exr").find("share their samples"), std::string::npos);
}

TEST_F(ErrorLog, TimeStopsAWholePicture)
{
    const Said said = render_until({"-o", "x.exr", "--time", "300ms", "--stats", "s.json"});
    ASSERT_EQ(said.code, 0) << said.err;
    const auto stats = nlohmann::json::parse(read_bytes(file("s.json")));
    EXPECT_EQ(stats["stopped_by"], "time");
    EXPECT_EQ(stats["partial"], false);
    EXPECT_GE(stats["passes"].back()["seconds"].get<double>(), 0.0);
    EXPECT_EQ(metadata("x.exr", "bias"), "stopped_by_time");
    EXPECT_EQ(metadata("x.exr", "partial"), "0");
    // So many as there were time for, not those that the scene file says.
    EXPECT_EQ(metadata("x.exr", "spp"), std::to_string(stats["settings"]["spp"].get<int>()));
}

TEST_F(ErrorLog, ErrorStopsWhereItIsSmallEnough)
{
    const Said said = render_until({"-o", "x.exr", "--error", "0.2", "--stats", "s.json"});
    ASSERT_EQ(said.code, 0) << said.err;
    const auto stats = nlohmann::json::parse(read_bytes(file("s.json")));
    EXPECT_EQ(stats["stopped_by"], "error");
    EXPECT_LE(stats["estimated_error"].get<double>(), 0.2);
    EXPECT_EQ(metadata("x.exr", "bias"), "stopped_by_error");
    // The picture is that of so many samples.
    const std::string spp = metadata("x.exr", "spp");
    EXPECT_GE(std::stoi(spp), 16);
    ASSERT_EQ(render({"-o", "same.exr", "-s", spp}).code, 0);
    EXPECT_TRUE(same_pixels(image("x.exr"), image("same.exr")));
    EXPECT_EQ(metadata("x.exr", "settings_hash"), metadata("same.exr", "settings_hash"));
}

TEST_F(ErrorLog, SamplesMayRunOutFirst)
{
    ASSERT_EQ(render({"-o", "x.exr", "--time", "1h", "--error", "1e-9", "-s", "5"}).code, 0);
    EXPECT_EQ(metadata("x.exr", "bias"), "none");
    EXPECT_EQ(metadata("x.exr", "spp"), "5");
}

TEST_F(ErrorLog, ReplicatesGiveAnInterval)
{
    ASSERT_EQ(render({"-o", "x.exr", "-s", "32", "--replicates", "4", "--stats", "s.json"}).code, 0);
    const auto stats = nlohmann::json::parse(read_bytes(file("s.json")));
    const double error = stats["estimated_error"];
    EXPECT_LT(stats["estimated_interval"][0].get<double>(), error);
    EXPECT_GT(stats["estimated_interval"][1].get<double>(), error);
    EXPECT_EQ(metadata("x.exr", "replicates"), "4");
    ASSERT_EQ(render({"-o", "plain.exr", "-s", "32"}).code, 0);
    EXPECT_FALSE(same_pixels(image("x.exr"), image("plain.exr")));
    EXPECT_NE(metadata("x.exr", "settings_hash"), metadata("plain.exr", "settings_hash"));
}

TEST_F(ErrorLog, SaysWhatIsWrong)
{
    ASSERT_EQ(render({"-o", "reference.exr"}).code, 0);
    const auto expect = [&](const std::vector<std::string>& options, int code, const std::string& words) {
        std::vector<std::string> all{"-o", "x.exr"};
        all.insert(all.end(), options.begin(), options.end());
        const Said said = render(all);
        EXPECT_EQ(said.code, code) << said.err;
        EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
    };
    expect({"--time", "soon"}, 2, "--time: 'soon' is not a time such as 90s, 1.5m, 2h or 500ms");
    expect({"--time", "-3s"}, 2, "is not a time");
    expect({"--time", "0"}, 2, "is not a time");
    expect({"--error", "0"}, 2, "--error: '0' is not a number from");
    expect({"--replicates", "0"}, 2, "--replicates");
    expect({"--reference2", "reference.exr"}, 2, "--reference2: needs --reference");
    expect({"--reference", "x.exr"}, 2, "--reference: 'x.exr' would be overwritten");
    expect({"--reference", "nothing.exr"}, 66, "nothing.exr");
    expect({"--reference", "reference.exr", "--size", "8x8"}, 65, "the pictures differ in size");
    expect({"--error-log", "nowhere/e.csv"}, 1, "nowhere");
    expect({"--error-log", "scene.toml"}, 2, "would overwrite the input");
}

}  // namespace
}  // namespace lancer
