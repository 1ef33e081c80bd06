// Which glass is taken for thin sheets, and which never.
#include <gtest/gtest.h>

#include "materials/material.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

MaterialDescription glass(const std::string& name = "glass")
{
    MaterialDescription m = default_description(MaterialType::glass);
    m.name = name;
    return m;
}
SceneDescription of_mesh(std::shared_ptr<const MeshData> data, TransformDescription transform = {})
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(std::move(data), transform));
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}

struct Result {
    size_t thin = 0, absent = 0, left = 0;  // triangles: of thin glass, taken away, other
    std::vector<std::string> notes;
};
Result result_of(const SceneDescription& d)
{
    Diagnostics diagnostics;
    const Scene scene = Scene::build(d, d.render, diagnostics);
    Result r;
    for (size_t m = 0; m < scene.shading.size(); ++m)
        for (uint32_t t = 0; t < scene.geometry.meshes[m].triangles.size(); ++t) {
            const auto& corners = scene.geometry.meshes[m].triangles[t];
            const auto* const g = std::get_if<Glass>(&scene.materials[scene.shading[m].material_of(t)]);
            ++(corners[0] == corners[1] ? r.absent : g && g->thin ? r.thin : r.left);
        }
    for (const Scene::Note& note : scene.sheets) r.notes.push_back(note.text);
    return r;
}
void expect(const std::string& what, const SceneDescription& d, size_t thin, size_t absent, const std::string& note)
{
    const Result r = result_of(d);
    EXPECT_EQ(r.thin, thin) << what;
    EXPECT_EQ(r.absent, absent) << what;
    ASSERT_EQ(r.notes.size(), note.empty() ? 0u : 1u) << what;
    if (!note.empty()) {
        EXPECT_NE(r.notes[0].find(note), std::string::npos) << what << ": " << r.notes[0];
    }
}
void expect_unchanged(const std::string& what, const SceneDescription& d) { expect(what, d, 0, 0, ""); }

// In the plane z = 0, its front towards +z, or turned round; split along either diagonal.
const std::vector<Vec3d> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
Triangles face(bool turned, bool other_diagonal, uint32_t first = 0)
{
    Triangles t = other_diagonal ? Triangles{{0, 1, 3}, {1, 2, 3}} : Triangles{{0, 1, 2}, {0, 2, 3}};
    for (auto& corners : t) {
        if (turned) std::swap(corners[1], corners[2]);
        for (uint32_t& c : corners) c += first;
    }
    return t;
}
Triangles joined(std::initializer_list<Triangles> all)
{
    Triangles sum;
    for (const Triangles& t : all) sum.insert(sum.end(), t.begin(), t.end());
    return sum;
}
// Each face with corners of its own, as exporters write them.
std::shared_ptr<const MeshData> with_own_corners(const MeshData& data, MaterialDescription m)
{
    std::vector<Vec3d> p;
    Triangles t;
    for (const auto& corners : data.triangles) {
        const auto at = static_cast<uint32_t>(p.size());
        for (const uint32_t c : corners) p.push_back(data.positions[c]);
        t.push_back({at, at + 1, at + 2});
    }
    return make_mesh_data(std::move(p), std::move(t), std::move(m));
}
std::shared_ptr<const MeshData> box(Vec3d size, MaterialDescription m)
{
    std::vector<Vec3d> p = make_cube()->positions;
    for (Vec3d& v : p) v = {v.x * size.x / 2, v.y * size.y / 2, v.z * size.z / 2};
    return make_mesh_data(std::move(p), make_cube()->triangles, std::move(m));
}
Triangles turned_round(Triangles t)
{
    for (auto& corners : t) std::swap(corners[1], corners[2]);
    return t;
}

TEST(Sheets, ThatBoundNothingAreThin)
{
    expect("a quad", of_mesh(make_mesh_data(square, face(false, false), glass())), 2, 0, "1 sheet of glass 'glass'");
    const MeshData bowl = *make_uv_sphere(12, 24);
    Triangles half(bowl.triangles.begin(),
                   bowl.triangles.begin() + static_cast<std::ptrdiff_t>(bowl.triangles.size() / 2));
    const size_t n = half.size();
    expect("half a ball", of_mesh(make_mesh_data(bowl.positions, half, glass())), n, 0, "bounds no volume");
    Triangles cube = make_cube()->triangles;
    std::swap(cube[0][1], cube[0][2]);
    expect("a cube, a triangle turned", of_mesh(make_mesh_data(make_cube()->positions, cube, glass())), 12, 0,
           "bounds no volume");
}

