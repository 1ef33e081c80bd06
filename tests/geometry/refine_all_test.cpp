// Batches in lanes give the bits that single rays give.
#include "geometry/refine_all.h"

#include <cstring>

#include "geometry/accelerators.h"
#include "geometry/ray_lanes.h"

namespace lancer {
namespace {

// Many kinds of hits after each other, and misses between them; every third ray goes along axes or between two.
TEST(RefineAll, GivesTheBitsOfRefine)
{
    const Geometry g = random_geometry(21);
    const auto list = make_accelerator(AccelKind::list, g, "avx2");
    Random random(22);
    std::vector<Ray> rays;
    std::vector<Hit> found;
    std::array<int, 5> met{};
    for (int i = 0; i < 5000; ++i) {
        Vec3 dir = random.unit_vector();
        if (i % 3 == 0) dir.x = 0;
        if (i % 6 == 0) dir.y = 0;
        if (i % 7 == 0) dir.y = dir.x;
        rays.push_back({.org = to_float(random.point(-3, 3)), .dir = normalize(dir)});
        Hit hit = list->closest(rays.back());
        ++met[hit.instance != Hit::no_instance ? 4 : static_cast<size_t>(hit.kind)];
        // As an accelerator has it that computes in float; of a triangle that is seen from its edge this is what stays.
        if (hit.kind == Kind::triangle) hit.t *= 1.0001f, hit.uv = {9, 9};
        found.push_back(hit);
    }
    for (const int count : met) EXPECT_GT(count, 100);
    // Exactly from its edge, and from a place within its plane.
    Geometry flat;
    flat.meshes.push_back({.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {}}, .triangles = {{0, 1, 2}}});
    const Ray along{.org = {-1, 0.25f, 0}, .dir = {1, 0, 0}};
    for (const auto& [geometry, all] : {std::pair(&g, std::span<const Ray>(rays)), {&flat, {&along, 1}}}) {
        std::vector<Hit> hits = found;
        if (geometry == &flat) hits = {{1.5f, Hit::no_instance, 0, 0, {9, 9}, Kind::triangle}};
        for (const size_t batch : {size_t{1}, size_t{7}, size_t{256}}) {
            std::vector<Hit> refined = hits;
            for (size_t i = 0; i < all.size(); i += batch) {
                const size_t n = std::min(batch, all.size() - i);
                refine_all(*geometry, all.subspan(i, n), std::span(refined).subspan(i, n));
            }
            for (size_t i = 0; i < all.size(); ++i) {
                const Hit one = hits[i] ? refine(*geometry, all[i], hits[i]) : hits[i];
                ASSERT_EQ(std::bit_cast<uint32_t>(refined[i].t), std::bit_cast<uint32_t>(one.t)) << i;
                ASSERT_EQ(std::bit_cast<uint32_t>(refined[i].uv.x), std::bit_cast<uint32_t>(one.uv.x)) << i;
                ASSERT_EQ(std::bit_cast<uint32_t>(refined[i].uv.y), std::bit_cast<uint32_t>(one.uv.y)) << i;
            }
        }
    }
}

TEST(RayPacket, HoldsTheNumbersOfEightRaysAndTheirVerdicts)
{
    constexpr float inf = std::numeric_limits<float>::infinity();
    const std::array values{0.0f, -0.0f, 1.0f, -1.7e18f, 1.8e18f, -1e30f, inf, -inf, NAN, 1e-40f};
    Random random(23);
    const auto value = [&] { return values[random.below(3) ? random.below(4) : random.below(values.size())]; };
    int traceable = 0;
    for (int i = 0; i < 4000; ++i) {
        std::vector<Ray> rays(1 + random.below(8));
        for (Ray& r : rays) r = {{value(), value(), value()}, std::abs(value()), {value(), value(), value()}, value()};
        if (i % 2)
            for (Ray& r : rays) r.t_max = inf;
        const RayPacket packet(rays);
        const uint32_t verdicts = movemask(is_traceable(packet));
        for (size_t k = 0; k < 8; ++k) {
            const Ray& r = rays[std::min(k, rays.size() - 1)];
            ASSERT_EQ(verdicts >> k & 1, is_traceable(r) ? 1u : 0u) << i << " " << k;
            traceable += is_traceable(r) ? 1 : 0;
            const std::array lane{packet.org.x[k], packet.org.y[k], packet.org.z[k], packet.t_min[k],
                                  packet.dir.x[k], packet.dir.y[k], packet.dir.z[k], packet.t_max[k]};
            ASSERT_EQ(std::memcmp(lane.data(), &r, sizeof lane), 0) << i << " " << k;
        }
    }
    EXPECT_GT(traceable, 2000);
    EXPECT_LT(traceable, 30000);
}

TEST(AxisOrder, IsThatOfTheLargestAxis)
{
    for (const float x : {0.0f, 1.0f, -1.0f, 0.5f, -2.0f})
        for (const float y : {0.0f, 1.0f, -1.0f, 0.5f, -2.0f})
            for (const float z : {0.0f, 1.0f, -1.0f, 0.5f, -2.0f}) {
                const auto& axes = axis_order({x, y, z}).axes;
                const auto largest = static_cast<uint32_t>(largest_axis(Vec3{x, y, z}));
                EXPECT_EQ(axes[2], largest) << x << " " << y << " " << z;
                EXPECT_EQ(axes[0], (largest + 1) % 3);
                EXPECT_EQ(axes[1], (largest + 2) % 3);
            }
}

}  // namespace
}  // namespace lancer
