// Tables that hold more than they take room for: each answers as the plain one does.
#include <gtest/gtest.h>

#include <random>

#include "core/compact_index_array.h"
#include "core/lanes/row_table.h"
#include "core/ranked_bitset.h"

namespace lancer {
namespace {

TEST(CompactIndexArray, AreThoseThatWerePutIn)
{
    std::mt19937 random(7);
    for (const auto& [largest, width] : {std::pair{0u, 1u},
                                         {1u, 1u},
                                         {255u, 1u},
                                         {256u, 2u},
                                         {65535u, 2u},
                                         {65536u, 4u},
                                         {UINT32_MAX - 1, 4u},
                                         {UINT32_MAX, 4u}})
        for (const size_t count : {1, 2, 3, 5, 64, 1000}) {
            std::vector<uint32_t> numbers(count);
            for (uint32_t& n : numbers) n = std::uniform_int_distribution<uint32_t>(0, largest)(random);
            for (const size_t at : {size_t{0}, count / 2, count - 1}) {
                numbers[at] = largest;
                const CompactIndexArray packed(numbers);
                ASSERT_EQ(packed.size(), count);
                EXPECT_EQ(packed.bytes(), count * width + 4 - width) << "but for what is read past the end";
                for (size_t i = 0; i < count; ++i) ASSERT_EQ(packed[i], numbers[i]) << largest << ' ' << i;
                EXPECT_TRUE(packed.any([l = largest](uint32_t n) { return n == l; }));
                EXPECT_FALSE(packed.any([l = largest](uint32_t n) { return n > l; }));
            }
        }
}

TEST(CompactIndexArray, OfNothingTakeNothing)
{
    const CompactIndexArray none = CompactIndexArray(std::vector<uint32_t>());
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.bytes(), 0u);
    EXPECT_FALSE(none.any([](uint32_t) { return true; }));
}

// Few records are looked up otherwise than many.
TEST(RowTable, GivesTheRowsThatWerePutIn)
{
    std::mt19937 random(9);
    for (const uint32_t count : {1, 2, 7, 8, 9, 100}) {
        std::vector<RowTable<3>::Record> records(count);
        for (auto& record : records)
            for (Row& row : record) {
                const auto number = [&] { return std::uniform_real_distribution<float>(-1, 1)(random); };
                row.x = number(), row.y = number(), row.z = number(), row.w = number();
            }
        const RowTable<3> table(records);
        for (int repetition = 0; repetition < 100; ++repetition) {
            UInt8 numbers{};
            for (uint32_t i = 0; i < float_lanes; ++i)
                numbers[i] = std::uniform_int_distribution<uint32_t>(0, count - 1)(random);
            for (size_t row = 0; row < 3; ++row) {
                const RowLanes found = table.at(numbers, row);
                for (size_t i = 0; i < float_lanes; ++i) {
                    const Row& wanted = records[numbers[i]][row];
                    ASSERT_EQ(lane(found.xyz, i), (Vec3{wanted.x, wanted.y, wanted.z})) << count << ' ' << row;
                    ASSERT_EQ(found.w[i], wanted.w) << count << ' ' << row;
                }
            }
        }
    }
    EXPECT_TRUE(RowTable<3>().empty());
}

TEST(RankedBitset, CountThoseBeforeEach)
{
    std::mt19937 random(8);
    for (const uint32_t count : {1, 63, 64, 65, 128, 1000})
        for (const double part : {0.0, 0.02, 0.5, 1.0}) {
            std::vector<bool> marked(count);
            for (uint32_t i = 0; i < count; ++i) marked[i] = std::bernoulli_distribution(part)(random);
            const RankedBitset marks(count, [&](uint32_t i) { return marked[i]; });
            uint32_t before = 0;
            for (uint32_t i = 0; i < count; ++i) {
                ASSERT_EQ(marks.has(i), marked[i]) << count << ' ' << i;
                ASSERT_EQ(marks.before(i), before) << count << ' ' << i;
                before += marked[i];
            }
            EXPECT_EQ(marks.marked(), before);
            EXPECT_FALSE(marks.empty());
            EXPECT_EQ(marks.bytes(), 16 * (count / 64 + 1));
        }
    EXPECT_TRUE(RankedBitset().empty());
    EXPECT_EQ(RankedBitset().bytes(), 0u);
}

}  // namespace
}  // namespace lancer
