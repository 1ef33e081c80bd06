// What the program says when something is wrong, its exit code, and what it leaves behind.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <cstdlib>

#include "app/run_program.h"
#include "support/sanitized.h"

namespace lancer {
namespace {

class Wrong : public AppTest {
protected:
    // The run fails with this code and these words, and writes nothing.
    void expect_fault(const std::vector<std::string>& arguments, int code, const std::string& words) const
    {
        const std::vector<std::string> before = folder_.names();
        const Said said = run(arguments);
        EXPECT_EQ(said.code, code) << said.err;
        expect_words(said.err, words);
        EXPECT_EQ(said.out, "");
        EXPECT_EQ(folder_.names(), before);
    }
    void expect_usage(std::vector<std::string> arguments, const std::string& words) const
    {
        arguments.insert(arguments.begin(), {"render", "scene.toml"});
        expect_fault(arguments, 2, words);
    }
};

TEST_F(Wrong, Commands)
{
    expect_fault({}, 2, "lancer: error: nothing to do; see lancer --help");
    expect_fault({"rendr", "scene.toml"}, 2, "unknown command 'rendr'; did you mean 'render'?");
    expect_fault({"render"}, 2, "SCENE is required");
    expect_fault({"render", "scene.toml", "more"}, 2, "unexpected argument 'more'");
}

TEST_F(Wrong, Options)
{
    expect_usage({"--sppp", "3"}, "unknown option '--sppp'; did you mean '--spp'?");
    expect_usage({"--thread=3"}, "unknown option '--thread'; did you mean '--threads'?");
    expect_usage({"--integrator", "pth"}, "--integrator: unknown name 'pth'; did you mean 'path'? known: path, direct");
    expect_usage({"--filter", "gausian"}, "did you mean 'gaussian'?");
    expect_usage({"--sampler", "sobel"}, "did you mean 'sobol'?");
    expect_usage({"--accel", "embre"}, "did you mean 'embree'?");
    expect_usage({"--isa", "avx3"}, "did you mean 'avx'?");
    expect_usage({"--set", "nea=true"}, "--set: unknown name 'nea'; did you mean 'nee'? known: nee, mis, direct");
    expect_usage({"--set", "common=true"}, "--set: unknown name 'common'; known: nee, mis, direct");
    expect_usage({"--set", "nne=false"}, "did you mean 'nee'?");
    expect_usage({"--set", "nee=maybe"}, "'nee=maybe' is not nee=true or =false");
    expect_usage({"--progress", "bar"}, "--progress: unknown name 'bar'");
    expect_usage({"--aov", "normal", "-o", "a.png"}, "--aov: its channels are written to EXR pictures");
    expect_usage({"-o", "a.tif"}, "'a.tif' must end in .exr, .png, .ppm, .jpg, .jpeg or .hdr");
    expect_usage({"--size", "8x8", "-o", "a.exr", "-o", "./a.exr"}, "is named twice");
}

TEST_F(Wrong, Numbers)
{
    for (const char* spp : {"0", "-1", "1099511627776", "4x", "", "1e3", "nan"}) {
        expect_usage({"--spp", spp}, "--spp: '" + std::string(spp) + "' is not a whole number from 1 to 2147483647");
    }
    expect_usage({"--threads", "0"}, "--threads: '0' is not a whole number from 1 to");
    expect_usage({"--size", "0x5"}, "--size: '0' is not a whole number from 1 to 65536");
    expect_usage({"--size", "640"}, "--size: '640' is not WIDTHxHEIGHT");
    expect_usage({"--size", "65536x65536"}, "too large");
    expect_usage({"--seed", "-3"}, "--seed: '-3'");
    expect_usage({"--exposure", "nan"}, "--exposure: 'nan'");
    expect_usage({"--tile", "0"}, "--tile: '0'");
    expect_usage({"--batch", "0"}, "--batch: '0'");
    expect_usage({"--max-depth", "-1"}, "--max-depth: '-1'");
}

TEST_F(Wrong, Crops)
{
    expect_usage({"--crop", "0,0,4"}, "is not x0,y0,x1,y1");
    expect_usage({"--crop", "4,0,4,2"}, "is empty");
    expect_usage({"--crop", "0,0,4,-2"}, "--crop: '-2'");
    expect_usage({"--size", "8x8", "--crop", "0,0,9,8"}, "reaches beyond the picture of 8x8");
}

TEST_F(Wrong, InputsThatAreMissing)
{
    expect_fault({"none.toml"}, 66, "none.toml: error: ");
    expect_fault({"none.obj"}, 66, "none.obj: error: ");
    write("hole.toml", "version = 1\n[[mesh]]\nfile = \"none.obj\"\n");
    expect_fault({"hole.toml"}, 66, "hole.toml:3:8: error: mesh file 'none.obj' does not exist");
    expect_fault({"compare", "none.exr", "none.exr"}, 66, "none.exr: error: ");
}

TEST_F(Wrong, ScenesAndMeshes)
{
    write("typo.toml", "version = 1\n[camera]\npositon = [0, 0, 1]\n");
    expect_fault({"typo.toml"}, 65,
                 "typo.toml:3:1: error: unknown key 'positon' in [camera]; did you mean 'position'?");
    write("name.toml", "version = 1\n[render]\nintegrator = \"pth\"\nfilter = \"bx\"\n[[sphere]]\nradius = 1\n");
    expect_fault({"name.toml"}, 65,
                 "name.toml:3:14: error: unknown integrator 'pth' in [render]; did you mean 'path'?");
    expect_fault({"name.toml"}, 65, "name.toml:4:10: error: unknown filter 'bx' in [render]; did you mean 'box'?");
    write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    expect_fault({"index.obj"}, 65, "index.obj:4");
    ASSERT_EQ(mkfifo(file("pipe.toml").c_str(), 0600), 0);
    expect_fault({"pipe.toml"}, 65, "pipe.toml: error: not a regular file");
    write("scene.txt", "version = 1\n");
    expect_fault({"render", "scene.txt"}, 65, "must end in .toml, .obj, .ply, .gltf or .glb");
}

TEST_F(Wrong, WarningsFailOnlyIfStrict)
{
    write("unused.toml", std::string(small_scene) + "[material.unused]\ntype = \"mirror\"\n");
    expect_fault({"unused.toml", "--strict"}, 65, "unused.toml: error: 1 warnings, and --strict allows none");
    const Said said = run({"unused.toml", "-o", "a.exr", "--size", "8x8", "-s", "1", "-q"});
    EXPECT_EQ(said.code, 0);
    expect_words(said.err, "warning: material 'unused' is not used");
    EXPECT_EQ(run({"scene.toml", "-o", "a.exr", "--size", "8x8", "-s", "1", "--strict"}).code, 0);
}

TEST_F(Wrong, OutputsThatCannotBeWritten)
{
    expect_usage({"--aov", "normal", "-o", "a.png"}, "--aov: its channels are written to EXR pictures");
    expect_usage({"-o", "a.tif"}, "must end in");
    expect_fault({"scene.toml", "-o", "none/a.exr"}, 1, "none/a.exr: error: cannot write: No such file or directory");
    expect_fault({"scene.toml", "-o", "quad.obj/a.png"}, 1, "quad.obj/a.png: error: cannot write: Not a directory");
    expect_fault({"scene.toml", "--stats", "none/s.json"}, 1, "none/s.json: error: cannot write");
    std::filesystem::create_directory(file("folder.exr"));
    expect_fault({"scene.toml", "-o", "folder.exr"}, 1, "folder.exr: error: cannot write: Is a directory");
}

// Found before any time is spent on rendering: with these samples the test would not end.
TEST_F(Wrong, OutputsAreTriedFirst)
{
    expect_fault({"scene.toml", "-s", "2147483647", "-o", "none/a.exr"}, 1, "none/a.exr: error: cannot write");
}

TEST_F(Wrong, AFullDeviceIsAFailure)
{
    std::filesystem::create_symlink("/dev/full", file("full.exr"));
    const Said said = run({"scene.toml", "--size", "64x64", "-s", "1", "-o", "full.exr", "--progress", "none"});
    EXPECT_EQ(said.code, 1);
    expect_words(said.err, "full.exr: error: cannot write: No space left on device");
    expect_words(said.err, "the picture is rescued as 'full-rescued.exr'");
    EXPECT_EQ(said.out, "full-rescued.exr\n");
    EXPECT_EQ(image("full-rescued.exr").pixels.size(), 64u * 64);
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"full-rescued.exr", "full.exr", "quad.obj", "scene.toml"}));
}

