// Hashes of names as Cryptomatte wants them.
#include "render/mattes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace lancer {
namespace {

// Known answers of MurmurHash3_x86_32 with seed 0: of its tail of 0, 1, 2, 3 bytes.
TEST(Mattes, HashIsMurmur3)
{
    EXPECT_EQ(murmur_hash(""), 0u);
    EXPECT_EQ(murmur_hash("test"), 0xba6bd213u);
    EXPECT_EQ(murmur_hash("Hello, world!"), 0xc0363e43u);
    EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Mattes, IdsAreOrdinaryFloats)
{
    for (int i = 0; i < 20000; ++i)
        EXPECT_TRUE(std::isnormal(std::bit_cast<float>(matte_id("object " + std::to_string(i)))));
    EXPECT_NE(matte_id(""), 0u);
}

TEST(Mattes, CountByName)
{
    std::array<Matte, 3> places{};
    for (const uint32_t id : {7u, 9u, 7u, 5u, 4u, 7u}) count_matte(places, id);
    EXPECT_EQ(places[0].id, 7u);
    EXPECT_EQ(places[0].n, 3u);
    EXPECT_EQ(places[2].id, 5u);
    EXPECT_EQ(places[2].n, 1u);
}

TEST(Mattes, NamesAreTextOfJson)
{
    Scene scene;
    scene.material_names = {"a\"b\\c\n", "wood"};
    const auto attributes = attributes_of(matte_manifests(scene));
    ASSERT_EQ(attributes.size(), 8u);
    EXPECT_EQ(attributes[3].second, "{}");
    const std::string id = "\\u000a\":\"";
    EXPECT_EQ(attributes[7].second.find("{\"a\\\"b\\\\c" + id), 0u) << attributes[7].second;
    EXPECT_EQ(attributes[7].first.substr(0, 12), "cryptomatte/");
    EXPECT_EQ(attributes[7].first.substr(19), "/manifest");
}

}  // namespace
}  // namespace lancer
