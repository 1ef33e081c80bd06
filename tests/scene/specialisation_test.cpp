// What building a scene leaves out, and that what stays is the same.
#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "materials/material.h"
#include "scene/features.h"
#include "support/stage.h"

namespace lancer {
namespace {

// How many of something were left out.
uint64_t count_of(const Scene& scene, const std::string& what)
{
    for (const UnusedFeature& l : scene.unused_features.all())
        if (l.what.find(what) != std::string::npos) return l.count;
    return 0;
}

// Grey of 51 everywhere, but "two" has another texel.
RasterFuture even_picture(const std::string& file)
{
    Raster r = {.width = 5, .height = 3, .channels = 3, .bytes = {}, .floats = {}, .is_float = false};
    r.bytes.assign(45, 51);
    if (file == "two") r.bytes[0] = 52;
    std::promise<std::shared_ptr<const Raster>> promise;
    promise.set_value(std::make_shared<const Raster>(std::move(r)));
    return promise.get_future().share();
}

SceneDescription worn(const std::string& picture)
{
    MaterialDescription m = make_lambert("m", {0.5f, 0.25f, 1});
    m.base_color_map = picture_of(picture, Encoding::linear);
    m.opacity_map = picture_of(picture, Encoding::linear, Channel::alpha);
    m.bump_map = heights_of(picture);
    m.emission = {1, 2, 3};
    m.emission_map = picture_of(picture, Encoding::linear);
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_mapped_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1}, m)));
    return d;
}

TEST(Specialisation, PicturesOfOneValueBecomeFactors)
{
    const Scene one = build_scene(worn("one"), even_picture), two = build_scene(worn("two"), even_picture);
    const uint32_t id = one.shading[0].material;
    EXPECT_EQ(std::get<Lambert>(one.materials[id]).albedo.texture, no_texture);
    EXPECT_EQ(std::get<Lambert>(one.materials[id]).albedo.value, Color({0.5f, 0.25f, 1}) * (51 / 255.0f));
    EXPECT_EQ(one.emission[id].radiance.value, Color({1, 2, 3}) * (51 / 255.0f));
    EXPECT_EQ(one.traits[id].bump, no_texture);
    EXPECT_FALSE(one.traits[id].has_holes()) << "the picture has no alpha";
    EXPECT_FALSE(one.traits[id].reads_uv);
    EXPECT_TRUE(one.shading[0].uvs.empty() && one.shading[0].uv_triangles.empty());
    EXPECT_EQ(count_of(one, "constant textures"), 3u);
    EXPECT_EQ(count_of(one, "texture coordinates"), 2u);
    EXPECT_FALSE(features_of(one).has(Feature::textures));
    // Another texel, and all of it is needed but the alpha that is not there.
    const uint32_t other = two.shading[0].material;
    EXPECT_NE(std::get<Lambert>(two.materials[other]).albedo.texture, no_texture);
    EXPECT_NE(two.traits[other].bump, no_texture);
    EXPECT_TRUE(two.traits[other].reads_uv);
    EXPECT_FALSE(two.shading[0].uvs.empty());
    EXPECT_EQ(count_of(two, "constant textures"), 1u);
}

// Whether a picture is the same everywhere or not: no part of the light is above 1 or below 0, and no light negative.
TEST(Specialisation, PicturesOfTooMuchOrTooLittleAreLimited)
{
    for (const bool is_constant : {true, false}) {
        const RasterSource source = [&](const std::string&) {
            Raster r{.width = 2, .height = 2, .channels = 3, .bytes = {}, .floats = {}, .is_float = true};
            for (int i = 0; i < 4; ++i) r.floats.insert(r.floats.end(), {3.0f, -0.5f, 0.5f});
            if (!is_constant) r.floats[2] = 0.25f;
            std::promise<std::shared_ptr<const Raster>> promise;
            promise.set_value(std::make_shared<const Raster>(std::move(r)));
            return promise.get_future().share();
        };
        const Scene scene = build_scene(worn("one"), source);
        const uint32_t id = scene.shading[0].material;
        EXPECT_EQ(std::get<Lambert>(scene.materials[id]).albedo.texture == no_texture, is_constant);
        ShadingPoint p{.uv = {0.75, 0.25}, .textures = scene.textures.data()};
        EXPECT_EQ(std::get<Lambert>(scene.materials[id]).at(p).albedo, (Color{1, 0, 0.5f}));
        EXPECT_EQ(scene.emission[id].towards(true, p), (Color{3, 0, 1.5f}));
    }
}

