// Random numbers by address: (seed, pixel, sample, branch, bounce, dimension). A number depends on its address alone,
// so threads, tiles, batches and disabled features never change the numbers of anything else. Padded Owen-scrambled
// Sobol' points: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; the hash is Laine and Karras', with
// Vegdahl's constants.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/hash.h"
#include "core/lanes/lanes.h"
#include "core/sampler_kind.h"
#include "core/vec.h"

namespace lancer {

// Each purpose has a group of three numbers: (u, v) by get2 and w by get1. get2 computes an even group and the next one
// together, as most callers use both.
enum class Dim : uint32_t {
    pixel,
    lens,
    light,
    bsdf,
    roulette,
    mix,
    alpha,
    shadow_alpha,
    mirror,
    mirrored_light,
    flight,         // where a medium scatters a path
    near_light,     // which light is sampled along a ray, and where on the ray
    along_the_ray,  // where on that light
    time            // while the shutter is open
};

namespace sobol {

// The functions below are templates for one, four and eight numbers at once.

// Owen scrambling of bit-reversed x: flips each bit by a hash of the bits below it.
template <class T>
constexpr T laine_karras(T x, T seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
// Wellons' lowbias32.
template <class T>
constexpr T mix32(T x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
// Scrambles a bit-reversed coordinate. hash: the upper half of the group's hash.
template <class T>
constexpr T scrambled(T reversed, T hash, T dimension)
{
    return reverse_bits(laine_karras(reversed, mix32(hash + dimension * 0x9e3779b9u)));
}
// Second Sobol' dimension of index i, bit-reversed: its generator matrix is Pascal's triangle mod 2, which five
// shifts apply.
template <class T>
constexpr T second_reversed(T i)
{
    i ^= (i & 0xffff0000u) >> 16;
    i ^= (i & 0xff00ff00u) >> 8;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xaaaaaaaau) >> 1;
    return i;
}
// Third dimension, bit-reversed: primitive polynomial x^2 + x + 1, m = 1, 3 (Joe and Kuo), by bytes of the index.
inline constexpr std::array<std::array<uint32_t, 256>, 4> third_table = [] {
    std::array<uint32_t, 32> direction{};
    for (uint32_t j = 0; j < 32; ++j)
        direction[j] = j == 0   ? 1u << 31
                       : j == 1 ? 3u << 30
                                : direction[j - 2] ^ (direction[j - 2] >> 2) ^ direction[j - 1];
    std::array<std::array<uint32_t, 256>, 4> table{};
    for (uint32_t byte = 0; byte < 4; ++byte)
        for (uint32_t value = 0; value < 256; ++value)
            for (uint32_t bit = 0; bit < 8; ++bit)
                if (value >> bit & 1) table[byte][value] ^= reverse_bits(direction[8 * byte + bit]);
    return table;
}();
constexpr uint32_t third_reversed(uint32_t i)
{
    return third_table[0][i & 255] ^ third_table[1][i >> 8 & 255] ^ third_table[2][i >> 16 & 255] ^
           third_table[3][i >> 24];
}

}  // namespace sobol

class Sampler {
public:
    // pixel: y * width + x in the whole picture; sample: index within the pixel; branch: distinguishes the rays of one
    // path after it splits (0 before).
    Sampler(SamplerKind kind, uint64_t seed, uint64_t pixel, uint32_t sample, uint32_t branch)
        : kind_(kind), sample_(sample), key_(key_of(seed, pixel, branch))
    {
    }
    // key: from key_of().
    Sampler(SamplerKind kind, uint64_t key, uint32_t sample) : kind_(kind), sample_(sample), key_(key) {}
    // Hash of the part of the address that all samples of a pixel share.
    static constexpr uint64_t key_of(uint64_t seed, uint64_t pixel, uint32_t branch)
    {
        return mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15ull) ^ (pixel * 0xd1342543de82ef95ull + branch));
    }
    // Hash of a group of numbers, without the sample.
    template <class T>
    static constexpr T hash_of(T key, uint32_t bounce, Dim dim)
    {
        return mix_bits(key + (uint64_t{bounce} << 8 | static_cast<uint32_t>(dim)) * uint64_t{0x9e3779b97f4a7c15});
    }
    // Independent numbers of a sample, given the hash of the group.
    static Vec2 independent2(uint64_t hash, uint32_t sample)
    {
        const uint64_t r = mix_bits(hash + sample * 0x9e3779b97f4a7c15ull);
        return {to_unit(static_cast<uint32_t>(r >> 32)), to_unit(static_cast<uint32_t>(r))};
    }
    static float independent1(uint64_t hash, uint32_t sample)
    {
        return to_unit(static_cast<uint32_t>(mix_bits(~hash + sample * 0x9e3779b97f4a7c15ull) >> 32));
    }
    // The sampler of another sample of the same pixel.
    Sampler of_sample(uint32_t sample) const
    {
        Sampler other = *this;
        other.sample_ = sample;
        other.pair_first_ = UINT32_MAX;
        return other;
    }
    // Each in [0, 1).
    Vec2 get2(uint32_t bounce, Dim dim) const
    {
        if (kind_ == SamplerKind::independent) return independent2(group(bounce, dim), sample_);
        const uint32_t number = static_cast<uint32_t>(dim), first = number & ~1u;
        if (pair_bounce_ != bounce || pair_first_ != first) {
            pair_ = compute_pair(bounce, first);
            pair_bounce_ = bounce, pair_first_ = first;
        }
        return pair_[number & 1];
    }
    float get1(uint32_t bounce, Dim dim) const
    {
        const uint64_t h = group(bounce, dim);
        if (kind_ == SamplerKind::independent) return independent1(h, sample_);
        return to_unit(sobol::scrambled(sobol::third_reversed(shuffled(h)), static_cast<uint32_t>(h >> 32), 3u));
    }

