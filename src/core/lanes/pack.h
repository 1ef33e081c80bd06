// Compaction of eight lanes: moves the selected lanes to the front.
#pragma once

#include <array>

#include "core/lanes/lanes.h"

namespace lancer {

// Permutes the selected lanes to the front, in order; the other lanes are undefined.
class Packing {
public:
    // wanted: bit i selects lane i.
    explicit Packing(uint32_t wanted) : order_(load8(orders[wanted].data())) {}
    Float8 operator()(Float8 x) const { return permute(x, order_); }
    UInt8 operator()(UInt8 x) const { return permute(x, order_); }
    // Writes eight numbers; the selected ones come first.
    void store(float* to, Float8 x) const { store8_anywhere(to, (*this)(x)); }
    void store(uint32_t* to, UInt8 x) const { store8_anywhere(to, (*this)(x)); }

private:
    struct alignas(32) Orders : std::array<uint32_t, float_lanes> {};
    static constexpr std::array<Orders, 256> orders = [] {
        std::array<Orders, 256> all{};
        for (uint32_t wanted = 0; wanted < all.size(); ++wanted)
            for (uint32_t lane = 0, next = 0; lane < float_lanes; ++lane)
                if (wanted >> lane & 1) all[wanted][next++] = lane;
        return all;
    }();

    UInt8 order_;
};

}  // namespace lancer
