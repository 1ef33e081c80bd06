#include <cmath>
#include <cstdio>

#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;

// Polygons, as seen by a whole load: the area is that of the outline and every triangle faces its way.
class Polygon : public ObjTest {
protected:
    struct Result {
        size_t triangles = 0;
        double area = 0, smallest = 0;  // signed, along z
    };
    Result polygon(const std::vector<Vec3d>& outline)
    {
        std::string text;
        char line[200];
        for (const Vec3d& p : outline) {
            std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
            text += line;
        }
        text += "f";
        for (size_t i = 1; i <= outline.size(); ++i) text += " " + std::to_string(i);
        const auto m = load(text + "\n");
        EXPECT_TRUE(m) << errors();
        Result r;
        if (!m) return r;
        r.triangles = m->triangles.size();
        r.smallest = 1e300;
        for (const Triangle& t : m->triangles) {
            const Vec3d a = m->positions[t[0]], b = m->positions[t[1]], c = m->positions[t[2]];
            const double area = cross(b - a, c - a).z / 2;
            r.area += area;
            r.smallest = std::min(r.smallest, area);
        }
        return r;
    }
    static std::vector<Vec3d> star(size_t n, double inner, Vec3d center = {})
    {
        std::vector<Vec3d> p;
        for (size_t i = 0; i < n; ++i) {
            const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i) / static_cast<double>(n);
            const double r = i % 2 ? inner : 1;
            p.push_back(center + Vec3d{r * std::cos(angle), r * std::sin(angle), 0});
        }
        return p;
    }
    static double shoelace(const std::vector<Vec3d>& p)
    {
        double a = 0;
        for (size_t i = 2; i < p.size(); ++i) a += cross(p[i - 1] - p[0], p[i] - p[0]).z / 2;
        return a;
    }
};

TEST_F(Polygon, QuadsAreSplitAlongTheDiagonalInside)
{
    EXPECT_THAT(load(square + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    // An arrow with its notch at the second corner, then at the first.
    const std::string arrow = "v 0 0 0\nv 0.2 0.2 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(load(arrow + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
    EXPECT_THAT(load(arrow + "f 2 3 4 1\n")->triangles, ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 0}));
    EXPECT_THAT(load(arrow + "f 4 3 2 1\n")->triangles, ElementsAre(Triangle{3, 2, 1}, Triangle{3, 1, 0}));
    // A corner on a straight edge.
    const std::string straight = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\n";
    EXPECT_THAT(load(straight + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
    EXPECT_THAT(load(square + "f 1 2 2 3\n")->triangles, ElementsAre(Triangle{0, 1, 2}));
}

// Where both diagonals lie inside, along the shorter; along the first where they are as long.
TEST_F(Polygon, QuadsAreSplitAlongTheShorterDiagonal)
{
    const std::string kite = "v 0 0 0\nv 1 -0.3 0.1\nv 2 0 0\nv 1 0.3 0.1\n";
    EXPECT_THAT(load(kite + "f 1 2 3 4\n")->triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
    EXPECT_THAT(load(kite + "f 2 3 4 1\n")->triangles, ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 0}));
}

TEST_F(Polygon, ConcavePolygonsKeepTheirArea)
{
    for (const size_t n : {5u, 6u, 16u, 255u, 256u, 257u, 300u, 512u, 10'000u})
        for (const double inner : {1.0, 0.3}) {
            const auto outline = star(n, inner);
            const Result r = polygon(outline);
            EXPECT_EQ(r.triangles, n - 2) << n;
            EXPECT_NEAR(r.area, shoelace(outline), 1e-9) << n;
            EXPECT_GT(r.smallest, 0) << n << ' ' << inner;
        }
    const std::vector<Vec3d> comb{{0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {8, 1, 0}, {7, 5, 0}, {6, 1, 0}, {5, 5, 0},
                                  {4, 1, 0}, {3, 5, 0}, {2, 1, 0}, {1, 5, 0}, {1, 1, 0}, {0, 1, 0}};
    Result r = polygon(comb);
    EXPECT_NEAR(r.area, shoelace(comb), 1e-12);
    EXPECT_GT(r.smallest, 0);
    // A square with a square hole, joined by a bridge that is run along twice.
    const std::vector<Vec3d> hole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                  {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    r = polygon(hole);
    EXPECT_NEAR(r.area, 8, 1e-12);
    EXPECT_GT(r.smallest, 0);
    r = polygon(star(50, 0.4, {100000, -50000, 7}));
    EXPECT_NEAR(r.area, shoelace(star(50, 0.4)), 1e-8);
    std::vector<Vec3d> tiny = star(50, 0.4);
    for (Vec3d& p : tiny) p *= 1e-200;
    EXPECT_EQ(polygon(tiny).triangles, 48u);
}

TEST_F(Polygon, HugeAndSelfCrossingPolygonsEnd)
{
    const auto big = star(70'000, 0.5);
    const Result r = polygon(big);
    EXPECT_EQ(r.triangles, big.size() - 2);
    EXPECT_NEAR(r.area, shoelace(big), 1e-6);
    std::vector<Vec3d> teeth{{0, 0, 0}, {0, -25'000, 0}};
    for (int i = 24'999; i > 0; --i) {
        teeth.push_back({100, -i - 0.5, 0});
        teeth.push_back({1, -i * 1.0, 0});
    }
    std::reverse(teeth.begin(), teeth.end());
    const Result comb = polygon(teeth);
    EXPECT_EQ(comb.triangles, teeth.size() - 2);
    EXPECT_NEAR(comb.area / shoelace(teeth), 1, 1e-9);
    std::vector<Vec3d> pentagram, tangle;
    for (int i = 0; i < 5; ++i) pentagram.push_back(star(5, 1)[static_cast<size_t>(2 * i % 5)]);
    EXPECT_LE(polygon(pentagram).triangles, 3u);
    for (size_t i = 0; i < 2000; ++i) tangle.push_back(star(2000, 0.7)[i * 617 % 2000]);
    EXPECT_LE(polygon(tangle).triangles, 1998u);
    EXPECT_EQ(error_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 0 0\nf 1 2 3 4 5 6\n"),
              "a.obj: error: no face has an area");
}

}  // namespace
}  // namespace lancer
