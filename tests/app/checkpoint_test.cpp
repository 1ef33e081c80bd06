// A render that was stopped, or killed, goes on from its checkpoint with the bits of one that was not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/render/checkpoint_file.h"
#include "app/run_program.h"
#include "app/system_info.h"

namespace lancer {
namespace {

class Checkpoint : public AppTest {
protected:
    // That all channels have the same bits.
    void expect_same(const std::string& a, const std::string& b, const std::string& what) const
    {
        const ExrInfo info = read_exr_info(file(a));
        ASSERT_EQ(info.channels.size(), read_exr_info(file(b)).channels.size()) << what;
        for (const ExrInfo::Channel& channel : info.channels) {
            const auto in_a = read_exr_channel(file(a), channel.name), in_b = read_exr_channel(file(b), channel.name);
            ASSERT_EQ(in_a.size(), in_b.size()) << what;
            EXPECT_EQ(std::memcmp(in_a.data(), in_b.data(), in_a.size() * sizeof(float)), 0)
                << what << ", " << channel.name;
        }
    }
    // Of --stats: what does not depend on time.
    std::vector<nlohmann::json> figures() const
    {
        const auto stats = nlohmann::json::parse(read_bytes(file("s.json")));
        std::vector<nlohmann::json> all{stats.at("estimated_error"), stats.at("samples").at("count")};
        for (const char* const kind : {"camera", "bounce", "shadow"})
            all.push_back(stats.at("rays").at(kind).at("count"));
        return all;
    }
    // The last byte of a file changed.
    void damage(const std::string& name) const
    {
        std::string bytes = read_bytes(file(name));
        bytes.back() = static_cast<char>(bytes.back() ^ 1);
        write(name, bytes);
    }
};

TEST_F(Checkpoint, GoesOnWithTheSameBitsFromAnyNumberOfSamples)
{
    const std::vector<std::pair<std::string, Arguments>> ways{
        {"plain", {}},
        {"AOVs", {"--aov", "all"}},
        {"replicates", {"--replicates", "4"}},
        {"replicates with halves", {"--replicates", "4", "--aov", "denoise"}},
        {"crop", {"--crop", "5,3,20,11"}},
        {"whitted", {"--integrator", "whitted"}},
        {"random decision", {"--integrator", "random-decision"}}};
    for (const auto& [name, way] : ways) {
        const Arguments base = Arguments{"-o", "a.exr", "--stats", "s.json"} + way;
        ASSERT_EQ(render(base + Arguments{"-s", "75", "-o", "whole.exr"}).code, 0) << name;
        const auto expected = figures();
        const Arguments with = base + Arguments{"--checkpoint", "c.lancer", "--resume", "auto"};
        for (const char* const samples : {"3", "21", "21", "64"}) {
            const Said said = render(with + Arguments{"-s", samples});
            ASSERT_EQ(said.code, 0) << name << said.err;
        }
        const Said said = render(with + Arguments{"-s", "75", "--threads", "3", "--tile", "5", "-v"});
        ASSERT_EQ(said.code, 0) << name << said.err;
        expect_words(said.err, "going on after 64.0 samples per pixel");
        expect_same("a.exr", "whole.exr", name);
        EXPECT_EQ(figures(), expected) << name;
        std::filesystem::remove(file("c.lancer"));
        std::filesystem::remove(file("c.lancer.old"));
    }
}

// Adaptive sampling: how many samples a pixel gets is decided on the way.
TEST_F(Checkpoint, KeepsWhatAdaptiveSamplingDecided)
{
    const Arguments base{"-s", "256", "--set", "stop=true", "--stop-error", "0.05", "--aov", "samples"};
    ASSERT_EQ(render(base + Arguments{"-o", "whole.exr"}).code, 0);
    Program program(
        folder_, Arguments{"scene.toml", "--size", "24x16", "-o", "part.exr", "--checkpoint", "c.lancer,0.02s"} + base);
    ASSERT_TRUE(program.wait_for([&] { return exists("c.lancer"); }));
    program.send(SIGKILL);
    program.wait();
    ASSERT_EQ(render(base + Arguments{"-o", "a.exr", "--resume", "c.lancer"}).code, 0);
    expect_same("a.exr", "whole.exr", "adaptive");
}

TEST_F(Checkpoint, ARenderThatIsKilledLosesNoMoreThanAnInterval)
{
    const Arguments picture{"scene.toml", "-s", "600", "--size", "64x64", "--aov", "normal,variance,denoise", "-q"};
    ASSERT_EQ(run(picture + Arguments{"-o", "whole.exr"}).code, 0);
    for (const int wait_ms : {0, 3, 20, 50, 90}) {
        const Arguments with = picture + Arguments{"-o", "a.exr", "--checkpoint", "c.lancer,0.05s", "--resume", "auto"};
        // Killed several times over on the way.
        for (int again = 0; again < 3; ++again) {
            const std::string before = exists("c.lancer") ? read_bytes(file("c.lancer")) : "";
            Program program(folder_, with);
            program.wait_for([&] { return exists("c.lancer") && read_bytes(file("c.lancer")) != before; });
            std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
            program.send(SIGKILL);
            program.wait();
        }
        const Said said = run(with);
        ASSERT_EQ(said.code, 0) << said.err;
        expect_same("a.exr", "whole.exr", "killed after " + std::to_string(wait_ms) + " ms");
        for (const char* const name : {"c.lancer", "c.lancer.old"}) std::filesystem::remove(file(name));
    }
}

TEST_F(Checkpoint, EverySignalThatStopsARenderLeavesOne)
{
    const Arguments picture{"scene.toml", "-s", "2000", "--size", "48x48"};
    ASSERT_EQ(run(picture + Arguments{"-o", "whole.exr"}).code, 0);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGUSR2}) {
        Program program(folder_, picture + Arguments{"-o", "a.exr", "--checkpoint", "c.lancer", "--progress", "json"});
        ASSERT_TRUE(program.wait_for_message("\"spp\":8"));
        program.send(signal);
        const Said stopped = program.wait();
        ASSERT_EQ(stopped.code, 75) << signal << stopped.err;
        expect_words(stopped.err, "to go on, add --resume c.lancer");
        EXPECT_EQ(metadata("a.exr", "partial"), "1");
        if (signal != SIGTERM && signal != SIGHUP) continue;
        ASSERT_EQ(run(picture + Arguments{"-o", "b.exr", "--resume", "c.lancer"}).code, 0);
        expect_same("b.exr", "whole.exr", "signal " + std::to_string(signal));
    }
    Program same(folder_, picture + Arguments{"-o", "c.exr", "--checkpoint", "d.lancer", "--resume", "auto",
                                              "--progress", "json"});
    ASSERT_TRUE(same.wait_for_message("\"spp\":8"));
    same.send(SIGTERM);
    expect_words(same.wait().err, "to go on, run the same command");
    Program program(folder_, picture + Arguments{"-o", "a.exr", "--progress", "json"});
    ASSERT_TRUE(program.wait_for_message("\"spp\":8"));
    program.send(SIGXCPU);
    EXPECT_EQ(program.wait().code, 130) << "nothing to go on from";
}

