// Manual pages, completions of shells and docs/cli.md, made of what the parsers of the commands know: they cannot tell
// of an option that there is not. `lancer options --pages` writes them; the repository keeps them, so that building
// needs no program that runs, and a test compares.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/options/option_listing.h"

namespace lancer {

struct ManualFile {
    std::string path;  // from the root of the repository
    std::string text;
};

// All of them.
std::vector<ManualFile> manual_files();

// Of one command as `lancer COMMAND --help` knows it, and of the program itself; in the language of man(7).
std::string command_page(const ListedCommand& command);
std::string program_page(std::span<const ListedCommand> commands);
// Completions of all commands.
std::string bash_completion(std::span<const ListedCommand> commands);
std::string zsh_completion(std::span<const ListedCommand> commands);
std::string fish_completion(std::span<const ListedCommand> commands);
// Every option of every command, in Markdown.
std::string markdown_reference(std::span<const ListedCommand> commands);

}  // namespace lancer
