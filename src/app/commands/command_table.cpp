#include "app/commands/command_table.h"

#include <algorithm>
#include <array>
#include <vector>

#include "app/commands/commands.h"
#include "app/console.h"
#include "core/error.h"
#include "core/names.h"

namespace lancer {
namespace {

constexpr std::array<Command, 16> command_table{{
    {"render", "SCENE [-o FILE]...", "render a scene (.toml) or a mesh (.obj, .ply, .gltf, .glb) into pictures", run_render},
    {"film", "SCENE -o FRAME.####.exr", "render the frames of an animation or a turntable", run_film},
    {"view", "SCENE", "show a scene in a window and move camera and lights by hand", run_view},
    {"check", "SCENE", "print every problem of a scene and its files; nothing is rendered", run_check},
    {"info", "FILE", "print what is in a scene, or what a picture says of its making", run_info},
    {"denoise", "PICTURE -o FILE", "remove the noise of a picture of lancer render --aov denoise", run_denoise},
    {"merge", "PART... -o FILE", "join the shards of a picture: lancer render --shard", run_merge},
    {"verify", "PICTURE [SCENE]", "trace pixels of a picture again and compare every bit", run_verify},
    {"slurm", "SCENE --shards N", "print a job script for a Slurm cluster", run_slurm},
    {"compare", "PICTURE REFERENCE", "print how far a picture is from a reference", run_compare},
    {"pixel", "SCENE X Y [SAMPLE]", "trace one sample again and print every vertex", run_pixel},
    {"study", "STUDY -o FOLDER", "error against run time: methods on scenes, as one HTML page", run_study},
    {"bench", "SCENE [-o FOLDER]", "speed of accelerators beside Embree on a mesh, as one HTML page", run_bench},
    {"tune", "SCENE", "measure what each estimator gives on a scene", run_tune},
    {"export", "SCENE -o FOLDER", "write a scene for other renderers: JSON and plain meshes", run_export},
    {"options", "[--biases]", "print the table of render settings, or of what biases pictures", run_options},
}};

}  // namespace

std::span<const Command> all_commands() { return command_table; }

const char* const program_summary = "a path tracer for CPUs";
const char* const program_footer =
    "Results go to the standard output, everything else to the standard error.\n"
    "Exit codes: 0 done; 1 failed at run time; 2 wrong usage; 65 scene or asset invalid; 66 input missing;\n"
    "71 more memory is needed than --memory allows; 75 interrupted, to go on with --resume; 130 interrupted\n"
    "(both write the picture so far, marked partial).\n\n"
    "Examples:\n"
    "  lancer render scene.toml -s 256 -o picture.exr -o picture.png\n"
    "  lancer mesh.obj --size 640x360";

std::string program_help()
{
    constexpr size_t column = 44;
    std::string text = "lancer: " + std::string(program_summary) + "\n\nUsage:\n";
    const auto add = [&](const std::string& usage, std::string_view summary) {
        text +=
            usage + std::string(usage.size() < column ? column - usage.size() : 1, ' ') + std::string(summary) + "\n";
    };
    for (const Command& c : command_table)
        add("  lancer " + std::string(c.name) + " " + std::string(c.arguments), c.summary);
    add("  lancer SCENE ...", "the same as lancer render SCENE ...");
    add("  lancer help COMMAND", "the options of a command; also lancer COMMAND --help");
    add("  lancer --version", "the versions of the program and its libraries");
    return text + "\n" + program_footer;
}

int run_help(int argc, char** argv)
{
    if (argc > 2) throw Error(ErrorKind::usage, {}, "help: unexpected argument " + in_quotes(argv[2]));
    const std::string word = argc > 1 ? argv[1] : "";
    if (word.empty() || word == "-h" || word == "--help") return print_result(program_help()), exit_done;
    for (const Command& command : command_table)
        if (command.name == word) {
            std::string name(word), option = "--help";
            char* arguments[] = {name.data(), option.data(), nullptr};
            return command.run(2, arguments);
        }
    fail_unknown_command(word);
}

void fail_unknown_command(const std::string& word)
{
    std::array<std::string_view, command_table.size()> known;
    std::transform(command_table.begin(), command_table.end(), known.begin(), [](const Command& c) { return c.name; });
    throw Error(ErrorKind::usage, {}, "unknown command " + in_quotes(word) + suggestion(word, known));
}

}  // namespace lancer
