// PLY files: each form of a mesh is the mesh of the OBJ file, and what is broken is told.
#include "io/ply/ply.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

#include "io/mesh_file.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

enum class Form { text, little_endian, big_endian };

// Writes numbers of any type in a form.
class PlyText {
public:
    PlyText(Form form, const std::string& header) : form_(form)
    {
        constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
        bytes_ = "ply\nformat " + std::string(names[static_cast<size_t>(form)]) + " 1.0\n" + header + "end_header\n";
    }
    template <class T>
    PlyText& add(T value)
    {
        if (form_ == Form::text) {
            char digits[64];
            std::snprintf(digits, sizeof digits, "%.17g ", static_cast<double>(value));
            bytes_ += digits;
            return *this;
        }
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if ((form_ == Form::big_endian) == (std::endian::native == std::endian::little))
            std::reverse(raw, raw + sizeof(T));
        bytes_.append(raw, sizeof(T));
        return *this;
    }
    template <class T>
    PlyText& all(std::initializer_list<T> values)
    {
        for (const T x : values) add(x);
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

private:
    Form form_;
    std::string bytes_;
};

// A square, a triangle and a pentagon that is not convex.
const char* const shapes_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0.25\nv 0 1 0\nv 3 0.1 0\nv 5 0.125 0\nv 4 0.5 0\nv 5 1 0\nv 3 1 0\n"
    "f 1 2 3 4\nf 1 2 5\nf 5 6 7 8 9\nf 1 1 2\n";

class Ply : public ObjTest {
protected:
    std::shared_ptr<const MeshData> load(const std::string& bytes, const MeshOptions& options = {})
    {
        diagnostics_ = {};
        return load_mesh(write("a.ply", bytes), diagnostics_, options);
    }
    std::shared_ptr<const MeshData> load_shapes_obj(const MeshOptions& options = {})
    {
        Diagnostics none;
        return load_mesh(write("a.obj", shapes_obj), none, options);
    }
};

template <class Real, class Count, class Index>
std::string shapes(Form form, const std::string& real, const std::string& count, const std::string& index)
{
    PlyText ply(form, "comment a square\nelement vertex 9\nproperty " + real + " x\nproperty " + real +
                          " y\nproperty uchar quality\nproperty " + real +
                          " z\nelement face 4\nproperty float weight\nproperty list " + count + " " + index +
                          " vertex_indices\nelement edge 1\nproperty int vertex1\nproperty list uchar float more\n");
    constexpr double at[9][3] = {{0, 0, 0},     {1, 0, 0},   {1, 1, 0.25}, {0, 1, 0}, {3, 0.1, 0},
                                 {5, 0.125, 0}, {4, 0.5, 0}, {5, 1, 0},    {3, 1, 0}};
    for (const auto& p : at)
        ply.add(static_cast<Real>(p[0])).add(static_cast<Real>(p[1])).add(uint8_t{7}).add(static_cast<Real>(p[2]));
    const std::vector<std::vector<int>> faces{{0, 1, 2, 3}, {0, 1, 4}, {4, 5, 6, 7, 8}, {0, 0, 1}};
    for (const auto& face : faces) {
        ply.add(1.5f).add(static_cast<Count>(face.size()));
        for (const int i : face) ply.add(static_cast<Index>(i));
    }
    return ply.add(int32_t{3}).add(uint8_t{2}).add(1.0f).add(2.0f).bytes();
}

TEST_F(Ply, OfEachFormAndTypeIsTheMeshOfTheObjFile)
{
    const auto obj = load_shapes_obj();
    ASSERT_TRUE(obj);
    for (const Form form : {Form::text, Form::little_endian, Form::big_endian})
        for (const std::string& bytes : {shapes<double, uint8_t, int32_t>(form, "double", "uchar", "int"),
                                         shapes<double, uint32_t, uint16_t>(form, "float64", "uint32", "ushort"),
                                         shapes<double, int16_t, int8_t>(form, "double", "short", "char")}) {
            const auto ply = load(bytes);
            ASSERT_TRUE(ply) << errors();
            EXPECT_EQ(ply->positions, obj->positions);
            EXPECT_EQ(ply->triangles, obj->triangles);
            EXPECT_EQ(ply->materials.size(), 1u);
            EXPECT_THAT(warnings(), ElementsAre(HasSubstr("zero-area face dropped")));
        }
    const auto rounded = load(shapes<float, uint8_t, uint32_t>(Form::little_endian, "float", "uint8", "uint"));
    ASSERT_TRUE(rounded) << errors();
    EXPECT_EQ(rounded->positions[4].y, static_cast<double>(0.1f));
}

TEST_F(Ply, HasNormalsColoursAndTextureCoordinatesOfVertices)
{
    for (const Form form : {Form::text, Form::little_endian, Form::big_endian}) {
        PlyText ply(form,
                    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
                    "property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
                    "property uchar blue\nproperty uchar alpha\nproperty float s\nproperty float t\n"
                    "element face 2\nproperty list uchar int vertex_index\n");
        const auto vertex = [&](std::initializer_list<float> place, std::initializer_list<uint8_t> color, float s) {
            ply.all(place).all(color).add(s).add(0.5f);
        };
        vertex({0, 0, 0, 0, 0, 2}, {255, 0, 51, 9}, 0);
        vertex({1, 0, 0, 0, 3, 4}, {0, 255, 0, 9}, 1);
        vertex({0, 1, 0, 0, 0, 1}, {0, 0, 255, 9}, 2);
        vertex({1, 1, 0, 0, 0, 0}, {1, 2, 3, 9}, 3);
        ply.add(uint8_t{3}).all({0, 1, 2}).add(uint8_t{3}).all({1, 3, 2});
        const auto mesh = load(ply.bytes(), {.uvs = true});
        ASSERT_TRUE(mesh) << errors();
        ASSERT_EQ(mesh->triangles.size(), 2u);
        EXPECT_EQ(mesh->normals[1], (Vec3{0, 0.6f, 0.8f}));
        EXPECT_EQ(mesh->normal_triangles[0], mesh->triangles[0]);
        EXPECT_EQ(mesh->normal_triangles[1][0], MeshData::no_normal) << "a corner without a direction";
        EXPECT_EQ(mesh->colors[0], (Color{1, 0, 0.2f}));
        EXPECT_EQ(mesh->alphas, std::vector<float>(4, 9 / 255.0f));
        EXPECT_EQ(mesh->uv_triangles, mesh->triangles);
        EXPECT_EQ(mesh->uvs[3], (Vec2{3, 0.5f}));
        EXPECT_THAT(warnings(), ElementsAre(HasSubstr("normal of zero length")));
        EXPECT_TRUE(load(ply.bytes())->uvs.empty()) << "where no texture asks for them";
    }
}

TEST_F(Ply, KeepsAnAlphaThatSaysSomething)
{
    const auto alphas = [&](uint8_t a, uint8_t b) {
        PlyText ply(Form::text,
                    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                    "property uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                    "element face 1\nproperty list uchar int vertex_index\n");
        const auto vertex = [&](std::initializer_list<float> place, uint8_t alpha) {
            ply.all(place).all({uint8_t{1}, uint8_t{2}, uint8_t{3}, alpha});
        };
        vertex({0, 0, 0}, a), vertex({1, 0, 0}, b), vertex({0, 1, 0}, b);
        ply.add(uint8_t{3}).all({0, 1, 2});
        const auto mesh = load(ply.bytes());
        return mesh ? mesh->alphas : std::vector<float>{-1};
    };
    EXPECT_EQ(alphas(51, 255), (std::vector<float>{0.2f, 1, 1}));
    EXPECT_THAT(alphas(255, 255), IsEmpty());
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_THAT(alphas(0, 0), IsEmpty());
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("the alpha of all vertices is 0")));
}

