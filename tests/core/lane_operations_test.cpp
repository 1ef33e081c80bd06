// Each vector operation gives in each lane the bits of the scalar operation, with intrinsics and in plain C++, for
// special values, with denormals and with these flushed to zero.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "core/lanes/denormals.h"
#include "core/lanes/half.h"
#include "core/lanes/lanes.h"
#include "core/lanes/portable.h"
#include "core/lanes/prefetch.h"
#include "support/random.h"

namespace lancer {
namespace {

bool same_bits(float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); }
bool same_bits(double a, double b) { return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b); }
// Where denormals count as zero, the least and the largest of two may come out as zero or as they are: compilers choose
// among instructions that differ in it.
template <class T>
T as_counted(T x)
{
    return flushes_denormals() && std::abs(x) < std::numeric_limits<T>::min() ? std::copysign(T{0}, x) : x;
}
bool same(float a, float b) { return same_bits(as_counted(a), as_counted(b)) || (a != a && b != b); }
bool same(double a, double b) { return same_bits(as_counted(a), as_counted(b)) || (a != a && b != b); }
template <class T>
bool same(T a, T b)
{
    return a == b;
}

template <class Lanes>
constexpr size_t lanes_in = sizeof(Lanes) / sizeof(Lanes{}[0]);

// alone(k): what lane k is to be.
template <class Lanes, class Alone>
void expect_lanes(const char* what, Lanes of, const Alone& alone)
{
    for (size_t k = 0; k < lanes_in<Lanes>; ++k) {
        const auto expected = alone(k);
        const std::remove_const_t<decltype(expected)> got = of[k];
        EXPECT_TRUE(same(got, expected)) << what << ", lane " << k << ": " << got << ", not " << expected;
    }
}
template <class Lanes, class Alone>
void expect_both(const char* what, Lanes by_native, Lanes by_portable, const Alone& alone)
{
    expect_lanes(what, by_native, alone);
    expect_lanes(what, by_portable, alone);
}

// Numbers at which operations are known to differ, and others.
const std::vector<float>& floats()
{
    static const std::vector<float> all = [] {
        using Limits = std::numeric_limits<float>;
        std::vector<float> x{Limits::quiet_NaN(),
                             std::bit_cast<float>(0x7f812345u),
                             Limits::infinity(),
                             0.0f,
                             Limits::denorm_min(),
                             0x1.fffffcp-127f,
                             Limits::min(),
                             Limits::max(),
                             1.0f,
                             0.5f,
                             1.5f,
                             2.5f,
                             0x1.fffffep-2f,
                             0x1p23f,
                             0x1.000002p22f,
                             0x1p31f,
                             0x1.fffffep30f,
                             1e10f,
                             65504.0f,
                             65520.0f,
                             0x1p-14f,
                             0x1p-24f,
                             0x1p-25f,
                             0x1.8p-25f,
                             255.0f,
                             3.0f};
        for (size_t i = 0, n = x.size(); i < n; ++i) x.push_back(-x[i]);
        Random random(4);
        for (int i = 0; i < 12; ++i) x.push_back(std::bit_cast<float>(static_cast<uint32_t>(random.bits() >> 32)));
        return x;
    }();
    return all;
}
template <class Lanes, class T>
Lanes take(const std::vector<T>& x, size_t first)
{
    Lanes of{};
    for (size_t k = 0; k < lanes_in<Lanes>; ++k) of[k] = x[(first + k) % x.size()];
    return of;
}
std::vector<double> doubles()
{
    std::vector<double> x(floats().begin(), floats().end());
    for (const double more :
         {0x1p-1074, 0x1p-1022, 0x1p-150, 0x1.000001p0, 0x1.000003p0, 1e300, -1e300, 0x1p-126 - 0x1p-160})
        x.push_back(more);
    return x;
}

