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

}  // namespace
}  // namespace lancer
