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
    return encoding == Encoding::srgb ? srgb.data() : linear.data();
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

// Sizes and offsets of all levels below the finest one.
void list_levels(MipPyramid& pyramid)
{
    for (MipLevel level = pyramid.levels[0]; level.width > 1 || level.height > 1;) {
        level.first += size_t{level.width} * level.height * pyramid.channels;
        level.width = static_cast<uint32_t>(next_size(level.width));
        level.height = static_cast<uint32_t>(next_size(level.height));
        pyramid.levels.push_back(level);
    }
}

// Computes the levels below the finest one in `values`, each from the unrounded numbers of the previous one.
template <class Value, class Codec>
void add_levels(MipPyramid& pyramid, std::vector<Value> values, const Codec& codec)
{
    const size_t channels = pyramid.channels;
    list_levels(pyramid);
    values.resize(pyramid.levels.back().first + channels);
    std::vector<float> exact;
    for (size_t i = 0; i + 1 < pyramid.levels.size(); ++i) {
        const MipLevel& level = pyramid.levels[i];
        exact = i == 0 ? shrink(level, channels, values.data(), [&](Value v) { return codec.decode(v); })
                       : shrink(level, channels, exact.data(), [](float v) { return v; });
        std::transform(exact.begin(), exact.end(), &values[pyramid.levels[i + 1].first],
                       [&](float v) { return codec.encode(v); });
    }
    const auto top = [&](size_t c) { return exact.empty() ? codec.decode(values[c]) : exact[c]; };
    pyramid.mean = {top(0), top(channels / 2), top(channels - 1)};
    pyramid.values = std::move(values);
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

template <class Value, class Get>
std::vector<Value> collect(const Raster& raster, uint32_t channels, const Get& get)
{
    std::vector<Value> values(size_t{raster.width} * raster.height * channels);
    for (size_t i = 0, pixel = 0; i < values.size(); pixel += raster.channels)
        for (uint32_t c = 0; c < channels; ++c) values[i++] = get(pixel, c);
    return values;
}

// A finite, decoded value.
std::vector<float> collect_floats(const Raster& raster, Encoding encoding, MipPyramid& pyramid, uint32_t first)
{
    constexpr size_t steps = 65536;  // integers of more than 16 bits are rounded to these
    const bool is_curved = !raster.is_float && encoding == Encoding::srgb;
    const std::vector<float> table = is_curved ? make_linear_table(encoding, steps) : std::vector<float>();
    return collect<float>(raster, pyramid.channels, [&](size_t pixel, uint32_t c) {
        const float v = raster.floats[pixel + first + c];
        if (!std::isfinite(v)) {
            ++pyramid.not_finite;
            return 0.0f;
        }
        if (!is_curved) return v;
        return table[static_cast<size_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * (steps - 1)))];
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

MipPyramid build_pyramid(const Raster& raster, Encoding encoding, Channel asked)
{
    const Channel channel = resolve(raster, asked);
    MipPyramid result;
    result.levels = {{raster.width, raster.height, 0}};
    if (channel == Channel::alpha && !raster.has_alpha()) {
        result.levels = {{1, 1, 0}};
        result.decode = linear_table(Encoding::linear);
        add_levels(result, std::vector<uint8_t>{255}, ByteCodec(result.decode));
        return result;
    }
    if (channel == Channel::alpha) encoding = Encoding::linear;
    const bool wants_luminance = channel == Channel::luminance;
    result.channels = channel == Channel::color || wants_luminance ? 3 : 1;
    const uint32_t first = channel == Channel::alpha   ? raster.channels - 1
                           : channel == Channel::green ? 1
                           : channel == Channel::blue  ? 2
                                                       : 0;
    if (raster.floats.empty()) {
        result.decode = linear_table(encoding);
        const ByteCodec codec(result.decode);
        const auto byte = [&](size_t pixel, uint32_t c) { return raster.bytes[pixel + first + c]; };
        const auto luminance_byte = [&](size_t pixel, uint32_t) {
            const auto v = [&](uint32_t c) { return static_cast<double>(codec.decode(byte(pixel, c))); };
            return codec.encode(static_cast<float>(luminance(v(0), v(1), v(2))));
        };
        if (wants_luminance) result.channels = 1;
        const bool as_it_is = result.channels == raster.channels;
        add_levels(result,
                   wants_luminance ? collect<uint8_t>(raster, 1, luminance_byte)
                   : as_it_is      ? raster.bytes
                                   : collect<uint8_t>(raster, result.channels, byte),
                   codec);
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
    const HalfCodec half;
    if (std::all_of(values.begin(), values.end(), [&](float v) { return half.decode(half.encode(v)) == v; })) {
        std::vector<uint16_t> halves(values.size());
        std::transform(values.begin(), values.end(), halves.begin(), [&](float v) { return half.encode(v); });
        values = {};
        add_levels(result, std::move(halves), half);
    } else {
        add_levels(result, std::move(values), FloatCodec());
    }
    return result;
}

}  // namespace lancer
