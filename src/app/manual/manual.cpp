#include "app/manual/manual.h"

#include "app/commands/command_table.h"
#include "app/manual/listed_values.h"

namespace lancer {
namespace {

std::vector<ListedCommand> listed_commands()
{
    std::vector<ListedCommand> all;
    for (const Command& command : all_commands()) {
        const OptionListener listener(all.emplace_back());
        std::string name(command.name);
        char* arguments[] = {name.data(), nullptr};
        command.run(1, arguments);
    }
    return all;
}

}  // namespace

std::vector<ManualFile> manual_files()
{
    const std::vector<ListedCommand> commands = listed_commands();
    std::vector<ManualFile> files{{"share/man/lancer.1", program_page(commands)},
                                  {"share/completions/lancer.bash", bash_completion(commands)},
                                  {"share/completions/_lancer", zsh_completion(commands)},
                                  {"share/completions/lancer.fish", fish_completion(commands)},
                                  {"docs/cli.md", markdown_reference(commands)}};
    for (const ListedCommand& command : commands)
        files.push_back({"share/man/lancer-" + command_name(command) + ".1", command_page(command)});
    return files;
}

}  // namespace lancer
