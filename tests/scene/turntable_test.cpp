// A camera that circles a scene.
#include "scene/view/turntable.h"

#include <gtest/gtest.h>

namespace lancer {
namespace {

CameraDescription camera()
{
    CameraDescription c;
    c.position = {3, 2, 5}, c.target = {1, 0.5, 1}, c.up = {0.1, 1, 0};
    return c;
}

TEST(Turntable, TheFirstViewIsTheCamerasOwn)
{
    const CameraDescription own = camera(), turned_by_none = turned(own, {1, 2, 3}, {0, 1, 0}, 0);
    EXPECT_EQ(turned_by_none.position, own.position);
    EXPECT_EQ(turned_by_none.target, own.target);
    EXPECT_EQ(turned_by_none.up, own.up);
}

TEST(Turntable, AQuarterTurnIsExactAndCounterClockwise)
{
    const CameraDescription c = turned(camera(), {1, 0, 1}, {0, 1, 0}, 0.25);
    EXPECT_EQ(c.position, (Vec3d{5, 2, -1}));  // (2, 2, 4) about the axis is (4, 2, -2)
    EXPECT_EQ(c.target, (Vec3d{1, 0.5, 1}));   // on the axis
    EXPECT_EQ(c.up, (Vec3d{0, 1, -0.1}));
}

// Whatever the axis: distances to it and heights along it stay, as do the distance and angle of the view.
TEST(Turntable, TurnsAboutAnyAxis)
{
    const Vec3d up = normalize(Vec3d{1, 2, -0.5}), center{0.3, -2, 1};
    const CameraDescription own = camera();
    const auto height = [&](Vec3d p) { return dot(p - center, up); };
    const auto radius = [&](Vec3d p) { return length(cross(p - center, up)); };
    for (int i = 1; i < 12; ++i) {
        const CameraDescription c = turned(own, center, up, i / 12.0);
        EXPECT_NEAR(height(c.position), height(own.position), 1e-12);
        EXPECT_NEAR(radius(c.position), radius(own.position), 1e-12);
        EXPECT_NEAR(length(c.target - c.position), length(own.target - own.position), 1e-12);
        EXPECT_NEAR(dot(c.target - c.position, c.up), dot(own.target - own.position, own.up), 1e-12);
        const Vec3d before = cross(up, own.position - center), now = c.position - center;
        EXPECT_NEAR(std::remainder(std::atan2(dot(now, before), dot(now, cross(before, up))) - i * pi_d / 6, 2 * pi_d),
                    0, 1e-12);
    }
}

}  // namespace
}  // namespace lancer
