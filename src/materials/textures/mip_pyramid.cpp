#include "materials/textures/mip_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/lanes/half.h"
#include "core/srgb.h"

namespace lancer {
namespace {

const float* linear_table(Encoding encoding)
{
    static const std::vector<float> srgb = make_linear_table(Encoding::srgb, 256);
    static const std::vector<float> linear = make_linear_table(Encoding::linear, 256);
    return encoding == Encoding::linear ? linear.data() : srgb.data();
}

// Storage formats of texels.
class ByteCodec {
public:
    explicit ByteCodec(const float* table) : table_(table)
    {
        for (size_t i = 0; i + 1 < borders_.size(); ++i) borders_[i] = 0.5f * (table[i] + table[i + 1]);
        borders_.back() = std::numeric_limits<float>::infinity();
        uint8_t below = 0;
        for (size_t i = 0; i < first_.size(); ++i) {
            while (borders_[below] <= static_cast<float>(i) / parts) ++below;
            first_[i] = below;
        }
    }
    float decode(uint8_t v) const { return table_[v]; }
    // Rounds to the nearest step in linear light, so that means stay as close as possible. v: in [0, 1], divided into
    // parts of which few contain a step boundary.
    uint8_t encode(float v) const
    {
        uint8_t n = first_[std::min(static_cast<size_t>(v * parts), first_.size() - 1)];
        while (borders_[n] <= v) ++n;
        return n;
    }

private:
    static constexpr float parts = 4096;