TEST(Specialisation, TheSamePictureUnderTwoNamesIsKeptOnce)
{
    MaterialDescription a = make_lambert("a", {1, 1, 1}), b = a;
    b.name = "b";
    a.base_color_map = picture_of("two", Encoding::linear);
    b.base_color_map = picture_of("two", Encoding::linear);
    b.base_color_map->use.scale = {2, 3};
    SceneDescription d;
    d.materials = {a, b};
    d.spheres = {sphere_of({0, 0, 0}, 1, "a"), sphere_of({3, 0, 0}, 1, "b")};
    const Scene s = build_scene(d, even_picture);
    ASSERT_EQ(s.textures.size(), 2u);
    EXPECT_EQ(count_of(s, "same texels"), 1u);
    d.materials[1].base_color_map->use.channel = Channel::red;
    EXPECT_EQ(count_of(build_scene(d, even_picture), "same texels"), 0u);
}

// Vertices, normals and texture coordinates that no triangle names, put between those that some does.
TEST(Specialisation, WhatNoTriangleNamesIsNotKept)
{
    MaterialDescription mapped = make_lambert("mapped", {1, 1, 1});
    mapped.base_color_map = picture_of("two", Encoding::linear);
    MeshData data = *make_mapped_quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {3, 5}, mapped);
    data.materials.push_back(make_lambert("plain", {1, 1, 1}));
    data.face_material = {0, 1};
    data.normals = {{0, 0, 1}, {0.6f, 0, 0.8f}};
    data.normal_triangles = {{1, 1, 1}, {1, 1, 1}};
    MeshData padded = data;
    const auto pad = [](auto& values, auto& triangles) {
        values.insert(values.begin(), values.back());
        values.push_back(values.front());
        for (auto& t : triangles)
            for (uint32_t& i : t) ++i;
    };
    pad(padded.positions, padded.triangles);
    pad(padded.normals, padded.normal_triangles);
    pad(padded.uvs, padded.uv_triangles);
    const auto stage_of = [](const MeshData& mesh) {
        SceneDescription d;
        d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(mesh)));
        return std::make_unique<Stage>(d, even_picture);
    };
    const auto a = stage_of(data), b = stage_of(padded);
    EXPECT_EQ(count_of(a->scene, "unused vertices"), 0u);
    EXPECT_EQ(count_of(b->scene, "unused vertices"), 2u);
    EXPECT_EQ(count_of(a->scene, "unused vertex normals"), 1u);
    EXPECT_EQ(count_of(b->scene, "unused vertex normals"), 3u);
    EXPECT_EQ(b->scene.geometry.meshes[0].positions.size(), 5u);
    EXPECT_EQ(b->scene.shading[0].normals.values.size(), 2u) << "one, and one behind the last";
    EXPECT_EQ(b->scene.shading[0].uvs.size(), 3u) << "of the triangle that reads them";
    for (const Vec3d from : {Vec3d{1.5, 0.2, 1}, Vec3d{0.5, 1.7, 1}}) {
        const auto p = a->look(a->to_scene(from), {0, 0, -1}), q = b->look(b->to_scene(from), {0, 0, -1});
        ASSERT_TRUE(p && q);
        EXPECT_EQ(p->p, q->p);
        EXPECT_EQ(p->ns, q->ns);
        EXPECT_EQ(p->uv, q->uv);
        EXPECT_EQ(p->uv == Vec2{}, from.x < 1) << "only who reads them has any";
    }
}