    // Computes get2(bounce, dim) and that of the paired group for up to eight samplers in SIMD lanes, which costs a
    // third of computing them one by one. The samplers keep the results.
    struct SampleRequest {
        const Sampler* sampler;
        uint32_t bounce;
    };
    static void prepare(std::span<const SampleRequest> asked, Dim dim)
    {
        using namespace sobol;
        const uint32_t first = static_cast<uint32_t>(dim) & ~1u;
        UInt8 sample{}, low_a{}, low_b{}, high_a{}, high_b{};
        for (size_t k = 0; k < asked.size(); ++k) {
            const Sampler& s = *asked[k].sampler;
            if (s.kind_ == SamplerKind::independent) return;
            const uint64_t a = s.group(asked[k].bounce, static_cast<Dim>(first));
            const uint64_t b = s.group(asked[k].bounce, static_cast<Dim>(first + 1));
            sample[k] = s.sample_;
            low_a[k] = static_cast<uint32_t>(a), high_a[k] = static_cast<uint32_t>(a >> 32);
            low_b[k] = static_cast<uint32_t>(b), high_b[k] = static_cast<uint32_t>(b >> 32);
        }
        const auto both = [&](UInt8 low, UInt8 high, UInt8& x, UInt8& y) {
            const UInt8 i = reverse_bits(laine_karras(reverse_bits(sample), low));
            x = scrambled(i, high, UInt8{} + 1u);
            y = scrambled(second_reversed(i), high, UInt8{} + 2u);
        };
        UInt8 ax, ay, bx, by;
        both(low_a, high_a, ax, ay);
        both(low_b, high_b, bx, by);
        for (size_t k = 0; k < asked.size(); ++k) {
            const Sampler& s = *asked[k].sampler;
            s.pair_ = {Vec2{to_unit(ax[k]), to_unit(ay[k])}, Vec2{to_unit(bx[k]), to_unit(by[k])}};
            s.pair_bounce_ = asked[k].bounce, s.pair_first_ = first;
        }
    }

    // A 32-bit hash of the address, for Ray::key.
    uint32_t key(uint32_t bounce, Dim dim) const { return key(group(bounce, dim), sample_); }
    // The same, given the hash of the group.
    static uint32_t key(uint64_t hash, uint32_t sample)
    {
        return static_cast<uint32_t>(mix_bits(hash + sample * 0x9e3779b97f4a7c15ull) >> 32);
    }

private:
    // get2 of two groups in four lanes: a third of the instructions of computing each number alone.
    std::array<Vec2, 2> compute_pair(uint32_t bounce, uint32_t first) const
    {
        using namespace sobol;
        const uint64_t a = group(bounce, static_cast<Dim>(first)), b = group(bounce, static_cast<Dim>(first + 1));
        const auto low_a = static_cast<uint32_t>(a), low_b = static_cast<uint32_t>(b);
        const auto high_a = static_cast<uint32_t>(a >> 32), high_b = static_cast<uint32_t>(b >> 32);
        const uint32_t sample = reverse_bits(sample_);
        const UInt4 i =
            reverse_bits(laine_karras(UInt4{sample, sample, sample, sample}, UInt4{low_a, low_a, low_b, low_b}));
        const UInt4 second{0, ~0u, 0, ~0u};
        const UInt4 points = (second_reversed(i) & second) | (i & ~second);
        const UInt4 x = scrambled(points, UInt4{high_a, high_a, high_b, high_b}, UInt4{1, 2, 1, 2});
        return {Vec2{to_unit(x[0]), to_unit(x[1])}, Vec2{to_unit(x[2]), to_unit(x[3])}};
    }
    // 24 bits: more would round up to 1.
    static constexpr float to_unit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }
    uint64_t group(uint32_t bounce, Dim dim) const { return hash_of(key_, bounce, dim); }
    uint32_t shuffled(uint64_t h) const
    {
        return reverse_bits(sobol::laine_karras(reverse_bits(sample_), static_cast<uint32_t>(h)));
    }

    SamplerKind kind_;
    uint32_t sample_;
    uint64_t key_;
    // The last result of compute_pair() or prepare(). A Sampler is used by one thread.
    mutable uint32_t pair_bounce_ = 0, pair_first_ = UINT32_MAX;
    mutable std::array<Vec2, 2> pair_{};
};

// Collects samplers whose numbers of one group will be needed, and computes them together. The samplers must not move
// before prepare().
template <size_t most>
class SampleRequests {
public:
    explicit SampleRequests(Dim dim) : dim_(dim) {}
    void add(const Sampler& sampler, uint32_t bounce) { asked_[count_++] = {&sampler, bounce}; }
    void prepare() const
    {
        for (size_t i = 0; i < count_; i += float_lanes)
            Sampler::prepare(std::span(asked_).subspan(i, std::min<size_t>(float_lanes, count_ - i)), dim_);
    }

private:
    std::array<Sampler::SampleRequest, most> asked_;
    size_t count_ = 0;
    Dim dim_;
};

}  // namespace lancer
