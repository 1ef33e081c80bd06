// Eight samplers at once, with the bits of Sampler in each lane.
#pragma once

#include "core/lanes/vec.h"
#include "core/sampler.h"

namespace lancer {

// Sampler::key_of() of each lane, split into halves.
struct KeyLanes {
    UInt8 low, high;
};

// The hashes of a group of numbers in each lane, without the sample.
class AddressLanes {
public:
    AddressLanes(SamplerKind kind, const KeyLanes& key, uint32_t bounce, Dim dim) : kind_(kind)
    {
        const auto hash = [&](UInt8 keys) {
            return reinterpret_cast<UInt8>(Sampler::hash_of(reinterpret_cast<ULong4>(keys), bounce, dim));
        };
        const UInt8 a = hash(interleave_low(key.low, key.high)), b = hash(interleave_high(key.low, key.high));
        low_ = even_lanes(a, b);
        high_ = odd_lanes(a, b);
    }
    // As Sampler::get2(); sample: index within the pixel.
    Vec2x8 get2(UInt8 sample) const
    {
        if (kind_ == SamplerKind::independent) {
            Vec2x8 of;
            for (uint32_t i = 0; i < float_lanes; ++i) {
                const Vec2 u = Sampler::independent2(hash(i), sample[i]);
                of.x[i] = u.x, of.y[i] = u.y;
            }
            return of;
        }
        const UInt8 i = shuffled(sample);
        return {first_of(i), second_of(i)};
    }
    // The first number of get2().
    Float8 get2_x(UInt8 sample) const
    {
        if (kind_ == SamplerKind::independent) return get2(sample).x;
        return first_of(shuffled(sample));
    }
    Float8 get1(UInt8 sample) const
    {
        Float8 of;
        if (kind_ == SamplerKind::independent) {
            for (uint32_t i = 0; i < float_lanes; ++i) of[i] = Sampler::independent1(hash(i), sample[i]);
            return of;
        }
        return third_of(shuffled(sample));
    }
    // get2() and get1() at once.
    Vec3x8 get3(UInt8 sample) const
    {
        if (kind_ == SamplerKind::independent) {
            const Vec2x8 first = get2(sample);
            return {first.x, first.y, get1(sample)};
        }
        const UInt8 i = shuffled(sample);
        return {first_of(i), second_of(i), third_of(i)};
    }
    // As Sampler::key(), for lane i.
    uint32_t key(size_t i, uint32_t sample) const { return Sampler::key(hash(i), sample); }

private:
    uint64_t hash(size_t i) const { return uint64_t{high_[i]} << 32 | low_[i]; }
    static Float8 to_unit(UInt8 x) { return to_float(reinterpret_cast<Int8>(x >> 8)) * 0x1p-24f; }
    UInt8 shuffled(UInt8 sample) const { return reverse_bits(sobol::laine_karras(reverse_bits(sample), low_)); }
    // Coordinates of the point with a shuffled index.
    Float8 first_of(UInt8 i) const { return to_unit(sobol::scrambled(i, high_, UInt8{} + 1u)); }
    Float8 second_of(UInt8 i) const
    {
        return to_unit(sobol::scrambled(sobol::second_reversed(i), high_, UInt8{} + 2u));
    }
    Float8 third_of(UInt8 i) const { return to_unit(sobol::scrambled(third_reversed(i), high_, UInt8{} + 3u)); }
    static UInt8 third_reversed(UInt8 i)
    {
        const auto of_byte = [i](int byte) {
            return gather(sobol::third_table[static_cast<size_t>(byte)].data(), i >> (8 * byte) & 255u);
        };
        return of_byte(0) ^ of_byte(1) ^ of_byte(2) ^ of_byte(3);
    }

    SamplerKind kind_;
    UInt8 low_, high_;
};

}  // namespace lancer
