#include "app/render/checkpoint_file.h"

#include <algorithm>
#include <filesystem>

#include "app/render/render_memory.h"
#include "app/render/shard.h"
#include "core/names.h"

namespace lancer {
namespace {

// The last character is the version of the format. The number behind it shows the order of its bytes.
constexpr std::string_view magic = "lancer checkpoint 6\n";
constexpr uint32_t byte_order = 0x01020304;

// Every member in turn.
template <class Number, class Visit>
void visit_pixel(Number& p, Visit& visit)
{
    for (auto& sum : p.sum) visit(sum);
    if constexpr (requires { p.sum_sq; }) visit(p.sum_sq);
    visit(p.n);
}
template <class Set, class Visit>
void visit_set(Set& s, Visit& visit)
{
    visit_pixel(s, visit);
    for (auto& feature : s.features) visit(feature);
    visit(s.seen);
}
template <class Counts, class Visit>
void visit_counters(Counts& c, Visit& visit)
{
    visit(c.camera_rays), visit(c.bounce_rays), visit(c.shadow_rays);
    visit(c.background_only_samples), visit(c.dropped);
}
template <class AnyTile, class Visit>
void visit_tile(AnyTile& t, Visit& visit)
{
    visit(t.x0), visit(t.y0), visit(t.x1), visit(t.y1);
}
template <class Half, class Visit>
void visit_half(Half& h, Visit& visit)
{
    visit(h.mean.r), visit(h.mean.g), visit(h.mean.b), visit(h.n), visit(h.error);
}

template <class Stream, class AnyIdentity>
void visit_identity(Stream& stream, AnyIdentity& identity)
{
    stream.each(identity, [&](auto& one) { stream(one.first), stream(one.second); });
}

template <class Stream, class AnyState>
void visit_state(Stream& stream, AnyState& s)
{
    const auto tile = [&](auto& t) { visit_tile(t, stream); };
    stream(s.shard.index), stream(s.shard.count);
    stream.each(s.held, tile);
    stream(s.pass.begin), stream(s.pass.end);
    stream.each(s.left, tile);
    visit_counters(s.counters, stream);
    SampleId first = s.counters.first_dropped.value_or(SampleId{});
    uint32_t has_dropped = s.counters.first_dropped.has_value() ? 1 : 0;
    stream(has_dropped), stream(first.x), stream(first.y), stream(first.sample);
    if constexpr (Stream::loads)
        if (has_dropped != 0) s.counters.first_dropped = first;
    stream(s.wall_s), stream(s.cpu_s);
    stream.each(s.passes, [&](auto& p) { stream(p.spp), stream(p.seconds), visit_optional(stream, p.error); });
    stream(s.error_log);
    visit_optional(stream, s.error);
}

// All sums of the tiles in turn: of each kind first how many a pixel has.
template <class Stream, class AnyFilm, class AnyHalves>
void visit_film(Stream& stream, AnyFilm& film, AnyHalves& halves, const std::vector<Tile>& tiles)
{
    const auto visit_all = [&](auto& all, auto&& visit) {
        const size_t of_pixel = all.size() / film.pixels.size();
        auto count = static_cast<uint32_t>(of_pixel);
        stream(count);
        if constexpr (Stream::loads)
            if (count != of_pixel) stream.fail_damaged();
        for (const Tile& t : tiles)
            for (uint32_t y = t.y0; y < t.y1; ++y)
                for (size_t i = film.index(t.x0, y) * of_pixel, end = i + t.width() * of_pixel; i < end; ++i)
                    visit(all[i]);
    };
    const auto pixel = [&](auto& p) { visit_pixel(p, stream); };
    visit_all(film.pixels, pixel), visit_all(film.open, pixel);
    visit_all(film.aovs, stream), visit_all(film.open_aovs, stream);
    visit_all(film.replicates, pixel);
    visit_all(film.sets, [&](auto& set) { visit_set(set, stream); });
    visit_all(film.layer_sums, [&](auto& sum) {
        for (auto& channel : sum) stream(channel);
    });
    visit_all(film.mattes, [&](auto& matte) { stream(matte.id), stream(matte.n); });
    visit_all(film.wanted, stream);
    uint32_t has_halves = halves.empty() ? 0 : 1;
    stream(has_halves);
    if constexpr (Stream::loads)
        if (has_halves == 1) halves.resize(film.pixels.size());
    visit_all(halves, [&](auto& h) { visit_half(h, stream); });
}

// That all tiles lie within the crop and none has a pixel of another.
void require_apart(const std::vector<Tile>& tiles, const Tile& crop, const Loader& from)
{
    std::vector<bool> taken(size_t{crop.width()} * crop.height());
    for (const Tile& t : tiles) {
        const bool is_inside =
            crop.x0 <= t.x0 && t.x0 < t.x1 && t.x1 <= crop.x1 && crop.y0 <= t.y0 && t.y0 < t.y1 && t.y1 <= crop.y1;
        if (!is_inside) from.fail_damaged();
    }
    for_pixels_of(tiles, [&](uint32_t x, uint32_t y) {
        const size_t i = size_t{y - crop.y0} * crop.width() + (x - crop.x0);
        if (taken[i]) from.fail_damaged();
        taken[i] = true;
    });
}

}  // namespace

UnseenCheckpoint::UnseenCheckpoint(const std::string& path, const RenderIdentity& identity, const PictureRecipe& recipe,
                                   const RenderState& state, const Film& film)
    : file_(path)
{
    Saver to(file_);
    to.bytes(magic.data(), magic.size());
    to(byte_order);
    visit_identity(to, identity);
    save_recipe(to, recipe);
    visit_state(to, state);
    visit_film(to, film, state.halves, state.held);
    to.end();
}

void UnseenCheckpoint::commit()
{
    file_.finish();
    // Whatever happens in between, one of the two has its name.
    const std::string& path = file_.path();
    std::error_code absent;
    if (std::filesystem::is_regular_file(path, absent)) std::filesystem::rename(path, checkpoint_before(path), absent);
    file_.commit();
}

void write_checkpoint(const std::string& path, const RenderIdentity& identity, const PictureRecipe& recipe,
                      const RenderState& state, const Film& film)
{
    UnseenCheckpoint(path, identity, recipe, state, film).commit();
}

CheckpointFile::CheckpointFile(const std::string& path) : content_(path), from_(path, {})
{
    if (!content_.problem().empty())
        throw Error(content_.missing() ? ErrorKind::missing_input : ErrorKind::invalid_input, {path},
                    content_.problem());
    std::string_view bytes = content_.bytes();
    if (!bytes.starts_with(magic)) from_.fail("this is not a checkpoint, or one of another version of lancer");
    uint64_t hash = 0;
    if (bytes.size() < magic.size() + sizeof byte_order + sizeof hash) from_.fail_damaged();
    std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
    bytes.remove_suffix(sizeof hash);
    if (Loader::hash_of(bytes) != hash) from_.fail_damaged();
    from_ = Loader(path, bytes);
    from_.bytes(magic.size());
    uint32_t order = 0;
    from_(order);
    if (order != byte_order) from_.fail("this checkpoint was written on a machine with another order of bytes");
    visit_identity(from_, identity);
    recipe = load_recipe(from_);
    visit_state(from_, state);
    if (state.pass.begin > state.pass.end || state.shard.index > state.shard.count) from_.fail_damaged();
    require_apart(state.held, recipe.stats.settings.crop, from_);
    require_apart(state.left, recipe.stats.settings.crop, from_);
}

void CheckpointFile::read_film(Film& film, std::vector<HalfBuffers::Half>& halves)
{
    visit_film(from_, film, halves, state.held);
    if (!from_.is_at_end()) from_.fail_damaged();
}

Checkpoint read_checkpoint(const std::string& path)
{
    CheckpointFile file(path);
    require_memory(file.recipe);
    Film film = empty_film(file.recipe);
    file.read_film(film, file.state.halves);
    return {std::move(file.identity), std::move(file.recipe), std::move(file.state), std::move(film)};
}

void require_same(const RenderIdentity& there, const RenderIdentity& expected, const std::string& path)
{
    if (there == expected) return;
    std::string differences;
    const auto add = [&](const std::string& text) { differences += (differences.empty() ? "" : "; ") + text; };
    const auto value_in = [](const RenderIdentity& all, const std::string& name) -> const std::string* {
        const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
        return found == all.end() ? nullptr : &found->second;
    };
    for (const auto& [name, value] : expected) {
        const std::string* const other = value_in(there, name);
        if (!other)
            add(name + " is not in it");
        else if (*other != value)
            add(name + " " + in_quotes(*other) + " there, " + in_quotes(value) + " here");
    }
    for (const auto& [name, value] : there)
        if (!value_in(expected, name)) add(name + " is only there");
    throw Error(ErrorKind::invalid_input, {path}, "this checkpoint is of another picture: " + differences);
}

}  // namespace lancer