TEST(Specialisation, CornersAreFoundWhereverTheyAre)
{
    std::vector<CornerTable::Corners> all(1000);
    for (uint32_t i = 0; i < all.size(); ++i) all[i] = {i, 2 * i, 3 * i};
    const CornerTable nearly(all, [](uint32_t t) { return t != 77; });
    for (uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(nearly.find(i) == nullptr, i == 77);
    EXPECT_EQ(nearly.bytes(), all.size() * sizeof(all[0])) << "not worth a list of who has some";
    for (const uint32_t step : {1u, 2u, 3u, 64u, 65u, 2000u}) {
        CornerTable table(all, [&](uint32_t t) { return t % step == step / 2; });
        uint64_t found = 0;
        for (uint32_t i = 0; i < all.size(); ++i) {
            const CornerTable::Corners* const c = table.find(i);
            EXPECT_EQ(c != nullptr, i % step == step / 2) << i << " of " << step;
            EXPECT_EQ(c ? *c : all[i], all[i]);
            found += c != nullptr;
        }
        EXPECT_EQ(table.all().size(), found) << step;
        EXPECT_LE(table.bytes(), found * sizeof(all[0]) + (step == 1 ? 0 : 16 * (all.size() / 64 + 1))) << step;
    }
    EXPECT_TRUE(CornerTable(all, [](uint32_t) { return false; }).empty());
}

// A material file that two meshes name, and one material of it on all faces of one of them.
TEST(Specialisation, MaterialsThatComeAgainAreMerged)
{
    MeshData data = *make_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, make_lambert("a", {0.1f, 0.2f, 0.3f}));
    data.materials.push_back(make_lambert("b", {1, 1, 1}));
    data.face_material = {0, 1};
    SceneDescription d;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(data)));
    data.face_material = {1, 1};
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(data)));
    const Scene s = build_scene(d);
    EXPECT_EQ(s.materials.size(), 2u);
    EXPECT_EQ(count_of(s, "duplicate materials"), 2u);
    EXPECT_EQ(s.shading[0].face_material.size(), 2u);
    EXPECT_TRUE(s.shading[1].face_material.empty());
    EXPECT_EQ(s.shading[1].material_of(1), s.shading[0].material_of(1));
    // The same, but from another line: it may be another one tomorrow, and has a number of its own.
    data.materials[0].where.line = 7;
    d.meshes.push_back(make_mesh(std::make_shared<const MeshData>(data)));
    EXPECT_EQ(build_scene(d).materials.size(), 3u);
}

TEST(Specialisation, LightsAndMaterialsAreCounted)
{
    SceneDescription d;
    d.materials = {make_lambert("unused", {1, 1, 1})};
    d.spheres = {sphere_of({0, 0, 0}, 1)};
    d.lights = {sky_of({}), light_of(LightType::point, {}, {0, 2, 0}), sky_of({1, 1, 1})};
    const Scene s = build_scene(d);
    EXPECT_EQ(count_of(s, "lights without power"), 2u);
    EXPECT_EQ(count_of(s, "unused materials"), 1u);
}

// What grows with a scene's triangles, vertices, shapes and lights but for what every triangle has: elements of each
// table, by name.
std::map<std::string, size_t> tables_of_features(const Scene& s)
{
    std::map<std::string, size_t> t{{"spheres", s.geometry.spheres.size() + s.sphere_material.size()},
                                    {"lights of spheres", s.sphere_light.size()},
                                    {"planes", s.geometry.planes.size() + s.plane_material.size()},
                                    {"maps of planes", s.plane_maps.size()},
                                    {"instances", s.geometry.instances.size() + s.instance_first_light.size()},
                                    {"holes", s.geometry.alpha_test.passes_through != nullptr},
                                    {"textures", s.textures.size()},
                                    {"mixes", s.mixes.size() + s.mix_of.size()},
                                    {"media", s.media.size()},
                                    {"points and directions of light", s.delta_lights.size() + s.lights.deltas},
                                    {"light tree", s.lights.tree != nullptr},
                                    {"lights beside the tree", s.lights.far.size()},
                                    {"environment", s.environment_map != nullptr},
                                    {"table of the environment", s.environment_table != nullptr},
                                    {"background", s.background != nullptr}};
    for (const std::vector<uint8_t>& asked : s.geometry.alpha_test.meshes) t["triangles with holes"] += asked.size();
    for (const Mesh& m : s.geometry.meshes) t["normals of vertices"] += m.rows - 1;
    for (const MeshShading& m : s.shading) {
        t["normals"] += m.normals.bytes();
        t["texture coordinates"] += m.uvs.size() + m.uv_triangles.bytes();
        t["colours"] += m.colors.size();
        t["materials of faces"] += m.face_material.bytes();
    }
    return t;
}

