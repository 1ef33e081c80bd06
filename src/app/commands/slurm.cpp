// lancer slurm: a job script for a cluster that runs Slurm.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/options/option_values.h"
#include "app/options/options.h"

namespace lancer {
namespace {

// A word in which #### stands for the variable `frame` of the script, in double quotes where it does.
std::string word_of(const std::string& name, bool has_frames)
{
    const size_t at = has_frames ? name.find('#') : std::string::npos;
    if (at == std::string::npos) return in_shell_quotes(name);
    const size_t end = std::min(name.find_first_not_of('#', at), name.size());
    return in_shell_quotes(name.substr(0, at)) + format_text("\"$(printf %%0%zud \"$frame\")\"", end - at) +
           in_shell_quotes(name.substr(end));
}

std::string script_of(const SlurmOptions& o)
{
    const FrameRange frames = o.frames.value_or(FrameRange{});
    const uint64_t tasks = uint64_t{o.shards} * (frames.last - frames.first + 1);
    const bool has_frames = o.frames.has_value();
    const std::filesystem::path output(o.output);
    const std::string stem = (output.parent_path() / output.stem()).string();
    const std::string parts = word_of(stem, has_frames);
    // Of numbered scene files each is one; else the scene has an [animation].
    const bool is_film = has_frames && o.scene.find('#') == std::string::npos;
    std::string more;
    for (const std::string& options : o.render) more += " " + options;
    return "#!/bin/sh\n"
           "# Renders " +
           o.scene + " in " + std::to_string(tasks) +
           " tasks and merges their shards: sh THIS\n"
           "# Options of sbatch, such as --partition, --cpus-per-task and --time, are taken from $SBATCH_OPTIONS.\n"
           "set -eu\n"
           "SBATCH_OPTIONS=${SBATCH_OPTIONS-}\n"
           "job=$(sbatch --parsable $SBATCH_OPTIONS --array=1-" +
           std::to_string(tasks) +
           " --requeue <<'END'\n"
           "#!/bin/sh\n"
           "frame=$((" +
           std::to_string(frames.first) + " + (SLURM_ARRAY_TASK_ID - 1) / " + std::to_string(o.shards) +
           "))\n"
           "shard=$(((SLURM_ARRAY_TASK_ID - 1) % " +
           std::to_string(o.shards) +
           " + 1))\n"
           "# As a step, so that a signal reaches it. 75: stopped with a checkpoint, from which it goes on.\n"
           "code=0\n"
           "srun --ntasks=1 lancer render " +
           word_of(o.scene, has_frames) + (is_film ? " --frame \"$frame\"" : "") + more +
           " --progress none \\\n"
           "    --shard \"$shard/" +
           std::to_string(o.shards) + "\" --resume auto -o " + parts +
           ".%k-of-%n.lancer || code=$?\n"
           "if [ $code = 75 ]; then scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"; fi\n"
           "exit $code\n"
           "END\n"
           ")\n"
           "echo \"$job\"\n"
           "# After any end of the tasks: merge names what is missing, and this script can be run again.\n"
           "sbatch --parsable $SBATCH_OPTIONS --dependency=\"afterany:$job\" <<'END'\n"
           "#!/bin/sh\n"
           "code=0\n"
           "for frame in $(seq " +
           std::to_string(frames.first) + " " + std::to_string(frames.last) +
           "); do\n"
           "    lancer merge " +
           parts + ".*-of-" + std::to_string(o.shards) + ".lancer -o " + word_of(o.output, has_frames) +
           " || code=$?\n"
           "done\n"
           "exit $code\n"
           "END\n";
}

// A mistake in --render would else show when the tasks begin. What only a shell can read is left to it. Throws Error
// (usage).
void check_render_options(const SlurmOptions& o)
{
    std::vector<std::string> words{"lancer render", o.scene};
    for (const std::string& options : o.render) {
        if (options.find_first_of("\\'\"$`*?[;&|<>()") != std::string::npos) return;
        std::istringstream rest(options);
        for (std::string word; rest >> word;) {
            // It would be printed into the script.
            if (word == "-h" || word == "--help") fail_usage("--render: " + word + " renders nothing");
            words.push_back(word);
        }
    }
    words.push_back("--shard=1/" + std::to_string(o.shards));
    words.emplace_back("--output=part.lancer");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    parse_render(static_cast<int>(argv.size()), argv.data());
}

}  // namespace

int run_slurm(int argc, char** argv)
{
    const auto options = parse_slurm(argc, argv);
    if (!options) return exit_done;
    check_render_options(*options);
    std::string script = script_of(*options);
    script.pop_back();  // print_result() ends the last line
    print_result(script);
    return exit_done;
}

}  // namespace lancer