TEST(Sheets, GivenSeveralTimesCountOnce)
{
    for (const bool other : {false, true}) {
        const std::string diagonal = other ? ", other diagonal" : "";
        expect("two faces" + diagonal,
               of_mesh(make_mesh_data(square, joined({face(false, false), face(true, other)}), glass())), 2, 2,
               "more than once");
        expect("two faces that look the same way" + diagonal,
               of_mesh(make_mesh_data(square, joined({face(false, false), face(false, other)}), glass())), 2, 2,
               "more than once");
        expect("twice on both sides" + diagonal,
               of_mesh(make_mesh_data(
                   square, joined({face(false, false), face(true, false), face(false, other), face(true, other)}),
                   glass())),
               2, 6, "more than once");
    }
    const MeshData shared = *make_mesh_data(square, joined({face(false, false), face(true, true)}), glass());
    expect("corners of their own", of_mesh(with_own_corners(shared, glass())), 2, 2, "more than once");
    // Rotated and moved, coordinates have rounding errors in the last digits of a file.
    MeshData moved = *with_own_corners(shared, glass());
    const Transform turn = make_transform({10, 3, -7}, {20, 30, 40}, {1, 1, 1});
    for (Vec3d& p : moved.positions) {
        p = turn.point(p);
        p = {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6, std::round(p.z * 1e6) / 1e6};
    }
    expect("turned, with six digits", of_mesh(std::make_shared<const MeshData>(moved)), 2, 2, "more than once");
}

// Rows of panes whose copies have other diagonals, and share their edges.
TEST(Sheets, OfManyPanesAreFoundPaneByPane)
{
    std::vector<Vec3d> p;
    Triangles t;
    constexpr uint32_t n = 7;
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j <= n; ++j) p.push_back({double(i), double(j), 0});
    const auto add = [&](bool turned, int split) {
        for (uint32_t i = 0; i < n; ++i)
            for (uint32_t j = 0; j < n; ++j) {
                const uint32_t a = i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
                const bool other = split == 2 ? (i + j) % 2 == 1 : split == 1;
                Triangles two = other ? Triangles{{a, b, d}, {b, c, d}} : Triangles{{a, b, c}, {a, c, d}};
                if (turned) two = turned_round(two);
                t.insert(t.end(), two.begin(), two.end());
            }
    };
    add(false, 0), add(true, 1), add(false, 2), add(true, 2);
    expect("a wall of panes", of_mesh(make_mesh_data(p, t, glass())), 2 * n * n, 6 * n * n, "1 sheet of glass");
}

