// Whatever call fails while files are written: each file is the old one or the new one, the picture is somewhere, and
// nothing else is left behind.
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>

#include "app/run_program.h"

namespace lancer {
namespace {

class Faults : public AppTest {
protected:
    static constexpr const char* old = "of before";

    // All files that a render writes. Relative names: out/ is the folder whose calls fail.
    Said render_with(const std::vector<std::string>& faults)
    {
        std::filesystem::remove_all(file("out"));
        std::filesystem::remove_all(file("spare"));
        for (const char* const folder : {"out", "spare"}) std::filesystem::create_directory(file(folder));
        for (const char* const name : {"a.exr", "b.png", "s.json", "e.csv"}) write(std::string("out/") + name, old);
        std::vector<std::string> environment{"LD_PRELOAD=" LANCER_FAIL_CALLS, "LANCER_FAIL_BELOW=" + file("out"),
                                             "TMPDIR=" + file("spare"), "ASAN_OPTIONS=verify_asan_link_order=0"};
        environment.insert(environment.end(), faults.begin(), faults.end());
        const std::string out = file("out") + "/";
        return run({"render", "scene.toml", "--size", "24x16", "-s", "40", "-o", out + "a.exr", "-o", out + "b.png",
                    "--stats", out + "s.json", "--error-log", out + "e.csv", "--checkpoint", out + "c.lancer",
                    "--reproducible", "--progress", "json"},
                   environment);
    }
    static std::vector<std::string> names_in(const std::string& folder)
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().string());
        return names;
    }
    void expect_nothing_lost(const Said& said, const std::string& picture)
    {
        EXPECT_TRUE(said.code == 0 || said.code == 1) << said.code << said.err;
        const std::string exr = read_bytes(file("out/a.exr")), png = read_bytes(file("out/b.png"));
        EXPECT_TRUE(exr == old || exr == picture) << exr.size();
        EXPECT_TRUE(png == old || png.starts_with("\x89PNG")) << png.size();
        const std::string stats = read_bytes(file("out/s.json")), log = read_bytes(file("out/e.csv"));
        EXPECT_TRUE(stats == old || stats.ends_with("}\n")) << stats;
        EXPECT_TRUE(log == old || log.ends_with("\n")) << log;
        bool is_somewhere = exr == picture;
        for (const std::string& folder : {file("out"), file("spare")})
            for (const std::string& name : names_in(folder)) {
                EXPECT_EQ(name.find(".tmp."), std::string::npos) << name;
                is_somewhere = is_somewhere || (name.find("a-rescued") != std::string::npos && name.ends_with(".exr") &&
                                                read_bytes(name) == picture);
            }
        // What cannot be written at all is found before the first sample.
        EXPECT_TRUE(is_somewhere || said.err.find("\"spp\"") == std::string::npos);
        const bool is_whole = exr != old && png != old && stats != old && log != old;
        EXPECT_TRUE(is_whole || said.code == 1);
        if (said.code == 1) expect_words(said.err, "error");
    }
};

// LANCER_FAULTS=all makes each call fail, in each way; else each eighth, in the ways by turns.
TEST_F(Faults, LoseNoPictureAndLeaveNothing)
{
    ASSERT_EQ(render_with({"LANCER_FAIL_COUNT=" + file("count")}).code, 0);
    const std::string picture = read_bytes(file("out/a.exr"));
    const int calls = std::stoi(read_bytes(file("count")));
    EXPECT_GT(calls, 60);
    const bool all = std::getenv("LANCER_FAULTS") != nullptr;
    const std::vector<std::pair<int, bool>> ways{{ENOSPC, true}, {EIO, false}, {EIO, true}, {ENOSPC, false}};
    int injected = 0;
    for (int call = 1; call <= calls; ++call)
        for (size_t way = 0; way < ways.size(); ++way) {
            if (!all && static_cast<size_t>(call) % (8 * ways.size()) != 8 * way) continue;
            const auto [reason, is_lasting] = ways[way];
            SCOPED_TRACE("call " + std::to_string(call) + ": " + std::strerror(reason) +
                         (is_lasting ? ", lasting" : ""));
            std::vector<std::string> faults{"LANCER_FAIL_CALL=" + std::to_string(call),
                                            "LANCER_FAIL_ERRNO=" + std::to_string(reason)};
            if (is_lasting) faults.emplace_back("LANCER_FAIL_LASTING=1");
            expect_nothing_lost(render_with(faults), picture);
            ++injected;
        }
    RecordProperty("injected", injected);
    if (all) std::printf("%d faults at %d calls\n", injected, calls);
}

}  // namespace
}  // namespace lancer
