// Compressed glTF files. The compressed bytes were made by the encoders of meshoptimizer and Draco.
#include "gltf_file.h"
#include "io/base64.h"
#include "io/gltf/gltf.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const char* const meshopt_positions =
    "oAAAATPAAAD//4ABM8AAAH59gAAAAQzAAAD//wEMQAAAfgAAAQ8AAAD//wEPwAAAfHuAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=";
const char* const meshopt_octahedral = "oAEPwAAA/v3+AQPAAAD9AwAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAfwA=";
const char* const meshopt_exponential =
    "oAAAATPAAAAIBwwBIIAAAAABAMAAAIABDMAAAAgHASCAAAAAAAEJwAAACAEggAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADtAAAA7QAAAO0=";
const char* const meshopt_triangles = "4PAAMAB2h1ZneKmGZYlomAFpAAA=";
const char* const meshopt_sequence = "0AAEBAYIBAYMBgAAAAA=";
const char* const draco_mesh =
    "RFJBQ08CAgEAAAADBQEAAQIAAgMBBAIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAIA/AACAPgAAAAAAAIA/AAAAAAAAQEA"
    "AAAA+AAAAQA==";

// The vertices of a triangle, in whatever order it begins.
std::array<uint32_t, 3> from_least(std::array<uint32_t, 3> t)
{
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

class CompressedGltf : public ObjTest {
protected:
    // Of accessor 0 (positions), 1 (normals) and 2 (indices), each with a compressed view.
    GltfFile meshopt(const char* positions, const std::string& filter, const char* indices, const std::string& mode)
    {
        GltfFile file;
        const auto add = [&](const char* base64, size_t count, size_t stride, const std::string& how,
                             const std::string& accessor) {
            const std::string bytes = *decode_base64(base64);
            const std::string place = std::to_string((file.binary.size() + 3) / 4 * 4);
            const size_t view = file.add_view(
                bytes, ",\"byteStride\":" + std::to_string(stride) +
                           ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":" + place +
                           ",\"byteLength\":" + std::to_string(bytes.size()) + ",\"byteStride\":" +
                           std::to_string(stride) + ",\"count\":" + std::to_string(count) + "," + how + "}}");
            file.add_accessor("\"bufferView\":" + std::to_string(view) + ",\"count\":" + std::to_string(count) + "," +
                              accessor);
        };
        add(positions, 5, 12, "\"mode\":\"ATTRIBUTES\"" + filter, "\"componentType\":5126,\"type\":\"VEC3\"");
        add(meshopt_octahedral, 5, 4, "\"mode\":\"ATTRIBUTES\",\"filter\":\"OCTAHEDRAL\"",
            "\"componentType\":5120,\"normalized\":true,\"type\":\"VEC3\"");
        add(indices, 9, 4, "\"mode\":\"" + mode + "\"", "\"componentType\":5125,\"type\":\"SCALAR\"");
        file.add_mesh("\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2");
        file.rest = "\"extensionsRequired\":[\"EXT_meshopt_compression\"]";
        return file;
    }
    static GltfFile draco(const std::string& attributes, const std::string& bytes)
    {
        GltfFile file;
        const size_t view = file.add_view(bytes);
        file.add_accessor("\"componentType\":5126,\"type\":\"VEC3\",\"count\":5");
        file.add_accessor("\"componentType\":5121,\"type\":\"SCALAR\",\"count\":9");
        file.add_mesh(
            "\"attributes\":{\"POSITION\":0},\"indices\":1,\"extensions\":{\"KHR_draco_mesh_compression\":{"
            "\"bufferView\":" +
            std::to_string(view) + ",\"attributes\":{" + attributes + "}}}");
        file.rest = "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]";
        return file;
    }
    std::shared_ptr<const MeshData> load_file(const GltfFile& file)
    {
        diagnostics_ = {};
        return load_gltf(write("a.glb", file.glb()), diagnostics_);
    }
    void expect_square(const MeshData& mesh)
    {
        EXPECT_THAT(mesh.positions,
                    ElementsAre(Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1, 1, 0.25}, Vec3d{0, 1, 0}, Vec3d{3, 0.125, 2}));
        std::vector<std::array<uint32_t, 3>> triangles;
        for (const auto& t : mesh.triangles) triangles.push_back(from_least(t));
        EXPECT_THAT(triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{1, 4, 2}));
    }
};

TEST_F(CompressedGltf, ByMeshoptimizerIsTheMesh)
{
    const char* const exponential = ",\"filter\":\"EXPONENTIAL\"";
    for (const GltfFile& file : {meshopt(meshopt_positions, "", meshopt_triangles, "TRIANGLES"),
                                 meshopt(meshopt_positions, "", meshopt_sequence, "INDICES"),
                                 meshopt(meshopt_exponential, exponential, meshopt_triangles, "TRIANGLES")}) {
        const auto mesh = load_file(file);
        ASSERT_TRUE(mesh) << errors();
        expect_square(*mesh);
        ASSERT_EQ(mesh->normals.size(), 5u);
        EXPECT_NEAR(mesh->normals[0].z, 1, 0.02);
        EXPECT_NEAR(mesh->normals[2].x, 1, 0.02);
        EXPECT_NEAR(mesh->normals[3].y, -1, 0.02);
        EXPECT_NEAR(mesh->normals[4].z, -1, 0.02);
    }
}

TEST_F(CompressedGltf, ByDracoIsTheMesh)
{
    const auto mesh = load_file(draco("\"POSITION\":0", *decode_base64(draco_mesh)));
    ASSERT_TRUE(mesh) << errors();
    expect_square(*mesh);
}

TEST_F(CompressedGltf, ThatIsBrokenIsRefused)
{
    const auto expect = [&](const GltfFile& file, const std::string& words) {
        EXPECT_FALSE(load_file(file)) << words;
        EXPECT_THAT(errors(), HasSubstr(words));
    };
    const std::string good = *decode_base64(draco_mesh);
    expect(draco("\"POSITION\":0", good.substr(0, 40)), "KHR_draco_mesh_compression: what is compressed is broken");
    expect(draco("\"POSITION\":7", good), "there is no compressed attribute for POSITION");
    expect(draco("\"POSITION\":\"a\"", good), "is a string, not a number");
    expect(meshopt(meshopt_positions, "", meshopt_sequence, "TRIANGLES"), "what is compressed is broken");
    expect(meshopt(meshopt_positions, ",\"filter\":\"QUATERNION\"", meshopt_sequence, "INDICES"), "do not fit");
    expect(meshopt(meshopt_positions, ",\"filter\":\"X\"", meshopt_sequence, "INDICES"), "'filter' is 'X'");
    GltfFile large;
    const std::string bytes = *decode_base64(meshopt_positions);
    large.add_view(bytes,
                   ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteLength\":83,\"byteStride\":12,"
                   "\"count\":9007199254740991,\"mode\":\"ATTRIBUTES\"}}");
    large.add_accessor("\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":5");
    large.add_mesh("\"attributes\":{\"POSITION\":0}");
    expect(large, "'count' is more than 83 bytes can make");
}

}  // namespace
}  // namespace lancer