TEST(Sheets, BodiesStay)
{
    for (const double bump : {0.0, 0.15}) expect_unchanged("a ball", of_mesh(make_uv_sphere(12, 24, bump, glass())));
    expect_unchanged("a cube", of_mesh(make_cube(glass())));
    expect_unchanged("a cube of single triangles", of_mesh(with_own_corners(*make_cube(), glass())));
    expect_unchanged("a cube inside out",
                     of_mesh(make_mesh_data(make_cube()->positions, turned_round(make_cube()->triangles), glass())));
    // A seam whose two rims differ by rounding.
    MeshData ball = *with_own_corners(*make_uv_sphere(12, 24), glass());
    for (size_t i = 0; i < ball.positions.size(); ++i) ball.positions[i].x += (i % 3 == 0 ? 3e-7 : -2e-7);
    expect_unchanged("a ball with open seams", of_mesh(std::make_shared<const MeshData>(ball)));
    // Holes, as scans have them, or a face of wrong winding among many.
    MeshData holes = *make_uv_sphere(12, 24, 0, glass());
    holes.triangles.erase(holes.triangles.begin() + 100, holes.triangles.begin() + 106);
    expect_unchanged("a ball with a hole", of_mesh(std::make_shared<const MeshData>(holes)));
    MeshData one_turned = *make_uv_sphere(12, 24, 0, glass());
    std::swap(one_turned.triangles[100][0], one_turned.triangles[100][1]);
    expect_unchanged("a ball with a turned face", of_mesh(std::make_shared<const MeshData>(one_turned)));
    MeshData one_twice = *make_uv_sphere(12, 24, 0, glass());
    one_twice.triangles.push_back(one_twice.triangles[100]);
    expect("a ball with a face twice", of_mesh(std::make_shared<const MeshData>(one_twice)), 0, 1, "1 body of glass");
    // The winding of a face is wrong, but its normals are right: they decide.
    MeshData turned = *make_cube(glass());
    std::swap(turned.triangles[0][1], turned.triangles[0][2]);
    turned.normals = {{0, 0, -1}};
    turned.normal_triangles.assign(12, {MeshData::no_normal, MeshData::no_normal, MeshData::no_normal});
    turned.normal_triangles[0] = {0, 0, 0};
    expect_unchanged("a cube with right normals", of_mesh(std::make_shared<const MeshData>(turned)));
    // Two cubes that share a side: it is there twice, and neither of its faces may go.
    MeshData pair = *make_cube(glass());
    for (size_t i = 0; i < 8; ++i) pair.positions.push_back(pair.positions[i] + Vec3d{2, 0, 0});
    for (size_t i = 0; i < 12; ++i) {
        auto corners = pair.triangles[i];
        for (uint32_t& c : corners) c += 8;
        pair.triangles.push_back(corners);
    }
    expect_unchanged("two cubes side by side", of_mesh(std::make_shared<const MeshData>(pair)));
}

TEST(Sheets, BodiesGivenTwiceCountOnce)
{
    const Triangles cube = make_cube()->triangles;
    Triangles mixed;  // of each pair the one or the other first
    for (size_t i = 0; i < cube.size(); ++i) {
        const Triangles one{cube[i]}, other = turned_round(one);
        for (const Triangles& t : i % 3 == 0 ? std::array{other, one} : std::array{one, other})
            mixed.insert(mixed.end(), t.begin(), t.end());
    }
    for (const auto& [name, t] : {std::pair{"inside out first", joined({turned_round(cube), cube})},
                                  {"inside out last", joined({cube, turned_round(cube)})},
                                  {"the same", joined({cube, cube})},
                                  {"in any order", mixed}}) {
        const SceneDescription d = of_mesh(make_mesh_data(make_cube()->positions, t, glass()));
        expect(name, d, 0, 12, "1 body of glass");
        // What is left has its front outside.
        Diagnostics diagnostics;
        const Scene scene = Scene::build(d, d.render, diagnostics);
        const Mesh& mesh = scene.geometry.meshes[0];
        for (const auto& corners : mesh.triangles) {
            if (corners[0] == corners[1]) continue;
            const Vec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]], c = mesh.positions[corners[2]];
            EXPECT_GT(dot(cross(b - a, c - a), a), 0) << name;
        }
    }
}

TEST(Sheets, SlabsAreSheetsBelowTwoPercent)
{
    const auto slab = [&](double thickness, const MaterialDescription& m) { return box({2, 3, thickness}, m); };
    for (const TransformDescription& place :
         {TransformDescription{}, TransformDescription{{5, 6, 7}, {30, 40, 50}, {100, 100, 100}}}) {
        expect("thin", of_mesh(slab(0.039, glass()), place), 2, 10, "1 slab of glass");
        expect_unchanged("thick", of_mesh(slab(0.041, glass()), place));
    }
    expect("flattened", of_mesh(slab(2, glass()), {{}, {}, {1, 1, 0.01}}), 2, 10, "1 slab of glass");
    Triangles twice = joined({make_cube()->triangles, turned_round(make_cube()->triangles)});
    SceneDescription doubled = of_mesh(make_mesh_data(slab(0.03, glass())->positions, twice, glass()));
    const Result r = result_of(doubled);
    EXPECT_EQ(r.thin, 2u);
    EXPECT_EQ(r.absent, 22u);

    MaterialDescription m = glass();
    m.absorption = {1, 0, 0};
    expect_unchanged("absorbs", of_mesh(slab(0.03, m)));
    m = glass();
    m.priority = 1;
    expect_unchanged("has a priority", of_mesh(slab(0.03, m)));
    m = glass();
    m.roughness = 0.4f;
    expect_unchanged("rough", of_mesh(slab(0.03, m)));
    m = glass();
    m.thin = false;
    expect_unchanged("forbidden", of_mesh(slab(0.03, m)));
    expect_unchanged("opaque", of_mesh(slab(0.03, make_lambert("wall", {0.5f, 0.5f, 0.5f}))));
    // Whose face is not flat.
    expect_unchanged("a lens", of_mesh(make_uv_sphere(12, 24, 0, glass()), {{}, {}, {1, 1, 0.005}}));
}