// f(lanes at i, lanes at j), with all pairs of numbers in some lane; denormals are zero, and then are not.
template <class Lanes, class T, class F>
void for_pairs(const std::vector<T>& x, const F& f)
{
    const uint64_t mode = float_mode();
    for (const uint64_t flush : {uint64_t{0}, flush_bits}) {
        set_float_mode((mode & ~flush_bits) | flush);
        for (size_t i = 0; i < x.size(); ++i)
            for (size_t j = 0; j < x.size(); ++j) f(take<Lanes>(x, i), take<Lanes>(x, j));
    }
    set_float_mode(mode);
}

template <class Lanes>
void check_min_max()
{
    for_pairs<Lanes>(floats(), [](Lanes a, Lanes b) {
        expect_both("min", native::min(a, b), portable::min(a, b), [&](size_t k) { return a[k] < b[k] ? a[k] : b[k]; });
        expect_both("max", native::max(a, b), portable::max(a, b), [&](size_t k) { return a[k] > b[k] ? a[k] : b[k]; });
        for (size_t k = 0; k < lanes_in<Lanes>; ++k)
            if (a[k] != a[k] || b[k] != b[k]) {
                for (const Lanes& of : {native::min(a, b), portable::min(a, b), native::max(a, b), portable::max(a, b)})
                    EXPECT_TRUE(same_bits(as_counted<float>(of[k]), as_counted<float>(b[k]))) << a[k] << " " << b[k];
            }
    });
}
TEST(LaneOperations, MinimumAndMaximumKeepTheSecondWhereNeitherIsLess)
{
    check_min_max<Float4>();
    check_min_max<Float8>();
}

TEST(LaneOperations, RootsAndProductsAreRoundedOnce)
{
    for_pairs<Float8>(floats(), [](Float8 a, Float8 b) {
        const Float8 c = permute(a, UInt8{3, 7, 1, 5, 0, 2, 4, 6});
        expect_both("sqrt", native::sqrt(a), portable::sqrt(a), [&](size_t k) { return std::sqrt(a[k]); });
        expect_both("sqrt", native::sqrt(lower(a)), portable::sqrt(lower(a)),
                    [&](size_t k) { return std::sqrt(a[k]); });
        expect_both("fmadd", native::fmadd(a, b, c), portable::fmadd(a, b, c),
                    [&](size_t k) { return std::fma(a[k], b[k], c[k]); });
        expect_both("fnmadd", native::fnmadd(a, b, c), portable::fnmadd(a, b, c),
                    [&](size_t k) { return std::fma(-a[k], b[k], c[k]); });
    });
    for_pairs<Double4>(doubles(), [](Double4 a, Double4) {
        expect_both("sqrt", native::sqrt(a), portable::sqrt(a), [&](size_t k) { return std::sqrt(a[k]); });
    });
    const Float8 a = broadcast(1 + 0x1p-12f);
    EXPECT_EQ(native::fnmadd(a, a, broadcast(1.0f))[0], -0x1.0008p-11f);
    EXPECT_EQ(portable::fnmadd(a, a, broadcast(1.0f))[0], -0x1.0008p-11f);
}

template <class Lanes, class T>
void check_signs(const std::vector<T>& x)
{
    for_pairs<Lanes>(x, [](Lanes a, Lanes b) {
        for (size_t k = 0; k < lanes_in<Lanes>; ++k)
            for (const Lanes& of : {native::copysign(a, b), portable::copysign(a, b)})
                EXPECT_TRUE(same_bits(of[k], std::copysign(a[k], b[k]))) << a[k] << " " << b[k];
        for (size_t k = 0; k < lanes_in<Lanes>; ++k)
            for (const Lanes& of : {native::abs(a), portable::abs(a)})
                EXPECT_TRUE(same_bits(of[k], std::copysign(a[k], T{1}))) << a[k];
    });
}
TEST(LaneOperations, SignsAreBits)
{
    check_signs<Float4>(floats());
    check_signs<Float8>(floats());
    check_signs<Double4>(doubles());
}

