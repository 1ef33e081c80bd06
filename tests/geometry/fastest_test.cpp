// Which accelerator is chosen where none is named, and what that is chosen by.
#include <gtest/gtest.h>

#include "geometry/box_overlap.h"
#include "geometry/list/list8.h"
#include "geometry/trees.h"

namespace lancer {
namespace {

// Of a grid in a plane of two axes.
Mesh flat(uint32_t triangles)
{
    Mesh mesh;
    for (uint32_t i = 0; i < triangles; ++i) {
        const auto x = static_cast<float>(i);
        for (const Vec3 p : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x, 1, 0}}) mesh.positions.push_back(p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.positions.emplace_back();
    return mesh;
}
// From corner to corner of a box of these sides, all but as thin as a line.
Mesh slivers(uint32_t triangles, Vec3 sides)
{
    Mesh mesh;
    for (uint32_t i = 0; i < triangles; ++i) {
        const auto corner = static_cast<uint32_t>(mesh.positions.size());
        for (const Vec3 p : {Vec3{}, sides, Vec3{0, 0, sides.z * 1e-5f}}) mesh.positions.push_back(p);
        mesh.triangles.push_back({corner, corner + 1, corner + 2});
    }
    mesh.positions.emplace_back();
    return mesh;
}

TEST(FastestAccelerator, IsAListOfFewTrianglesAndElseEmbree)
{
    EXPECT_EQ(fastest_accelerator(of_mesh(flat(64))), AccelKind::list8);
    EXPECT_EQ(fastest_accelerator(of_mesh(flat(65))), AccelKind::embree);
    Geometry two = of_mesh(flat(32));
    two.meshes.push_back(flat(33));
    EXPECT_EQ(fastest_accelerator(two), AccelKind::embree);
    Geometry with_sphere = of_mesh(flat(2)), with_plane = with_sphere, with_instance = with_sphere;
    with_sphere.spheres.emplace_back();
    EXPECT_EQ(fastest_accelerator(with_sphere), AccelKind::embree);
    with_plane.planes.emplace_back();
    EXPECT_EQ(fastest_accelerator(with_plane), AccelKind::embree);
    with_instance.meshes[0].instanced = true;
    with_instance.instances.push_back(make_instance(0, make_transform({}, {}, {1, 1, 1})));
    EXPECT_EQ(fastest_accelerator(with_instance), AccelKind::embree);
    // And that is what one gets.
    EXPECT_EQ(make_accelerator(AccelKind::automatic, of_mesh(flat(64)), "avx2")->stats().sah_cost, 64);
}

TEST(FastestAccelerator, CutsTrianglesWhoseBoxesAreInTheWay)
{
    EXPECT_EQ(fastest_accelerator(of_mesh(slivers(64, {1, 1, 1}))), AccelKind::list8);
    Geometry many = of_mesh(slivers(65, {1, 1, 1}));
    EXPECT_EQ(fastest_accelerator(many), AccelKind::bvh8);
    many.spheres.emplace_back();
    EXPECT_EQ(fastest_accelerator(many), AccelKind::bvh8);
    EXPECT_EQ(fastest_accelerator(of_mesh(slivers(500'000, {1, 1, 1}))), AccelKind::bvh8);
    EXPECT_EQ(fastest_accelerator(of_mesh(slivers(500'001, {1, 1, 1}))), AccelKind::embree);
    many.meshes.push_back(flat(1));
    many.meshes[1].instanced = true;
    many.instances.push_back(make_instance(1, make_transform({}, {}, {1, 1, 1})));
    EXPECT_EQ(fastest_accelerator(many), AccelKind::embree);
}

TEST(FastestAccelerator, SpendsLittleOnEachOfAMillionInstances)
{
    Geometry forest = of_mesh(flat(65));
    forest.meshes[0].instanced = true;
    forest.instances.assign(999'999, make_instance(0, make_transform({}, {}, {1, 1, 1})));
    EXPECT_EQ(fastest_accelerator(forest), AccelKind::embree);
    forest.instances.push_back(forest.instances[0]);
    EXPECT_EQ(fastest_accelerator(forest), AccelKind::bvh8);
    forest.meshes.push_back(flat(4'000'001));
    EXPECT_EQ(fastest_accelerator(forest), AccelKind::embree);
}

TEST(FastestAccelerator, DoesNotWaitForTheTrianglesOfALargeScan)
{
    const auto bounces = [](const Geometry& g) { return fastest_accelerator(g, RayUse::bounces); };
    EXPECT_EQ(bounces(of_mesh(flat(999'999))), AccelKind::embree);
    const Geometry scan = of_mesh(flat(1'000'000));
    EXPECT_EQ(bounces(scan), AccelKind::bvh8);
    EXPECT_EQ(fastest_accelerator(scan), AccelKind::embree) << "many rays ask whether a light is seen";
    EXPECT_EQ(bounces(of_mesh(flat(4'000'001))), AccelKind::embree);
    Geometry loose = scan;
    loose.meshes.push_back(slivers(1, {1e6f, 1, 1}));
    EXPECT_GT(false_positive_box_hits(loose), 0.25);
    EXPECT_EQ(bounces(loose), AccelKind::embree);
    EXPECT_EQ(bounces(of_mesh(flat(64))), AccelKind::list8);
}

TEST(BoxesMetInVain, AreThoseOfTrianglesThatDoNotFillTheirs)
{
    EXPECT_EQ(false_positive_box_hits({}), 0);
    EXPECT_EQ(false_positive_box_hits(of_mesh(flat(100))), 0);
    for (const Vec3 sides : {Vec3{1, 1, 1}, Vec3{3, 2, 5}, Vec3{1e-6f, 1e-6f, 1e-6f}, Vec3{1e6f, 2e6f, 1e6f}})
        for (const uint32_t count : {1u, 7u, 70'000u})
            EXPECT_NEAR(false_positive_box_hits(of_mesh(slivers(count, sides))), count, 1e-4 * count);
    // Half as long, in the same room: a quarter.
    Geometry part = of_mesh(slivers(8, {1, 1, 1}));
    part.meshes.push_back(flat(0));
    part.meshes[1].positions = {{2, 2, 2}, {2, 2, 2}, {2, 2, 2}};
    part.meshes[1].triangles = {{0, 1, 2}};
    EXPECT_NEAR(false_positive_box_hits(part), 2, 1e-3);
    // What no ray can meet is in nobody's way.
    part.meshes[1].positions[1].x = std::numeric_limits<float>::infinity();
    EXPECT_NEAR(false_positive_box_hits(part), 8, 1e-3);
    part.meshes[0].instanced = true;
    EXPECT_EQ(false_positive_box_hits(part), 0);
}

}  // namespace
}  // namespace lancer
