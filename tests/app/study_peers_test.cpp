// lancer study with other renderers: a script stands in for them that draws with lancer itself, so that what a peer's
// pictures are worth is known to the bit, and that fails in the ways that scripts have.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/run_program.h"
#include "report/page/html_pictures.h"
#include "report/study/json.h"
#include "support/xml_check.h"

namespace lancer {
namespace {

// Takes n milliseconds for n samples, so it says. `fault` is run before each picture, in place of `draw` if it ends.
std::string script(const std::string& about, const std::string& fault = "", const std::string& scene = "\"$2\"")
{
    return R"sh(#!/bin/sh
echo "$*" >>calls
if [ "$1" = --about ]; then
)sh" + about +
           R"sh(
exit 0
fi
scene=)sh" +
           scene +
           R"sh(
shift 2
seed=0
size=
while [ $# -gt 0 ]; do
    case $1 in
        -o) out=$2; shift 2 ;;
        --spps) spps=$(echo "$2" | tr , ' '); shift 2 ;;
        --seed) seed=$2; shift 2 ;;
        --size) size="--size $2"; shift 2 ;;
        --throughput-only) shift ;;
        *) shift 2 ;;
    esac
done
for n in $spps; do
)sh" + fault +
           R"sh(
"$LANCER" render $scene $size --filter box -s $n --seed $seed -q -o "$(echo "$out" | sed "s/%d/$n/")" >&2 || exit 1
printf '{"spp": %d, "render_wall_s": %s, "render_cpu_s": null, "biases": []}\n' $n "$(printf '0.%04d' $n)"
done
)sh";
}

const std::string about = R"(echo '{"version": "7", "seeds": true, "squares": false}')";
const std::string about_fixed = R"(echo '{"version": "7", "seeds": false, "squares": true}')";

class StudyPeers : public AppTest {
protected:
    StudyPeers()
    {
        write("study.toml", study);
        std::filesystem::create_directory(file("peers"));
        peer_is(script(about));
    }
    void peer_is(const std::string& text) const
    {
        write("peers/run", text);
        std::filesystem::permissions(file("peers/run"), std::filesystem::perms::owner_all);
    }
    Study result() const { return read_study("study.json", read_bytes(file("out/study.json"))); }
    std::string page() const { return read_bytes(file("out/index.html")); }
    std::vector<StudyRun> runs_of(const std::string& method) const
    {
        std::vector<StudyRun> runs;
        for (const StudyRun& run : result().runs)
            if (run.method == method) runs.push_back(run);
        return runs;
    }
    size_t calls() const
    {
        const std::string text = read_bytes(file("calls"));
        return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    // The study is written anew with one text in place of another.
    void replace(const std::string& from, const std::string& to) const
    {
        std::string text = read_bytes(file("study.toml"));
        ASSERT_NE(text.find(from), std::string::npos);
        write("study.toml", text.replace(text.find(from), from.size(), to));
    }
    Said run_study() const { return run({"study", "study.toml", "-o", "out", "--allow-peers"}); }

    static constexpr const char* study = R"(version = 1
seeds = 2
spp = 16
peers = "peers"
[[scene]]
name = "balls"
file = "scene.toml"
options = "--size 12x8 --filter box"
reference_spp = 64
[[method]]
name = "path"
[[method]]
name = "other"
peer = "fake"
own_reference_spp = 32
)";
};

TEST_F(StudyPeers, ItsPicturesAreWorthWhatTheSameOfLancerAre)
{
    const Said said = run_study();
    ASSERT_EQ(said.code, 0) << said.err;
    const auto ours = runs_of("path"), theirs = runs_of("other");
    ASSERT_EQ(theirs.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        ASSERT_EQ(theirs[i].points.size(), 3u);
        for (size_t k = 0; k < 3; ++k) {
            const ErrorPoint &a = ours[i].points[2 * k], &b = theirs[i].points[k];
            EXPECT_EQ(b.spp, 1u << 2 * k);
            EXPECT_EQ(a.spp, b.spp);
            EXPECT_EQ(a.rmse, b.rmse);
            EXPECT_EQ(a.relmse, b.relmse);
            EXPECT_EQ(a.relmse_trimmed, b.relmse_trimmed);
            EXPECT_EQ(a.smape, b.smape);
            EXPECT_EQ(a.flip, b.flip);
            EXPECT_EQ(a.rays_camera, b.rays_camera);
            EXPECT_DOUBLE_EQ(b.wall_s, 1e-4 * (1 << 2 * k));
            EXPECT_TRUE(std::isnan(b.cpu_s));
        }
    }
    const Study s = result();
    EXPECT_EQ(s.methods[1].version, "7");
    EXPECT_TRUE(s.methods[1].peer);
}