// Water has a depth, also where only its surface is drawn.
TEST(Sheets, SurfacesOfLiquidsStay)
{
    MaterialDescription water = glass("water");
    water.ior = 1.33f;
    expect_unchanged("a pond", of_mesh(make_mesh_data(square, face(false, false), water)));
    expect("given twice", of_mesh(make_mesh_data(square, joined({face(false, false), face(true, false)}), water)), 2, 2,
           "1 sheet of glass 'water'");
}

TEST(Sheets, SlabsInOtherBodiesStay)
{
    const auto thin_slab = [&] { return of_mesh(box({2, 3, 0.03}, glass())); };
    SceneDescription in_ball = thin_slab();
    in_ball.materials = {glass("ball")};
    in_ball.spheres = {sphere_of({0, 0, 0}, 3, "ball")};
    expect_unchanged("in a ball", in_ball);
    in_ball.spheres[0].center = {10, 0, 0};
    expect("beside a ball", in_ball, 2, 10, "1 slab of glass");
    SceneDescription in_mesh = thin_slab();
    in_mesh.meshes.push_back(make_mesh(make_cube(glass("block")), {{}, {}, {4, 4, 4}}));
    expect_unchanged("in a block", in_mesh);
    SceneDescription in_water = thin_slab();
    in_water.materials = {glass("water")};
    in_water.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "water")};
    expect_unchanged("half in water", in_water);
    in_water.planes[0].point = {0, -2, 0};
    expect("above water", in_water, 2, 10, "1 slab of glass");
}

// Two faces that look away from each other, without the edges between them.
TEST(Sheets, TwoSidesWithoutEdgesAreASlab)
{
    const auto sides = [&](double distance, bool first_turned) {
        std::vector<Vec3d> p = square;
        for (const Vec3d& v : square) p.push_back(v - Vec3d{0, 0, distance});
        return of_mesh(make_mesh_data(p, joined({face(first_turned, false), face(!first_turned, true, 4)}), glass()));
    };
    expect("close", sides(0.03, false), 2, 2, "1 slab of glass");
    expect("farther apart", sides(0.05, false), 4, 0, "2 sheets of glass");
    expect("looking at each other", sides(0.03, true), 4, 0, "2 sheets of glass");
}

TEST(Sheets, OpenGlassThatOtherMaterialsCloseIsABody)
{
    MeshData labelled = *make_cube(glass());
    labelled.materials.push_back(make_lambert("label", {0.5f, 0.5f, 0.5f}));
    labelled.face_material.assign(12, 0);
    labelled.face_material[0] = labelled.face_material[1] = 1;
    expect_unchanged("a block with a label", of_mesh(std::make_shared<const MeshData>(labelled)));
    MeshData room = labelled;
    room.face_material.assign(12, 1);
    room.face_material[0] = room.face_material[1] = 0;
    expect("a room with a window", of_mesh(std::make_shared<const MeshData>(room)), 2, 0, "1 sheet of glass");
}

TEST(Sheets, OpacityOfSeveralFacesInAPlaceIsThatOfOne)
{
    const MaterialDescription veil = make_gauze("veil", {1, 1, 1}, 0.3f);
    const Triangles both = joined({face(false, false), face(true, true)});
    expect("twice", of_mesh(make_mesh_data(square, both, veil)), 0, 2, "2 triangles of 'veil'");
    expect_unchanged("once", of_mesh(make_mesh_data(square, face(false, false), veil)));
    MaterialDescription lamp = veil;
    lamp.emission = {1, 1, 1};
    expect_unchanged("emitting to its own side", of_mesh(make_mesh_data(square, both, lamp)));
    MeshData two = *make_mesh_data(square, both, veil);
    two.materials.push_back(make_gauze("other", {1, 0, 0}, 0.3f));
    two.face_material = {0, 0, 1, 1};
    expect_unchanged("of two materials", of_mesh(std::make_shared<const MeshData>(two)));
    MeshData mapped = *make_mesh_data(square, both, make_gauze("veil", {1, 1, 1}, 0.3f, 4));
    mapped.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5f, 0.5f}};
    mapped.uv_triangles = mapped.triangles;
    expect("with a picture", of_mesh(std::make_shared<const MeshData>(mapped)), 0, 2, "2 triangles of 'veil'");
    mapped.uv_triangles[2][0] = mapped.uv_triangles[3][0] = 4;
    expect_unchanged("with another picture", of_mesh(std::make_shared<const MeshData>(mapped)));
}

