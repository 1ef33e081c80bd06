// glTF files: each form of a mesh is the mesh of the OBJ file, and what is broken is told.
#include "io/gltf/gltf.h"

#include "gltf_file.h"
#include "io/mesh_file.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Two triangles of a square, and one above.
const char* const square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0.25\nv 0 1 0\nv 3 0.125 2\nf 1 2 3\nf 1 3 4\nf 2 5 3\n";
const std::vector<double> square_positions{0, 0, 0, 1, 0, 0, 1, 1, 0.25, 0, 1, 0, 3, 0.125, 2};
const std::vector<double> square_indices{0, 1, 2, 0, 2, 3, 1, 4, 2};

class Gltf : public ObjTest {
protected:
    std::shared_ptr<const MeshData> load(const std::string& bytes, const MeshOptions& options = {})
    {
        diagnostics_ = {};
        return load_mesh(write("a.gltf", bytes), diagnostics_, options);
    }
    std::shared_ptr<const MeshData> load(const GltfFile& file, const MeshOptions& options = {})
    {
        return load(file.glb(), options);
    }
    // Of one primitive with its members.
    static GltfFile square(const std::string& more = "")
    {
        GltfFile file;
        const size_t p = file.add<float>(square_positions, "VEC3"), i = file.add<uint16_t>(square_indices, "SCALAR");
        file.add_mesh("\"attributes\":{\"POSITION\":" + std::to_string(p) + "},\"indices\":" + std::to_string(i) +
                      (more.empty() ? "" : "," + more));
        return file;
    }
    void expect_error(const std::string& bytes, const std::string& words)
    {
        EXPECT_FALSE(load(bytes)) << words;
        EXPECT_THAT(errors(), HasSubstr(words));
        EXPECT_THAT(errors(), HasSubstr("a.gltf"));
    }
};

std::string with(std::string text, const std::string& from, const std::string& to)
{
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST_F(Gltf, OfEachFormAndTypeOfIndicesIsTheMeshOfTheObjFile)
{
    Diagnostics none;
    const auto obj = load_mesh(write("a.obj", square_obj), none);
    ASSERT_TRUE(obj);
    std::vector<std::string> forms;
    for (const int size : {1, 2, 4}) {
        GltfFile file;
        const size_t p = file.add<float>(square_positions, "VEC3");
        std::string attributes = "\"attributes\":{\"POSITION\":" + std::to_string(p) + "},\"mode\":4";
        const size_t i = size == 1   ? file.add<uint8_t>(square_indices, "SCALAR")
                         : size == 2 ? file.add<uint16_t>(square_indices, "SCALAR")
                                     : file.add<uint32_t>(square_indices, "SCALAR");
        file.add_mesh(attributes + ",\"indices\":" + std::to_string(i));
        forms.push_back(file.glb());
        forms.push_back(file.embedded());
        const std::string number = std::to_string(size);
        write("buffer " + number + ".bin", file.binary);
        forms.push_back(file.json("buffer%20" + number + ".bin"));
        forms.push_back(file.json("buffer " + number + ".bin"));
        forms.push_back("\xEF\xBB\xBF" + file.embedded());
    }
    for (const std::string& form : forms) {
        const auto gltf = load(form);
        ASSERT_TRUE(gltf) << errors() << form;
        EXPECT_EQ(gltf->positions, obj->positions);
        EXPECT_EQ(gltf->triangles, obj->triangles);
        EXPECT_EQ(gltf->materials.size(), 1u);
        EXPECT_THAT(warnings(), IsEmpty());
    }
}

TEST_F(Gltf, WithoutIndicesInStripsAndFansHasTheSameTriangles)
{
    const std::vector<double> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 2, 0};
    using Triangles = std::vector<std::array<uint32_t, 3>>;
    const std::vector<std::pair<int, Triangles>> modes{
        {5, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}}, {6, {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}}, {4, {{0, 1, 2}}}};
    for (const auto& [mode, triangles] : modes) {
        GltfFile file;
        const size_t p = file.add<float>(strip, "VEC3");
        file.add_mesh("\"attributes\":{\"POSITION\":" + std::to_string(p) + "},\"mode\":" + std::to_string(mode));
        const auto gltf = load(file);
        ASSERT_TRUE(gltf) << errors();
        // A fan about a corner whose first triangles fold back keeps them all.
        EXPECT_EQ(gltf->triangles, mode == 6 ? Triangles({{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}) : triangles) << mode;
        if (mode == 4) {
            EXPECT_THAT(warnings(), ElementsAre(HasSubstr("corners left over")));
        }
    }
}

