// Compaction of eight lanes: moves the selected lanes to the front.
#pragma once

#include <array>

#include "core/lanes/lanes.h"

namespace lancer {

// Permutes the selected lanes to the front, in order; the other lanes are undefined.
class Packing {
public:
    // wanted: bit i selects lane i.
    explicit Packing(uint32_t wanted)
        : order_(_mm256_load_si256(reinterpret_cast<const __m256i*>(orders[wanted].data())))
    {
    }
    Float8 operator()(Float8 x) const { return _mm256_permutevar8x32_ps(x, order_); }
    UInt8 operator()(UInt8 x) const
    {
        return reinterpret_cast<UInt8>(_mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(x), order_));
    }
    // Writes eight numbers; the selected ones come first.
    void store(float* to, Float8 x) const { _mm256_storeu_ps(to, (*this)(x)); }
    void store(uint32_t* to, UInt8 x) const
    {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), reinterpret_cast<__m256i>((*this)(x)));
    }

private:
    struct alignas(32) Orders : std::array<uint32_t, float_lanes> {};
    static constexpr std::array<Orders, 256> orders = [] {
        std::array<Orders, 256> all{};
        for (uint32_t wanted = 0; wanted < all.size(); ++wanted)
            for (uint32_t lane = 0, next = 0; lane < float_lanes; ++lane)
                if (wanted >> lane & 1) all[wanted][next++] = lane;
        return all;
    }();

    __m256i order_;
};

inline UInt8 load8_anywhere(const uint32_t* from)
{
    return reinterpret_cast<UInt8>(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
}

}  // namespace lancer