TEST_F(Ply, HasTextureCoordinatesOfFaces)
{
    PlyText ply(Form::big_endian,
                "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 2\n"
                "property list uchar int vertex_indices\nproperty list uchar float texcoord\n");
    ply.all({0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0});
    ply.add(uint8_t{4}).all({0, 1, 2, 3}).add(uint8_t{8}).all({0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f, 1.f});
    ply.add(uint8_t{3}).all({0, 2, 1}).add(uint8_t{2}).all({0.f, 0.f});
    const auto mesh = load(ply.bytes(), {.uvs = true});
    ASSERT_TRUE(mesh) << errors();
    ASSERT_EQ(mesh->uv_triangles.size(), 3u);
    for (size_t t = 0; t < 2; ++t)
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d p = mesh->positions[mesh->triangles[t][k]];
            EXPECT_EQ(mesh->uvs[mesh->uv_triangles[t][k]], (Vec2{static_cast<float>(p.x), static_cast<float>(p.y)}));
        }
    EXPECT_EQ(mesh->uv_triangles[2][0], MeshData::no_uv);
    EXPECT_THAT(warnings(),
                ElementsAre(HasSubstr("face without one pair of finite texture coordinates for each corner")));
}

// -1 ends a strip; a corner that comes twice turns it.
TEST_F(Ply, StripsAreTriangles)
{
    const auto mesh = load(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n10  0 1 2 3 3 4 -1 2 3 4\n");
    ASSERT_TRUE(mesh) << errors();
    using T = std::array<uint32_t, 3>;
    EXPECT_THAT(mesh->triangles, ElementsAre(T{0, 1, 2}, T{2, 1, 3}, T{2, 3, 4}));
    EXPECT_THAT(warnings(), IsEmpty());
}

// Read in parallel where all are triangles, else one by one.
TEST_F(Ply, OfManyFacesIsTheSameByBothWays)
{
    constexpr int side = 400;
    const auto grid = [&](bool has_quad) {
        constexpr int faces = 2 * (side - 1) * (side - 1);
        PlyText ply(Form::little_endian, "element vertex " + std::to_string(side * side) +
                                             "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                                             std::to_string(faces + (has_quad ? 1 : 0)) +
                                             "\nproperty list uchar int vertex_indices\n");
        for (int i = 0; i < side * side; ++i) ply.all({float(i % side), float(i / side), float(i % 7)});
        for (int y = 0; y + 1 < side; ++y)
            for (int x = 0; x + 1 < side; ++x) {
                const int a = y * side + x;
                ply.add(uint8_t{3})
                    .all({a, a + 1, a + side})
                    .add(uint8_t{3})
                    .all({a + 1, x == 9 ? a + 1 : a + side + 1, a + side});
            }
        if (has_quad) ply.add(uint8_t{4}).all({0, 1, side + 1, side});
        return ply.bytes();
    };
    const auto fast = load(grid(false));
    ASSERT_TRUE(fast) << errors();
    const std::vector<std::string> said = warnings();
    const auto slow = load(grid(true));
    ASSERT_TRUE(slow) << errors();
    EXPECT_EQ(said, warnings());
    ASSERT_EQ(fast->triangles.size() + 2, slow->triangles.size());
    EXPECT_TRUE(std::equal(fast->triangles.begin(), fast->triangles.end(), slow->triangles.begin()));
}

TEST_F(Ply, SmoothingGivesNormals)
{
    const std::string bytes = shapes<double, uint8_t, int32_t>(Form::text, "double", "uchar", "int");
    EXPECT_TRUE(load(bytes)->normals.empty());
    const MeshOptions all{.smoothing = {Smoothing::Faces::all, 80}};
    const auto obj = load_shapes_obj(all);
    EXPECT_EQ(load(bytes, all)->normals, obj->normals);
    EXPECT_FALSE(obj->normals.empty());
}

TEST_F(Ply, TellsWhatIsWrong)
{
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz;
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string places = "0 0 0\n1 0 0\n0 1 0\n";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "a.ply: error: not a PLY file: its first line must be ply"},
        {"plyx\n", "a.ply:1: error: not a PLY file"},
        {"ply\nformat asci 1.0\n", "a.ply:2: error: unknown format 'asci'; did you mean 'ascii'?"},
        {"ply\nformat ascii 2.0\n", "a.ply:2: error: format must have the version 1.0"},
        {"ply\nformat ascii 1.0\nelment vertex 3\n",
         "a.ply:3: error: unknown word 'elment' in the header; did you mean 'element'?"},
        {"ply\nelement vertex -3\n", "a.ply:2: error: element must have a name and a number"},
        {"ply\nproperty float x\n", "a.ply:2: error: property before any element"},
        {"ply\nelement vertex 3\nproperty flaot x\n",
         "a.ply:3: error: 'flaot' is no type of a property; did you mean 'float'?"},
        {"ply\nelement face 3\nproperty list float int x\n",
         "a.ply:3: error: 'float' is no type of the length of a list"},
        {"ply\nelement vertex 3\nend_header\n", "a.ply:3: error: the header has no format"},
        {"ply\nformat ascii 1.0\n", "a.ply:2: error: the header does not end"},
        {head + "end_header\n" + places, "error: the file has vertices, and no faces"},
        {"ply\nformat ascii 1.0\nend_header\n", "error: the file has no vertices"},
        {"ply\nformat ascii 1.0\n" + faces + "3 0 1 2\n", "error: faces stand before vertices"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n" + faces + "0\n3 0 0 0\n",
         "error: vertices have no x, y and z"},
        {head + "element face 1\nproperty int i\nend_header\n" + places + "3\n",
         "error: faces have no list vertex_indices"},
        {head + faces + "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n",
         "a.ply:11: error: no number, or the end of the file, in vertex 1 of 3"},
        {head + faces + "0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n", "error: a coordinate of vertex 1 is not a finite number"},
        {head + faces + places + "3 0 1 3\n",
         "a.ply:13: error: there are 3 vertices, and other numbers in face 0 of 1"},
        {head + faces + places + "3 0 1 -1\n", "and other numbers in face 0 of 1"},
        {head + faces + places + "4 0 1 2\n", "no number, or the end of the file, in face 0 of 1"},
        {head + faces + places + "250 0 1 2\n", "no number, or the end of the file, in face 0 of 1"},
        {head + faces + places + "3 0 0 1\n", "error: no face has an area"},
        {"ply\nformat ascii 1.0\nelement vertex 4000000000\n" + xyz + faces + places,
         "the header says 4000000000 of element 'vertex', more than the file can hold"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" + xyz + faces + places,
         "more than the file can hold"},
    };
    for (const auto& [bytes, expected] : cases) {
        EXPECT_FALSE(load(bytes)) << bytes;
        EXPECT_THAT(errors(), HasSubstr(expected)) << bytes;
    }
}

TEST_F(Ply, ThatIsCutOffIsRefused)
{
    for (const Form form : {Form::text, Form::little_endian}) {
        const std::string whole = shapes<double, uint8_t, int32_t>(form, "double", "uchar", "int");
        const size_t used = form == Form::text ? 4 : 0;  // the last digits of a number and its space
        for (size_t size = 0; size + used < whole.size(); size += 3) {
            EXPECT_FALSE(load(whole.substr(0, size))) << size;
            EXPECT_TRUE(diagnostics_.has_errors()) << size;
        }
    }
}

}  // namespace
}  // namespace lancer
