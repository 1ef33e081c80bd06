#include "app/render/checkpoint_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <type_traits>

#include "core/error.h"
#include "core/hash.h"
#include "core/names.h"
#include "io/atomic_file.h"
#include "io/file_content.h"

namespace lancer {
namespace {

// The last character is the version of the format. The number behind it shows the order of its bytes.
constexpr std::string_view magic = "lancer checkpoint 1\n";
constexpr uint32_t byte_order = 0x01020304;
constexpr size_t hashed_at_once = size_t{1} << 20;  // bytes

// Appends numbers as they are in memory, and their hash at the end.
class Writer {
public:
    explicit Writer(AtomicFile& file) : file_(file), buffer_(hashed_at_once) {}

    void put_bytes(const void* from, size_t count)
    {
        const auto* next = static_cast<const char*>(from);
        while (count > 0) {
            const size_t n = std::min(count, hashed_at_once - used_);
            std::memcpy(&buffer_[used_], next, n);
            next += n, count -= n, used_ += n;
            if (used_ == hashed_at_once) flush();
        }
    }
    template <class T>
    void put(const T& x)
    {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
        // The usual case, without a loop: there are millions of numbers.
        if (used_ + sizeof x >= hashed_at_once) return put_bytes(&x, sizeof x);
        std::memcpy(&buffer_[used_], &x, sizeof x);
        used_ += sizeof x;
    }
    void put(const std::string& text)
    {
        put(uint64_t{text.size()});
        put_bytes(text.data(), text.size());
    }
    // put_one(element) for each, after their number.
    template <class T, class F>
    void put_all(const std::vector<T>& all, const F& put_one)
    {
        put(uint64_t{all.size()});
        for (const T& x : all) put_one(x);
    }
    void end()
    {
        if (used_ > 0) flush();
        file_.write(&hash_, sizeof hash_);
    }

private:
    void flush()
    {
        hash_ = hash_bytes({buffer_.data(), used_}, hash_);
        file_.write(buffer_.data(), used_);
        used_ = 0;
    }

    AtomicFile& file_;
    std::vector<char> buffer_;
    size_t used_ = 0;
    uint64_t hash_ = 0;
};

class Reader {
public:
    Reader(const std::string& path, std::string_view bytes) : path_(path), rest_(bytes) {}

    [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorKind::invalid_input, {path_}, what); }
    [[noreturn]] void fail_damaged() const { fail("this checkpoint is damaged"); }

