#include <cmath>

#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::HasSubstr;

using ObjMutations = ObjTest;

void expect_valid(const MeshData& m)
{
    EXPECT_FALSE(m.triangles.empty());
    EXPECT_FALSE(m.materials.empty());
    bool right = m.face_material.size() == (m.materials.size() > 1 ? m.triangles.size() : 0);
    right = right && m.normal_triangles.size() == (m.normals.empty() ? 0 : m.triangles.size());
    for (const Vec3d& p : m.positions) right = right && is_finite(p);
    for (const Vec3& n : m.normals) right = right && std::abs(length(n) - 1) < 1e-5f;
    for (const Triangle& t : m.triangles)
        for (const uint32_t i : t) right = right && i < m.positions.size();
    for (const Triangle& t : m.normal_triangles)
        for (const uint32_t i : t) right = right && (i == MeshData::no_normal || i < m.normals.size());
    right = right && m.uv_triangles.size() == (m.uvs.empty() ? 0 : m.triangles.size());
    for (const Vec2& uv : m.uvs) right = right && std::isfinite(uv.x) && std::isfinite(uv.y);
    for (const Triangle& t : m.uv_triangles)
        for (const uint32_t i : t) right = right && (i == MeshData::no_uv || i < m.uvs.size());
    for (const uint32_t i : m.face_material) right = right && i < m.materials.size();
    for (const MaterialDescription& d : m.materials) {
        right = right && is_finite(d.base_color) && is_finite(d.emission) && max_component(d.base_color) <= 1;
        right = right && std::min({d.base_color.r, d.base_color.g, d.base_color.b, d.emission.r, d.emission.g,
                                   d.emission.b}) >= 0;
        const auto is_part = [](float x) { return x >= 0 && x <= 1; };
        right = right && is_part(d.roughness) && is_part(d.opacity) && is_part(d.metallic.value_or(0));
        right = right && is_part(max_component(d.specular)) && d.ior >= 0.001f && d.ior <= 10;
        right = right && std::isfinite(d.bump_scale);
    }
    EXPECT_TRUE(right) << m.file;
}

TEST(ObjFiles, BrokenFilesGiveAMeshOrAnError)
{
    std::error_code error;
    for (fs::recursive_directory_iterator i(shared_folder() / "malformed", error), end; i != end; ++i) {
        const std::string extension = i->path().extension().string();
        if (!i->is_regular_file() || (extension != ".obj" && extension != ".mtl" && extension != ".off")) continue;
        Diagnostics diagnostics;
        const auto m = load_obj(i->path().string(), diagnostics);
        EXPECT_EQ(m == nullptr, diagnostics.has_errors()) << i->path();
        if (m) expect_valid(*m);
    }
}

TEST_F(ObjMutations, BrokenMaterialFilesGiveAMesh)
{
    std::error_code error;
    for (fs::recursive_directory_iterator i(shared_folder() / "malformed", error), end; i != end; ++i) {
        const std::string extension = i->path().extension().string();
        if (!i->is_regular_file() || (extension != ".obj" && extension != ".mtl")) continue;
        const auto m = load("mtllib " + i->path().string() + "\n" + corners + "usemtl a\nf 1 2 3\n");
        ASSERT_TRUE(m) << i->path() << errors();
        expect_valid(*m);
        for (const std::string& w : warnings()) EXPECT_THAT(w, testing::Not(HasSubstr("not found"))) << w;
    }
}