TEST_F(StudyPeers, StandsASecondTimeAgainstItsOwnReference)
{
    ASSERT_EQ(run_study().code, 0);
    const auto own = runs_of("other (own reference)"), theirs = runs_of("other");
    ASSERT_EQ(own.size(), 2u);
    EXPECT_EQ(own[0].points.size(), 3u);
    EXPECT_NE(own[0].points[2].relmse, theirs[0].points[2].relmse);
    EXPECT_EQ(own[0].points[2].wall_s, theirs[0].points[2].wall_s);
    const Study s = result();
    const MethodOnScene& known = s.on_scene("balls", "other (own reference)");
    EXPECT_EQ(known.reference, "fake 7, two halves of 32 spp each, seeds of their own");
    EXPECT_GT(known.reference_noise_relmse, 0);
    EXPECT_TRUE(s.on_scene("balls", "other").reference.empty());
}

TEST_F(StudyPeers, ThePageShowsLevelsAndCrops)
{
    ASSERT_EQ(run_study().code, 0);
    size_t images = 0, captions = 0;
    for (const XmlElement& e : read_xml(page())) {
        images += e.name == "img";
        captions += e.name == "figcaption" && e.text.find("other") == 0 && e.text.find("relMSE") != std::string::npos &&
                    e.text.find("16 spp in 0.0016") != std::string::npos;
        if (e.name == "img") {
            EXPECT_EQ(e.attributes.at("src").rfind("data:image/png;base64,", 0), 0u);
        }
    }
    EXPECT_EQ(captions, 1u);  // the picture is one block
    // The scene; side by side, the reference over two of them, and either side of the slider.
    EXPECT_EQ(images, 1u + 3 + 2 + 6);
    const std::string reference = read_bytes(file("out/references/balls.png"));
    EXPECT_NE(page().find("<div class=\"gallery\">"), std::string::npos);
    EXPECT_NE(page().find(base64(reference)), std::string::npos);
    const Study s = result();
    ASSERT_EQ(s.levels.size(), 2u);
    for (size_t c = 0; c < 3; ++c) EXPECT_EQ(s.levels[0].ratio[c], s.levels[1].ratio[c]);
    EXPECT_EQ(s.levels[0].systematic_relmse, s.levels[1].systematic_relmse);
    EXPECT_EQ(s.levels[0].pictures, 2u);
}

TEST_F(StudyPeers, GoesOnWhereItEnded)
{
    ASSERT_EQ(run_study().code, 0);
    const size_t first = calls();
    EXPECT_EQ(first, 1u + 1 + 2 + 2);  // what it is, how fast it is, its own reference, two seeds
    const std::string before = read_bytes(file("out/runs.csv"));
    ASSERT_EQ(run_study().code, 0);
    EXPECT_EQ(calls(), first + 1);  // what it is
    EXPECT_EQ(read_bytes(file("out/runs.csv")), before);
    std::filesystem::remove(file("out/runs/balls.other.2.16.exr.done"));
    ASSERT_EQ(run_study().code, 0);
    EXPECT_EQ(calls(), first + 3);
    std::string newer = script(about);
    peer_is(newer.replace(newer.find("\"7\""), 3, "\"8\""));
    ASSERT_EQ(run_study().code, 0);
    EXPECT_EQ(calls(), 2 * first + 3);
}

TEST_F(StudyPeers, APictureThatTookLongerThanABetterOneIsLeftOut)
{
    std::string text = script(about);
    const std::string seconds = "\"$(printf '0.%04d' $n)\"";
    text.replace(text.find(seconds), seconds.size(), "$([ $n = 4 ] && echo 0.5 || printf '0.%04d' $n)");
    peer_is(text);
    ASSERT_EQ(run_study().code, 0);
    const StudyRun run = runs_of("other")[0];
    ASSERT_EQ(run.points.size(), 2u);
    EXPECT_EQ(run.points[0].spp, 1u);
    EXPECT_EQ(run.points[1].spp, 16u);
}

TEST_F(StudyPeers, WhatCannotBeHadIsLeftOutAndSaid)
{
    const auto expect = [&](const std::string& words) {
        std::filesystem::remove_all(file("out"));
        const Said said = run_study();
        EXPECT_EQ(said.code, 0) << said.err;
        expect_words(said.err, "warning: 1 method left out:");
        expect_words(said.err, "other on balls: " + words);
        expect_words(result().on_scene("balls", "other").left_out, words);
        EXPECT_TRUE(runs_of("other").empty());
        EXPECT_EQ(runs_of("path").size(), 2u);
        expect_words(page(), "Left out: other: " + words.substr(0, 20));
    };
    peer_is("#!/bin/sh\necho 'run: error: fake is not installed: say please' >&2\nexit 69\n");
    expect("fake is not installed: say please");
    peer_is(script(about, "echo 'run: error: scene.toml: fake cannot render balls' >&2; exit 65"));
    expect("scene.toml: fake cannot render balls");
    peer_is(script(about));
    replace("--filter box", "--filter box --max-depth 4");
    expect("another program has no equivalent of '--max-depth'");
    replace("--filter box --max-depth 4", "");
    expect("another program draws with a box filter");
    std::filesystem::remove(file("peers/run"));
    expect("there is no script");
}

