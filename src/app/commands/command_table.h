// The commands of the program, as `lancer --help` lists them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lancer {

struct Command {
    std::string_view name, arguments, summary;
    int (*run)(int argc, char** argv);  // argv[0] is the name; returns the exit code, throws errors
};

std::span<const Command> all_commands();

// The parts of what `lancer --help` prints, without the list of commands: what a manual says of the whole program.
extern const char* const program_summary;
extern const char* const program_footer;
std::string program_help();

// `lancer help [COMMAND]`. Throws Error (usage) if there is no such command.
int run_help(int argc, char** argv);
// Throws Error (usage): there is no such command; perhaps another one was meant.
[[noreturn]] void fail_unknown_command(const std::string& word);

}  // namespace lancer