    const float* table_;
    std::array<float, 256> borders_;  // where the next step begins
    // For each part of [0, 1] the number of step boundaries at or below its beginning.
    std::array<uint8_t, static_cast<size_t>(parts)> first_{};
};
struct HalfCodec {
    float decode(uint16_t v) const { return float_from_half(v); }
    uint16_t encode(float v) const { return half_from_float(v); }
};
struct FloatCodec {
    float decode(float v) const { return v; }
    float encode(float v) const { return v; }
};

// The texels of a row of n that contribute to texel i of the next level, and their weights.
struct Taps {
    size_t first, count;
    std::array<double, 3> weight;
};

size_t next_size(size_t n) { return std::max<size_t>(n / 2, 1); }

Taps taps_of(size_t i, size_t n)
{
    if (n == 1) return {0, 1, {1, 0, 0}};
    if (n % 2 == 0) return {2 * i, 2, {0.5, 0.5, 0}};
    const double whole = static_cast<double>(n), part = static_cast<double>(i), kept = static_cast<double>(n / 2);
    return {2 * i, 3, {(kept - part) / whole, kept / whole, (part + 1) / whole}};
}

// The next level as floats; decode() converts a texel. Sums are double: rounded to float, the mean of equal numbers is
// that number.
template <class Value, class Decode>
std::vector<float> shrink(const MipLevel& from, size_t channels, const Value* values, const Decode& decode)
{
    const size_t width = next_size(from.width), height = next_size(from.height), row_size = from.width * channels;
    std::vector<float> result(width * height * channels);
    std::vector<double> sum(row_size);
    for (size_t y = 0; y < height; ++y) {
        const Taps down = taps_of(y, from.height);
        const auto row = [&](size_t k) { return values + (down.first + k) * row_size; };
        std::fill(sum.begin(), sum.end(), 0.0);
        for (size_t k = 0; k < down.count; ++k)
            for (size_t i = 0; i < row_size; ++i) sum[i] += down.weight[k] * static_cast<double>(decode(row(k)[i]));
        float* const out = &result[y * width * channels];
        if (from.width % 2 == 0) {
            for (size_t x = 0; x < width; ++x)
                for (size_t c = 0; c < channels; ++c)
                    out[x * channels + c] =
                        static_cast<float>(0.5 * sum[2 * x * channels + c] + 0.5 * sum[(2 * x + 1) * channels + c]);
            continue;
        }
        for (size_t x = 0; x < width; ++x) {
            const Taps across = taps_of(x, from.width);
            for (size_t c = 0; c < channels; ++c) {
                double v = 0;
                for (size_t k = 0; k < across.count; ++k)
                    v += across.weight[k] * sum[(across.first + k) * channels + c];
                out[x * channels + c] = static_cast<float>(v);
            }
        }
    }
    return result;
}

// Sizes and offsets of all levels.
std::vector<MipLevel> list_levels(uint32_t width, uint32_t height, uint32_t channels)
{
    std::vector<MipLevel> levels{{width, height, 0}};
    for (MipLevel level = levels[0]; level.width > 1 || level.height > 1;) {
        level.first += size_t{level.width} * level.height * channels;
        level.width = static_cast<uint32_t>(next_size(level.width));
        level.height = static_cast<uint32_t>(next_size(level.height));
        levels.push_back(level);
    }
    return levels;
}

// How many of the levels have a side longer than the limit; never all of them.
size_t count_dropped(const std::vector<MipLevel>& levels, uint32_t limit)
{
    if (limit == 0) return 0;
    const auto first = std::find_if(levels.begin(), levels.end(),
                                    [&](const MipLevel& l) { return std::max(l.width, l.height) <= limit; });
    return static_cast<size_t>(first - levels.begin());
}

// Computes the levels below the finest one, which is in `values`, each from the unrounded numbers of the previous one.
// Where some are dropped, they are what the others are computed from and are not kept.
template <class Value, class Codec>
void add_levels(MipPyramid& pyramid, std::vector<Value> values, const Codec& codec, uint32_t limit)
{
    const size_t channels = pyramid.channels;
    std::vector<MipLevel>& levels = pyramid.levels;
    const size_t dropped = count_dropped(levels, limit), before = levels[dropped].first;
    const size_t size = levels.back().first + channels - before;
    std::vector<Value> kept;
    if (dropped == 0) kept.swap(values);
    kept.resize(size);
    const Value* const finest = dropped == 0 ? kept.data() : values.data();
    std::vector<float> exact;
    for (size_t i = 0; i + 1 < levels.size(); ++i) {
        exact = i == 0 ? shrink(levels[i], channels, finest, [&](Value v) { return codec.decode(v); })
                       : shrink(levels[i], channels, exact.data(), [](float v) { return v; });
        if (i + 1 < dropped) continue;
        std::transform(exact.begin(), exact.end(), &kept[levels[i + 1].first - before],
                       [&](float v) { return codec.encode(v); });
    }
    const auto top = [&](size_t c) { return exact.empty() ? codec.decode(kept[c]) : exact[c]; };
    pyramid.mean = {top(0), top(channels / 2), top(channels - 1)};
    pyramid.values = std::move(kept);
    levels.erase(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(dropped));
    for (MipLevel& level : levels) level.first -= before;
}

bool is_one_everywhere(const Raster& raster, uint32_t channel)
{
    for (size_t i = channel; i < raster.value_count(); i += raster.channels)
        if (raster.floats.empty() ? raster.bytes[i] != 255 : raster.floats[i] != 1) return false;
    return true;
}

Channel resolve(const Raster& raster, Channel channel)
{
    if (channel == Channel::automatic) {
        const bool says_something = raster.has_alpha() && !is_one_everywhere(raster, raster.channels - 1);
        channel = says_something ? Channel::alpha : Channel::red;
    }
    const bool is_grey = raster.channels < 3;
    return is_grey && channel != Channel::alpha ? Channel::red : channel;
}

// With room for all levels, so that adding them moves nothing.
template <class Value, class Get>
std::vector<Value> collect(const Raster& raster, uint32_t channels, const Get& get)
{
    const size_t finest = size_t{raster.width} * raster.height * channels;
    std::vector<Value> values;
    values.reserve(list_levels(raster.width, raster.height, channels).back().first + channels);
    values.resize(finest);
    for (size_t i = 0, pixel = 0; i < values.size(); pixel += raster.channels)
        for (uint32_t c = 0; c < channels; ++c) values[i++] = get(pixel, c);
    return values;
}

// All channels of the bytes.
std::vector<uint8_t> collect_all(const Raster& raster)
{
    std::vector<uint8_t> values;
    values.reserve(list_levels(raster.width, raster.height, raster.channels).back().first + raster.channels);
    values.assign(raster.bytes.begin(), raster.bytes.end());
    return values;
}

// Whether integers are decoded by a power of the file's own, for which no table is kept.
bool is_power(float exponent, Encoding encoding)
{
    return encoding == Encoding::of_file && exponent != 0 && exponent != 1;
}

// A finite, decoded value.
std::vector<float> collect_floats(const Raster& raster, Encoding encoding, MipPyramid& pyramid, uint32_t first)
{
    const bool is_bytes = raster.floats.empty();
    const size_t steps = is_bytes ? 256 : 65536;  // integers of more than 16 bits are rounded to these
    const bool is_curved = !raster.is_float && encoding != Encoding::linear;
    const std::vector<float> table =
        is_curved ? make_linear_table(encoding, steps, raster.exponent) : std::vector<float>();
    return collect<float>(raster, pyramid.channels, [&](size_t pixel, uint32_t c) {
        if (is_bytes) return table[raster.bytes[pixel + first + c]];
        const float v = raster.floats[pixel + first + c];
        if (!std::isfinite(v)) {
            ++pyramid.not_finite;
            return 0.0f;
        }
        if (!is_curved) return v;
        return table[static_cast<size_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * static_cast<float>(steps - 1)))];
    });
}

}  // namespace