TEST(LaneOperations, ConversionsRoundAsOneNumberDoes)
{
    const auto whole = [](float x) { return x >= -0x1p31f && x < 0x1p31f ? static_cast<int32_t>(x) : INT32_MIN; };
    for_pairs<Float8>(floats(), [&](Float8 a, Float8) {
        const Float4 four = lower(a);
        expect_both("to_double", native::to_double(four), portable::to_double(four),
                    [&](size_t k) { return double{four[k]}; });
        expect_both("nearest", native::nearest(a), portable::nearest(a),
                    [&](size_t k) { return std::nearbyint(a[k]); });
        expect_both("nearest", native::nearest(four), portable::nearest(four),
                    [&](size_t k) { return std::nearbyint(a[k]); });
        expect_both("truncate", native::truncate(a), portable::truncate(a), [&](size_t k) { return whole(a[k]); });
        expect_both("truncate", native::truncate(four), portable::truncate(four),
                    [&](size_t k) { return whole(four[k]); });
        const Int8 number = reinterpret_cast<Int8>(a);
        expect_lanes("to_float", to_float(number), [&](size_t k) { return static_cast<float>(number[k]); });
        expect_lanes("to_float", to_float(reinterpret_cast<Int4>(lower(a))),
                     [&](size_t k) { return static_cast<float>(number[k]); });
    });
    for_pairs<Double4>(doubles(), [](Double4 a, Double4) {
        expect_lanes("to_float", to_float(a), [&](size_t k) { return static_cast<float>(a[k]); });
        expect_lanes("as_stored", as_stored(a), [&](size_t k) { return double{static_cast<float>(a[k])}; });
    });
}

TEST(LaneOperations, RoundingFollowsTheMode)
{
    for (const int mode : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO, FE_TONEAREST}) {
        std::fesetround(mode);
        for (size_t i = 0; i < floats().size(); ++i) {
            const Float8 a = take<Float8>(floats(), i);
            expect_lanes("nearest", native::nearest(a), [&](size_t k) { return portable::nearest(a)[k]; });
        }
    }
}

TEST(LaneOperations, HalfFloatsAreTheSame)
{
    const auto expect_half = [](float v) {
        EXPECT_EQ(native::half_from_float(v), portable::half_from_float(v)) << v << " " << std::bit_cast<uint32_t>(v);
    };
    for (uint32_t h = 0; h <= UINT16_MAX; ++h) {
        const float v = native::float_from_half(static_cast<uint16_t>(h));
        EXPECT_TRUE(same_bits(v, portable::float_from_half(static_cast<uint16_t>(h)))) << h;
        // It, between it and the next, and about that tie.
        for (const uint32_t more : {0u, 1u, 0xfffu, 0x1000u, 0x1001u, 0x1fffu})
            expect_half(std::bit_cast<float>(std::bit_cast<uint32_t>(v) + more));
    }
    for (const float v : floats()) expect_half(v);
    Random random(5);
    for (int i = 0; i < 100000; ++i) expect_half(std::bit_cast<float>(static_cast<uint32_t>(random.bits() >> 32)));
}

TEST(LaneOperations, MasksChooseBits)
{
    const auto x = take<Float8>(floats(), 0), y = take<Float8>(floats(), 26);
    const auto dx = take<Double4>(doubles(), 0), dy = take<Double4>(doubles(), 26);
    for (uint32_t set = 0; set < 256; ++set) {
        const Mask8 m = lanes_of(set);
        const Mask4f m4 = reinterpret_cast<Mask4f>(lower(reinterpret_cast<Float8>(m)));
        const Mask4 d = Double4{} < Double4{set & 1 ? 1.0 : 0, set & 2 ? 1.0 : 0, set & 4 ? 1.0 : 0, set & 8 ? 1.0 : 0};
        for (const uint32_t of : {native::movemask(m), portable::movemask(m)}) EXPECT_EQ(of, set);
        for (const uint32_t of :
             {native::movemask(m4), portable::movemask(m4), native::movemask(d), portable::movemask(d)})
            EXPECT_EQ(of, set & 15);
        EXPECT_EQ(movemask(narrow(d)), set & 15);
        EXPECT_EQ(movemask(select(d, d, Mask4{})), set & 15);
        for (size_t k = 0; k < float_lanes; ++k) {
            const bool is_set = set >> k & 1;
            EXPECT_EQ(uint32_t(m[k]), is_set ? UINT32_MAX : 0);
            for (const Float8& of : {native::select(m, x, y), portable::select(m, x, y)})
                EXPECT_TRUE(same_bits(of[k], is_set ? x[k] : y[k]));
            if (k >= double_lanes) continue;
            for (const Float4& of : {native::select(m4, lower(x), lower(y)), portable::select(m4, lower(x), lower(y))})
                EXPECT_TRUE(same_bits(of[k], is_set ? x[k] : y[k]));
            for (const Double4& of : {native::select(d, dx, dy), portable::select(d, dx, dy)})
                EXPECT_TRUE(same_bits(of[k], is_set ? dx[k] : dy[k]));
        }
        std::vector<uint32_t> visited;
        for_each_lane(set, [&](uint32_t lane) { visited.push_back(lane); });
        EXPECT_TRUE(std::is_sorted(visited.begin(), visited.end()));
        EXPECT_EQ(visited.size(), static_cast<size_t>(std::popcount(set)));
    }
    for (size_t n = 0; n <= float_lanes; ++n) EXPECT_EQ(movemask(first_lanes(n)), (1u << n) - 1);
}