// While a scene is built there is nothing to keep, but a batch system must hear that the job can be put in again.
// Tables of two anisotropic materials take seconds.
TEST_F(Checkpoint, StoppedBeforeTheFirstSampleARenderBeginsAgain)
{
    std::string scene = "[[light]]\ntype = \"environment\"\nradiance = 1\n";
    for (const std::string ior : {"1.3", "1.5"})
        scene += "[[sphere]]\nmaterial = \"" + ior + "\"\n[material.\"" + ior +
                 "\"]\ntype = \"principled\"\nanisotropy = 0.5\nior = " + ior +
                 "\nroughness_texture = { type = \"checker\", scale = 8 }\n";
    write("slow.toml", scene);
    const auto code_of = [&](const Arguments& more) {
        Program program(folder_, Arguments{"slow.toml", "-s", "64", "--size", "48x48"} + more);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        program.send(SIGTERM);
        const Said said = program.wait();
        expect_words(said.err, "before the first sample");
        return said.code;
    };
    EXPECT_EQ(code_of({"-o", "a.exr", "--checkpoint", "c.lancer", "--resume", "auto"}), 75);
    EXPECT_EQ(code_of({"-o", "part.lancer", "--shard", "1/2"}), 75);
    EXPECT_EQ(code_of({"-o", "a.exr"}), 130);
}

