// The program: selects the command and handles all exceptions.
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "app/commands/command_table.h"
#include "app/commands/commands.h"
#include "app/console.h"
#include "app/version.h"
#include "core/error.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"

namespace lancer {
namespace {

// A name that cannot be a file to render was meant to be a command.
bool looks_like_command(const std::string& word)
{
    return !word.starts_with('-') && word.find_first_of("./") == std::string::npos && !std::filesystem::exists(word);
}

int print_help(int, char**) { return print_result(program_help()), exit_done; }
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
    if (word == "--help" || word == "-h") return {print_help, argc, argv};
    if (word == "help") return {run_help, argc - 1, argv + 1};
    if (word == "--version") return {print_version, argc, argv};
    for (const Command& command : all_commands())
        if (command.name == word) return {command.run, argc - 1, argv + 1};
    if (looks_like_command(word)) fail_unknown_command(word);
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
