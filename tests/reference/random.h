// Random numbers: PCG XSH-RR 64/32 of O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good
// Algorithms for Random Number Generation", 2014, sections 6.3.1 and 4.3; a stream for each sample of each pixel.
#pragma once

#include <cstdint>

namespace reference {

class Random {
public:
    Random(uint64_t seed, uint64_t pixel, uint64_t sample)
        : state_(scatter(seed + 0x9e3779b97f4a7c15u * (sample + 1))), increment_(2 * scatter(pixel ^ ~seed) + 1)
    {
        bits();
        state_ += scatter(pixel + 0xd1342543de82ef95u * sample);
        bits();
    }
    // In [0, 1), of 53 bits.
    double next()
    {
        const uint64_t high = bits(), low = bits();
        return static_cast<double>((high << 21) ^ (low >> 11)) * 0x1p-53;
    }

private:
    uint32_t bits()
    {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + increment_;
        const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }
    // Neighbouring numbers far apart: the finaliser of Steele, Lea, Flood, "Fast Splittable Pseudorandom Number
    // Generators", OOPSLA 2014, variant 13.
    static uint64_t scatter(uint64_t x)
    {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    uint64_t state_, increment_;
};

}  // namespace reference