TEST_F(Wrong, AFailureOfOneOutputLeavesAllOldOnes)
{
    write("old.exr", "an old picture");
    std::filesystem::create_symlink("/dev/full", file("full.png"));
    const Said said =
        run({"scene.toml", "--size", "64x64", "-s", "1", "-o", "old.exr", "-o", "full.png", "--progress", "none"});
    EXPECT_EQ(said.code, 1);
    expect_words(said.err, "full.png: error: cannot write: No space left on device");
    EXPECT_EQ(read_bytes(file("old.exr")), "an old picture");
    EXPECT_EQ(said.out, "old-rescued.exr\nfull-rescued.png\n");
}

TEST_F(Wrong, AnOutputThatIsAnInput)
{
    write("lit.obj", "mtllib lit.mtl\n" + std::string(quad));
    write("lit.mtl", "newmtl a\nKe 1 1 1\n");
    write("mesh.toml", "[[mesh]]\nfile = \"lit.obj\"\n");
    std::filesystem::create_symlink("mesh.toml", file("link.exr"));
    const std::vector<std::string> small{"mesh.toml", "--size", "8x8", "-s", "1", "-q"};
    for (const auto& [option, output, input] :
         {std::array{"-o", "link.exr", "mesh.toml"}, std::array{"--stats", "./mesh.toml", "mesh.toml"},
          std::array{"--stats", "lit.obj", "lit.obj"}, std::array{"--stats", "lit.mtl", "lit.mtl"}}) {
        std::vector<std::string> arguments = small;
        arguments.insert(arguments.end(), {option, output});
        const std::string before = read_bytes(file(input));
        expect_fault(arguments, 2, "'" + std::string(output) + "' would overwrite the input '" + input + "'");
        EXPECT_EQ(read_bytes(file(input)), before);
    }
}

