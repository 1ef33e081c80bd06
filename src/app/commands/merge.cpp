// lancer merge: the shards of a picture become one.
#include <algorithm>
#include <optional>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/paths.h"
#include "app/render/checkpoint_file.h"
#include "app/render/content.h"
#include "app/render/render_memory.h"
#include "app/render/shard.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "render/denoise/film_halves.h"
#include "report/json_object.h"

namespace lancer {
namespace {

std::string name_of(const Shard& shard)
{
    return shard.is_whole() ? "a merge" : format_text("shard %u of %u", shard.index, shard.count);
}

// The parts so far, as one.
class Merge {
public:
    // Takes over a part that is complete and brings something new. Throws Error (invalid_input) if it does not belong
    // to the others.
    void add(const std::string& path);
    bool has_any() const { return sum_.has_value(); }
    bool is_complete() const { return sum_ && missing() == 0; }
    std::string text_of_missing();
    // "lancer.merge/1" but for the files that are written: docs/json/merge.schema.json.
    JsonObject json(const MergeOptions& options);
    Checkpoint finish(const std::string& command_line);

private:
    // How many pixels are; no two parts have the same.
    uint64_t missing() const { return sum_->film.pixels.size() - pixels_of(sum_->state.held); }
    // The numbers of the shards that lack pixels.
    std::vector<uint32_t> missing_shards();
    // Whether a pixel is there.
    std::vector<bool>::reference has(uint32_t x, uint32_t y) { return has_[sum_->film.index(x, y)]; }

