#include "report/study/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/page/html.h"
#include "report/page/html_pictures.h"
#include "report/study/json.h"
#include "support/xml_check.h"
#include "synthetic_study.h"

namespace lancer {
namespace {

const std::string png =
    std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\4\0\0\0\3", 24);  // as much of one as a page looks at

// Two scenes, of which the second has a poor reference and a failed run; two alike methods and a biased one.
Study example()
{
    const std::vector<SyntheticMethod> methods{{"plain", 1, -1, 0, 1, 0.1, 2048},
                                               {"better", 0.5, -1, 0, 0.8, 0.1, 2048},
                                               {"clamped", 0.3, -1, 5e-3, 1, 0.1, 2048}};
    Study study = synthetic_study(methods, 31, 8, "box");
    Study other = synthetic_study(methods, 32, 8, "<statues>");
    study.scenes.push_back(other.scenes[0]);
    std::move(other.runs.begin(), other.runs.end(), std::back_inserter(study.runs));
    study.scenes[0].reference_noise_relmse = 1e-7;
    study.scenes[1].reference_noise_relmse = 2e-3;
    study.methods[2].biases = {"clamp 10", "depth 4"};
    study.methods[1].peer = true;
    return study;
}

std::vector<XmlElement> page_of(const Study& study, const std::vector<ScenePictures>& crops = {})
{
    return read_xml(to_html(make_study_page(study, crops)));
}

// Texts of all elements of this name.
std::vector<std::string> texts(const std::vector<XmlElement>& page, const std::string& name)
{
    std::vector<std::string> found;
    for (const XmlElement& e : page)
        if (e.name == name) found.push_back(e.text);
    return found;
}

size_t holding(const std::vector<std::string>& list, const std::string& part)
{
    return static_cast<size_t>(std::count_if(list.begin(), list.end(),
                                             [&](const auto& text) { return text.find(part) != std::string::npos; }));
}

// The row of the first table with this in its caption that begins with the first text.
std::vector<std::string> row(const Document& page, size_t section, const std::string& caption, const std::string& first)
{
    for (const Block& block : page.sections.at(section).blocks) {
        const auto* table = std::get_if<Table>(&block);
        if (!table || table->caption.find(caption) == std::string::npos) continue;
        for (const auto& cells : table->rows) {
            if (cells.front().text.rfind(first, 0) != 0) continue;
            std::vector<std::string> words;
            for (const Cell& cell : cells) words.push_back(cell.text);
            return words;
        }
    }
    ADD_FAILURE() << caption << " has no row " << first;
    return std::vector<std::string>(8);
}

TEST(StudyPage, HasWhatAStudySays)
{
    const Study study = example();
    const auto page = page_of(study);
    EXPECT_EQ(texts(page, "h2"),
              (std::vector<std::string>{"Methods and the ledger of their biases", "Scene: box", "Scene: <statues>",
                                        "The machine", "How to read this", "Raw data"}));
    size_t plots = 0, bands = 0;
    for (const XmlElement& e : page) {
        plots += e.has_class("plot");
        bands += e.has_class("band");
    }
    EXPECT_EQ(plots, 4u);   // over time and over samples of each scene
    EXPECT_EQ(bands, 12u);  // of each method
    const auto cells = texts(page, "td"), words = texts(page, "p"), captions = texts(page, "caption");
    EXPECT_EQ(holding(cells, "a CPU"), 1u);
    EXPECT_EQ(holding(cells, "clamped\nbiased: clamp 10, depth 4") + holding(cells, "clampedbiased: clamp 10, depth 4"),
              12u);  // in six tables of each scene
    EXPECT_EQ(holding(words, "Its own noise is a relMSE of 1.00·10⁻⁷; nothing is ranked below 2.00·10⁻⁷"), 1u);
    EXPECT_EQ(holding(words, "path, 65536 samples"), 2u);
    EXPECT_EQ(holding(words, "Comparable:"), 1u);
    EXPECT_EQ(holding(captions, "Seconds of rendering to an error"), 2u);
}

TEST(StudyPage, TablesSayWhatTheStatisticsSay)
{
    const Document page = make_study_page(example(), {});
    const auto times = row(page, 1, "Seconds of rendering", "plain");
    EXPECT_NEAR(std::stod(times[1]), 10 * 1.14, 2);
    EXPECT_NEAR(std::stod(times[2]), 100 * 1.14, 20);
    EXPECT_NEAR(std::stod(times[3]), 1000 * 1.14, 200);
    EXPECT_NE(times[2].find(" .. "), std::string::npos);
    EXPECT_EQ(row(page, 1, "Seconds of rendering", "clamped")[3], "not reached");
    EXPECT_EQ(row(page, 2, "Seconds of rendering", "plain")[3], "below the noise of the reference");
    EXPECT_EQ(row(page, 1, "At equal time", "plain").back(), "the baseline");
    const auto gain = row(page, 1, "At equal time", "better");
    EXPECT_EQ(gain.back(), "faster");
    EXPECT_NEAR(std::stod(gain[4].substr(std::string("×").size())), 2.5, 0.5);
    EXPECT_EQ(row(page, 1, "At equal time", "clamped").back(), "not ranked: biased, the baseline is not");
    EXPECT_EQ(row(page, 2, "At equal time", "better").back(), "not ranked: below the noise of the reference");
    EXPECT_NEAR(std::stod(row(page, 1, "Slopes", "plain")[1]), -0.5, 0.05);
    EXPECT_NE(row(page, 1, "At equal error", "better")[2].find("\nfaster"), std::string::npos);
    EXPECT_NEAR(std::stod(row(page, 1, "The runs", "plain")[3]), 2048, 0);
    const auto errors = row(page, 1, "Errors at equal time", "plain");
    EXPECT_NEAR(std::stod(errors[3].substr(0, 4)) / std::stod(errors[2].substr(0, 4)), 0.8, 0.02);
    EXPECT_EQ(errors[6], "");  // FLIP was not measured
}

TEST(StudyPage, NoiseIsDrawnWhereItMatters)
{
    std::vector<std::string> marked;
    for (const Section& section : make_study_page(example(), {}).sections)
        for (const Block& block : section.blocks)
            if (const auto* plot = std::get_if<Plot>(&block))
                marked.push_back(plot->svg.find("twice the noise of the reference") != std::string::npos ? "yes"
                                                                                                         : "no");
    EXPECT_EQ(marked, (std::vector<std::string>{"no", "no", "yes", "yes"}));
}

TEST(StudyPage, WhatIsNotComparableIsSaidFirstAndNotRanked)
{
    Study study = example();
    study.not_comparable = {"load 7 is above 2.5", "CPU 'a' against 'b'"};
    const auto page = page_of(study);
    const auto words = texts(page, "p");
    EXPECT_EQ(words.at(0), "Not comparable: load 7 is above 2.5.");
    EXPECT_EQ(words.at(1), "Not comparable: CPU 'a' against 'b'.");
    EXPECT_EQ(holding(words, "Comparable:"), 0u);
    for (const std::string& cell : texts(page, "td")) {
        EXPECT_NE(cell, "faster");
        EXPECT_NE(cell, "slower");
    }
}

TEST(StudyPage, FailedRunsAreShown)
{
    Study study = example();
    study.runs[1] = {"box", "better", 1, {}, true, "out of <memory>"};
    const auto page = page_of(study);
    EXPECT_EQ(holding(texts(page, "h2"), "Failed runs"), 1u);
    EXPECT_EQ(holding(texts(page, "td"), "out of <memory>"), 1u);
    EXPECT_EQ(holding(texts(page, "td"), "not ranked: 1 run failed"), 6u);  // twice above, at equal time, at 3 errors
}

TEST(StudyPage, CropsOfAScene)
{
    const PictureRow row{"", "here", {{"reference", "", png}, {"plain", "16 spp", png}, {"clamped", "17 spp", png}}};
    const auto page = page_of(example(), {{"box", {row, row}, ""}});
    size_t images = 0;
    for (const XmlElement& e : page) {
        if (e.name != "img") continue;
        EXPECT_EQ(e.attributes.at("src"), "data:image/png;base64," + base64(png));
        ++images;
    }
    EXPECT_EQ(images, 2 * (3u + 2 + 6));  // side by side, the reference over the others, either side of the slider
    EXPECT_EQ(holding(texts(page, "figcaption"), "clamped (biased)17 spp"), 2u);
}

TEST(StudyPage, WhatIsLeftOutAndWhatIsNotRankedIsSaid)
{
    Study study = example();
    study.on_scenes = {{"box", "better", "not installed", "", "", 0},
                       {"<statues>", "better", "", "the same samples in every run", "", 0},
                       {"box", "plain", "", "", "its own", 1e-3}};
    const auto page = page_of(study);
    const auto words = texts(page, "p");
    EXPECT_EQ(holding(words, "Left out: better: not installed"), 1u);
    EXPECT_EQ(holding(words, "better: the same samples in every run."), 1u);
    EXPECT_EQ(holding(words, "plain: errors against its own. Its own noise is a relMSE of"), 1u);
    EXPECT_EQ(holding(texts(page, "td"), "left out: not installed"), 1u);  // above alone
    EXPECT_EQ(holding(texts(page, "td"), "not ranked: the same samples in every run"), 6u);
    // The own reference is too noisy to tell the time to 1e-3.
    EXPECT_EQ(row(make_study_page(study, {}), 1, "Seconds of rendering", "plain")[3],
              "below the noise of the reference");
}

TEST(StudyPage, Levels)
{
    Study study = example();
    PictureLevel level;
    level.scene = "box", level.method = "better", level.pictures = 8;
    level.ratio = {0.998, 0.9982, 0.9985};
    level.ratio_interval = {Interval{0.9979, 0.9981}, {0.9981, 0.9983}, {0.9984, 0.9986}};
    level.systematic_relmse = 1.2e-5, level.systematic_interval = {1e-5, 1.4e-5};
    study.levels = {level};
    const Document page = make_study_page(study, {});
    const auto cells = row(page, 1, "Exposure and energy", "better");
    EXPECT_EQ(cells[2], "0.99800\n[0.99790 .. 0.99810]");
    EXPECT_EQ(cells[5], "1.20·10⁻⁵\n[1.00·10⁻⁵ .. 1.40·10⁻⁵]");
}

TEST(StudyPage, OneTableOverAllScenes)
{
    Study study = example();
    for (StudyRun& run : study.runs)
        for (ErrorPoint& p : run.points) p.flip = 0.3 * std::sqrt(p.relmse);
    const auto table = [&] { return std::get<Table>(make_study_page(study, {}).opening.at(1)); };
    const Table all = table();
    EXPECT_EQ(all.head, (std::vector<std::string>{"scene", "better: time to equal error", "better: FLIP at equal time",
                                                  "clamped (biased): time to equal error",
                                                  "clamped (biased): FLIP at equal time"}));
    ASSERT_EQ(all.rows.size(), 3u);
    EXPECT_EQ(all.rows[1][0].text, "<statues>");
    EXPECT_EQ(all.rows[2][0].text, "geometric mean");
    const auto number = [](const Cell& cell) { return std::stod(cell.text.substr(std::string("×").size())); };
    EXPECT_NEAR(number(all.rows[0][1]), 2.5, 0.5);
    EXPECT_NE(all.rows[0][1].text.find("\nat relMSE 0.001\nfaster"), std::string::npos) << all.rows[0][1].text;
    EXPECT_NE(all.rows[1][1].text.find("\nat relMSE 0.005\n"), std::string::npos) << "above the noise";
    EXPECT_NEAR(number(all.rows[0][2]), std::sqrt(2.5), 0.3);
    EXPECT_NE(all.rows[0][2].text.find(" against "), std::string::npos);
    EXPECT_NEAR(number(all.rows[2][1]), std::sqrt(number(all.rows[0][1]) * number(all.rows[1][1])), 0.02);
    EXPECT_NE(all.rows[2][1].text.find("of 2 of 2 scenes\nfaster"), std::string::npos);
    EXPECT_NE(all.rows[0][3].text.find("not ranked: biased, the baseline is not"), std::string::npos);
    EXPECT_EQ(all.rows[2][3].text, "not ranked: ranked on no scene");
    study.on_scenes = {{"box", "better", "textures are not supported", "", "", 0}};
    const Table refused = table();
    EXPECT_EQ(refused.rows[0][1].text, "left out: textures are not supported");
    EXPECT_EQ(refused.rows[0][1].tone, Tone::bad);
    EXPECT_NE(refused.rows[2][1].text.find("of 1 of 2 scenes"), std::string::npos);
}

TEST(StudyPage, OpensWithTheReferences)
{
    const Document page = make_study_page(example(), {{"<statues>", {}, png}, {"box", {}, ""}});
    const auto* gallery = std::get_if<Gallery>(&page.opening.at(0));
    ASSERT_TRUE(gallery);
    ASSERT_EQ(gallery->pictures.size(), 1u) << "scenes without a reference have no picture";
    EXPECT_EQ(gallery->pictures[0].name, "<statues>");
    EXPECT_EQ(gallery->pictures[0].caption, "a scene");
    EXPECT_EQ(gallery->pictures[0].png, png);
    EXPECT_FALSE(std::get_if<Gallery>(&make_study_page(example(), {}).opening.at(0)));
}

TEST(StudyPage, HoldsTheWholeStudy)
{
    const Study study = example();
    for (const XmlElement& e : page_of(study))
        if (e.name == "script") {
            EXPECT_EQ(to_json(read_study("page", e.text)), to_json(study));
        }
    EXPECT_EQ(texts(page_of(study), "script").size(), 1u);
}

TEST(StudyPage, StandsWithoutAnything)
{
    EXPECT_NO_THROW(page_of({}));
    Study study = example();
    study.runs.clear();
    study.machine.clear();
    EXPECT_EQ(holding(texts(page_of(study), "td"), "no run"), 24u);  // three methods, three errors and FLIP, two scenes
    study = example();
    study.runs.resize(1);
    for (ErrorPoint& p : study.runs[0].points) p.relmse = p.rmse = std::numeric_limits<double>::infinity();
    EXPECT_NO_THROW(page_of(study));
    for (ErrorPoint& p : study.runs[0].points) p.relmse = p.rmse = 0;
    EXPECT_NO_THROW(page_of(study));
    study.runs[0].points.resize(1);
    EXPECT_NO_THROW(page_of(study));
}

}  // namespace
}  // namespace lancer