TEST(LaneOperations, ComparisonsOfNaNAreFalse)
{
    for_pairs<Float8>(floats(), [](Float8 a, Float8 b) {
        for (uint32_t k = 0; k < float_lanes; ++k) {
            EXPECT_EQ(movemask_le(a, b) >> k & 1, uint32_t{a[k] <= b[k]});
            EXPECT_EQ(movemask_eq(a, b) >> k & 1, uint32_t{a[k] == b[k]});
            EXPECT_TRUE(same(float{larger(a, b)[k]}, std::max<float>(a[k], b[k]))) << a[k] << " " << b[k];
            EXPECT_TRUE(same(float{smaller(a, b)[k]}, std::min<float>(a[k], b[k]))) << a[k] << " " << b[k];
        }
        for (uint32_t k = 0; k < 4; ++k) EXPECT_EQ(sign_bits(lower(a)) >> k & 1, uint32_t{std::signbit(a[k])});
    });
    alignas(32) const std::array<uint32_t, 8> numbers{5, 0, 5, UINT32_MAX, 6, 5, 1u << 31, 5};
    EXPECT_EQ(movemask_eq(numbers, 5u), 0b10100101u);
}

TEST(LaneOperations, WholeNumbers)
{
    const std::vector<int32_t> x{0, 1, -1, INT32_MIN, INT32_MAX, 7, -8};
    for_pairs<Int4>(x, [](Int4 a, Int4 b) {
        expect_lanes("min", min(a, b), [&](size_t k) { return std::min<int32_t>(a[k], b[k]); });
        expect_lanes("max", max(a, b), [&](size_t k) { return std::max<int32_t>(a[k], b[k]); });
        const UInt4 ua = reinterpret_cast<UInt4>(a), ub = reinterpret_cast<UInt4>(b);
        expect_lanes("min", min(ua, ub), [&](size_t k) { return std::min<uint32_t>(ua[k], ub[k]); });
        expect_both("reverse_bits", native::reverse_bits(ua), portable::reverse_bits(ua),
                    [&](size_t k) { return reverse_bits(uint32_t{ua[k]}); });
    });
    Random random(6);
    for (int round = 0; round < 200; ++round) {
        UInt8 a{};
        for (uint32_t k = 0; k < float_lanes; ++k) a[k] = static_cast<uint32_t>(random.bits() >> 32);
        const auto turned = [](uint32_t one) {
            uint32_t of = 0;
            for (uint32_t i = 0; i < 32; ++i) of |= (one >> i & 1) << (31 - i);
            return of;
        };
        expect_both("reverse_bits", native::reverse_bits(a), portable::reverse_bits(a),
                    [&](size_t k) { return turned(a[k]); });
        const Float8 x8 = take<Float8>(floats(), static_cast<size_t>(round));
        for (uint32_t k = 0; k < float_lanes; ++k) {
            EXPECT_TRUE(same_bits(negated(x8, a)[k], negated(x8[k], a[k])));
            EXPECT_EQ(movemask(is_odd(a)) >> k & 1, a[k] & 1);
        }
        const uint64_t bytes = random.bits();
        expect_both("widen_bytes", native::widen_bytes(bytes), portable::widen_bytes(bytes),
                    [&](size_t k) { return static_cast<uint32_t>(bytes >> 8 * k & 255); });
    }
}