TEST_F(StudyPeers, WhatGoesWrongIsAFailedRun)
{
    const auto expect = [&](const std::string& text, const std::string& words) {
        std::filesystem::remove_all(file("out"));
        peer_is(text);
        const Said said = run_study();
        EXPECT_EQ(said.code, 1) << said.err;
        expect_words(said.err, " runs failed; the first one, other on balls, said:");
        expect_words(said.err, words);
        EXPECT_TRUE(runs_of("other").at(0).failed);
        EXPECT_FALSE(runs_of("path").at(0).failed);
        EXPECT_NO_THROW(read_xml(page()));
    };
    expect(script("exit 3"), "ended with 3");
    expect(script("echo '{\"version\": 7}'"), "fake printed invalid peer JSON: {\"version\": 7}");
    expect(script(about, "echo out of luck >&2; exit 1"), "out of luck");
    expect(script(about, "kill -SEGV $$"), "ended with 139");
    expect(script(about, "echo '{{{'"), "printed invalid peer JSON: {{{");
    expect(script(about, "[ $n = 1 ] && continue"), "told of 2 pictures and was asked for 3");
    expect(script(about, "echo '{\"spp\":3,\"render_wall_s\":1,\"render_cpu_s\":null,\"biases\":[]}'; exit 0"),
           "told of 3 samples");
    expect(script(about, "[ $n = 1 ] && size='--size 3x3'"), "the pictures differ in size");
    expect(script(about, "[ $n = 1 ] && out=elsewhere%d.exr"), "balls.other.1.1.exr");
}

TEST_F(StudyPeers, OneThatDoesNotEndIsStoppedWithAllThatItStarted)
{
    replace("peers = \"peers\"", "peers = \"peers\"\npeer_timeout = 0.5");
    peer_is(script(about, "(sleep 60; echo late >late) & sleep 60"));
    const Said said = run_study();
    EXPECT_EQ(said.code, 1);
    expect_words(said.err, "did not end within 0.5 s");
}

TEST_F(StudyPeers, WithoutSeedsItHasNoReferenceOfItsOwnAndIsNotRanked)
{
    peer_is(script(about_fixed));
    const Said said = run_study();
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_TRUE(runs_of("other (own reference)").empty());
    const StudyRun run = runs_of("other")[1];
    std::vector<uint32_t> samples;
    for (const ErrorPoint& p : run.points) samples.push_back(p.spp);
    EXPECT_EQ(samples, (std::vector<uint32_t>{1, 4, 16}));
    expect_words(result().on_scene("balls", "other").not_ranked, "the same samples in every run");
    EXPECT_EQ(result().levels[1].pictures, 1u);
    replace("own_reference_spp = 32", "throughput_only = true");
    ASSERT_EQ(run_study().code, 0);
    EXPECT_EQ(runs_of("other")[1].points.size(), 1u);
    EXPECT_EQ(result().on_scene("balls", "other").not_ranked, "throughput only");
}

TEST_F(StudyPeers, AnotherLevelIsNotComparable)
{
    std::string brighter = small_scene;
    brighter.replace(brighter.find("[0.2, 0.3, 0.4]"), 15, "[0.4, 0.6, 0.8]");
    write("brighter.toml", brighter);
    peer_is(script(about, "", "brighter.toml"));
    ASSERT_EQ(run_study().code, 0);
    expect_words(result().on_scene("balls", "other").not_ranked, "not comparable: its mean radiance is ");
    expect_words(result().on_scene("balls", "other (own reference)").not_ranked, "not comparable");
    EXPECT_EQ(result().on_scene("balls", "path").not_ranked, "");
    EXPECT_GT(result().levels[1].systematic_relmse, 0.01);
}

TEST_F(StudyPeers, WrongStudyFiles)
{
    const auto expect = [&](const std::string& from, const std::string& to, int code, const std::string& words) {
        write("study.toml", study);
        replace(from, to);
        const Said said = run_study();
        EXPECT_EQ(said.code, code) << said.err;
        expect_words(said.err, words);
    };
    expect("peer = \"fake\"", "peer = \"fake\"\noptions = \"-s 4\"", 65, "'options' in [[method]]");
    expect("name = \"path\"", "name = \"path\"\nthroughput_only = true", 65, "is of peers alone");
    expect("peers = \"peers\"", "", 65, "needs 'peers' at the top level");
    expect("spp = 16", "spp = 16\npeer_timeout = 0", 65, "'peer_timeout' at the top level");
    peer_is("#!/bin/sh\necho \"run: error: unknown peer '$2'\" >&2\nexit 2\n");
    write("study.toml", study);
    const Said said = run_study();
    EXPECT_EQ(said.code, 65);
    expect_words(said.err, "study.toml: error: [[method]] 'other': unknown peer 'fake'");
    EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace lancer