TEST_F(Gltf, PointsAndLinesAreCountedAsLeftOut)
{
    GltfFile file = square();
    for (const char* mode : {"0", "1", "3"})
        file.add_mesh(std::string("\"attributes\":{\"POSITION\":0},\"mode\":") + mode);
    const auto gltf = load(file);
    ASSERT_TRUE(gltf) << errors();
    EXPECT_EQ(gltf->triangles.size(), 3u);
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("meshes[1].primitives[0]: points and lines are left out (3 times")));
}

TEST_F(Gltf, ReadsNormalsCoordinatesAndColoursOfEveryType)
{
    for (const bool close : {true, false}) {
        const auto stride = [&](size_t bytes) { return close ? 0 : bytes; };
        GltfFile file;
        file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", "", stride(20));
        file.add<int8_t>({0, 0, 127, 0, 0, 127, 0, -127, 0}, "VEC3", "\"normalized\":true", stride(4));
        file.add<uint16_t>({0, 0, 65535, 0, 0, 13107}, "VEC2", "\"normalized\":true", stride(8));
        file.add<uint8_t>({255, 0, 0, 255, 0, 51, 0, 255, 0, 0, 255, 255}, "VEC4", "\"normalized\":true", stride(8));
        file.add_mesh("\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"COLOR_0\":3}");
        MeshOptions options;
        options.uvs = true;
        const auto gltf = load(file, options);
        ASSERT_TRUE(gltf) << errors();
        EXPECT_THAT(gltf->normals, ElementsAre(Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, -1, 0}));
        EXPECT_THAT(gltf->normal_triangles, ElementsAre(std::array<uint32_t, 3>{0, 1, 2}));
        EXPECT_THAT(gltf->uvs, ElementsAre(Vec2{0, 1}, Vec2{1, 1}, Vec2{0, 0.8f}));
        EXPECT_THAT(gltf->colors, ElementsAre(Color{1, 0, 0}, Color{0, 0.2f, 0}, Color{0, 0, 1}));
        EXPECT_THAT(warnings(), IsEmpty());
    }
}

