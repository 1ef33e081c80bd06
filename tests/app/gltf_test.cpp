// glTF files as a user gives them: alone, with their cameras and lights, and in a scene.
#include <gtest/gtest.h>

#include "app/run_program.h"
#include "io/gltf_file.h"
#include "io/image/png.h"

namespace lancer {
namespace {

const std::vector<double> corners{0.1, 0, 0, 2, 0, 0, 2, 0, 1, 0, 0, 1.3, 0, 3, 0, 2, 3.7, 0, 2, 3, 1, 0, 3, 1};
const std::vector<double> faces{0, 1, 2, 0, 2, 3, 4, 7, 6, 4, 6, 5, 0, 4, 5, 0, 5, 1,
                                1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};

std::string nine_digits(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g ", static_cast<double>(static_cast<float>(x)));
    return text;
}

class GltfFiles : public AppTest {
protected:
    GltfFiles()
    {
        GltfFile file;
        file.add<float>(corners, "VEC3");
        file.add<uint16_t>(faces, "SCALAR");
        file.add_mesh("\"attributes\":{\"POSITION\":0},\"indices\":1");
        write("block.glb", file.glb());
        write("block.GLTF", file.embedded());
        std::string obj,
            ply =
                "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
                "z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n";
        for (size_t i = 0; i < corners.size(); i += 3) {
            const std::string place =
                nine_digits(corners[i]) + nine_digits(corners[i + 1]) + nine_digits(corners[i + 2]);
            obj += "v " + place + "\n", ply += place + "\n";
        }
        for (size_t i = 0; i < faces.size(); i += 3) {
            obj += "f", ply += "3";
            for (size_t k = 0; k < 3; ++k) {
                const int v = static_cast<int>(faces[i + k]);
                obj += " " + std::to_string(v + 1), ply += " " + std::to_string(v);
            }
            obj += "\n", ply += "\n";
        }
        write("block.obj", obj);
        write("block.ply", ply);
    }
    void render(const std::string& scene, const std::string& to, const Arguments& more = {})
    {
        const Said said = run(Arguments{"render", scene, "--size", "32x24", "-s", "4", "-q", "-o", to} + more);
        ASSERT_EQ(said.code, 0) << said.err;
    }
    // A square of one texture, seen from before, as OBJ or as glTF.
    void write_square_picture()
    {
        Image picture = make_image(4, 4);
        picture.at(0, 0) = {1, 0, 0}, picture.at(3, 0) = {0, 1, 0}, picture.at(0, 3) = {0, 0, 1};
        picture.at(2, 1) = {1, 1, 1};
        write_png(folder_.file("wood.png"), picture);
    }
};

TEST_F(GltfFiles, HaveThePixelsOfObjAndPlyFiles)
{
    const std::string rest =
        "material = \"red\"\n[material.red]\ntype = \"plastic\"\nbase_color = [0.7, 0.1, 0.1]\nroughness = 0.3\n"
        "[[light]]\ntype = \"environment\"\nradiance = 1\n";
    for (const std::string mesh : {"block.obj", "block.ply", "block.glb", "block.GLTF"}) {
        write(mesh + ".toml", "[[mesh]]\nfile = \"" + mesh + "\"\n" + rest);
        render(mesh + ".toml", mesh + ".exr");
        EXPECT_TRUE(same_pixels(image("block.obj.exr"), image(mesh + ".exr"))) << mesh;
        render(mesh, mesh + ".bare.exr");
        EXPECT_TRUE(same_pixels(image("block.obj.bare.exr"), image(mesh + ".bare.exr"))) << mesh;
    }
    EXPECT_EQ(run({"block.glb", "--size", "8x6", "-s", "1", "-q", "-o", "a.exr"}).code, 0) << "without a command";
    expect_words(run({"info", "block.glb"}).out, "12, drawn 12");
    EXPECT_EQ(run({"check", "block.glb"}).code, 0);
}

TEST_F(GltfFiles, TexturesLieAsThoseOfObjFilesDo)
{
    write_square_picture();
    write("square.mtl", "newmtl wood\nmap_Kd wood.png\n");
    write("square.obj",
          "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wood\n"
          "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    GltfFile file;
    file.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    file.add<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    file.add<uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    file.add_mesh("\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,\"material\":0");
    const size_t view = file.add_view(read_bytes(folder_.file("wood.png")));
    const std::string textures =
        "],\"textures\":[{\"source\":0}],\"materials\":[{\"name\":\"wood\",\"pbrMetallicRoughness\":{"
        "\"baseColorTexture\":{"
        "\"index\":0}}}]";
    const std::string data = to_base64(read_bytes(folder_.file("wood.png")));
    const std::vector<std::string> images{"{\"uri\":\"wood.png\"}", "{\"bufferView\":" + std::to_string(view) + "}",
                                          "{\"uri\":\"data:image/png;base64," + data + "\"}"};
    const std::string rest =
        "[[material_override]]\nmatch = \"wood\"\ntype = \"lambert\"\n[[light]]\ntype = \"environment\"\nradiance = 1\n"
        "[camera]\nposition = [0.5, 0.5, 2]\ntarget = [0.5, 0.5, 0]\n";
    write("square.toml", "[[mesh]]\nfile = \"square.obj\"\n" + rest);
    render("square.toml", "obj.exr");
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string name = "square" + std::to_string(i);
        file.rest = "\"images\":[" + images[i] + textures;
        write(name + ".glb", file.glb());
        write(name + ".toml", "[[mesh]]\nfile = \"" + name + ".glb\"\n" + rest);
        render(name + ".toml", name + ".exr");
        EXPECT_TRUE(same_pixels(image("obj.exr"), image(name + ".exr"))) << images[i];
        const Said checked = run({"check", name + ".toml"});
        EXPECT_EQ(checked.code, 0) << checked.out;
    }
}

TEST_F(GltfFiles, ColoursOfVerticesAreLinear)
{
    const std::string vertices[3] = {"0 0 0", "1 0 0", "0 1 0"};
    GltfFile file;
    file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    file.add<float>({0.5, 0.25, 0.125, 0.5, 0.25, 0.125, 0.5, 0.25, 0.125}, "VEC3");
    file.add_mesh("\"attributes\":{\"POSITION\":0,\"COLOR_0\":1}");
    write("color.glb", file.glb());
    std::string obj;
    for (const std::string& v : vertices) obj += "v " + v + " 0.5 0.25 0.125\n";
    write("color.obj", obj + "f 1 2 3\n");
    const std::string rest = "[[light]]\ntype = \"environment\"\nradiance = 1\n";
    write("obj.toml", "[[mesh]]\nfile = \"color.obj\"\nvertex_colors = \"linear\"\n" + rest);
    write("glb.toml", "[[mesh]]\nfile = \"color.glb\"\n" + rest);
    write("srgb.toml", "[[mesh]]\nfile = \"color.glb\"\nvertex_colors = \"srgb\"\n" + rest);
    for (const std::string scene : {"obj", "glb", "srgb"}) render(scene + ".toml", scene + ".exr");
    EXPECT_TRUE(same_pixels(image("obj.exr"), image("glb.exr")));
    EXPECT_FALSE(same_pixels(image("srgb.exr"), image("glb.exr")));
}

GltfFile room()
{
    GltfFile file;
    file.add<float>(corners, "VEC3", "\"min\":[0,0,0],\"max\":[2,3.7,1.3]");
    file.add<uint16_t>(faces, "SCALAR");
    file.add_mesh("\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0");
    file.add_node("\"name\":\"front\",\"camera\":0,\"translation\":[1,1.5,9]");
    file.add_node("\"camera\":1,\"translation\":[0,0,4],\"rotation\":[0,0.7071067811865476,0,0.7071067811865476]");
    file.add_node("\"camera\":2");
    file.add_node("\"translation\":[3,4,5],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}");
    file.add_node(
        "\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}");
    file.add_node("\"translation\":[1,1.5,9],\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}");
    file.rest =
        "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.6,\"aspectRatio\":2,\"znear\":0.1}},"
        "{\"name\":\"side\",\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}},"
        "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0,\"zfar\":1}}],"
        "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
        "{\"type\":\"point\",\"color\":[1,0.5,0],\"intensity\":683,\"range\":7},"
        "{\"type\":\"directional\",\"intensity\":2},"
        "{\"type\":\"spot\",\"intensity\":900,\"spot\":{\"innerConeAngle\":0.25,\"outerConeAngle\":0.5}}]}}";
    return file;
}

TEST_F(GltfFiles, CamerasAndLightsAreThoseOfTheFile)
{
    write("room.glb", room().glb());
    write("room.toml",
          "[[mesh]]\nfile = \"room.glb\"\n[camera]\nposition = [1, 1.5, 9]\ntarget = [1, 1.5, 0]\nfov = "
          "34.37746770784939\n"
          "[[light]]\ntype = \"point\"\nposition = [3, 4, 5]\nintensity = [683, 341.5, 0]\n"
          "[[light]]\ntype = \"directional\"\ndirection = [0, -1, 0]\nirradiance = 2\n"
          "[[light]]\ntype = \"spot\"\nposition = [1, 1.5, 9]\nintensity = 900\ndirection = [0, 0, -1]\n"
          "inner_angle = 14.32394487827058\nouter_angle = 28.64788975654116\n");
    render("room.glb", "a.exr");
    render("room.toml", "b.exr");
    const Image a = image("a.exr"), b = image("b.exr");
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    for (size_t i = 0; i < a.pixels.size(); ++i)
        ASSERT_NEAR(a.pixels[i].r, b.pixels[i].r, 1e-3f * (1 + b.pixels[i].r)) << i;
    const Said said = run({"room.glb", "-s", "1", "-o", "c.exr"});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_EQ(image("c.exr").display.width(), 1440) << "720 times the aspect of the camera";
    expect_words(said.err, "cameras[2]: a camera that is not a perspective one is not used");
    expect_words(said.err, "the range of a light is not used");
    EXPECT_EQ(said.err.find("(2 times"), std::string::npos) << said.err;
    EXPECT_EQ(said.err.find("added to the scene"), std::string::npos) << said.err;
    render("room.glb", "side.exr", {"--camera", "side"});
    EXPECT_FALSE(same_pixels(image("a.exr"), image("side.exr")));
    render("room.glb", "wide.exr", {"-D", "camera.fov=90"});
    EXPECT_FALSE(same_pixels(image("a.exr"), image("wide.exr")));
    expect_words(run({"info", "room.glb"}).out, "front");
}

TEST_F(GltfFiles, LampsOfBlenderAreInWatts)
{
    GltfFile file = room();
    file.generator = "Khronos glTF Blender I/O v3.6.6";
    write("room.glb", room().glb());
    write("blender.glb", file.glb());
    render("room.glb", "a.exr", {"-D", "light.1.irradiance=0", "-D", "light.2.intensity=0", "--set", "indirect=false"});
    render("blender.glb", "b.exr",
           {"-D", "light.1.irradiance=0", "-D", "light.2.intensity=0", "--set", "indirect=false"});
    const Image a = image("a.exr"), b = image("b.exr");
    double sum_a = 0, sum_b = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        sum_a += static_cast<double>(a.pixels[i].r), sum_b += static_cast<double>(b.pixels[i].r);
    EXPECT_GT(sum_a, 0);
    EXPECT_NEAR(sum_a / sum_b, 683, 0.1);
}

TEST_F(GltfFiles, NodesThatShareALargeMeshAreInstances)
{
    constexpr int side = 24;
    GltfFile file;
    std::vector<double> places, indices;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) places.insert(places.end(), {x / 24.0, y / 24.0, 0.01 * (x * y % 5)});
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double a = y * (side + 1) + x;
            indices.insert(indices.end(), {a, a + 1, a + side + 2, a, a + side + 2, a + side + 1});
        }
    file.add<float>(places, "VEC3");
    file.add<uint16_t>(indices, "SCALAR");
    file.add_mesh("\"attributes\":{\"POSITION\":0},\"indices\":1", "\"rotation\":[0,0.6,0,0.8]");
    file.add_node("\"mesh\":0,\"translation\":[1.5,0,0],\"scale\":[-1,2,1]");
    file.add_node("\"mesh\":0,\"matrix\":[0,0,-1,0, 0,1,0,0, 1,0,0,0, -1,0.5,0,1]");
    write("many.glb", file.glb());
    write("many.toml", "[[mesh]]\nfile = \"many.glb\"\n");
    expect_words(run({"info", "many.glb"}).out, "3 instances, 1 mesh");
    expect_words(run({"info", "many.toml"}).out, "3456, drawn 3456");
    const std::string light =
        "light=[{type=\"environment\",radiance=1},{type=\"directional\",direction=[-1,-1,-2],irradiance=3}]";
    for (const std::string scene : {"many.glb", "many.toml"})
        render(scene, scene + ".exr",
               {"-s", "64", "-D", light, "-D", "camera.position=[1,1,6]", "-D", "camera.target=[0.5,0.8,0]"});
    const Image one = image("many.glb.exr"), copied = image("many.toml.exr");
    double difference = 0, sum = 0;
    for (size_t i = 0; i < one.pixels.size(); ++i) {
        difference += std::abs(static_cast<double>(one.pixels[i].g - copied.pixels[i].g));
        sum += static_cast<double>(copied.pixels[i].g);
    }
    EXPECT_LT(difference, 0.02 * sum);
    EXPECT_GT(sum, 0);
}