TEST_F(Checkpoint, OfAnotherPictureIsRefused)
{
    ASSERT_EQ(render({"--checkpoint", "c.lancer"}).code, 0);
    write("a.exr", "precious");
    const auto expect_refused = [&](const Arguments& arguments, int code, const std::string& words) {
        const Said said = render(arguments + Arguments{"-o", "a.exr", "--resume", "c.lancer"});
        EXPECT_EQ(said.code, code) << words << said.err;
        expect_words(said.err, words);
        EXPECT_EQ(read_bytes(file("a.exr")), "precious");
    };
    expect_refused({"--seed", "7"}, 65, "of another picture: seed '0' there, '7' here");
    expect_refused({"--size", "25x16"}, 65, "size '24x16' there, '25x16' here");
    expect_refused({"--aov", "depth"}, 65, "aov '' there, 'depth' here");
    expect_refused({"--crop", "0,0,9,9"}, 65, "crop '0,0,24,16' there, '0,0,9,9' here");
    expect_refused({"-s", "2"}, 2, "more than the 2 of --spp");
    expect_refused({"--denoise"}, 65, "halves to denoise 'none' there, 'of 3 sets' here");
    write("scene.toml", read_bytes(file("scene.toml")) + "# changed\n");
    expect_refused({}, 65, "scene '");
    EXPECT_EQ(render({"--resume", "auto"}).code, 2);
    EXPECT_EQ(render({"--resume", "none.lancer"}).code, 66);
    EXPECT_EQ(render({"--checkpoint", "scene.toml"}).code, 2);
    EXPECT_EQ(render({"--checkpoint", "none/c.lancer"}).code, 1);
}

TEST_F(Checkpoint, TheOneBeforeStandsInForADamagedOne)
{
    const Arguments with{"--checkpoint", "c.lancer", "--resume", "auto"};
    ASSERT_EQ(render({"-s", "40", "-o", "whole.exr"}).code, 0);
    ASSERT_EQ(render(with + Arguments{"-s", "10"}).code, 0);
    ASSERT_EQ(render(with + Arguments{"-s", "20"}).code, 0);
    ASSERT_TRUE(exists("c.lancer.old"));
    damage("c.lancer");
    const Said said = render(with + Arguments{"-s", "40", "-o", "a.exr"});
    ASSERT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "this checkpoint is damaged");
    expect_words(said.err, "c.lancer.old: warning: the render goes on from this one");
    expect_words(said.err, "going on after 10.0 samples");
    expect_same("a.exr", "whole.exr", "from the one before");
    damage("c.lancer");
    std::filesystem::remove(file("c.lancer.old"));
    EXPECT_EQ(render(with).code, 65) << "not begun anew in silence";
}