TEST_F(Gltf, QuantizedPositionsAreScaledByTheirNode)
{
    GltfFile file;
    file.add<int16_t>({0, 0, 0, 32767, 0, 0, 0, -32768, 0}, "VEC3", "\"normalized\":true", 8);
    file.add<uint8_t>({0, 0, 0, 200, 0, 0, 0, 100, 0}, "VEC3", "", 4);
    file.add_mesh("\"attributes\":{\"POSITION\":0}", "\"scale\":[2,2,2]");
    file.add_mesh("\"attributes\":{\"POSITION\":1}");
    file.rest = "\"extensionsUsed\":[\"KHR_mesh_quantization\"],\"extensionsRequired\":[\"KHR_mesh_quantization\"]";
    const auto gltf = load(file);
    ASSERT_TRUE(gltf) << errors();
    EXPECT_THAT(gltf->positions, ElementsAre(Vec3d{0, 0, 0}, Vec3d{2, 0, 0}, Vec3d{0, -2, 0}, Vec3d{0, 0, 0},
                                             Vec3d{200, 0, 0}, Vec3d{0, 100, 0}));
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(Gltf, SparseAccessorsReplaceElements)
{
    for (const bool has_base : {true, false}) {
        GltfFile file;
        const size_t base = file.add<float>({0, 0, 0, 1, 0, 0, 9, 9, 9, 0, 1, 0}, "VEC3");
        const size_t at = file.add_view(std::string("\2\0\3\0", 4));
        std::string raw;
        for (const float x : {1.f, 2.f, 0.f, 0.f, 5.f, 0.f}) raw.append(reinterpret_cast<const char*>(&x), 4);
        const size_t values = file.add_view(raw);
        file.add_accessor((has_base ? "\"bufferView\":" + std::to_string(base) + "," : "") +
                          "\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":2,\"indices\":{"
                          "\"bufferView\":" +
                          std::to_string(at) +
                          ",\"componentType\":5123},\"values\":{\"bufferView\":" + std::to_string(values) + "}}");
        file.add<uint8_t>({1, 2, 3}, "SCALAR");
        file.add_mesh("\"attributes\":{\"POSITION\":1},\"indices\":2");
        const auto gltf = load(file);
        ASSERT_TRUE(gltf) << errors();
        EXPECT_THAT(gltf->positions,
                    ElementsAre(Vec3d{}, has_base ? Vec3d{1, 0, 0} : Vec3d{}, Vec3d{1, 2, 0}, Vec3d{0, 5, 0}));
    }
}

TEST_F(Gltf, NodesPlaceMeshesAndAMirrorKeepsWhatFacesTheFront)
{
    GltfFile file = square();
    file.add_node("\"translation\":[10,0,0],\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],\"children\":[2]");
    file.add_node("\"scale\":[-2,1,1],\"mesh\":0");
    file.add_node("\"matrix\":[1,0,0,0, 0,0,1,0, 0,-1,0,0, 0,0,7,1],\"mesh\":0");
    file.roots = "0,1,3";
    const auto gltf = load(file);
    ASSERT_TRUE(gltf) << errors();
    ASSERT_EQ(gltf->positions.size(), 15u);
    // Turned by a quarter about z: x becomes y.
    EXPECT_NEAR(gltf->positions[6].x, 10, 1e-12);
    EXPECT_NEAR(gltf->positions[6].y, -2, 1e-12);
    EXPECT_EQ(gltf->positions[13], (Vec3d{0, 0, 8}));
    EXPECT_EQ(gltf->triangles[0], (std::array<uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(gltf->triangles[3], (std::array<uint32_t, 3>{5, 7, 6})) << "mirrored";
    EXPECT_EQ(gltf->triangles[6], (std::array<uint32_t, 3>{10, 11, 12}));
}

TEST_F(Gltf, InstancesAreReadOfEveryTypeAndSparse)
{
    const std::string use = "\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{";
    const auto file_with = [&](const std::string& attributes) {
        GltfFile file;
        file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        file.add<int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", "\"normalized\":true");
        file.add<float>({0, 0, 1, 0, 0, 2}, "VEC3");
        const size_t numbers = file.add_view(GltfFile::word(1)), values = file.add_view(std::string(12, '\0'));
        file.add_accessor(
            "\"componentType\":5126,\"count\":2,\"type\":\"VEC3\",\"sparse\":{\"count\":1,"
            "\"indices\":{\"bufferView\":" +
            std::to_string(numbers) + ",\"componentType\":5125},\"values\":{\"bufferView\":" + std::to_string(values) +
            "}}");
        file.add<float>({1, 2, 1, 2, 4, 8}, "VEC3");
        file.add_mesh("\"attributes\":{\"POSITION\":0}", "\"scale\":[1,1,2]," + use + attributes + "}}}");
        return file;
    };
    const auto mesh = load(file_with("\"ROTATION\":1,\"TRANSLATION\":2,\"_ID\":2"));
    ASSERT_TRUE(mesh) << errors();
    EXPECT_THAT(mesh->positions, ElementsAre(Vec3d{0, 0, 2}, Vec3d{1, 0, 2}, Vec3d{0, 1, 2}, Vec3d{0, 0, 4},
                                             Vec3d{-1, 0, 4}, Vec3d{0, -1, 4}));
    const auto sparse = load(file_with("\"TRANSLATION\":3,\"SCALE\":4"));
    ASSERT_TRUE(sparse) << errors();
    EXPECT_THAT(sparse->positions,
                ElementsAre(Vec3d{}, Vec3d{1, 0, 0}, Vec3d{0, 2, 0}, Vec3d{}, Vec3d{2, 0, 0}, Vec3d{0, 4, 0}));
    for (const char* attributes : {"", "\"_ID\":2"}) {
        const auto alone = load(file_with(attributes));
        ASSERT_TRUE(alone) << errors();
        EXPECT_EQ(alone->triangles.size(), 1u) << "without a place of its own the node is all";
    }
    expect_error(file_with("\"ROTATION\":1,\"TRANSLATION\":0").glb(), "different counts");
    expect_error(file_with("\"TRANSLATION\":1").glb(), "TRANSLATION of instances has not 3 components");
    expect_error(file_with("\"SCALE\":9").glb(), "SCALE");
    GltfFile lame = file_with("\"ROTATION\":5");
    lame.add<float>({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4");
    expect_error(lame.glb(), "instance 1 has numbers that are not finite, or a rotation that cannot be normalised");
}

TEST_F(Gltf, MaterialsFollowTheirPrimitivesAndShareVertices)
{
    GltfFile file;
    file.add<float>(square_positions, "VEC3");
    file.add<uint8_t>({0, 1, 2}, "SCALAR");
    file.add<uint8_t>({0, 2, 3}, "SCALAR");
    file.add_mesh(
        "\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":1},{\"attributes\":{\"POSITION\":0},\"indices\":2");
    file.rest = "\"materials\":[{\"name\":\"unused\"},{\"name\":\"red\"}]";
    const auto gltf = load(file);
    ASSERT_TRUE(gltf) << errors();
    EXPECT_EQ(gltf->positions.size(), 5u);
    EXPECT_THAT(gltf->face_material, ElementsAre(0u, 1u));
    EXPECT_EQ(gltf->materials[0].name, "red");
    EXPECT_EQ(gltf->materials[1].name, "default");
}

TEST_F(Gltf, SmoothsWhereTheFileHasNoNormals)
{
    MeshOptions options;
    EXPECT_TRUE(load(square(), options)->normals.empty());
    options.smoothing = {.faces = Smoothing::Faces::all, .largest_deg = 180};
    EXPECT_FALSE(load(square(), options)->normals.empty());
}

TEST_F(Gltf, ThatIsBrokenIsRefusedWithItsPlace)
{
    const std::string good = square().embedded(), glb = square().glb();
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& words) {
        expect_error(with(good, from, to), words);
    };
    expect("\"POSITION\":0", "\"POSITION\":9", "meshes[0].primitives[0].attributes.POSITION: there is no such element");
    expect("\"POSITION\":0", "\"POSITION\":-1", "there is no such element");
    expect("\"POSITION\":0", "\"POSITION\":0.5", "there is no such element");
    expect("\"POSITION\":0", "\"POSITION\":\"0\"", "POSITION: is a string, not a number");
    expect("\"count\":5", "\"count\":6", "accessors[0]: 6 elements from byte 0 on are not within the buffer view");
    expect("\"count\":5", "\"count\":9007199254740991", "are not within the buffer view");
    expect("\"count\":5", "\"count\":1e300", "is not a whole number");
    expect("\"count\":5", "\"count\":4", "meshes[0].primitives[0]: index 7 is beyond the 4 vertices");
    expect("\"componentType\":5126", "\"componentType\":5124", "'componentType' is 5124");
    expect("\"componentType\":5123", "\"componentType\":5122", "indices are not single numbers");
    expect("\"type\":\"VEC3\"", "\"type\":\"VEC5\"", "'type' is none of");
    expect("\"type\":\"VEC3\"", "\"type\":\"VEC2\"", "has 2 components, which POSITION has not");
    expect("\"byteLength\":60", "\"byteLength\":9007199254740991",
           "bufferViews[0]: 9007199254740991 bytes from byte 0");
    expect("\"byteOffset\":0", "\"byteOffset\":9007199254740991", "are not within the buffer");
    expect("\"byteLength\":78,\"uri\"", "\"byteLength\":79,\"uri\"", "buffers[0]: there are 78 bytes");
    expect("base64,", "base64,!", "the data URI is not base64");
    expect("\"nodes\":[0]", "\"nodes\":[1]", "scenes[0].nodes[0]: there is no such element of 'nodes'");
    expect("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}", "nodes[0]: the node is reached twice");
    expect("{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1e308,1e308,1],\"children\":[1]},{\"mesh\":0,\"scale\":[1e308,1,1]}",
           "nodes[1]: the transform has numbers that are not finite");
    expect("{\"mesh\":0}", "{\"mesh\":0,\"rotation\":[0,0,0,0]}", "no quaternion");
    expect("{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[1,2]}", "not 16 numbers");
    expect("\"asset\"", "\"azzet\"", "there is no 'asset'");
    expect("\"2.0\"", "\"1.0\"", "version is '1.0'");
    expect("\"scene\":0", "\"extensionsRequired\":[\"KHR_nonsense\"],\"scene\":0",
           "the file requires an extension that is not read: 'KHR_nonsense'");
    expect("\"scene\":0", "\"scene\":0 0", "a.gltf:1: error: not a glTF file: no JSON");
    expect_error("", "no JSON");
    expect_error("[]", "its JSON is no object");
    expect_error(std::string(100000, '['), "more than 100 deep");
    expect_error(glb.substr(0, glb.size() - 4), "it is cut off");
    expect_error(glb.substr(0, 10), "the file ends in its header");
    expect_error(with(glb, "glTF" + GltfFile::word(2), "glTF" + GltfFile::word(1)), "a GLB file of version 1");
    expect_error(with(glb, "JSON{", std::string("BIN\0{", 5)), "the first chunk is not the JSON");
    expect_error(with(glb, GltfFile::word(80) + std::string("BIN\0", 4), GltfFile::word(800) + std::string("BIN\0", 4)),
                 "a chunk of 800 bytes from byte");
    GltfFile none;
    none.add_node("\"name\":\"empty\"");
    expect_error(none.embedded(), "the default scene has no triangle with an area");
    GltfFile broken = square();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(broken.binary.data() + 16, &nan, 4);
    expect_error(broken.glb(), "accessors[0]: a coordinate of vertex 1 is not a finite number");

    diagnostics_ = {};
    EXPECT_FALSE(load(square().json("none.bin")));
    EXPECT_THAT(errors(), HasSubstr("buffers[0]: file 'none.bin' not found"));
    try {
        diagnostics_.throw_if_errors();
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::missing_input);
    }
}

TEST_F(Gltf, WhatIsNotReadIsOneWarningForEachKind)
{
    GltfFile file = square("\"targets\":[{}]");
    file.add_mesh("\"attributes\":{\"POSITION\":0},\"indices\":1", "\"scale\":[0,1,1]");
    file.add_mesh("\"attributes\":{\"POSITION\":0},\"indices\":1", "\"skin\":0");
    file.rest = "\"animations\":[{}],\"extensionsUsed\":[\"VENDOR_a\",\"KHR_texture_transform\"]";
    const auto gltf = load(file);
    ASSERT_TRUE(gltf) << errors();
    EXPECT_EQ(gltf->triangles.size(), 6u);
    EXPECT_THAT(warnings(), ElementsAre(HasSubstr("extensionsUsed[0]: extension 'VENDOR_a' is not read"),
                                        HasSubstr("animations: animations are not used"),
                                        HasSubstr("meshes[0].primitives[0]: morph targets are not used"),
                                        HasSubstr("nodes[1]: a node that scales its mesh to nothing"),
                                        HasSubstr("nodes[2]: skins are not used")));
}

TEST_F(Gltf, OfTheCollectionIsReadOrRefused)
{
    for (const std::string& path : malformed_files("gltf")) {
        if (!path.ends_with(".gltf") && !path.ends_with(".glb")) continue;
        Diagnostics said;
        const auto mesh = load_mesh(path, said);
        EXPECT_EQ(mesh == nullptr, said.has_errors()) << path;
    }
}

}  // namespace
}  // namespace lancer