// Transforms of instances and of nodes are composed by the same formulas, so that the pictures are the same.
TEST_F(GltfFiles, WithInstancesInAccessorsAreThoseWithNodesWrittenOut)
{
    constexpr int side = 24;
    std::vector<double> places, indices;
    for (int i = 0; i < side * side; ++i) {
        places.insert(places.end(), {i / 99.0, i % 7 / 9.0, 0.5});
        places.insert(places.end(), {i / 99.0 + 0.1, i % 5 / 9.0, 0.3, i / 99.0, 1, i % 11 / 11.0});
        for (int k = 0; k < 3; ++k) indices.push_back(3 * i + k);
        for (int k = 2; k >= 0; --k) indices.push_back(3 * i + k);
    }
    const std::vector<double> moves{0, 0, 0, 1.5, 0.25, 0, -1, 0.5, 3}, sizes{1, 1, 1, -1, 2, 1, 0.5, 0.5, 0.75};
    const std::vector<double> turns{0, 0.5, 0, 0.75, 0, 0, 0, 1, 0.25, 0.125, -0.5, 0.5};
    const std::string parent = "\"rotation\":[0,0.6,0,0.8],\"translation\":[0.5,0.1,-0.3]";
    const auto list = [](const std::vector<double>& v, size_t first, size_t n) {
        std::string text;
        for (size_t i = 0; i < n; ++i) text += (i ? "," : "[") + std::to_string(v[first + i]);
        return text + "]";
    };
    GltfFile nodes, instances;
    for (GltfFile* file : {&nodes, &instances})
        file->add<float>(places, "VEC3"), file->add<uint16_t>(indices, "SCALAR");
    const std::string primitive = "\"attributes\":{\"POSITION\":0},\"indices\":1";
    nodes.roots = "3";
    nodes.add_mesh(primitive, "\"translation\":" + list(moves, 0, 3) + ",\"rotation\":" + list(turns, 0, 4));
    for (size_t i = 1; i < 3; ++i)
        nodes.add_node("\"mesh\":0,\"translation\":" + list(moves, 3 * i, 3) +
                       ",\"rotation\":" + list(turns, 4 * i, 4) + ",\"scale\":" + list(sizes, 3 * i, 3));
    nodes.add_node("\"children\":[0,1,2]," + parent);
    instances.add<float>(moves, "VEC3"), instances.add<float>(turns, "VEC4"), instances.add<float>(sizes, "VEC3");
    instances.rest =
        "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"]";
    instances.add_mesh(primitive, parent +
                                      ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
                                      "\"TRANSLATION\":2,\"ROTATION\":3,\"SCALE\":4}}}");
    write("nodes.glb", nodes.glb()), write("instances.glb", instances.glb());
    write("nodes.toml", "[[mesh]]\nfile = \"nodes.glb\"\n");
    write("instances.toml", "[[mesh]]\nfile = \"instances.glb\"\n");
    expect_words(run({"info", "instances.glb"}).out, "3 instances, 1 mesh");
    expect_words(run({"info", "instances.toml"}).out, "3456, drawn 3456");
    for (const std::string form : {".glb", ".toml"}) {
        for (const std::string name : {"nodes", "instances"})
            render(name + form, name + form + ".exr", {"-s", "4", "-D", "light=[{type=\"environment\",radiance=1}]"});
        const Image a = image("nodes" + form + ".exr"), b = image("instances" + form + ".exr");
        EXPECT_TRUE(a.pixels == b.pixels) << form;
        EXPECT_TRUE(std::any_of(a.pixels.begin(), a.pixels.end(), [&](Color c) { return c != a.pixels[0]; })) << form;
    }
}