TEST(LaneOperations, LanesChangePlaces)
{
    Float8 x{}, y{};
    for (uint32_t k = 0; k < float_lanes; ++k) {
        x[k] = std::bit_cast<float>(0x7f800100u + k);  // signalling NaN: bits are moved alone
        y[k] = std::bit_cast<float>(0xff800200u + k);
    }
    const auto expect_order = [&](const char* what, auto of, const std::vector<size_t>& from) {
        for (size_t k = 0; k < from.size(); ++k)
            EXPECT_TRUE(same_bits(of[k], from[k] < 8 ? x[from[k]] : y[from[k] - 8])) << what << " " << k;
    };
    for (const Float8& of : {native::concat(lower(x), upper(y)), portable::concat(lower(x), upper(y))})
        expect_order("joined", of, {0, 1, 2, 3, 12, 13, 14, 15});
    for (const Float4& of : {native::lower(x), portable::lower(x)}) expect_order("lower", of, {0, 1, 2, 3});
    for (const Float4& of : {native::upper(x), portable::upper(x)}) expect_order("upper", of, {4, 5, 6, 7});
    const UInt8 from{7, 0, 3, 3, 12, 5, 1, 0xfffffffe};
    for (const Float8& of : {native::permute(x, from), portable::permute(x, from)})
        expect_order("permuted", of, {7, 0, 3, 3, 4, 5, 1, 6});
    for (const UInt8& of :
         {native::permute(reinterpret_cast<UInt8>(x), from), portable::permute(reinterpret_cast<UInt8>(x), from)})
        expect_order("permuted", reinterpret_cast<Float8>(of), {7, 0, 3, 3, 4, 5, 1, 6});
    const UInt4 axes{2, 0, 5, 3};
    for (const Float4& of : {native::permute(lower(x), axes), portable::permute(lower(x), axes)})
        expect_order("permuted", of, {2, 0, 1, 3});
    expect_order("interleave_low", interleave_low(x, y), {0, 8, 1, 9, 4, 12, 5, 13});
    expect_order("interleave_high", interleave_high(x, y), {2, 10, 3, 11, 6, 14, 7, 15});
    expect_order("even_lanes", even_lanes(x, y), {0, 2, 8, 10, 4, 6, 12, 14});
    expect_order("odd_lanes", odd_lanes(x, y), {1, 3, 9, 11, 5, 7, 13, 15});
    expect_order("copy_upper_to_lower", copy_upper_to_lower(lower(x)), {2, 3, 2, 3});
    const Double4 d{1, 2, 3, 4}, one{0, 1, 2, 3}, two{0, 0, 1, 2};
    EXPECT_EQ(movemask(shift_up_1(d) == one), all_bits);
    EXPECT_EQ(movemask(shift_up_2(d) == two), all_bits);
}

TEST(LaneOperations, RowsBecomeColumns)
{
    std::array<Float4, 4> four{};
    std::array<Double4, 4> doubled{};
    std::array<Float8, 4> eight{};
    for (uint32_t i = 0; i < 4; ++i)
        for (uint32_t k = 0; k < float_lanes; ++k) {
            eight[i][k] = static_cast<float>(10 * i + k);
            if (k < 4) four[i][k] = eight[i][k], doubled[i][k] = eight[i][k];
        }
    const auto t4 = transpose4x4(four);
    const auto td = transpose4x4(doubled);
    const auto t8 = transpose4x4(eight);
    for (uint32_t i = 0; i < 4; ++i)
        for (uint32_t k = 0; k < 4; ++k) {
            EXPECT_EQ(t4[i][k], four[k][i]);
            EXPECT_EQ(td[i][k], doubled[k][i]);
            EXPECT_EQ(t8[i][k], eight[k][i]);
            EXPECT_EQ(t8[i][k + 4], eight[k][i + 4]);
        }
}