    std::string first_;  // its path
    std::optional<Checkpoint> sum_;
    std::vector<bool> has_;
    uint32_t count_ = 0;  // of the shards; 0: not known
};

void Merge::add(const std::string& path)
{
    CheckpointFile part(path);
    const RenderState& s = part.state;
    const uint32_t spp = part.recipe.stats.settings.render.spp;
    if (!s.left.empty() || s.pass.end != spp)
        return print_problem(path + ": warning: " + name_of(s.shard) +
                             " is unfinished and left out; the render goes on with --resume auto");
    if (sum_) require_same(part.identity, sum_->identity, path);
    if (s.shard.count > 0) count_ = s.shard.count;
    if (!sum_) {
        first_ = path;
        require_memory(part.recipe);
        sum_.emplace(Checkpoint{part.identity, part.recipe, part.state, empty_film(part.recipe)});
        sum_->state.held.clear();
        sum_->state.counters = {};
        sum_->state.wall_s = sum_->state.cpu_s = 0;
        has_.resize(sum_->film.pixels.size());
    }
    RenderState& sum = sum_->state;
    if (const uint32_t others = sum_->recipe.stats.settings.render.spp; spp != others)
        throw Error(
            ErrorKind::invalid_input, {path},
            format_text("has %u samples per pixel, ", spp) + in_quotes(first_) + format_text(" has %u", others));
    uint64_t known = 0;
    for_pixels_of(s.held, [&](uint32_t x, uint32_t y) { known += has(x, y); });
    if (known > 0 && known == pixels_of(s.held))
        return print_note(path + ": " + name_of(s.shard) + " is there already");
    if (known > 0)
        throw Error(ErrorKind::invalid_input, {path}, "has pixels of other parts, which were cut in another way");
    part.read_film(sum_->film, sum.halves);
    for_pixels_of(s.held, [&](uint32_t x, uint32_t y) { has(x, y) = true; });
    sum.held.insert(sum.held.end(), s.held.begin(), s.held.end());
    sum.counters += s.counters;
    sum.wall_s += s.wall_s, sum.cpu_s += s.cpu_s;
}

std::vector<uint32_t> Merge::missing_shards()
{
    std::vector<uint32_t> numbers;
    for (uint32_t k = 1; k <= count_; ++k) {
        bool is_there = true;
        for_pixels_of(tiles_of({k, count_}, sum_->film.crop),
                      [&](uint32_t x, uint32_t y) { is_there = is_there && has(x, y); });
        if (!is_there) numbers.push_back(k);
    }
    return numbers;
}

JsonObject Merge::json(const MergeOptions& options)
{
    JsonObject all("lancer.merge/1");
    all.texts("parts", options.parts);
    all.flag("complete", is_complete());
    if (sum_) {
        all.count("pixels", static_cast<int64_t>(sum_->film.pixels.size()));
        all.count("missing_pixels", static_cast<int64_t>(missing()));
        all.count("shards", count_);
        const std::vector<uint32_t> numbers = missing_shards();
        all.counts("missing_shards", std::vector<int64_t>(numbers.begin(), numbers.end()));
    }
    return all;
}

std::string Merge::text_of_missing()
{
    if (!sum_) return "all parts";
    std::string text;
    for (const uint32_t k : missing_shards()) text += (text.empty() ? "shard " : ", ") + std::to_string(k);
    return text.empty() ? format_text("%zu pixels", size_t{missing()}) : text + format_text(" of %u", count_);
}

Checkpoint Merge::finish(const std::string& command_line)
{
    sum_->recipe.stats.partial = missing() > 0;
    Checkpoint all = std::move(*sum_);
    RenderState& s = all.state;
    s.shard = {0, count_};
    RunStats& stats = all.recipe.stats;
    stats.context.command_line = command_line;
    stats.counters = s.counters;
    stats.render_s = s.wall_s;
    if (!s.halves.empty()) {
        HalfBuffers halves(std::move(s.halves), {});
        halves.look(all.film);
        s.error = halves.rel_mse(), s.halves = halves.halves();
        if (s.error) stats.estimated_error = std::sqrt(*s.error);
    }
    if (const auto told = estimate_from_replicates(all.film, stats.settings.render.replicates))
        stats.estimated_error = std::sqrt(told->rel_mse);
    stats.passes = s.passes = {{s.pass.end, s.wall_s, stats.estimated_error}};
    return all;
}

// Returns the names of the files.
std::vector<std::string> write(Checkpoint all, const MergeOptions& options, bool with_pictures)
{
    std::vector<std::string> pictures, written;
    for (const std::string& path : options.outputs) {
        if (extension_of(path) != ".lancer") {
            pictures.push_back(path);
            continue;
        }
        write_checkpoint(path, all.identity, all.recipe, all.state, all.film);
        written.push_back(path);
        if (!options.json) print_path(path);
    }
    if (!with_pictures || pictures.empty()) return written;
    Denoised denoised;
    if (all.recipe.options.denoise && !all.recipe.stats.partial) {
        denoised = denoise_film(all.film);
        all.recipe.stats.denoised = true;
    }
    all.recipe.options.format = options.format;
    write_outputs(pictures, content_of(all.film, denoised, all.recipe));
    if (!options.json) print_written(pictures);
    written.insert(written.end(), pictures.begin(), pictures.end());
    return written;
}

int merge(const MergeOptions& options)
{
    for (const std::string& path : options.outputs) const AtomicFile probe(path);
    Merge merge;
    for (const std::string& path : options.parts) merge.add(path);
    const bool is_complete = merge.is_complete();
    if (!is_complete) print_problem("warning: missing: " + merge.text_of_missing());
    JsonObject json = merge.json(options);  // before the pixels are given away
    const bool has_any = merge.has_any();
    std::vector<std::string> written;
    if (has_any)
        written = write(merge.finish(format_text("lancer merge (%zu parts)", options.parts.size())), options,
                        is_complete || options.allow_missing);
    json.texts("written", written);
    if (options.json) print_result(json.to_text());
    if (!has_any) return exit_unfinished;
    return is_complete || options.allow_missing ? exit_done : exit_unfinished;
}

}  // namespace

int run_merge(int argc, char** argv)
{
    const auto options = parse_merge(argc, argv);
    if (!options) return exit_done;
    int code = exit_failed;
    with_threads(options->threads.value_or(available_threads()), [&] { code = merge(*options); });
    return code;
}

}  // namespace lancer
