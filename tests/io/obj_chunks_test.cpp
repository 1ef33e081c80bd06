// Large files are parsed in parts by all threads. In parts of a few lines each, every file gives what it gives when it
// is parsed as a whole by the other reader: the same mesh, the same warnings, the same errors.
#include "io/obj/chunks.h"

#include <cmath>

#include "io/file_content.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

struct Loaded {
    std::shared_ptr<const MeshData> mesh;
    Diagnostics diagnostics;

    std::string said() const
    {
        std::string all;
        for (const auto& w : diagnostics.warnings()) all += to_string(w) + "\n";
        try {
            diagnostics.throw_if_errors();
        } catch (const Error& e) {
            all += e.what();
        }
        return all;
    }
};

Loaded load_by(const std::string& path, size_t parallel_from)
{
    Loaded l;
    MeshOptions options;
    options.parallel_from = parallel_from, options.chunk = 150, options.uvs = true;
    l.mesh = load_obj(path, l.diagnostics, options);
    return l;
}

// Decimal numbers may be rounded differently, in the last places of a double.
bool close(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-14 * std::abs(x); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const Vec3d& p, const Vec3d& q) {
        return near(p.x, q.x) && near(p.y, q.y) && near(p.z, q.z);
    });
}

void expect_same(const std::string& path)
{
    const Loaded whole = load_by(path, SIZE_MAX), parts = load_by(path, 0);
    EXPECT_EQ(whole.said(), parts.said()) << path;
    ASSERT_EQ(whole.mesh == nullptr, parts.mesh == nullptr) << path;
    if (!whole.mesh) return;
    const MeshData &a = *whole.mesh, &b = *parts.mesh;
    EXPECT_TRUE(close(a.positions, b.positions)) << path;
    EXPECT_EQ(a.triangles, b.triangles) << path;
    EXPECT_EQ(a.normal_triangles, b.normal_triangles) << path;
    EXPECT_EQ(a.uv_triangles, b.uv_triangles) << path;
    EXPECT_EQ(a.face_material, b.face_material) << path;
    EXPECT_EQ(a.content_hash, b.content_hash) << path;
    ASSERT_EQ(a.normals.size(), b.normals.size()) << path;
    for (size_t i = 0; i < a.normals.size(); ++i) ASSERT_LT(length(a.normals[i] - b.normals[i]), 1e-6f) << path;
    ASSERT_EQ(a.uvs.size(), b.uvs.size()) << path;
    for (size_t i = 0; i < a.uvs.size(); ++i) ASSERT_NEAR(a.uvs[i].x, b.uvs[i].x, 1e-6f * std::abs(a.uvs[i].x));
    ASSERT_EQ(a.materials.size(), b.materials.size()) << path;
    for (size_t i = 0; i < a.materials.size(); ++i) EXPECT_EQ(a.materials[i].name, b.materials[i].name) << path;
    EXPECT_EQ(a.colors.size(), b.colors.size()) << path;
}

std::vector<std::string> objs_in(const fs::path& folder)
{
    std::vector<std::string> all;
    std::error_code error;
    for (fs::recursive_directory_iterator i(folder, error), end; i != end; ++i)
        if (i->is_regular_file() && i->path().extension() == ".obj") all.push_back(i->path().string());
    return all;
}

using ObjChunked = ObjTest;

TEST_F(ObjChunked, ReadsTheFilesThatAreThere)
{
    uint32_t in_parts = 0;
    for (const char* folder : {"malformed", "scenes/cornell", "scenes/spot", "scenes/gopher", "scenes/anchors"})
        for (const std::string& path : objs_in(shared_folder() / folder)) {
            expect_same(path);
            const FileContent content(path);
            in_parts += ObjChunks::survey(content.text(), 150).has_value();
        }
    if (!fs::exists(shared_folder() / "scenes")) return;
    EXPECT_GT(in_parts, 5u);
}

constexpr const char* plain =
    "# comment\nmtllib a.mtl\no thing\n"
    "v 0 0 0\nv 1 0 0\r\nv 1 1 0 1.0\n  v\t0 1 0.1e1  \nvt 0 0\nvt 1\nvt 1 1 0\nvn 0 0 1\nvn +1 -2. .3\n"
    "usemtl red\nf 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//2 3//-1\nf 1/1/1 2/2/2 3/3/1 4/-1/-2\n"
    "g group\ns off\nusemtl blue\nf -4 -3 -2\nusemtl red\nf 1 1 1\nv 5 5 5\n\nf -1 1 2\nvn 0 0 0\nf 1//3 2//3 3//3";