TEST(Sheets, SaidByTheMaterialAreTakenAtItsWord)
{
    MaterialDescription m = glass();
    m.thin = true;
    expect("a thin cube", of_mesh(make_cube(m)), 12, 0, "");
    expect("a thin quad twice", of_mesh(make_mesh_data(square, joined({face(false, false), face(true, true)}), m)), 2,
           2, "2 triangles of");
    m.thin = false;
    expect_unchanged("a solid quad", of_mesh(make_mesh_data(square, face(false, false), m)));
    SceneDescription legacy = of_mesh(make_mesh_data(square, face(false, false), glass()));
    legacy.render.legacy = true;
    expect_unchanged("legacy", legacy);
}

TEST(Sheets, HaveNoInside)
{
    for (const bool priority : {false, true}) {
        SceneDescription d = of_mesh(make_mesh_data(square, face(false, false)));
        MaterialDescription m = glass();
        m.thin = true;
        if (priority)
            m.priority = 2;
        else
            m.absorption = {1, 1, 1};
        d.materials = {m};
        d.meshes[0].material = "glass";
        Diagnostics diagnostics;
        EXPECT_THROW(Scene::build(d, d.render, diagnostics), Error);
    }
}

// What is not asked for costs nothing, and what is asked for is timed.
TEST(Sheets, AreLookedForWhereGlassIs)
{
    Diagnostics diagnostics;
    EXPECT_TRUE(Scene::build(of_mesh(make_cube()), {}, diagnostics).analyses.empty());
    const Scene with_glass = Scene::build(of_mesh(make_cube(glass())), {}, diagnostics);
    ASSERT_EQ(with_glass.analyses.size(), 1u);
    EXPECT_EQ(with_glass.analyses[0].name, "thin glass");
}

// Bodies inside out are told of; their cavities, which look inwards as they should, are not.
TEST(Sheets, BodiesInsideOutAreToldOf)
{
    const auto warnings = [](const SceneDescription& d) {
        Diagnostics diagnostics;
        Scene::build(d, d.render, diagnostics);
        std::string text;
        for (const Diagnostics::Warning& said : diagnostics.warnings()) text += said.before + said.after + "\n";
        return text;
    };
    const auto turned = [](MeshData data) {
        for (auto& corners : data.triangles) std::swap(corners[1], corners[2]);
        return std::make_shared<const MeshData>(std::move(data));
    };
    const auto cube = [] {
        MeshData data = *make_cube();
        data.materials = {glass()};
        return data;
    };
    const char* const told = "1 body of glass 'glass' with faces that look inwards";
    SceneDescription d = of_mesh(std::make_shared<const MeshData>(cube()));
    EXPECT_EQ(warnings(d), "");
    d.meshes[0].transform.scale = {-1, 2, 1};
    EXPECT_EQ(warnings(d), "") << "mirrored by the scene";
    d = of_mesh(turned(cube()));
    EXPECT_NE(warnings(d).find(told), std::string::npos) << warnings(d);
    // A cavity of the other cube, and one that leaves it.
    d.meshes[0].transform.scale = {0.5, 0.5, 0.5};
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(cube()), {}));
    EXPECT_EQ(warnings(d), "");
    d.meshes[0].transform.translate = {0.8, 0, 0};
    EXPECT_NE(warnings(d).find(told), std::string::npos);
    // Of all but glass either side is as good.
    d = of_mesh(turned(*make_cube()));
    EXPECT_EQ(warnings(d), "");
}

}  // namespace
}  // namespace lancer