TEST_F(GltfFiles, WithManyCopiesOfASmallMeshKeepItOnce)
{
    constexpr size_t triangles = 999, copies = 10'011;  // more than ten million triangles
    std::vector<double> corners, moves;
    for (size_t i = 0; i < triangles; ++i) {
        const auto x = static_cast<double>(i);
        corners.insert(corners.end(), {x, 0, 0, x + 1, 0, 0, x, 1, 0});
    }
    for (size_t i = 0; i < 3 * copies; ++i) moves.push_back(static_cast<double>(i));
    GltfFile file;
    file.add<float>(corners, "VEC3"), file.add<float>(moves, "VEC3");
    file.add_mesh("\"attributes\":{\"POSITION\":0}",
                  "\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":1}}}");
    write("copies.glb", file.glb());
    expect_words(run({"info", "copies.glb"}).out, "999, drawn 10000989");
    expect_words(run({"info", "copies.glb"}).out, "10011 instances, 1 mesh");
}

TEST_F(GltfFiles, ThatAreBrokenFailClearly)
{
    write("b.glb", "glTF");
    const Said said = run({"render", "b.glb", "-o", "b.exr"});
    EXPECT_EQ(said.code, 65);
    expect_words(said.err, "b.glb: error: the file ends in its header");
    EXPECT_FALSE(exists("b.exr"));
    EXPECT_EQ(run({"render", "none.glb", "-o", "b.exr"}).code, 66);
    GltfFile file = room();
    write("lost.gltf", file.json("lost.bin"));
    EXPECT_EQ(run({"check", "lost.gltf"}).code, 66);
    // A scene may not reach outside of its folder.
    std::filesystem::create_directories(folder_.file("sub"));
    write("sub/out.gltf", file.json("../room.bin"));
    write("room.bin", file.binary);
    const Said outside = run({"check", "sub/out.gltf"});
    EXPECT_EQ(outside.code, 65);
    expect_words(outside.out, "lies outside of the folder");
}

}  // namespace
}  // namespace lancer
