// That list8 finds what is there, in batches as singly, the laws of all accelerators show.
#include "geometry/list/list8.h"

#include <gtest/gtest.h>

#include "geometry/trees.h"

namespace lancer {
namespace {

// A part of the list ends in the middle of it, and the last octet of rays is not full.
TEST(List8, AnswersAnyNumberOfRaysAboutAnyNumberOfTriangles)
{
    for (const uint32_t triangles : {1u, 63u, 64u, 65u, 200u}) {
        const Geometry g = of_mesh(tangle(1, triangles));
        const auto list8 = make_accelerator(AccelKind::list8, g, ""), list = make_accelerator(AccelKind::list, g, "");
        Random random(triangles);
        for (const size_t count : {1u, 7u, 8u, 9u, 600u, 1025u}) {
            std::vector<Ray> rays(count);
            for (Ray& ray : rays) ray.org = to_float(random.point(-2, 2)), ray.dir = to_float(random.direction());
            std::vector<Hit> hits(count), expected(count);
            std::vector<uint8_t> occluded(count, 2);
            list8->closest(rays, hits, Coherence::incoherent);
            list8->any(rays, occluded);
            for (size_t i = 0; i < count; ++i) {
                const Hit h = list->closest(rays[i]);
                EXPECT_EQ(hits[i].kind, h.kind) << triangles << ' ' << count << ' ' << i;
                EXPECT_EQ(hits[i].primitive, h.primitive) << triangles << ' ' << count << ' ' << i;
                EXPECT_EQ(hits[i].t, h.t) << triangles << ' ' << count << ' ' << i;
                EXPECT_EQ(occluded[i], h ? 1 : 0) << triangles << ' ' << count << ' ' << i;
            }
        }
    }
}

// Rays between points in a room, on its walls, just beside them and outside of it, that end there or never.
TEST(List8, WallsStopShadowRaysThatReachThem)
{
    constexpr float side = 3;
    Mesh room;
    room.positions = {{0, 0, 0},    {side, 0, 0},    {side, side, 0},    {0, side, 0},
                      {0, 0, side}, {side, 0, side}, {side, side, side}, {0, side, side}};
    // One side is open.
    room.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5},
                      {0, 5, 4}, {3, 2, 6}, {3, 6, 7}, {0, 3, 7}, {0, 7, 4}};
    const Mesh furniture = tangle(1, 8);
    for (const auto& t : furniture.triangles) {
        const auto first = static_cast<uint32_t>(room.positions.size());
        for (const uint32_t corner : t) room.positions.push_back(furniture.positions[corner] * 0.4f + Vec3{1, 1, 1});
        room.triangles.push_back({first, first + 1, first + 2});
    }
    room.positions.emplace_back();
    const Geometry g = of_mesh(room);
    const auto list8 = make_accelerator(AccelKind::list8, g, "");
    Random random(3);
    const auto place = [&] {
        Vec3 p = to_float(random.point(0.01, side - 0.01));
        const float far = random.below(2) == 0 ? 0.0f : side;
        float& along = *std::array{&p.x, &p.y, &p.z}[random.below(3)];
        switch (random.below(6)) {
            case 0:
                along = far;
                break;
            case 1:
                along = std::nextafter(far, 1.0f);
                break;
            case 2:
                along = std::nextafter(far, far == 0 ? -1.0f : 4.0f);
                break;
            case 3:
                along = far == 0 ? -0.5f : 3.5f;
                break;
            default:
                break;
        }
        return p;
    };
    constexpr size_t count = 40000;
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.org = place(), ray.dir = place() - ray.org;
        const float distance = length(ray.dir);
        ray.dir = ray.dir / distance;
        ray.t_max = random.below(8) == 0 ? std::numeric_limits<float>::infinity() : distance;
    }
    std::vector<uint8_t> occluded(count, 2);
    list8->any(rays, occluded);
    size_t stopped = 0;
    for (size_t i = 0; i < count; ++i) {
        const bool expected{list8->closest(rays[i])};
        EXPECT_EQ(occluded[i], expected ? 1 : 0) << i;
        EXPECT_EQ(list8->any(rays[i]), expected) << i;
        stopped += expected;
    }
    EXPECT_GT(stopped, count / 4);
    EXPECT_LT(stopped, count * 3 / 4);
}

}  // namespace
}  // namespace lancer
