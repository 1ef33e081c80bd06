// Finds equal values in a list: for each the first one like it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "core/hash.h"
#include "core/vec.h"

namespace lancer {

// Of every value the first index that had it: open addressing, in a table twice as large as what it holds.
class FirstIndex {
public:
    static constexpr uint32_t none = UINT32_MAX;

    explicit FirstIndex(size_t count) : slots_(std::bit_ceil(2 * count + 1), none) {}

    // The index that was given first with an equal value, else i. equals(j): whether j has the value of i.
    template <class Equals>
    uint32_t of(uint32_t i, uint64_t hash, const Equals& equals)
    {
        size_t at = start(hash);
        for (; slots_[at] != none; at = next(at))
            if (equals(slots_[at])) return slots_[at];
        return slots_[at] = i;
    }
    // Which index has the value; `none` if none.
    template <class Equals>
    uint32_t find(uint64_t hash, const Equals& equals) const
    {
        size_t at = start(hash);
        while (slots_[at] != none && !equals(slots_[at])) at = next(at);
        return slots_[at];
    }

private:
    size_t start(uint64_t hash) const { return mix_bits(hash) & (slots_.size() - 1); }
    size_t next(size_t at) const { return (at + 1) & (slots_.size() - 1); }

    std::vector<uint32_t> slots_;
};

// Of the bits of numbers, where -0 is 0.
inline uint64_t hash_of_numbers(std::initializer_list<double> numbers)
{
    uint64_t hash = 0;
    for (const double x : numbers) hash = mix_bits(hash ^ std::bit_cast<uint64_t>(x == 0 ? 0.0 : x));
    return hash;
}

// The angle of a triangle at `at`; 0 if it has no area there.
inline double corner_angle(Vec3d at, Vec3d a, Vec3d b)
{
    const Vec3d u = a - at, v = b - at;
    return std::atan2(length(cross(u, v)), dot(u, v));
}

}  // namespace lancer
