// Where tables of albedos have values.
#include "materials/albedo_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random.h"

namespace lancer {
namespace {

// Between the two nodes that a cosine is said to lie the table is linear in it; nodes ascend, and no cosine lies
// outside of its own.
TEST(AlbedoNodes, HoldTheCosinesBetweenThem)
{
    Random random(1);
    for (const float edge : {0.0f, 1e-3f, 0.2f, 0.714f, 0.99f}) {
        for (uint32_t i = 0; i + 1 < cosines_of(edge); ++i)
            EXPECT_LE(cosine_node(edge, i), cosine_node(edge, i + 1)) << edge << ' ' << i;
        EXPECT_EQ(cosine_node(edge, cosines_of(edge) - 1), 1) << edge;
        std::vector<float> some{1, edge, std::nextafter(edge, 0.0f), std::nextafter(edge, 1.0f), 0.5f * edge};
        for (int i = 0; i < 1000; ++i) {
            some.push_back(random.unit());
            some.push_back(std::clamp(edge + 1e-3f * (random.unit() - 0.5f), 0.0f, 1.0f));
        }
        for (const float cos : some) {
            const NodeCell c = cosine_cell(edge, cos);
            ASSERT_LT(c.index + 1, cosines_of(edge));
            if (cos < cosine_node(edge, 0)) continue;
            const float low = cosine_node(edge, c.index), high = cosine_node(edge, c.index + 1);
            EXPECT_NEAR(low + c.part * (high - low), cos, 1e-6f) << edge << ' ' << cos;
        }
    }
}

}  // namespace
}  // namespace lancer
