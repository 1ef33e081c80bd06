#include <gtest/gtest.h>

#include "reference/reference.h"
#include "support/scenes.h"

TEST(Reference, Runs)
{
    const auto p = reference::render(lancer::cornell_scene(), {});
    EXPECT_GT(reference::luminance(p.at(3, 3)), 0);
}
