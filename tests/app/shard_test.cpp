// lancer render --shard and lancer merge: parts of a picture, rendered apart, are the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "app/run_program.h"

namespace lancer {
namespace {

class Shards : public AppTest {
protected:
    using Words = std::vector<std::string>;
    static Words with(Words words, const Words& more)
    {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    static std::string part(uint32_t k) { return std::to_string(k) + ".lancer"; }
    void render_parts(uint32_t count, const Words& options) const
    {
        for (uint32_t k = 1; k <= count; ++k) {
            const std::string shard = std::to_string(k) + "/" + std::to_string(count);
            const Said said =
                render(with(options, {"--shard", shard, "-o", "%k.lancer", "--threads", k % 2 ? "1" : "3"}));
            ASSERT_EQ(said.code, 0) << said.err;
            ASSERT_EQ(said.out, part(k) + "\n");
        }
    }
    static Words all_parts(uint32_t count)
    {
        Words parts;
        for (uint32_t k = count; k >= 1; --k) parts.push_back(part(k));
        return parts;
    }
    Said merge(const Words& parts, const Words& options) const { return run(with(with({"merge"}, parts), options)); }
    // Every channel of both, bit for bit.
    void expect_same(const std::string& one, const std::string& two) const
    {
        std::vector<std::string> names, others;
        for (const auto& c : read_exr_info(file(one)).channels) names.push_back(c.name);
        for (const auto& c : read_exr_info(file(two)).channels) others.push_back(c.name);
        ASSERT_EQ(names, others);
        const auto a = read_exr_channels(file(one), names), b = read_exr_channels(file(two), names);
        for (size_t i = 0; i < names.size(); ++i)
            EXPECT_EQ(std::memcmp(a[i].data(), b[i].data(), a[i].size() * sizeof(float)), 0) << names[i];
    }
};

TEST_F(Shards, AreThePictureWhateverItHolds)
{
    const std::vector<Words> ways{
        {"-s", "5"},
        {"-s", "33", "--aov", "all,denoise", "--sampler", "independent"},
        {"-s", "20", "--denoise", "--background", "transparent"},
        {"-s", "16", "--replicates", "4", "--crop", "3,2,21,13"},
        {"-s", "16", "--integrator", "whitted"},
        {"-s", "4", "--legacy"},
    };
    uint32_t count = 1;
    for (const Words& way : ways) {
        std::string shown;
        for (const std::string& word : way) shown += " " + word;
        SCOPED_TRACE(shown);
        ++count;
        ASSERT_EQ(render(with(way, {"-o", "whole.exr"})).code, 0);
        render_parts(count, way);
        const Said said = merge(all_parts(count), {"-o", "merged.exr", "-o", "merged.png"});
        ASSERT_EQ(said.code, 0) << said.err;
        EXPECT_EQ(said.out, "merged.exr\nmerged.png\n");
        expect_same("merged.exr", "whole.exr");
        for (const char* key :
             {"scene", "scene_hash", "settings_hash", "spp_done", "rays", "partial", "bias", "options"})
            EXPECT_EQ(metadata("merged.exr", key), metadata("whole.exr", key)) << key;
    }
}

TEST_F(Shards, MayBeMoreThanPixels)
{
    const Words tiny{"--size", "3x2", "-s", "4"};
    ASSERT_EQ(render(with(tiny, {"-o", "whole.exr"})).code, 0);
    render_parts(8, tiny);
    ASSERT_EQ(merge(all_parts(8), {"-o", "merged.exr"}).code, 0);
    expect_same("merged.exr", "whole.exr");
}

TEST_F(Shards, ThatAreMissingAreNamed)
{
    ASSERT_EQ(render({"-o", "whole.exr"}).code, 0);
    render_parts(4, {});
    const Said few = merge({part(1), part(3)}, {"-o", "few.exr"});
    EXPECT_EQ(few.code, 75);
    expect_words(few.err, "missing: shard 2, 4 of 4");
    EXPECT_FALSE(exists("few.exr"));
    const Said allowed = merge({part(1), part(3)}, {"-o", "few.exr", "--allow-missing"});
    EXPECT_EQ(allowed.code, 0) << allowed.err;
    EXPECT_EQ(metadata("few.exr", "partial"), "1");
    // What is there has its bits; what is not is black.
    const Image some = image("few.exr"), whole = image("whole.exr");
    size_t same = 0, black = 0;
    for (size_t i = 0; i < some.pixels.size(); ++i)
        some.pixels[i] == whole.pixels[i] ? ++same : some.pixels[i] == Color{} ? ++black : 0;
    EXPECT_EQ(same + black, some.pixels.size());
    EXPECT_NEAR(static_cast<double>(same) / static_cast<double>(some.pixels.size()), 0.5, 0.1);
}

TEST_F(Shards, MayBeMergedInSteps)
{
    ASSERT_EQ(render({"-o", "whole.exr"}).code, 0);
    render_parts(4, {});
    EXPECT_EQ(merge({part(1), part(2), part(1)}, {"-o", "12.lancer"}).code, 75);
    EXPECT_EQ(merge({part(3), part(2)}, {"-o", "23.lancer"}).code, 75);
    const Said overlap = merge({"12.lancer", "23.lancer"}, {"-o", "a.exr"});
    EXPECT_EQ(overlap.code, 65);
    expect_words(overlap.err, "23.lancer: error: has pixels of other parts");
    const Said said = merge({"12.lancer", part(3), part(2), part(4)}, {"-o", "a.exr", "-o", "all.lancer"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "2.lancer: shard 2 of 4 is there already");
    expect_same("a.exr", "whole.exr");
    ASSERT_EQ(merge({"all.lancer"}, {"-o", "b.exr"}).code, 0);
    expect_same("b.exr", "whole.exr");
    // A render goes on from what was merged: with the parts that are missing, or with more samples.
    ASSERT_EQ(render({"--resume", "12.lancer", "-o", "c.exr"}).code, 0);
    expect_same("c.exr", "whole.exr");
    ASSERT_EQ(render({"-s", "12", "-o", "more.exr"}).code, 0);
    ASSERT_EQ(render({"-s", "12", "--resume", "all.lancer", "-o", "d.exr"}).code, 0);
    expect_same("d.exr", "more.exr");
    EXPECT_EQ(render({"--resume", part(1), "-o", "e.exr"}).code, 65);
}

TEST_F(Shards, OfAnotherPictureAreRefused)
{
    render_parts(2, {});
    ASSERT_EQ(render({"--shard", "2/2", "--seed", "5", "-o", "seed.lancer"}).code, 0);
    const Said seed = merge({part(1), "seed.lancer"}, {"-o", "a.exr"});
    EXPECT_EQ(seed.code, 65);
    expect_words(seed.err, "seed.lancer: error: this checkpoint is of another picture: seed '5' there, '0' here");
    ASSERT_EQ(render({"--shard", "2/2", "-s", "5", "-o", "spp.lancer"}).code, 0);
    const Said spp = merge({part(1), "spp.lancer"}, {"-o", "a.exr"});
    EXPECT_EQ(spp.code, 65);
    expect_words(spp.err, "has 5 samples per pixel, '1.lancer' has 4");
    std::string bytes = read_bytes(file(part(2)));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 16);
    write("damaged.lancer", bytes);
    const Said damaged = merge({part(1), "damaged.lancer"}, {"-o", "a.exr"});
    EXPECT_EQ(damaged.code, 65);
    expect_words(damaged.err, "damaged.lancer: error: this checkpoint is damaged");
    EXPECT_EQ(merge({part(1), "absent.lancer"}, {"-o", "a.exr"}).code, 66);
    EXPECT_EQ(merge({part(1)}, {"-o", part(1)}).code, 2);
    EXPECT_FALSE(exists("a.exr"));
}

TEST_F(Shards, GoOnWhereTheyWereStopped)
{
    const Words slow{"-s", "1024", "--size", "64x48"};
    ASSERT_EQ(render(with(slow, {"-o", "whole.exr"})).code, 0);
    Words words = with({"render", "scene.toml", "--shard", "1/2", "-o", "1.lancer", "--resume", "auto"}, slow);
    {
        Program program(folder_, words);
        // Signals count once the first pass has begun.
        program.wait_for([&] { return program.catches(SIGTERM); });
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        program.send(SIGTERM);
        const Said said = program.wait();
        ASSERT_TRUE(said.code == 75 || said.code == 130 || said.code == 0) << said.err;
        if (said.code == 75) {
            expect_words(said.err, "the shard is partial");
            const Said unfinished = merge({"1.lancer"}, {"-o", "a.exr"});
            EXPECT_EQ(unfinished.code, 75);
            expect_words(unfinished.err, "1.lancer: warning: shard 1 of 2 is unfinished and left out");
        }
    }
    ASSERT_EQ(run(words).code, 0);
    ASSERT_EQ(run(words).code, 0) << "a finished one has nothing to do";
    ASSERT_EQ(render(with(slow, {"--shard", "2/2", "-o", "2.lancer"})).code, 0);
    ASSERT_EQ(merge({part(1), part(2)}, {"-o", "merged.exr"}).code, 0);
    expect_same("merged.exr", "whole.exr");
}

TEST_F(Shards, ThatCannotBeWrittenAreRescued)
{
    ASSERT_EQ(render({"-o", "whole.exr"}).code, 0);
    render_parts(2, {});
    std::filesystem::create_symlink("/dev/full", file("full.lancer"));
    const Said said = render({"--shard", "2/2", "-o", "full.lancer"});
    EXPECT_EQ(said.code, 1) << "not where it was asked for";
    EXPECT_EQ(said.out, "full-rescued.lancer\n");
    expect_words(said.err, "what was rendered is rescued as 'full-rescued.lancer'");
    ASSERT_EQ(merge({part(1), "full-rescued.lancer"}, {"-o", "a.exr"}).code, 0);
    expect_same("a.exr", "whole.exr");
}

TEST_F(Shards, AreNumberedAsTheClusterSays)
{
    const auto name_with = [&](const Words& environment) {
        const Said said =
            run({"render", "scene.toml", "--size", "8x8", "-s", "1", "-q", "--shard", "auto"}, environment);
        return said.code == 0 ? said.out : said.err;
    };
    const std::vector<std::pair<Words, std::string>> cases{
        {{"SLURM_ARRAY_TASK_ID=12", "SLURM_ARRAY_TASK_COUNT=4", "SLURM_ARRAY_TASK_MIN=10", "SLURM_ARRAY_TASK_STEP=2"},
         "scene.2-of-4.lancer\n"},
        {{"SLURM_PROCID=0", "SLURM_NTASKS=3", "SLURM_STEP_ID=0"}, "scene.1-of-3.lancer\n"},
        {{"OMPI_COMM_WORLD_RANK=4", "OMPI_COMM_WORLD_SIZE=5"}, "scene.5-of-5.lancer\n"},
        {{"PMI_RANK=1", "PMI_SIZE=2"}, "scene.2-of-2.lancer\n"},
        // mpirun within sbatch or srun: each rank sees the variables of the first task as well.
        {{"SLURM_PROCID=0", "SLURM_NTASKS=4", "SLURM_STEP_ID=0", "OMPI_COMM_WORLD_RANK=3", "OMPI_COMM_WORLD_SIZE=4"},
         "scene.4-of-4.lancer\n"},
        // Several tasks in each task of an array.
        {{"SLURM_ARRAY_TASK_ID=1", "SLURM_ARRAY_TASK_COUNT=2", "SLURM_PROCID=1", "SLURM_NTASKS=3", "SLURM_STEP_ID=0"},
         "scene.5-of-6.lancer\n"},
    };
    for (const auto& [environment, name] : cases) EXPECT_EQ(name_with(environment), name) << environment[0];
    // sbatch alone starts one program, whatever it was given.
    expect_words(name_with({"SLURM_PROCID=0", "SLURM_NTASKS=4"}), "auto finds none of SLURM_ARRAY_TASK_ID");
    expect_words(name_with({"PMI_RANK=2", "PMI_SIZE=2"}), "do not tell one of several");
    EXPECT_EQ(render({"--shard", "0/3"}).code, 2);
    EXPECT_EQ(render({"--shard", "4/3"}).code, 2);
    EXPECT_EQ(render({"--shard", "3"}).code, 2);
}

TEST_F(Shards, AreRefusedWhereTheyCannotBeTheWhole)
{
    for (const Words& what : std::vector<Words>{{"--time", "1s"},
                                                {"--error", "0.1"},
                                                {"--set", "stop=true"},
                                                {"--outliers", "3"},
                                                {"--checkpoint", "c.lancer"},
                                                {"-o", "a.exr"}}) {
        const Said said = run(with({"render", "scene.toml", "--shard", "1/2"}, what));
        EXPECT_EQ(said.code, 2) << what[0];
        expect_words(said.err, "shard");
    }
}

}  // namespace
}  // namespace lancer