TEST_F(Wrong, OneFileUnderTwoNames)
{
    std::filesystem::create_symlink("a.exr", file("b.exr"));
    expect_usage({"-o", "a.exr", "-o", "./a.exr"}, "'./a.exr' is named twice");
    write("a.exr", "precious");
    expect_usage({"--size", "8x8", "-o", "a.exr", "-o", "b.exr"}, "'b.exr' is named twice");
}

TEST_F(Wrong, AFileLargerThanAllowed)
{
    write("a.exr", "precious");
    const Limited limit(RLIMIT_FSIZE, 2048);
    expect_fault({"scene.toml", "--size", "64x64", "-s", "1", "-q", "-o", "a.exr"}, 1,
                 "a.exr: error: cannot write: File too large");
    EXPECT_EQ(read_bytes(file("a.exr")), "precious");
}

TEST_F(Wrong, MoreThreadsThanTheSystemGrants)
{
    if (is_sanitized) GTEST_SKIP() << "sanitizers reserve more address space than any limit leaves";
    const Limited limit(RLIMIT_AS, rlim_t{300} << 20);
    expect_fault({"scene.toml", "--size", "640x480", "-s", "1", "-q", "-o", "a.exr", "-t", "1000"}, 1,
                 "lancer: error: ");
}

// Whoever reads the messages may leave; the picture is made all the same.
TEST_F(Wrong, AReaderThatGoesAway)
{
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    close(ends[0]);
    const std::string command = std::string(LANCER_PROGRAM) + " scene.toml --size 8x8 -s 1 -v -o a.exr >/dev/null 2>&" +
                                std::to_string(ends[1]);
    const int status = std::system(("cd '" + folder_.path() + "' && " + command).c_str());
    close(ends[1]);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_TRUE(exists("a.exr"));
}

TEST_F(Wrong, AnOldFileSurvivesEveryFailure)
{
    write("old.exr", "precious");
    write("typo.toml", "version = 1\ntypo = 1\n");
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"typo.toml"},
                                               {"none.toml"},
                                               {"scene.toml", "--spp", "0"},
                                               {"scene.toml", "--crop", "0,0,5000,1"},
                                               {"scene.toml", "-o", "none/b.exr"},
                                               {"scene.toml", "--stats", "none/b.json"}}) {
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"-o", "old.exr"});
        const Said said = run(all);
        EXPECT_NE(said.code, 0);
        EXPECT_EQ(read_bytes(file("old.exr")), "precious") << said.err;
    }
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"old.exr", "quad.obj", "scene.toml", "typo.toml"}));
}

TEST_F(Wrong, SamplesThatAreNotFiniteAreCountedWithTheCommandToSeeOne)
{
    write("hot.toml",
          "version = 1\n[camera]\nposition = [0, 1, 4]\n[[plane]]\n[[light]]\ntype = \"point\"\n"
          "position = [0, 0.001, 0]\nintensity = [3e38, 3e38, 3e38]\n");
    const Said said = run({"hot.toml", "--size", "32x32", "-s", "4", "-o", "a.exr", "--seed", "2"});
    EXPECT_EQ(said.code, 0) << said.err;
    expect_words(said.err, "warning: dropped samples");
    EXPECT_NE(metadata("a.exr", "dropped_samples"), "0");
    EXPECT_EQ(metadata("a.exr", "bias"), "dropped=" + metadata("a.exr", "dropped_samples"));
    for (const Color& c : image("a.exr").pixels) EXPECT_TRUE(is_finite(c));

    const size_t begin = said.err.find("lancer pixel ");
    ASSERT_NE(begin, std::string::npos) << said.err;
    std::istringstream words(said.err.substr(begin, said.err.find('\n', begin) - begin));
    std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
    command.erase(command.begin());
    const Said replayed = run(command);
    EXPECT_EQ(replayed.code, 0) << replayed.err;
    expect_words(replayed.out, "not finite");
}

}  // namespace
}  // namespace lancer