uint64_t MipPyramid::bytes() const
{
    return std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, values);
}

bool MipPyramid::is_constant() const
{
    return std::visit(
        [&](const auto& v) {
            for (size_t i = channels; i < v.size(); ++i)
                if (v[i] != v[i - channels]) return false;
            return true;
        },
        values);
}

PyramidCost cost_of_pyramid(const RasterHeader& header, Encoding encoding, Channel channel, uint32_t limit)
{
    const uint32_t channels = channel == Channel::color && header.channels >= 3 ? 3 : 1;
    const bool is_grey = header.channels < 3, has_alpha = header.channels % 2 == 0;
    const bool luminance = channel == Channel::luminance && !is_grey;
    const bool is_bytes = header.values == RasterHeader::Values::bytes && !is_power(header.exponent, encoding);
    // A quotient by alpha and a mean of three are no halves.
    const bool is_half =
        header.values == RasterHeader::Values::halves && !luminance && (!has_alpha || channel == Channel::alpha);
    const std::vector<MipLevel> levels = list_levels(header.width, header.height, channels);
    const size_t dropped = count_dropped(levels, limit);
    const uint64_t finest = uint64_t{header.width} * header.height * channels;
    const uint64_t size = is_bytes ? 1 : is_half ? sizeof(uint16_t) : sizeof(float);
    // The finest level, as floats where it is not of bytes, and two levels as unrounded floats.
    const uint64_t collected = is_bytes ? (dropped > 0 ? finest : 0) : finest * sizeof(float) * (luminance ? 3 : 1);
    return {.kept = (levels.back().first + channels - levels[dropped].first) * size,
            .working = collected + finest + finest / 4};
}

MipPyramid build_pyramid(const Raster& raster, Encoding encoding, Channel asked, uint32_t limit)
{
    const Channel channel = resolve(raster, asked);
    MipPyramid result;
    if (channel == Channel::alpha && !raster.has_alpha()) {
        result.levels = {{1, 1, 0}};
        result.decode = linear_table(Encoding::linear);
        add_levels(result, std::vector<uint8_t>{255}, ByteCodec(result.decode), 0);
        return result;
    }
    if (channel == Channel::alpha || (encoding == Encoding::of_file && raster.exponent == 1))
        encoding = Encoding::linear;
    const bool wants_luminance = channel == Channel::luminance;
    result.channels = channel == Channel::color || wants_luminance ? 3 : 1;
    const uint32_t first = channel == Channel::alpha   ? raster.channels - 1
                           : channel == Channel::green ? 1
                           : channel == Channel::blue  ? 2
                                                       : 0;
    const auto set_levels = [&] { result.levels = list_levels(raster.width, raster.height, result.channels); };
    if (raster.floats.empty() && !is_power(raster.exponent, encoding)) {
        result.decode = linear_table(encoding);
        const ByteCodec codec(result.decode);
        const auto byte = [&](size_t pixel, uint32_t c) { return raster.bytes[pixel + first + c]; };
        const auto luminance_byte = [&](size_t pixel, uint32_t) {
            const auto v = [&](uint32_t c) { return static_cast<double>(codec.decode(byte(pixel, c))); };
            return codec.encode(static_cast<float>(luminance(v(0), v(1), v(2))));
        };
        if (wants_luminance) result.channels = 1;
        set_levels();
        add_levels(result,
                   wants_luminance                      ? collect<uint8_t>(raster, 1, luminance_byte)
                   : result.channels == raster.channels ? collect_all(raster)
                                                        : collect<uint8_t>(raster, result.channels, byte),
                   codec, limit);
        return result;
    }
    std::vector<float> values = collect_floats(raster, encoding, result, first);
    if (wants_luminance) {
        result.channels = 1;
        for (size_t i = 0; i < values.size() / 3; ++i) {
            const auto v = [&](size_t c) { return static_cast<double>(values[3 * i + c]); };
            values[i] = static_cast<float>(luminance(v(0), v(1), v(2)));
        }
        values.resize(values.size() / 3);
    }
    set_levels();
    const HalfCodec half;
    if (std::all_of(values.begin(), values.end(), [&](float v) { return half.decode(half.encode(v)) == v; })) {
        std::vector<uint16_t> halves;
        halves.reserve(result.levels.back().first + result.channels);
        halves.resize(values.size());
        std::transform(values.begin(), values.end(), halves.begin(), [&](float v) { return half.encode(v); });
        values = {};
        add_levels(result, std::move(halves), half, limit);
    } else {
        add_levels(result, std::move(values), FloatCodec(), limit);
    }
    return result;
}

}  // namespace lancer
