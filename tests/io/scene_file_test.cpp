// What a right scene file means: the effect and the default of every key, and the files it names.
#include "io/scene/scene_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/hash.h"
#include "io/input_text.h"
#include "scene_test_support.h"

namespace lancer {
namespace {

TEST_F(SceneFileTest, EveryKeyOfRenderIsRead)
{
    const RenderSettings r = scene(R"(version = 1
[render]
integrator = "direct"
filter = "gaussian"
sampler = "independent"
accel = "bvh8"
isa = "sse4.2"
replicates = 1024
spp = 2147483647
max_depth = 2147483647
seed = 9223372036854775807
stop_error = 0.25
multiscatter = false
mis = false
terminator = false
size = [65536, 4096])")
                                 .render;
    EXPECT_EQ(r.integrator, IntegratorKind::direct);
    EXPECT_EQ(r.filter, FilterKind::gaussian);
    EXPECT_EQ(r.sampler, SamplerKind::independent);
    EXPECT_EQ(r.accel, AccelKind::bvh8);
    EXPECT_EQ(r.isa, Isa::sse4_2);
    EXPECT_EQ(r.replicates, 1024u);
    EXPECT_EQ(r.spp, 2147483647u);
    EXPECT_EQ(r.max_depth, 2147483647u);
    EXPECT_EQ(r.seed, 9223372036854775807u);
    EXPECT_EQ(r.stop_error, 0.25);
    EXPECT_EQ(r.size, (PictureSize{65536, 4096}));
    EXPECT_FALSE(r.multiscatter);
    EXPECT_FALSE(r.mis);
    EXPECT_TRUE(r.is_given(&RenderSettings::terminator));
    EXPECT_FALSE(r.is_given(&RenderSettings::nee));
}

TEST_F(SceneFileTest, AMeshSaysWhatItsVertexColoursAre)
{
    const auto meaning = [&](const std::string& key) {
        return scene("[[mesh]]\nfile = \"a.obj\"\n" + key).meshes[0].vertex_colors;
    };
    write("a.obj", "");
    EXPECT_EQ(meaning(""), VertexColors::srgb);
    EXPECT_EQ(meaning("vertex_colors = \"srgb\""), VertexColors::srgb);
    EXPECT_EQ(meaning("vertex_colors = \"linear\""), VertexColors::linear);
    EXPECT_EQ(meaning("vertex_colors = \"none\""), VertexColors::none);
}

TEST_F(SceneFileTest, WhatRenderDoesNotSayIsLeftOpen)
{
    const RenderSettings r = scene("[render]").render;
    EXPECT_EQ(r, RenderSettings{});
    const RenderSettings least = scene("[render]\nspp = 1\nmax_depth = 0\nseed = 0\nsize = [1, 1]").render;
    EXPECT_EQ(least.spp, 1u);
    EXPECT_EQ(least.max_depth, 0u);
    EXPECT_EQ(least.seed, 0u);
    EXPECT_EQ(least.size, (PictureSize{1, 1}));
}

TEST_F(SceneFileTest, EveryKeyOfCameraIsRead)
{
    const SceneDescription s = scene(R"(
[camera]
type = "thin_lens"
position = [1, 2.5, -3]
target = [4, 5, 6]
up = [0, 0.5, 1]
fov = 179.5
aperture = 0.25
focus = 7)");
    ASSERT_TRUE(s.camera);
    EXPECT_EQ(s.camera->where.line, 2u);
    EXPECT_EQ(s.camera->type, CameraType::thin_lens);
    EXPECT_EQ(s.camera->position, (Vec3d{1, 2.5, -3}));
    EXPECT_EQ(s.camera->target, (Vec3d{4, 5, 6}));
    EXPECT_EQ(s.camera->up, (Vec3d{0, 0.5, 1}));
    EXPECT_EQ(s.camera->fov_deg, 179.5);
    EXPECT_EQ(s.camera->aperture, 0.25);
    EXPECT_EQ(s.camera->focus, 7.0);
}

TEST_F(SceneFileTest, CameraDefaults)
{
    EXPECT_FALSE(scene("version = 1").camera);
    const CameraDescription c = scene("[camera]").camera.value();
    EXPECT_EQ(c.type, CameraType::pinhole);
    EXPECT_EQ(c.position, (Vec3d{0, 0, 5}));
    EXPECT_EQ(c.target, (Vec3d{0, 0, 0}));
    EXPECT_EQ(c.up, (Vec3d{0, 1, 0}));
    EXPECT_EQ(c.fov_deg, 40);
    EXPECT_EQ(c.aperture, 0);
    EXPECT_EQ(c.focus, std::nullopt);
    EXPECT_EQ(scene("[camera]\ntype = \"pinhole\"").camera->type, CameraType::pinhole);
}

TEST_F(SceneFileTest, NamedCamerasStartFromTheUnnamedOne)
{
    const SceneDescription s = scene(R"(
[camera]
type = "thin_lens"
position = [1, 2, 3]
fov = 30
aperture = 0.5
focus = 4
[camera.close]
fov = 20
target = [0, 1, 0]
[camera."from above"]
type = "pinhole"
position = [0, 9, 0]
up = "z")");
    EXPECT_EQ(s.camera.value().name, "");
    EXPECT_EQ(s.camera->fov_deg, 30);
    ASSERT_EQ(s.cameras.size(), 2u);
    const CameraDescription &close = s.cameras[0], &above = s.cameras[1];
    EXPECT_EQ(close.name, "close");
    EXPECT_EQ(close.where.line, 8u);
    EXPECT_EQ(close.type, CameraType::thin_lens);
    EXPECT_EQ(close.position, (Vec3d{1, 2, 3}));
    EXPECT_EQ(close.target, (Vec3d{0, 1, 0}));
    EXPECT_EQ(close.fov_deg, 20);
    EXPECT_EQ(close.aperture, 0.5);
    EXPECT_EQ(close.focus, 4);
    EXPECT_EQ(above.name, "from above");
    EXPECT_EQ(above.fov_deg, 30);
    EXPECT_EQ(above.aperture, 0) << "a pinhole has none to inherit";
    EXPECT_FALSE(above.focus);
}

TEST_F(SceneFileTest, TheFirstNamedCameraIsTheDefaultWhereThereIsNoOther)
{
    const SceneDescription s = scene("[camera.a]\nfov = 10\n[camera.b]\nfov = 20");
    EXPECT_EQ(s.camera.value().name, "a");
    EXPECT_EQ(s.camera->fov_deg, 10);
    EXPECT_EQ(s.cameras.at(1).fov_deg, 20);
}

TEST_F(SceneFileTest, UpCanBeTheNameOfAnAxis)
{
    EXPECT_EQ(scene("[camera]\nposition = [5, 0, 0]\nup = \"y\"").camera->up, (Vec3d{0, 1, 0}));
    EXPECT_EQ(scene("[camera]\nposition = [5, 0, 0]\nup = \"z\"").camera->up, (Vec3d{0, 0, 1}));
}

TEST_F(SceneFileTest, HugeAndTinyCamerasAreNotTakenForDegenerateOnes)
{
    EXPECT_TRUE(scene("[camera]\nposition = [0, 0, 1e200]\nup = [0, 1e200, 1e199]").camera);
    EXPECT_TRUE(scene("[camera]\nposition = [0, 0, 1e-200]\nup = [0, 1e-200, 0]").camera);
}

TEST_F(SceneFileTest, EveryKeyOfMeshAndInstanceIsRead)
{
    write("sub/a.obj", "");
    const SceneDescription s = scene(R"(
[[mesh]]
name = "a"
file = "sub/a.obj"
material = "red"
translate = [1, 2, 3]
rotate = [10, 20, 30]
scale = [1, -2, 0.5]
[[instance]]
mesh = "a"
translate = [4, 5, 6]
rotate = [40, 50, 60]
scale = -0.01
[material.red])");
    ASSERT_EQ(s.meshes.size(), 1u);
    const MeshDescription& m = s.meshes[0];
    EXPECT_EQ(m.name, "a");
    EXPECT_EQ(m.where.line, 2u);
    EXPECT_EQ(m.material, "red");
    ASSERT_TRUE(m.data);
    EXPECT_EQ(m.data->file, path("sub/a.obj"));
    EXPECT_EQ(m.transform.translate, (Vec3d{1, 2, 3}));
    EXPECT_EQ(m.transform.rotate_deg, (Vec3d{10, 20, 30}));
    EXPECT_EQ(m.transform.scale, (Vec3d{1, -2, 0.5}));
    ASSERT_EQ(s.instances.size(), 1u);
    const InstanceDescription& i = s.instances[0];
    EXPECT_EQ(i.mesh, "a");
    EXPECT_EQ(i.where.line, 9u);
    EXPECT_EQ(i.transform.translate, (Vec3d{4, 5, 6}));
    EXPECT_EQ(i.transform.rotate_deg, (Vec3d{40, 50, 60}));
    EXPECT_EQ(i.transform.scale, (Vec3d{-0.01, -0.01, -0.01}));
}

TEST_F(SceneFileTest, MeshAndInstanceDefaults)
{
    write("a.obj", "");
    const SceneDescription s = scene(
        "[[mesh]]\nfile = \"a.obj\"\n[[mesh]]\nfile = \"a.obj\"\nname = \"a\"\n"
        "[[instance]]\nmesh = \"a\"");
    EXPECT_EQ(s.meshes.at(0).name, "");
    EXPECT_EQ(s.meshes.at(0).material, "");
    for (const TransformDescription& t : {s.meshes[0].transform, s.instances.at(0).transform}) {
        EXPECT_EQ(t.translate, (Vec3d{0, 0, 0}));
        EXPECT_EQ(t.rotate_deg, (Vec3d{0, 0, 0}));
        EXPECT_EQ(t.scale, (Vec3d{1, 1, 1}));
    }
}

TEST_F(SceneFileTest, SpheresAndPlanes)
{
    const SceneDescription s = scene(R"(
[[sphere]]
center = [1, 2, 3]
radius = 0.5
material = "red"
[[sphere]]
[[plane]]
point = [4, 5, 6]
normal = [0, 0, -7]
material = "red"
[[plane]]
[material.red])");
    ASSERT_EQ(s.spheres.size(), 2u);
    EXPECT_EQ(s.spheres[0].center, (Vec3d{1, 2, 3}));
    EXPECT_EQ(s.spheres[0].radius, 0.5);
    EXPECT_EQ(s.spheres[0].material, "red");
    EXPECT_EQ(s.spheres[0].where.line, 2u);
    EXPECT_EQ(s.spheres[1].center, (Vec3d{0, 0, 0}));
    EXPECT_EQ(s.spheres[1].radius, 1);
    EXPECT_EQ(s.spheres[1].material, "");
    ASSERT_EQ(s.planes.size(), 2u);
    EXPECT_EQ(s.planes[0].point, (Vec3d{4, 5, 6}));
    EXPECT_EQ(s.planes[0].normal, (Vec3d{0, 0, -7}));
    EXPECT_EQ(s.planes[0].material, "red");
    EXPECT_EQ(s.planes[1].point, (Vec3d{0, 0, 0}));
    EXPECT_EQ(s.planes[1].normal, (Vec3d{0, 1, 0}));
    EXPECT_EQ(s.planes[1].where.line, 11u);
}

TEST_F(SceneFileTest, EveryTypeOfLight)
{
    write("sky.hdr", "");
    const SceneDescription s = scene(R"(
[[light]]
type = "point"
position = [1, 2, 3]
intensity = [4, 5, 6]
[[light]]
type = "sphere"
center = [1, 0, 3]
radius = 0.25
radiance = 7
[[light]]
type = "environment"
radiance = [0, 0.5, 1]
[[light]]
type = "directional"
direction = [0, -2, 1]
irradiance = [1, 2, 4]
[[light]]
type = "environment"
file = "sky.hdr"
scale = 2.5
rotate = [0, 90, 0]
[[light]]
type = "environment"
file = "sky.hdr")");
    ASSERT_EQ(s.lights.size(), 6u);
    EXPECT_EQ(s.lights[0].type, LightType::point);
    EXPECT_EQ(s.lights[0].position, (Vec3d{1, 2, 3}));
    EXPECT_EQ(s.lights[0].power, (Color{4, 5, 6}));
    EXPECT_EQ(s.lights[1].type, LightType::sphere);
    EXPECT_EQ(s.lights[1].position, (Vec3d{1, 0, 3}));
    EXPECT_EQ(s.lights[1].radius, 0.25);
    EXPECT_EQ(s.lights[1].power, (Color{7, 7, 7}));
    EXPECT_EQ(s.lights[1].where.line, 6u);
    EXPECT_EQ(s.lights[2].type, LightType::environment);
    EXPECT_EQ(s.lights[2].power, (Color{0, 0.5f, 1}));
    EXPECT_EQ(s.lights[2].file, "");
    EXPECT_EQ(s.lights[3].type, LightType::directional);
    EXPECT_EQ(s.lights[3].direction, (Vec3d{0, -2, 1}));
    EXPECT_EQ(s.lights[3].power, (Color{1, 2, 4}));
    EXPECT_EQ(s.lights[4].type, LightType::environment);
    EXPECT_EQ(s.lights[4].file, path("sky.hdr"));
    EXPECT_EQ(s.lights[4].power, (Color{2.5f, 2.5f, 2.5f}));
    EXPECT_EQ(s.lights[4].rotate_deg, (Vec3d{0, 90, 0}));
    EXPECT_EQ(s.lights[5].power, (Color{1, 1, 1}));
}

TEST_F(SceneFileTest, EveryKeyOfMaterialIsRead)
{
    const SceneDescription s = scene(R"(
[material.plain]
[material.pane]
type = "glass"
base_color = [1, 0.5, 0]
ior = 1.33
[material."my lamp"]
type = "lambert"
base_color = 0
emission = 12
emission_sides = "both"
[material.chrome]
type = "mirror"
emission = [1, 2, 3]
emission_sides = "front")");
    ASSERT_EQ(s.materials.size(), 4u);
    const MaterialDescription &plain = s.materials[0], &pane = s.materials[1], &lamp = s.materials[2],
                              &chrome = s.materials[3];
    EXPECT_EQ(plain.name, "plain");
    EXPECT_EQ(plain.where.line, 2u);
    EXPECT_EQ(plain.type, MaterialType::lambert);
    EXPECT_EQ(plain.base_color, (Color{0.8f, 0.8f, 0.8f}));
    EXPECT_EQ(plain.ior, 1.5f);
    EXPECT_EQ(plain.emission, Color{});
    EXPECT_FALSE(plain.emission_both_sides);
    EXPECT_EQ(pane.type, MaterialType::glass);
    EXPECT_EQ(pane.base_color, (Color{1, 0.5f, 0}));
    EXPECT_EQ(pane.ior, 1.33f);
    EXPECT_EQ(lamp.name, "my lamp");
    EXPECT_EQ(lamp.emission, (Color{12, 12, 12}));
    EXPECT_TRUE(lamp.emission_both_sides);
    EXPECT_EQ(chrome.type, MaterialType::mirror);
    EXPECT_EQ(chrome.base_color, (Color{1, 1, 1})) << "untinted";
    EXPECT_EQ(chrome.emission, (Color{1, 2, 3}));
    EXPECT_FALSE(chrome.emission_both_sides);
}

TEST_F(SceneFileTest, MaterialsMayStandBehindTheirUse)
{
    EXPECT_EQ(scene("[[sphere]]\nmaterial = \"a\"\n[material.a]").spheres.at(0).material, "a");
}

TEST_F(SceneFileTest, OneMeshFileIsLoadedOnceHoweverItIsSpelled)
{
    write("sub/a.obj", "");
    write("b.obj", "");
    const SceneDescription s = scene(
        "[[mesh]]\nfile = \"sub/a.obj\"\n[[mesh]]\nfile = \"b.obj\"\n"
        "[[mesh]]\nfile = \"./sub/../sub/a.obj\"\n[[mesh]]\nfile = '" +
        path("sub/a.obj") + "'");
    EXPECT_EQ(loaded_, (std::vector<std::string>{"sub/a.obj", "b.obj"}));
    EXPECT_EQ(s.meshes.at(0).data, s.meshes.at(2).data);
    EXPECT_EQ(s.meshes.at(0).data, s.meshes.at(3).data);
    EXPECT_NE(s.meshes.at(0).data, s.meshes.at(1).data);
}

TEST_F(SceneFileTest, AssetRootWidensTheFolderAndIsSearchedAfterIt)
{
    write("shared/a.obj", "");
    write("scenes/b.obj", "");
    const std::string text =
        "[[mesh]]\nfile = \"../shared/a.obj\"\n[[mesh]]\nfile = \"shared/a.obj\"\n"
        "[[mesh]]\nfile = \"b.obj\"";
    options_.asset_root = folder_.string();
    Diagnostics diagnostics;
    parse_scene(text, path("scenes/s.toml"), options_, diagnostics);
    EXPECT_EQ(errors(diagnostics), "");
    EXPECT_EQ(loaded_, (std::vector<std::string>{"shared/a.obj", "scenes/b.obj"}));
}

TEST_F(SceneFileTest, RelativePathOfTheSceneStaysRelative)
{
    const std::filesystem::path before = std::filesystem::current_path();
    write("sub/a.obj", "");
    write("sub/s.toml", "[[mesh]]\nfile = \"a.obj\"");
    Diagnostics diagnostics;
    std::filesystem::current_path(folder_);
    const SceneDescription s = load_scene_file("sub/s.toml", options_, diagnostics);
    std::filesystem::current_path(folder_ / "sub");
    const SceneDescription t = load_scene_file("s.toml", options_, diagnostics);
    std::filesystem::current_path(before);
    EXPECT_EQ(errors(diagnostics), "");
    EXPECT_EQ(s.file, "sub/s.toml");
    EXPECT_EQ(s.meshes.at(0).data->file, "sub/a.obj");
    EXPECT_EQ(t.meshes.at(0).data->file, "a.obj");
}

TEST_F(SceneFileTest, ContentHashIsOfTheBytes)
{
    EXPECT_EQ(scene("[camera]").content_hash, hash_bytes("[camera]"));
    EXPECT_NE(scene("[camera]").content_hash, scene("[camera] ").content_hash);
}

TEST_F(SceneFileTest, ByteOrderMarkAndWindowsLinesAreFine)
{
    const SceneDescription s = scene("\xEF\xBB\xBFversion = 1\r\n[camera]\r\nfov = 30\r\n");
    EXPECT_EQ(s.camera.value().fov_deg, 30);
    EXPECT_EQ(s.camera->where.line, 2u);
}

TEST_F(SceneFileTest, EveryExampleOfTheManualIsRight)
{
    std::ifstream manual(LANCER_SOURCE_DIR "/docs/scene-format.md");
    int examples = 0;
    std::string example;
    bool is_inside = false;
    for (std::string line; std::getline(manual, line);) {
        const std::string file_key = "file = \"";
        if (line == "```toml") {
            is_inside = true;
        } else if (is_inside && line == "```") {
            scene(example);
            example.clear();
            is_inside = false;
            ++examples;
        } else if (is_inside) {
            example += line + "\n";
            if (line.starts_with(file_key)) write(line.substr(file_key.size(), line.rfind('"') - file_key.size()), "");
        }
    }
    EXPECT_GE(examples, 9);
}

}  // namespace
}  // namespace lancer