    std::string_view bytes(size_t count)
    {
        if (count > rest_.size()) fail_damaged();
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    template <class T>
    void get(T& x)
    {
        std::memcpy(&x, bytes(sizeof x).data(), sizeof x);
    }
    void get(std::string& text) { text = bytes(count_of(1)); }
    // The number of elements that follow, each of at least that many bytes.
    size_t count_of(size_t least_bytes)
    {
        uint64_t count = 0;
        get(count);
        if (count > rest_.size() / least_bytes) fail_damaged();
        return static_cast<size_t>(count);
    }
    // As many elements as there are.
    template <class T, class F>
    void get_all(std::vector<T>& all, const F& get_one)
    {
        uint64_t count = 0;
        get(count);
        if (count != all.size()) fail_damaged();
        for (T& x : all) get_one(x);
    }
    bool is_at_end() const { return rest_.empty(); }
    // Of bytes that Writer wrote.
    static uint64_t hash_of(std::string_view bytes)
    {
        uint64_t hash = 0;
        do {
            hash = hash_bytes(bytes.substr(0, hashed_at_once), hash);
            bytes.remove_prefix(std::min(bytes.size(), hashed_at_once));
        } while (!bytes.empty());
        return hash;
    }

private:
    std::string path_;
    std::string_view rest_;
};

// Every member in turn, for a Writer, a const object and visit = put, or a Reader and visit = get.
template <class Number, class Visit>
void visit_pixel(Number& p, const Visit& visit)
{
    for (auto& sum : p.sum) visit(sum);
    if constexpr (requires { p.sum_sq; }) visit(p.sum_sq);
    visit(p.n);
}
template <class Set, class Visit>
void visit_set(Set& s, const Visit& visit)
{
    visit_pixel(s, visit);
    for (auto& feature : s.features) visit(feature);
    visit(s.seen);
}
template <class Counts, class Visit>
void visit_counters(Counts& c, const Visit& visit)
{
    visit(c.camera_rays), visit(c.bounce_rays), visit(c.shadow_rays);
    visit(c.background_only_samples), visit(c.dropped);
}
template <class AnyTile, class Visit>
void visit_tile(AnyTile& t, const Visit& visit)
{
    visit(t.x0), visit(t.y0), visit(t.x1), visit(t.y1);
}
template <class Half, class Visit>
void visit_half(Half& h, const Visit& visit)
{
    visit(h.mean.r), visit(h.mean.g), visit(h.mean.b), visit(h.n), visit(h.error);
}

void put_optional(Writer& to, const std::optional<double>& x)
{
    to.put(uint32_t{x.has_value()});
    to.put(x.value_or(0));
}
std::optional<double> get_optional(Reader& from)
{
    uint32_t has = 0;
    double x = 0;
    from.get(has), from.get(x);
    return has != 0 ? std::optional(x) : std::nullopt;
}

void put_state(Writer& to, const RenderState& s)
{
    const auto put = [&](const auto& x) { to.put(x); };
    to.put(s.pass.begin), to.put(s.pass.end);
    to.put_all(s.left, [&](const Tile& t) { visit_tile(t, put); });
    visit_counters(s.counters, put);
    const SampleId first = s.counters.first_dropped.value_or(SampleId{});
    to.put(uint32_t{s.counters.first_dropped.has_value()}), to.put(first.x), to.put(first.y), to.put(first.sample);
    to.put(s.wall_s), to.put(s.cpu_s);
    to.put_all(s.passes, [&](const RunStats::Progress& p) {
        to.put(p.spp), to.put(p.seconds);
        put_optional(to, p.error);
    });
    to.put(s.error_log);
    put_optional(to, s.halves.rel_mse());
    to.put_all(s.halves.halves(), [&](const HalfBuffers::Half& h) { visit_half(h, put); });
}

// pixels: of the film.
RenderState get_state(Reader& from, const Tile& crop, size_t pixels)
{
    RenderState s;
    const auto get = [&](auto& x) { from.get(x); };
    from.get(s.pass.begin), from.get(s.pass.end);
    s.left.resize(from.count_of(sizeof(Tile)));
    for (Tile& t : s.left) {
        visit_tile(t, get);
        const bool is_inside =
            crop.x0 <= t.x0 && t.x0 < t.x1 && t.x1 <= crop.x1 && crop.y0 <= t.y0 && t.y0 < t.y1 && t.y1 <= crop.y1;
        if (!is_inside) from.fail_damaged();
    }
    if (s.pass.begin > s.pass.end) from.fail_damaged();
    visit_counters(s.counters, get);
    uint32_t has_dropped = 0;
    SampleId first;
    from.get(has_dropped), from.get(first.x), from.get(first.y), from.get(first.sample);
    if (has_dropped != 0) s.counters.first_dropped = first;
    from.get(s.wall_s), from.get(s.cpu_s);
    s.passes.resize(from.count_of(sizeof(double)));
    for (RunStats::Progress& p : s.passes) {
        from.get(p.spp), from.get(p.seconds);
        p.error = get_optional(from);
    }
    from.get(s.error_log);
    const std::optional<double> error = get_optional(from);
    std::vector<HalfBuffers::Half> halves(from.count_of(sizeof(HalfBuffers::Half)));
    if (!halves.empty() && halves.size() != pixels) from.fail_damaged();
    for (HalfBuffers::Half& h : halves) visit_half(h, get);
    s.halves = HalfBuffers(std::move(halves), error);
    return s;
}

// All sums of a film in turn; AnyFilm: Film or const Film. all(vector, visit): for the elements of each.
template <class AnyFilm, class All, class Visit>
void visit_film(AnyFilm& film, const All& all, const Visit& visit)
{
    const auto pixel = [&](auto& p) { visit_pixel(p, visit); };
    all(film.pixels, pixel), all(film.open, pixel);
    all(film.aovs, visit), all(film.open_aovs, visit);
    all(film.replicates, pixel);
    all(film.sets, [&](auto& set) { visit_set(set, visit); });
    all(film.wanted, visit);
}

void put_identity(Writer& to, const RenderIdentity& identity)
{
    to.put_all(identity, [&](const auto& one) { to.put(one.first), to.put(one.second); });
}

// Throws if it is not the one that is expected.
void check_identity(Reader& from, const RenderIdentity& expected)
{
    RenderIdentity there(from.count_of(2 * sizeof(uint64_t)));
    for (auto& [name, value] : there) from.get(name), from.get(value);
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
    from.fail("this checkpoint is of another picture: " + differences);
}

}  // namespace

void write_checkpoint(const std::string& path, const RenderIdentity& identity, const RenderState& state,
                      const Film& film)
{
    AtomicFile file(path);
    Writer to(file);
    to.put_bytes(magic.data(), magic.size());
    to.put(byte_order);
    put_identity(to, identity);
    put_state(to, state);
    visit_film(
        film, [&](const auto& all, const auto& visit) { to.put_all(all, visit); }, [&](const auto& x) { to.put(x); });
    to.end();
    file.finish();
    // Whatever happens in between, one of the two has its name.
    std::error_code absent;
    if (std::filesystem::is_regular_file(path, absent)) std::filesystem::rename(path, checkpoint_before(path), absent);
    file.commit();
}

RenderState read_checkpoint(const std::string& path, const RenderIdentity& identity, Film& film)
{
    const FileContent content(path);
    if (!content.problem().empty())
        throw Error(content.missing() ? ErrorKind::missing_input : ErrorKind::invalid_input, {path}, content.problem());
    std::string_view bytes = content.bytes();
    Reader from(path, bytes);
    if (!bytes.starts_with(magic)) from.fail("this is not a checkpoint, or one of another version of lancer");
    uint64_t hash = 0;
    if (bytes.size() < magic.size() + sizeof byte_order + sizeof hash) from.fail_damaged();
    std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
    bytes.remove_suffix(sizeof hash);
    if (Reader::hash_of(bytes) != hash) from.fail_damaged();
    from = Reader(path, bytes);
    from.bytes(magic.size());
    uint32_t order = 0;
    from.get(order);
    if (order != byte_order) from.fail("this checkpoint was written on a machine with another order of bytes");
    check_identity(from, identity);
    RenderState state = get_state(from, film.crop, film.pixels.size());
    visit_film(
        film, [&](auto& all, const auto& visit) { from.get_all(all, visit); }, [&](auto& x) { from.get(x); });
    if (!from.is_at_end()) from.fail_damaged();
    return state;
}

}  // namespace lancer