TEST_F(ObjChunked, UnderstandsWhatMostFilesHold)
{
    write("a.mtl", "newmtl red\nKd 1 0 0\n");
    std::string text;
    for (int i = 0; i < 20; ++i) text += std::string(plain) + "\n";
    const std::string path = write("a.obj", text);
    expect_same(path);
    const Loaded parts = load_by(path, 0);
    ASSERT_TRUE(parts.mesh) << parts.said();
    EXPECT_EQ(parts.mesh->triangles.size(), 20u * 8);
    for (const size_t chunk : {1u, 10u, 1000u, 1000000u}) {
        const auto survey = ObjChunks::survey(text, chunk);
        ASSERT_TRUE(survey) << chunk;
        EXPECT_EQ(survey->summary().vertices, 20u * 5);
        EXPECT_EQ(survey->summary().normals, 20u * 3);
        EXPECT_EQ(survey->summary().texcoords, 20u * 3);
        EXPECT_EQ(survey->summary().materials.size(), 2u);
        EXPECT_EQ(survey->summary().materials[1].line, 20u);
        EXPECT_TRUE(survey->summary().face_normals);
    }
}

// Each line alone, in the middle of a plain file: nothing may pass here that the other reader takes differently.
TEST_F(ObjChunked, LeavesTheRestToTheOtherReader)
{
    write("a.mtl", "newmtl red\nKd 1 0 0\n");
    for (const char* line : {"v 1 2",
                             "v 1 2 x",
                             "v 1 2 inf",
                             "v 1 2 nan",
                             "v 1e400 0 0",
                             "v 1e-400 0 0",
                             "v 1 2 3 0.5 0.5 0.5",
                             "v 1 2 3 # comment",
                             "v 1 2 3 #comment",
                             "v 1 2 3#comment",
                             "v 0x10 0 0",
                             "v 1 2 3\rv 4 5 6",
                             "v 1 2 3 1\rv 4 5 6",
                             "vt 0 0 0\rvt 1 1",
                             "vt",
                             "vt x 0",
                             "vt nan 0",
                             "vn 0 0",
                             "vn 0 0 1 1 1",
                             "vn 1 0 0 # c",
                             "f",
                             "f 1",
                             "f 1 2",
                             "f 1 2 3 # c",
                             "f 1 2 9999",
                             "f 1 2 -9999",
                             "f 0 1 2",
                             "f 1/ 2/ 3/",
                             "f 1// 2// 3//",
                             "f 1/2/ 2/2/ 3/2/",
                             "f 1/1/1/1 2 3",
                             "f 1 2 x",
                             "f 1.5 2 3",
                             "f 1 2 3 \\\n 4",
                             "f 99999999999999999999 1 2",
                             "f //1 2 3",
                             "f 1 2 3/",
                             "f +1 2 3",
                             "l 1 2",
                             "p 1",
                             "unknown 1 2",
                             "usemtl",
                             "usemtl a b # c",
                             "usemtl a#b",
                             "mtllib b.mtl",
                             "g a\rv 1 2 3",
                             "# ends \\",
                             "usemtl red\\",
                             "v -0 +0 -.0e-3",
                             "f 1 2\t3\t",
                             "call a.obj"}) {
        const std::string text = std::string(plain) + "\n" + line + "\n" + plain + "\nf -1 -2 -3\n";
        SCOPED_TRACE(line);
        expect_same(write("a.obj", text));
    }
}

// So large that parts of the text are gone when the last one is parsed: lines of messages are known nevertheless, and
// what needs the other reader at the very end is read again.
TEST_F(ObjChunked, GivesTheTextBackAsItGoes)
{
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    const auto fill = [&] {
        for (int i = 0; i < 3000; ++i) text += "v 1 2 " + std::to_string(i) + "\nf 1 2 -1\n";
    };
    fill();
    text += "vn 0 0 0\nf 1 1 2\nf 1 2//1 3\n";
    fill();
    for (const char* end : {"f 1 2 3\n", "v 1 2 3 # comment\n", "f 1 2 99999\n", "v 1 2 nan\n", "f 1/1 2/1 3/1\n"}) {
        SCOPED_TRACE(end);
        expect_same(write("a.obj", text + end));
    }
    EXPECT_THAT(load_by(write("a.obj", text + "f 3 2 1\n"), 0).said(), testing::HasSubstr("a.obj:6006: "));
}

TEST(GiveBack, KeepsWhatLiesBeside)
{
    constexpr size_t page = 4096;
    std::string text(1000 * page, 'x');
    for (const auto& [begin, size] : {std::pair{10 * page + 1, 50 * page}, {100 * page, page - 1}, {0ul, 0ul}}) {
        give_back(std::string_view(text).substr(begin, size));
        size_t gone = 0;
        for (size_t i = begin; i < begin + size; ++i) gone += text[i] == 0;
        EXPECT_EQ(gone, size / page * page - (size >= page ? page : 0)) << begin;
        std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(begin), size, 'x');
        EXPECT_EQ(text.find('\0'), std::string::npos) << begin;
    }
}

}  // namespace
}  // namespace lancer