TEST_F(Checkpoint, OneThatCannotBeWrittenEndsNoRender)
{
    const Said said = render({"-o", "a.exr", "--checkpoint", "/dev/full"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "/dev/full: warning: cannot write");
    EXPECT_TRUE(exists("a.exr"));
}

PictureRecipe small_recipe()
{
    PictureRecipe recipe;
    recipe.keeps_blocks_open = true;
    recipe.options.denoise_sets = true;
    recipe.options.aovs = {Aov::depth};
    recipe.options.light_layers = recipe.options.part_layers = recipe.options.lobe_layers = recipe.options.mattes =
        true;
    recipe.options.background = BackgroundChoice::transparent;
    recipe.stats.scene.catches_shadows = true;
    recipe.light_groups = {"rest", "key"};
    recipe.manifests = {{"CryptoObject", "{}"}};
    RenderSettings& settings = recipe.stats.settings.render;
    settings.size = {3, 2}, settings.replicates = 2, settings.stop = true;
    recipe.stats.settings.crop = {0, 0, 3, 2};
    return recipe;
}

Film small_film()
{
    Film film = empty_film(small_recipe());
    for (size_t i = 0; i < 6; ++i) {
        film.pixels[i] = {{0.1, 0.2, 1e300}, 5e-324, 7};
        film.wanted[i] = 9;
    }
    return film;
}

RenderState small_state()
{
    RenderState state;
    state.held = {{0, 0, 3, 2}};
    return state;
}

// A small file may claim a large picture.
TEST_F(Checkpoint, OneThatNeedsMoreMemoryThanThereIsIsRefused)
{
    if (memory_bytes() > uint64_t{1} << 37) GTEST_SKIP() << "there is room for it";
    PictureRecipe recipe = small_recipe();
    recipe.stats.settings.render.size = {16384, 16384};
    recipe.stats.settings.crop = {0, 0, 16384, 16384};
    RenderState state = small_state();
    recipe.stats.settings.render.spp = 1;
    state.held.clear(), state.shard = {1, 9}, state.pass = {0, 1};
    write_checkpoint(file("c.lancer"), {}, recipe, state, small_film());
    EXPECT_LT(read_bytes(file("c.lancer")).size(), 10000u);
    expect_error(ErrorKind::no_memory, "film", "", [&] { read_checkpoint(file("c.lancer")); });
    const Said said = run({"merge", "c.lancer", "-o", "a.exr"});
    EXPECT_EQ(said.code, 71) << said.err;
    expect_words(said.err, "film: 268.4 million pixels of ");
}

TEST_F(Checkpoint, EveryDamagedByteAndEveryLengthIsNoticed)
{
    const RenderIdentity identity{{"scene", "s"}, {"seed", "0"}};
    const Film film = small_film();
    RenderState state = small_state();
    state.pass = {16, 32}, state.left = {{0, 0, 2, 2}};
    state.counters.drop({1, 0, 17});
    state.passes = {{16, 0.5, 0.25}, {32, 1, {}}};
    state.error_log = "spp\n16\n";
    write_checkpoint(file("c"), identity, small_recipe(), state, film);
    const std::string whole = read_bytes(file("c"));
    const auto [same, recipe, again, read] = read_checkpoint(file("c"));
    EXPECT_EQ(same, identity);
    EXPECT_EQ(recipe.stats.settings.render.replicates, 2u);
    EXPECT_EQ(again.left, state.left);
    EXPECT_EQ(again.counters.first_dropped, state.counters.first_dropped);
    EXPECT_EQ(again.passes.size(), 2u);
    EXPECT_EQ(again.error_log, state.error_log);
    for (const Pixel& p : read.pixels) EXPECT_EQ(p.sum_sq, 5e-324);

    const auto expect_noticed = [&](const std::string& bytes, const std::string& what) {
        write("d", bytes);
        EXPECT_THROW(read_checkpoint(file("d")), Error) << what;
    };
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string bytes = whole;
        bytes[i] = static_cast<char>(bytes[i] ^ (1 << i % 8));
        expect_noticed(bytes, "byte " + std::to_string(i));
        if (i % 5 == 0) expect_noticed(whole.substr(0, i), "length " + std::to_string(i));
    }
    expect_noticed(whole + '\0', "longer");
}

// Hashes are of pieces: the last one may be as long as all others.
TEST_F(Checkpoint, MayHaveAnyLength)
{
    const Film film = small_film();
    RenderState state = small_state();
    write_checkpoint(file("c"), {}, small_recipe(), state, film);
    constexpr size_t piece = size_t{1} << 20;
    const size_t rest = piece + sizeof(uint64_t) - read_bytes(file("c")).size();
    for (const size_t length : {rest - 1, rest, rest + 1, rest + piece}) {
        state.error_log.assign(length, '7');
        write_checkpoint(file("c"), {}, small_recipe(), state, film);
        EXPECT_EQ(read_checkpoint(file("c")).state.error_log, state.error_log) << length;
    }
}

}  // namespace
}  // namespace lancer
