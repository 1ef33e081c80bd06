// Random numbers by address: (seed, pixel, sample, branch, bounce, dimension). A number has no place in a queue, so
// threads, tiles, batches and features left out never shift another's numbers.
// Owen-scrambled Sobol' points, padded: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; the hash
// that scrambles is Laine and Karras', with the constants of Vegdahl.
#pragma once

#include <array>
#include <cstdint>

#include "core/hash.h"
#include "core/vec.h"

namespace lancer {

enum class SamplerKind { sobol, independent };

// Each purpose owns a group of three numbers: (u, v) from get2, w from get1.
enum class Dim : uint32_t { pixel, lens, light, bsdf, roulette, mix, hole, shadow_hole };

namespace sobol {

constexpr uint32_t reverse_bits(uint32_t x)
{
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}
// Owen scrambling of bit-reversed x: flips each bit by a hash of the bits below it.
constexpr uint32_t laine_karras(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
// Second Sobol' dimension of index i, bit-reversed: its generator matrix is Pascal's triangle mod 2, which five
// shifts apply.
constexpr uint32_t second_reversed(uint32_t i)
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
    // pixel: y * width + x in the whole picture; sample: index within the pixel; branch: tells siblings of one path
    // apart (0 until a path splits).
    Sampler(SamplerKind kind, uint64_t seed, uint64_t pixel, uint32_t sample, uint32_t branch)
        : kind_(kind),
          sample_(sample),
          key_(mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15ull) ^ (pixel * 0xd1342543de82ef95ull + branch)))
    {
    }
    // Each in [0, 1).
    Vec2 get2(uint32_t bounce, Dim dim) const
    {
        const uint64_t h = group(bounce, dim);
        if (kind_ == SamplerKind::independent) {
            const uint64_t r = mix_bits(h + sample_ * 0x9e3779b97f4a7c15ull);
            return {to_unit(static_cast<uint32_t>(r >> 32)), to_unit(static_cast<uint32_t>(r))};
        }
        const uint32_t i = shuffled(h);
        return {to_unit(scrambled(i, h, 1)), to_unit(scrambled(sobol::second_reversed(i), h, 2))};
    }
    float get1(uint32_t bounce, Dim dim) const
    {
        const uint64_t h = group(bounce, dim);
        if (kind_ == SamplerKind::independent)
            return to_unit(static_cast<uint32_t>(mix_bits(~h + sample_ * 0x9e3779b97f4a7c15ull) >> 32));
        return to_unit(scrambled(sobol::third_reversed(shuffled(h)), h, 3));
    }

    // 32 bits that tell this address from all others: for numbers that need more to their address, see Ray::key.
    uint32_t key(uint32_t bounce, Dim dim) const
    {
        return static_cast<uint32_t>(mix_bits(group(bounce, dim) + sample_ * 0x9e3779b97f4a7c15ull) >> 32);
    }

private:
    // Wellons' lowbias32.
    static constexpr uint32_t mix32(uint32_t x)
    {
        x = (x ^ (x >> 16)) * 0x7feb352du;
        x = (x ^ (x >> 15)) * 0x846ca68bu;
        return x ^ (x >> 16);
    }
    // 24 bits: more would round up to 1.
    static constexpr float to_unit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }
    uint64_t group(uint32_t bounce, Dim dim) const
    {
        return mix_bits(key_ + (uint64_t{bounce} << 8 | static_cast<uint32_t>(dim)) * 0x9e3779b97f4a7c15ull);
    }
    uint32_t shuffled(uint64_t h) const
    {
        return sobol::reverse_bits(sobol::laine_karras(sobol::reverse_bits(sample_), static_cast<uint32_t>(h)));
    }
    static uint32_t scrambled(uint32_t reversed, uint64_t h, uint32_t dimension)
    {
        return sobol::reverse_bits(
            sobol::laine_karras(reversed, mix32(static_cast<uint32_t>(h >> 32) + dimension * 0x9e3779b9u)));
    }

    SamplerKind kind_;
    uint32_t sample_;
    uint64_t key_;
};

}  // namespace lancer
