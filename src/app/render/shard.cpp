#include "app/render/shard.h"

#include <algorithm>
#include <optional>

#include "app/options/option_values.h"
#include "core/hash.h"
#include "render/renderer.h"

namespace lancer {
namespace {

using Variables = std::function<const char*(const char*)>;

constexpr uint32_t most_shards = 1u << 20;

// A job that runs in several places at once, as its environment tells.
struct Launcher {
    const char* name;
    // Counts from `first` in steps of `step`, where these are variables.
    const char *index, *count, *first = nullptr, *step = nullptr;
    // Only where this variable is there as well: sbatch itself has the variables of srun.
    const char* needs = nullptr;
};
constexpr Launcher array{"a Slurm array", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
                         "SLURM_ARRAY_TASK_STEP"};
// The first that is there counts: mpirun may itself be started by srun.
constexpr Launcher ranks[] = {
    {"Open MPI", "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
    {"PMI", "PMI_RANK", "PMI_SIZE"},
    {.name = "srun", .index = "SLURM_PROCID", .count = "SLURM_NTASKS", .needs = "SLURM_STEP_ID"},
};

std::optional<Shard> found(const Launcher& launcher, const Variables& variable)
{
    const auto number = [&](const char* name, uint32_t otherwise) {
        const char* const text = name ? variable(name) : nullptr;
        return text ? to_count(name, text, 0) : otherwise;
    };
    if (!variable(launcher.index) || !variable(launcher.count)) return {};
    if (launcher.needs && !variable(launcher.needs)) return {};
    const uint32_t count = number(launcher.count, 0), step = std::max(1u, number(launcher.step, 1));
    const uint32_t index = (number(launcher.index, 0) - number(launcher.first, 0)) / step;
    if (count == 0 || count > most_shards || index >= count)
        fail_usage("--shard: " + std::string(launcher.index) + " and " + launcher.count + " of " + launcher.name +
                   " do not tell one of several");
    return Shard{index + 1, count};
}

// Of an array each task may have several ranks.
Shard of_environment(const Variables& variable)
{
    std::optional<Shard> task = found(array, variable), rank;
    for (const Launcher& launcher : ranks)
        if (!rank) rank = found(launcher, variable);
    if (task && rank) return {(task->index - 1) * rank->count + rank->index, task->count * rank->count};
    if (task || rank) return task ? *task : *rank;
    std::string looked_for = std::string(array.index) + " and " + array.count;
    for (const Launcher& launcher : ranks) looked_for += ", " + std::string(launcher.index) + " and " + launcher.count;
    fail_usage("--shard: auto finds none of " + looked_for + " (with SLURM_STEP_ID); say K/N");
}

}  // namespace

std::vector<Tile> tiles_of(const Shard& shard, const Tile& crop)
{
    // So small that each shard has many, and a hard place of the picture does not make one of them late.
    constexpr uint32_t largest = 32, wanted = 16;
    uint32_t size = largest;
    std::vector<Tile> tiles = make_tiles(crop, size);
    while (size > 1 && tiles.size() < size_t{wanted} * shard.count) tiles = make_tiles(crop, size /= 2);
    // Shuffled, or shards would get columns.
    std::vector<std::pair<uint64_t, size_t>> order;
    for (size_t i = 0; i < tiles.size(); ++i) order.emplace_back(mix_bits(uint64_t{i} + 1), i);
    std::sort(order.begin(), order.end());
    std::vector<size_t> own;
    for (size_t i = shard.index - 1; i < order.size(); i += shard.count) own.push_back(order[i].second);
    std::sort(own.begin(), own.end());
    std::vector<Tile> result;
    for (const size_t i : own) result.push_back(tiles[i]);
    return result;
}

uint64_t pixels_of(const std::vector<Tile>& tiles)
{
    uint64_t sum = 0;
    for (const Tile& t : tiles) sum += uint64_t{t.width()} * t.height();
    return sum;
}

std::vector<Tile> tiles_without(const std::vector<Tile>& tiles, const Tile& crop)
{
    std::vector<bool> taken(size_t{crop.width()} * crop.height());
    const auto at = [&](uint32_t x, uint32_t y) { return size_t{y - crop.y0} * crop.width() + (x - crop.x0); };
    for_pixels_of(tiles, [&](uint32_t x, uint32_t y) { taken[at(x, y)] = true; });
    constexpr uint32_t longest = 64;
    std::vector<Tile> rest;
    for (uint32_t y = crop.y0; y < crop.y1; ++y)
        for (uint32_t x = crop.x0; x < crop.x1; ++x) {
            if (taken[at(x, y)]) continue;
            if (!rest.empty() && rest.back().y0 == y && rest.back().x1 == x && rest.back().width() < longest)
                ++rest.back().x1;
            else
                rest.push_back({x, y, x + 1, y + 1});
        }
    return rest;
}

Shard to_shard(const std::string& text, const Variables& variable)
{
    if (text == "auto") return of_environment(variable);
    const std::vector<std::string> parts = split(text, '/');
    if (parts.size() != 2) fail_usage("--shard: " + in_quotes(text) + " is not K/N, as 3/8, or auto");
    const uint32_t count = to_count("--shard", parts[1], 1, most_shards);
    return {to_count("--shard", parts[0], 1, count), count};
}

}  // namespace lancer