// A room of one material, a lamp of another: nothing of it is there for what it lacks. Each of the tables is that of
// some scene, so that none of them is empty always.
TEST(Specialisation, AFeatureThatASceneLacksTakesNoByte)
{
    SceneDescription room;
    const auto wall = make_lambert("wall", {0.7f, 0.7f, 0.7f});
    room.meshes.push_back(make_mesh(make_cube(wall)));
    room.meshes.push_back(make_mesh(
        make_quad({0, 0.9, 0}, {0.1, 0.9, 0}, {0.1, 0.9, 0.1}, {0, 0.9, 0.1}, make_emitter("lamp", {8, 8, 8}))));
    Stage plain(room);
    for (const auto& [name, size] : tables_of_features(plain.scene)) EXPECT_EQ(size, 0u) << name;
    for (size_t i = 0; i < 2; ++i) {
        const Mesh& mesh = plain.scene.geometry.meshes[i];
        EXPECT_EQ(mesh.positions.size(), (i == 0 ? 8u : 4u) + 1) << "one to read past the end";
        EXPECT_EQ(plain.scene.shading[i].emitters.marked(), i == 0 ? 0 : mesh.triangles.size());
        EXPECT_EQ(plain.scene.shading[i].emitters.bytes() > 0, i == 1);
    }
    EXPECT_EQ(plain.scene.lights.lights.size(), 2u);

    std::map<std::string, size_t> somewhere;
    const auto look = [&](const SceneDescription& d, const RasterSource& images = test_picture) {
        const Stage stage(d, images);
        for (const auto& [name, size] : tables_of_features(stage.scene)) somewhere[name] += size;
    };
    for (const auto& [name, d] : all_test_scenes()) look(d);
    MaterialDescription mix = make_lambert("mix", {});
    mix.type = MaterialType::mix, mix.first = "a", mix.second = "b";
    SceneDescription more = room;
    more.materials = {make_lambert("a", {1, 1, 1}), make_lambert("b", {}), mix};
    more.meshes[0].material = "mix";
    MeshData colored = *more.meshes[1].data;
    colored.colors.assign(colored.positions.size(), {1, 0.5f, 0.2f});
    colored.materials = {wall, make_lambert("other", {1, 1, 1})};
    colored.face_material = {0, 1};
    more.meshes.push_back(make_mesh(std::make_shared<const MeshData>(colored)));
    more.background.emplace().sky = SkyType::noon;
    MeshData smooth = *room.meshes[0].data;
    smooth.normals = {{0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}};
    smooth.normal_triangles.assign(smooth.triangles.size(), {0, 0, 0});
    more.meshes.push_back(make_mesh(std::make_shared<const MeshData>(smooth)));
    smooth.normal_triangles[0] = {1, 1, 1};  // vertices have two
    more.meshes.push_back(make_mesh(std::make_shared<const MeshData>(smooth)));
    // As many lights as a tree is made for, and one that is nowhere.
    for (int i = 0; i < 100; ++i) more.lights.push_back(light_of(LightType::point, {1, 1, 1}, {0.01 * i, 0.5, 0}));
    more.lights.push_back(directional_of({1, 1, 1}, {0, -1, 0}));
    look(more);
    for (const auto& [name, size] : somewhere) EXPECT_GT(size, 0u) << name;
}

}  // namespace
}  // namespace lancer