TEST(LaneOperations, MemoryHoldsTheLanesInOrder)
{
    alignas(32) std::array<float, 17> from{}, to{};
    alignas(32) std::array<uint32_t, 17> numbers{}, put{};
    for (uint32_t i = 0; i < 17; ++i) from[i] = static_cast<float>(i), numbers[i] = i * 0x10001;
    const auto of_from = [&](size_t first) { return [&from, first](size_t k) { return from[first + k]; }; };
    const auto of_numbers = [&](size_t first) { return [&numbers, first](size_t k) { return numbers[first + k]; }; };
    expect_lanes("load4_aligned", load4_aligned(&from[4]), of_from(4));
    expect_lanes("load4_aligned", load4_aligned(&numbers[4]), of_numbers(4));
    expect_lanes("load4", load4(&from[3]), of_from(3));
    expect_lanes("load8", load8(&from[8]), of_from(8));
    expect_lanes("load8", load8(&numbers[8]), of_numbers(8));
    expect_lanes("load8_anywhere", load8_anywhere(&from[5]), of_from(5));
    expect_lanes("load8_anywhere", load8_anywhere(&numbers[5]), of_numbers(5));
    expect_lanes("load2x2", load2x2(&from[1], &from[9]), [&](size_t k) { return from[k < 2 ? 1 + k : 7 + k]; });
    const std::array<double, 5> doubles{0, 1, 2, 3, 4};
    expect_lanes("load4", load4(&doubles[1]), [](size_t k) { return 1.0 + static_cast<double>(k); });
    // What is stored stands there, and nothing else is changed.
    const auto expect_stored = [&](auto& where, const auto& source, size_t first, size_t n, const auto& store) {
        where.fill(99);
        store();
        for (size_t i = 0; i < where.size(); ++i)
            EXPECT_EQ(where[i], i - first < n ? source[i] : 99) << first << " " << i;
    };
    expect_stored(to, from, 4, 4, [&] { store4_aligned(&to[4], load4(&from[4])); });
    expect_stored(to, from, 3, 4, [&] { store4(&to[3], load4(&from[3])); });
    expect_stored(to, from, 8, 8, [&] { store8(&to[8], load8(&from[8])); });
    expect_stored(to, from, 7, 8, [&] { store8_anywhere(&to[7], load8_anywhere(&from[7])); });
    expect_stored(put, numbers, 4, 4, [&] { store4_aligned(&put[4], load4_aligned(&numbers[4])); });
    expect_stored(put, numbers, 8, 8, [&] { store8(&put[8], load8(&numbers[8])); });
    expect_stored(put, numbers, 7, 8, [&] { store8_anywhere(&put[7], load8_anywhere(&numbers[7])); });
    std::array<int32_t, 5> whole{};
    store4(&whole[1], Int4{-1, 2, -3, 4});
    EXPECT_EQ(whole, (std::array<int32_t, 5>{0, -1, 2, -3, 4}));
    const UInt8 at{16, 0, 3, 3, 12, 5, 1, 7};
    expect_both("gather", native::gather(numbers.data(), at), portable::gather(numbers.data(), at),
                [&](size_t k) { return numbers[at[k]]; });
    expect_lanes("together", from_array({0, 1, 2, 3, 4, 5, 6, 7}), [](size_t k) { return static_cast<uint32_t>(k); });
    native::prefetch(&from), portable::prefetch(&from);
}

TEST(LaneOperations, DenormalsAreZeroWhereThatIsSet)
{
    const uint64_t mode = float_mode();
    const volatile float tiny = std::numeric_limits<float>::min();
    set_float_mode(mode & ~flush_bits);
    EXPECT_FALSE(flushes_denormals());
    EXPECT_NE(tiny * 0.5f, 0);
    set_flush_denormals();
    EXPECT_TRUE(flushes_denormals());
    EXPECT_EQ(tiny * 0.5f, 0);
    set_float_mode(mode);
}

}  // namespace
}  // namespace lancer
