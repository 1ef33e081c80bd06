// Numbered scene files, and the job script of lancer slurm, run by stand-ins for Slurm's programs.
#include <gtest/gtest.h>

#include "app/run_program.h"

namespace lancer {
namespace {

class Farm : public AppTest {
protected:
    Farm()
    {
        for (const char* number : {"0008", "0009", "0010"})
            write("s." + std::string(number) + ".toml",
                  std::string(small_scene) + "[render]\nseed = " + std::to_string(std::stoi(number)) + "\n");
    }
    void write_program(const std::string& name, const std::string& text) const
    {
        write(name, "#!/bin/sh\n" + text);
        std::filesystem::permissions(file(name), std::filesystem::perms::all);
    }
};

TEST_F(Farm, FramesAreNumberedSceneFiles)
{
    const Said said = run({"render", "s.####.toml", "--frames", "8-10", "--size", "8x8", "-s", "2", "-o", "f.##.exr",
                           "-o", "f.######.png", "--stats", "s.#.json", "-q"});
    ASSERT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(said.out, "f.08.exr\nf.000008.png\nf.09.exr\nf.000009.png\nf.10.exr\nf.000010.png\n");
    EXPECT_TRUE(exists("s.10.json"));
    EXPECT_EQ(metadata("f.10.exr", "seed"), "10");
    const Said absent = run({"render", "s.####.toml", "--frames", "10-12", "--size", "8x8", "-o", "g.#.exr", "-q"});
    EXPECT_EQ(absent.code, 66);
    EXPECT_TRUE(exists("g.10.exr"));
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{"s.####.toml", "--frames", "8-10", "-o", "f.exr"},
                                               {"scene.toml", "--frames", "8-10", "-o", "f.#.exr"},
                                               {"s.####.toml", "--frames", "10-8", "-o", "f.#.exr"},
                                               {"s.####.toml", "--frames", "8-9-10", "-o", "f.#.exr"}}) {
        std::vector<std::string> words{"render"};
        words.insert(words.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run(words).code, 2) << wrong[0] << wrong[2];
    }
}

// sbatch runs the script for each task at once, srun the program.
TEST_F(Farm, TheJobScriptRendersAllShardsOfAllFrames)
{
    write_program("sbatch",
                  "tasks=\nfor word; do case $word in --array=1-*) tasks=$(seq ${word#--array=1-});; esac; done\n"
                  "cat > script\necho $tasks >> calls\necho 77\n"
                  "[ -n \"$tasks\" ] || tasks=0\n"
                  "for t in $tasks; do SLURM_ARRAY_TASK_ID=$t sh script >> log 2>&1; done\nexit 0\n");
    write_program("srun", "shift\nexec \"$@\"\n");
    std::filesystem::create_symlink(LANCER_PROGRAM, file("lancer"));
    const Said script = run({"slurm", "s.####.toml", "--frames", "8-9", "--shards", "3", "-o", "it's.####.exr",
                             "--render", "-s 3 --size 16x12"});
    ASSERT_EQ(script.code, 0) << script.err;
    write("job.sh", script.out);
    const std::string command = "cd '" + folder_.path() + "' && PATH=.:$PATH sh job.sh > ids";
    ASSERT_EQ(std::system(command.c_str()), 0) << read_bytes(file("log"));
    EXPECT_EQ(read_bytes(file("ids")), "77\n77\n");
    EXPECT_EQ(read_bytes(file("calls")), "1 2 3 4 5 6\n\n");
    for (const std::string number : {"0008", "0009"}) {
        ASSERT_EQ(run({"render", "s." + number + ".toml", "-s", "3", "--size", "16x12", "-o", "whole.exr", "-q"}).code,
                  0);
        ASSERT_TRUE(exists("it's." + number + ".exr")) << read_bytes(file("log"));
        EXPECT_TRUE(same_pixels(image("it's." + number + ".exr"), image("whole.exr")));
    }
}

TEST_F(Farm, TheJobScriptDrawsFramesOfAnAnimation)
{
    const Said script = run({"slurm", "film.toml", "--frames", "1-48", "-o", "f.##.exr"});
    ASSERT_EQ(script.code, 0) << script.err;
    expect_words(script.out, "lancer render film.toml --frame \"$frame\" --progress none");
    EXPECT_EQ(run({"slurm", "film.toml", "--frames", "1-48", "-o", "f.exr"}).code, 2);
    // A mistake is told before the job waits for its turn; what a shell has yet to read is left to it.
    const Said wrong = run({"slurm", "film.toml", "--render=-s 8 --integrator pth", "-o", "f.exr"});
    EXPECT_EQ(wrong.code, 2);
    expect_words(wrong.err, "did you mean 'path'?");
    EXPECT_EQ(wrong.out, "");
    EXPECT_EQ(run({"slurm", "film.toml", "--render=-s $SPP", "-o", "f.exr"}).code, 0);
    const Said help = run({"slurm", "film.toml", "--render=-s 8 --help", "-o", "f.exr"});
    EXPECT_EQ(help.code, 2);
    EXPECT_EQ(help.out, "") << "no page of help in a script";
}

}  // namespace
}  // namespace lancer
