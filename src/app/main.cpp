// The program: selects the command and handles all exceptions.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/version.h"
#include "core/error.h"
#include "core/lanes/denormals.h"
#include "core/names.h"
#include "core/parallel.h"

namespace lancer {
namespace {

struct Command {
    std::string_view name;
    int (*run)(int, char**);
};
constexpr std::array<Command, 15> commands{{{"render", run_render},
                                            {"film", run_film},
                                            {"view", run_view},
                                            {"denoise", run_denoise},
                                            {"merge", run_merge},
                                            {"verify", run_verify},
                                            {"slurm", run_slurm},
                                            {"check", run_check},
                                            {"info", run_info},
                                            {"compare", run_compare},
                                            {"pixel", run_pixel},
                                            {"tune", run_tune},
                                            {"export", run_export},
                                            {"study", run_study},
                                            {"options", run_options}}};

const char* const help =
    "lancer: a path tracer for CPUs\n\n"
    "Usage:\n"
    "  lancer render SCENE [-o FILE]...          render a scene (.toml) or a mesh (.obj, .ply) into pictures\n"
    "  lancer film SCENE -o FRAME.####.exr       render the frames of an animation or a turntable\n"
    "  lancer view SCENE                         show a scene in a window and move camera and lights by hand\n"
    "  lancer check SCENE                        print every problem of a scene and its files; nothing is rendered\n"
    "  lancer info FILE                          print what is in a scene, or what a picture says of its making\n"
    "  lancer denoise PICTURE -o FILE            remove the noise of a picture of lancer render --aov denoise\n"
    "  lancer merge PART... -o FILE              join the shards of a picture: lancer render --shard\n"
    "  lancer verify PICTURE [SCENE]             trace pixels of a picture again and compare every bit\n"
    "  lancer slurm SCENE --shards N             print a job script for a Slurm cluster\n"
    "  lancer compare PICTURE REFERENCE          print how far a picture is from a reference\n"
    "  lancer pixel SCENE X Y [SAMPLE]           trace one sample again and print every vertex\n"
    "  lancer study STUDY -o FOLDER              error against run time: methods on scenes, as one HTML page\n"
    "  lancer tune SCENE                         measure what each estimator gives on a scene\n"
    "  lancer export SCENE -o FOLDER             write a scene for other renderers: JSON and plain meshes\n"
    "  lancer options [--biases]                 print the table of render settings, or of what biases pictures\n"
    "  lancer SCENE ...                          the same as lancer render SCENE ...\n"
    "  lancer COMMAND --help                     the options of a command\n"
    "  lancer --version                          the versions of the program and its libraries\n\n"
    "Results go to the standard output, everything else to the standard error.\n"
    "Exit codes: 0 done; 1 failed at run time; 2 wrong usage; 65 scene or asset invalid; 66 input missing;\n"
    "75 interrupted, to go on with --resume; 130 interrupted (both write the picture so far, marked partial).\n\n"
    "Examples:\n"
    "  lancer render scene.toml -s 256 -o picture.exr -o picture.png\n"
    "  lancer mesh.obj --size 640x360";

// A name that cannot be a file to render was meant to be a command.
bool looks_like_command(const std::string& word)
{
    return !word.starts_with('-') && word.find_first_of("./") == std::string::npos && !std::filesystem::exists(word);
}

int print_help(int, char**) { return print_result(help), exit_done; }
int print_version(int, char**) { return print_result(version_text()), exit_done; }

// What is asked for; its arguments begin with the name of the command. Throws ErrorKind::usage.
struct Call {
    int (*command)(int, char**);
    int argc;
    char** argv;
};
Call find_command(int argc, char** argv)
{
    const std::string word = argc > 1 ? argv[1] : "";
    if (word.empty()) throw Error(ErrorKind::usage, {}, "nothing to do; see lancer --help");
    if (word == "--help" || word == "-h" || word == "help") return {print_help, argc, argv};
    if (word == "--version") return {print_version, argc, argv};
    for (const Command& command : commands)
        if (command.name == word) return {command.run, argc - 1, argv + 1};
    if (looks_like_command(word)) {
        std::array<std::string_view, commands.size()> known;
        std::transform(commands.begin(), commands.end(), known.begin(), [](const Command& c) { return c.name; });
        throw Error(ErrorKind::usage, {}, "unknown command " + in_quotes(word) + suggestion(word, known));
    }
    return {run_render, argc, argv};
}

// TBB and Embree may throw where no handler is, for example if the system grants no more threads.
[[noreturn]] void end_with_message()
{
    print_problem(message_of_termination(std::current_exception()));
    std::_Exit(exit_failed);
}

// A reader that goes away and a limit on the size of files are errors of writing, reported as such; the signals would
// end the program without a word and leave temporary files.
void take_signals_of_writing_as_errors()
{
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace
}  // namespace lancer

int main(int argc, char** argv)
{
    using namespace lancer;
    set_flush_denormals();
    std::set_terminate(end_with_message);
    take_signals_of_writing_as_errors();
    return guarded([&] {
        const Call call = find_command(argc, argv);
        return call.command(call.argc, call.argv);
    });
}