TEST(ObjFiles, RealFilesHaveTheirCounts)
{
    struct Case {
        const char* file;
        size_t triangles, dropped, materials;
    };
    const Case cases[] = {
        {"meshes/suzanne.obj", 968, 0, 1},
        {"meshes/teapot.obj", 6320, 0, 1},
        {"meshes/stanford-bunny.obj", 69451, 0, 1},
        {"meshes/armadillo.obj", 86482, 0, 1},
        {"meshes/ogre.obj", 124008, 4, 1},
        {"spot/cow.obj", 5856, 0, 1},
        {"spot/spot_quadrangulated.obj", 5856, 0, 1},
        {"cornell/CornellBox-Original.obj", 36, 0, 8},
        {"cornell/CornellBox-Water.obj", 7088, 0, 9},
        {"cornell/cornell_box_specular.obj", 2188, 0, 8},
        {"cornell/cornell_box_glossy.obj", 34, 0, 7},
        {"gopher/gopher.obj", 49792, 0, 7},
        {"anchors/cornell.obj", 32, 0, 4},
    };
    for (const Case& c : cases) {
        const fs::path path = shared_folder() / "scenes" / c.file;
        if (!fs::exists(path)) continue;
        Diagnostics diagnostics;
        const auto m = load_obj(path.string(), diagnostics);
        ASSERT_TRUE(m) << c.file;
        expect_valid(*m);
        uint64_t dropped = 0;
        for (const auto& w : diagnostics.warnings())
            if (message_of(w) == "zero-area face dropped") dropped = w.count;
        EXPECT_EQ(m->triangles.size(), c.triangles - c.dropped) << c.file;
        EXPECT_EQ(dropped, c.dropped) << c.file;
        EXPECT_EQ(m->materials.size(), c.materials) << c.file;
    }
}

TEST_F(ObjMutations, MutatedFilesNeverBreakTheReader)
{
    const std::string obj =
        "mtllib a.mtl\no thing\n" + square +
        "v 0.5 0.5 1e0 1 0 0\nvt 0 0\nvt 1 0.5\nvn 0 0 1\nvn 1 -2 3\n"
        "usemtl red\nf 1/1/1 2/2/2 3//1\nf 1 2 \\\n 3 4 # q\nusemtl lamp\r\nf -1 -2 -3\nf 1 2 3 4 5\n"
        "s off\ng x\nl 1 2\nf 5//2 4//1 1//-1\n";
    const std::string mtl =
        "newmtl red\nKd 1 0 0 # Red\nNs 10\nKs .5 .4 .3\nNi 1.5\nillum 3\nmap_Kd -s 2 2 1 -o 0 .5 a.png\n"
        "bump -bm 2 -imfchan r a.png\n\nnewmtl lamp\nKe 1 2 3\nillum 2\nd .5\nTr .5\nmap_d a.png\nPr .3\nPm .2\n";
    write("a.png", "");
    const std::string pieces[] = {"0",
                                  "-1",
                                  "99999999999",
                                  "nan",
                                  "1e400",
                                  "/",
                                  "//",
                                  "\\\n",
                                  "\r",
                                  "#",
                                  " ",
                                  "f ",
                                  "v ",
                                  "usemtl ",
                                  "newmtl ",
                                  "Kd ",
                                  "map_Kd ",
                                  "-bm ",
                                  "Tf 1e39 ",
                                  "vt ",
                                  "-",
                                  "e",
                                  std::string(1, '\0'),
                                  "\xff"};
    uint64_t state = 12345;
    const auto random = [&](size_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<size_t>(state >> 33) % n;
    };
    const auto mutate = [&](std::string s) {
        for (size_t times = 1 + random(4); times > 0; --times) {
            const size_t at = random(s.size()), kind = random(5);
            if (kind == 0) s[at] = static_cast<char>(random(256));
            if (kind == 1) s.erase(at, 1 + random(8));
            if (kind == 2) s.insert(at, pieces[random(std::size(pieces))]);
            if (kind == 3) s.insert(at, s.substr(random(s.size()), random(30)));
            if (kind == 4 && at > 0) s[at] = "0123456789 -./"[random(14)];
            if (s.empty()) s = "f";
        }
        return s;
    };
    int loaded = 0;
    for (int i = 0; i < 4000; ++i) {
        if (i % 4 == 0) write("a.mtl", mutate(mtl));
        const std::string text = i % 4 == 3 ? obj : mutate(obj);
        const auto m = load(text);
        ASSERT_EQ(m == nullptr, diagnostics_.has_errors()) << text;
        ASSERT_THAT(errors(), testing::Not(HasSubstr("could not be parsed")));
        if (m) expect_valid(*m);
        if (m) ++loaded;
        if (HasFailure()) FAIL() << text;
    }
    EXPECT_GT(loaded, 1000);
}

}  // namespace
}  // namespace lancer
