// lancer merge: the shards of a picture become one.
#include <algorithm>
#include <optional>

#include "app/commands.h"
#include "app/console.h"
#include "app/paths.h"
#include "app/render/checkpoint_file.h"
#include "app/render/shard.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "render/denoise/film_halves.h"

namespace lancer {
namespace {

uint64_t pixels_of(const std::vector<Tile>& tiles)
{
    uint64_t sum = 0;
    for (const Tile& t : tiles) sum += uint64_t{t.width()} * t.height();
    return sum;
}

// Copies what `from` has in the tiles.
template <class T>
void copy_pixels(const Film& film, const std::vector<Tile>& tiles, const std::vector<T>& from, std::vector<T>& to)
{
    const size_t of_pixel = from.size() / film.pixels.size();
    for (const Tile& t : tiles)
        for (uint32_t y = t.y0; y < t.y1; ++y) {
            const auto first = static_cast<std::ptrdiff_t>(film.index(t.x0, y) * of_pixel);
            std::copy_n(from.begin() + first, t.width() * of_pixel, to.begin() + first);
        }
}

void copy_pixels(const Film& from, const std::vector<Tile>& tiles, Film& to)
{
    copy_pixels(from, tiles, from.pixels, to.pixels), copy_pixels(from, tiles, from.open, to.open);
    copy_pixels(from, tiles, from.aovs, to.aovs), copy_pixels(from, tiles, from.open_aovs, to.open_aovs);
    copy_pixels(from, tiles, from.replicates, to.replicates), copy_pixels(from, tiles, from.sets, to.sets);
}

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
    bool is_complete() const { return sum_ && missing().empty(); }
    std::string text_of_missing() const;
    Checkpoint finish(const std::string& command_line);

private:
    std::vector<Tile> missing() const { return tiles_without(sum_->state.held, sum_->film.crop); }

    std::string first_;  // its path
    std::optional<Checkpoint> sum_;
    uint32_t count_ = 0;  // of the shards; 0: not known
};

void Merge::add(const std::string& path)
{
    Checkpoint part = read_checkpoint(path);
    RenderState& s = part.state;
    const uint32_t spp = part.recipe.stats.settings.render.spp;
    if (!s.left.empty() || s.pass.end != spp)
        return print_problem(path + ": warning: " + name_of(s.shard) +
                             " is unfinished and left out; the render goes on with --resume auto");
    if (s.shard.count > 0) count_ = s.shard.count;
    if (!sum_) {
        first_ = path;
        sum_ = std::move(part);
        return;
    }
    Checkpoint& sum = *sum_;
    require_same(part.identity, sum.identity, path);
    if (const uint32_t others = sum.recipe.stats.settings.render.spp; spp != others)
        throw Error(
            ErrorKind::invalid_input, {path},
            format_text("has %u samples per pixel, ", spp) + in_quotes(first_) + format_text(" has %u", others));
    const uint64_t gained = pixels_of(missing());
    std::vector<Tile> all = sum.state.held;
    all.insert(all.end(), s.held.begin(), s.held.end());
    const uint64_t gain = gained - pixels_of(tiles_without(all, sum.film.crop)), own = pixels_of(s.held);
    if (gain == 0 && own > 0) return print_note(path + ": " + name_of(s.shard) + " is there already");
    if (gain != own)
        throw Error(ErrorKind::invalid_input, {path}, "has pixels of other parts, which were cut in another way");
    copy_pixels(part.film, s.held, sum.film);
    if (!sum.state.halves.empty() && !s.halves.empty()) copy_pixels(sum.film, s.held, s.halves, sum.state.halves);
    sum.state.held = std::move(all);
    sum.state.counters += s.counters;
    sum.state.wall_s += s.wall_s, sum.state.cpu_s += s.cpu_s;
}

std::string Merge::text_of_missing() const
{
    std::string text;
    for (uint32_t k = 1; sum_ && k <= count_; ++k) {
        std::vector<Tile> all = sum_->state.held;
        const std::vector<Tile> own = tiles_of({k, count_}, sum_->film.crop);
        all.insert(all.end(), own.begin(), own.end());
        if (pixels_of(tiles_without(all, sum_->film.crop)) < pixels_of(missing()))
            text += (text.empty() ? "shard " : ", ") + std::to_string(k);
    }
    if (!text.empty()) return text + format_text(" of %u", count_);
    return sum_ ? format_text("%zu pixels", size_t{pixels_of(missing())}) : "all parts";
}

Checkpoint Merge::finish(const std::string& command_line)
{
    Checkpoint all = std::move(*sum_);
    RenderState& s = all.state;
    s.shard = {0, count_};
    RunStats& stats = all.recipe.stats;
    stats.context.command_line = command_line;
    stats.counters = s.counters;
    stats.render_s = s.wall_s;
    stats.partial = !tiles_without(s.held, all.film.crop).empty();
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

void write(Checkpoint all, const std::vector<std::string>& outputs, bool with_pictures)
{
    std::vector<std::string> pictures;
    for (const std::string& path : outputs) {
        if (extension_of(path) != ".lancer") {
            pictures.push_back(path);
            continue;
        }
        write_checkpoint(path, all.identity, all.recipe, all.state, all.film);
        print_result(path);
    }
    if (!with_pictures || pictures.empty()) return;
    Denoised denoised;
    if (all.recipe.options.denoise && !all.recipe.stats.partial) {
        denoised = denoise_film(all.film);
        all.recipe.stats.denoised = true;
    }
    write_outputs(pictures, content_of(all.film, denoised, all.recipe));
    for (const std::string& path : pictures) print_result(path);
}

int merge(const MergeOptions& options)
{
    for (const std::string& path : options.outputs) const AtomicFile probe(path);
    Merge merge;
    for (const std::string& path : options.parts) merge.add(path);
    const bool is_complete = merge.is_complete();
    if (!is_complete) print_problem("warning: missing: " + merge.text_of_missing());
    if (!merge.has_any()) return exit_unfinished;
    write(merge.finish(format_text("lancer merge (%zu parts)", options.parts.size())), options.outputs,
          is_complete || options.allow_missing);
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
