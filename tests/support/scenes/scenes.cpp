#include "support/scenes/scenes.h"

#include "support/scenes/media_scenes.h"

namespace lancer {

SceneDescription closed_furnace(float rho, Color emitted)
{
    SceneDescription d;
    MaterialDescription m = make_lambert("wall", {rho, rho, rho});
    m.emission = emitted;
    m.emission_both_sides = true;
    d.materials = {m};
    d.spheres.push_back(sphere_of({0, 0, 0}, 1.3, "wall"));
    d.camera = make_camera({0.3, 0.2, 0}, {0, 0, -1}, 70);
    return d;
}

SceneDescription cornell_scene()
{
    SceneDescription d;
    const Color white{0.7f, 0.7f, 0.7f};
    const auto wall = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d e, Color colour) {
        d.meshes.push_back(make_mesh(make_quad(a, b, c, e, make_lambert("wall", colour))));
    };
    wall({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, white);
    wall({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, white);
    wall({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, white);
    wall({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {0.6f, 0.1f, 0.1f});
    wall({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, {0.1f, 0.5f, 0.1f});
    d.meshes.push_back(make_mesh(make_quad({-0.3, 0.99, -0.3}, {0.3, 0.99, -0.3}, {0.3, 0.99, 0.3}, {-0.3, 0.99, 0.3},
                                           make_emitter("light", {12, 10, 8}))));
    const auto block = [&](Vec3d at, double turn_deg, Vec3d half) {
        d.meshes.push_back(make_mesh(make_cube(make_lambert("block", white)), {at, {0, turn_deg, 0}, half}));
    };
    block({0.35, -0.7, 0.3}, -17, {0.28, 0.3, 0.28});
    block({-0.35, -0.4, -0.3}, 20, {0.28, 0.6, 0.28});
    d.camera = make_camera({0, 0, 3.6}, {0, 0, 0}, 40);
    return d;
}

SceneDescription spheres_scene()
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f}),
                   make_lambert("red", {0.7f, 0.2f, 0.1f}),
                   {.name = "mirror", .where = {}, .type = MaterialType::mirror, .base_color = {0.9f, 0.9f, 0.9f}},
                   {.name = "glass", .where = {}, .type = MaterialType::glass, .base_color = {1, 1, 1}, .ior = 1.5f}};
    d.planes.push_back(plane_of({0, -0.5, 0}, {0, 1, 0}, "floor"));
    d.spheres.push_back(sphere_of({-1.05, 0, 0}, 0.5, "mirror"));
    d.spheres.push_back(sphere_of({0, 0, 0.2}, 0.5, "glass"));
    d.spheres.push_back(sphere_of({1.05, 0, -0.1}, 0.5, "red"));
    d.lights.push_back(light_of(LightType::sphere, {9, 9, 8}, {-0.5, 2.5, 1.5}, 0.4));
    d.lights.push_back(sky_of({0.2f, 0.25f, 0.3f}));
    d.camera = make_camera({0.3, 0.8, 4}, {0, 0, 0}, 40);
    d.camera->type = CameraType::thin_lens;
    d.camera->aperture = 0.04;
    return d;
}

SceneDescription lights_scene()
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2},
                                           make_lambert("floor", {0.6f, 0.6f, 0.5f}))));
    d.meshes.push_back(make_mesh(make_uv_sphere(20, 40, 0.08, make_lambert("bumpy", {0.3f, 0.5f, 0.7f})),
                                 {{0, 0, 0}, {30, 0, 0}, {0.7, 0.7, 0.7}}));
    d.meshes.push_back(make_mesh(
        make_quad({1.2, 0, -0.3}, {1.2, 0, 0.3}, {1.2, 0.6, 0.3}, {1.2, 0.6, -0.3}, make_emitter("panel", {4, 2, 1}))));
    d.lights.push_back(light_of(LightType::point, {6, 6, 6}, {-1.5, 2, 1.5}));
    d.lights.push_back(light_of(LightType::sphere, {10, 12, 14}, {1.5, 2, 1}, 0.2));
    d.lights.push_back(sky_of({0.1f, 0.1f, 0.15f}));
    d.camera = make_camera({0, 1, 4}, {0, -0.1, 0}, 40);
    return d;
}

SceneDescription instances_scene()
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.5f, 0.5f, 0.5f})};
    d.planes.push_back(plane_of({0, -0.6, 0}, {0, 1, 0}, "floor"));
    MeshDescription bumpy = make_mesh(make_uv_sphere(12, 24, 0.1, make_lambert("bumpy", {0.7f, 0.6f, 0.3f})));
    bumpy.name = "bumpy";
    d.meshes.push_back(std::move(bumpy));
    MeshDescription lamp =
        make_mesh(make_quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, make_emitter("lamp", {8, 8, 8})));
    lamp.name = "lamp";
    d.meshes.push_back(std::move(lamp));
    const auto place = [&](const char* mesh, Vec3d translate, Vec3d rotate_deg, Vec3d scale) {
        d.instances.push_back(instance_of(mesh, {translate, rotate_deg, scale}));
    };
    place("bumpy", {-1.2, 0, 0}, {0, 0, 0}, {0.4, 0.4, 0.4});
    place("bumpy", {-0.4, 0, 0.3}, {30, 45, 60}, {0.3, 0.5, 0.2});
    place("bumpy", {0.4, 0, 0}, {90, 0, 0}, {-0.4, 0.3, 0.4});
    place("bumpy", {1.2, 0, 0.2}, {0, 90, 15}, {0.2, 0.6, 0.4});
    place("bumpy", {0, 0.2, -0.9}, {10, 20, 200}, {0.7, 0.4, 0.3});
    place("lamp", {0, 2, 0.5}, {10, 0, 5}, {0.5, 1, 0.4});
    d.camera = make_camera({0, 1, 3.5}, {0, 0, 0}, 45);
    return d;
}

SceneDescription textured_scene()
{
    SceneDescription d;
    MaterialDescription wall = make_lambert("wall", {0.8f, 0.8f, 0.8f});
    wall.base_color_map = picture_of("colours", Encoding::srgb);
    wall.bump_map = heights_of("waves");
    wall.bump_scale = 4;
    d.meshes.push_back(
        make_mesh(make_mapped_quad({-2, -0.8, -1}, {2, -0.8, -1}, {2, 1.5, -1}, {-2, 1.5, -1}, {4, 3}, wall)));
    MaterialDescription tile = make_lambert("tile", {0.9f, 0.8f, 0.7f});
    tile.normal_map = picture_of("tilted normals", Encoding::linear);
    tile.base_color_map = picture_of("waves", Encoding::srgb);
    tile.base_color_map->use.wrap = Wrap::clamp;
    MeshDescription named =
        make_mesh(make_mapped_quad({-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}, {2, 2}, tile));
    named.name = "tile";
    d.meshes.push_back(std::move(named));
    d.instances.push_back(instance_of("tile", {{-1, -0.3, 0.3}, {-40, 30, 10}, {0.8, 0.6, 1}}));
    d.instances.push_back(instance_of("tile", {{0.2, -0.6, 0.8}, {-80, 0, 0}, {-0.5, 0.7, 1}}));
    MaterialDescription lamp = make_emitter("lamp", {8, 8, 8});
    lamp.emission_map = picture_of("colours", Encoding::srgb);
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-0.5, 1.8, -0.5}, {0.5, 1.8, -0.5}, {0.5, 1.8, 0.5}, {-0.5, 1.8, 0.5}, {1, 1}, lamp)));
    MaterialDescription ball = {.name = "ball", .where = {}, .type = MaterialType::mirror, .base_color = {1, 1, 1}};
    ball.base_color_map = picture_of("colours", Encoding::srgb);
    ball.bump_map = heights_of("waves");
    MaterialDescription floor = make_lambert("floor", {1, 1, 1});
    floor.base_color_map.emplace();
    floor.base_color_map->type = TextureType::checker;
    floor.base_color_map->even = {0.8f, 0.7f, 0.6f};
    floor.base_color_map->odd = {0.1f, 0.2f, 0.3f};
    floor.base_color_map->use.scale = {2, 2};
    d.materials = {ball, floor};
    d.spheres.push_back(sphere_of({0.9, -0.3, 0}, 0.5, "ball"));
    d.planes.push_back(plane_of({0, -0.8, 0}, {0, 1, 0}, "floor"));
    d.lights.push_back(sky_of({0.3f, 0.3f, 0.35f}));
    d.camera = make_camera({0.2, 0.6, 3.5}, {0, 0, 0}, 45);
    return d;
}

SceneDescription holes_scene()
{
    SceneDescription d;
    d.materials = {make_gauze("half", {0.7f, 0.6f, 0.3f}, 0.5f), make_gauze("wall", {0.4f, 0.5f, 0.6f}, 0.7f)};
    MaterialDescription bulb = make_gauze("bulb", {}, 0.6f);
    bulb.emission = {5, 5, 6};
    bulb.emission_both_sides = true;
    d.materials.push_back(bulb);
    d.meshes.push_back(make_mesh(make_quad({-2, -0.7, 2}, {2, -0.7, 2}, {2, -0.7, -2}, {-2, -0.7, -2},
                                           make_lambert("floor", {0.6f, 0.6f, 0.5f}))));
    d.planes.push_back(plane_of({0, 0, -2}, {0, 0.1, 1}, "wall"));
    d.spheres.push_back(sphere_of({-0.9, -0.3, 0.2}, 0.4, "half"));
    d.spheres.push_back(sphere_of({-1.2, 1.3, 0.6}, 0.5, "bulb"));
    // A screen of squares before the rest.
    d.meshes.push_back(
        make_mesh(make_mapped_quad({-0.5, -0.6, 0.9}, {0.6, -0.6, 0.8}, {0.6, 0.3, 0.8}, {-0.5, 0.3, 0.9}, {1, 1},
                                   make_gauze("screen", {0.2f, 0.6f, 0.3f}, 1, 7))));
    MeshData box = *make_cube(make_lambert("solid", {0.7f, 0.3f, 0.2f}));
    box.materials.push_back(make_gauze("veil", {0.5f, 0.5f, 0.5f}, 0.3f));
    for (uint32_t i = 0; i < box.triangles.size(); ++i) box.face_material.push_back(i / 2 % 2);
    d.meshes.push_back(
        make_mesh(std::make_shared<const MeshData>(box), {{0.9, -0.2, -0.2}, {0, 30, 0}, {0.3, 0.4, 0.3}}));
    MeshDescription shell = make_mesh(make_uv_sphere(6, 9, 0.1, make_gauze("shell", {0.6f, 0.6f, 0.8f}, 0.4f)));
    shell.name = "shell";
    d.meshes.push_back(std::move(shell));
    d.instances.push_back(instance_of("shell", {{0, 0.1, -0.5}, {20, 30, 40}, {0.5, 0.4, 0.3}}));
    d.instances.push_back(instance_of("shell", {{1.1, 0.6, 0.3}, {0, 70, 10}, {-0.3, 0.3, 0.4}}));
    MaterialDescription lamp = make_gauze("lamp", {0.3f, 0.3f, 0.3f}, 0.8f, 3);
    lamp.emission = {6, 5, 4};
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-0.1, 1.5, -0.8}, {1.3, 1.5, -0.8}, {1.3, 1.5, 0.6}, {-0.1, 1.5, 0.6}, {1, 1}, lamp)));
    d.lights.push_back(sky_of({0.3f, 0.35f, 0.45f}));
    d.camera = make_camera({0.2, 0.9, 4}, {0, 0, 0}, 40);
    return d;
}

SceneDescription glossy_scene()
{
    SceneDescription d;
    MaterialDescription brushed = make_glossy("brushed", MaterialType::metal, {0.9f, 0.8f, 0.5f}, 0.8f);
    brushed.roughness_map = heights_of("waves");
    MaterialDescription copper = make_copper("copper", 0.4f);
    copper.bump_map = heights_of("waves");
    copper.bump_scale = 4;
    MaterialDescription inlay = make_glossy("inlay", MaterialType::plastic, {0.2f, 0.5f, 0.3f}, 0.5f);
    inlay.base_color_map = picture_of("colours", Encoding::srgb);
    inlay.metallic = 1;
    inlay.metallic_map = heights_of("discs");
    MaterialDescription floor = make_lambert("floor", {});
    floor.type = MaterialType::mix;
    floor.first = "lacquer";
    floor.second = "steel";
    floor.weight = 0.9f;
    floor.weight_map.emplace();
    floor.weight_map->type = TextureType::checker;
    floor.weight_map->odd = {0.2f, 0.2f, 0.2f};
    d.materials = {brushed,
                   copper,
                   inlay,
                   floor,
                   make_glossy("lacquer", MaterialType::plastic, {0.6f, 0.2f, 0.2f}, 0.3f),
                   make_glossy("steel", MaterialType::metal, {0.6f, 0.6f, 0.7f}, 0.5f),
                   make_glossy("frosted", MaterialType::glass, {0.9f, 1, 0.9f}, 0.4f),
                   make_glossy("glazed", MaterialType::plastic, {0.3f, 0.3f, 0.8f}, 0)};
    d.meshes.push_back(make_mesh(make_mapped_quad({-2, -0.5, 1.5}, {2, -0.5, 1.5}, {2, -0.5, -1.5}, {-2, -0.5, -1.5},
                                                  {8, 6}, make_lambert("", {}))));
    d.meshes.back().material = "floor";
    d.spheres = {sphere_of({-1.1, -0.1, 0}, 0.4, "brushed"), sphere_of({-0.3, -0.15, 0.5}, 0.35, "frosted"),
                 sphere_of({0.4, -0.2, -0.3}, 0.3, "copper"), sphere_of({1.3, -0.1, -0.6}, 0.4, "glazed")};
    MeshDescription box = make_mesh(make_cube());
    box.material = "lacquer";
    box.transform = {{-0.4, -0.25, -0.7}, {0, 30, 0}, {0.25, 0.25, 0.25}};
    d.meshes.push_back(std::move(box));
    d.meshes.push_back(make_mesh(
        make_mapped_quad({0.6, -0.5, 0.8}, {1.2, -0.5, 0.5}, {1.2, 0.1, 0.3}, {0.6, 0.1, 0.6}, {1, 1}, inlay)));
    // The pane is a boundary only: what lies behind it is all glass.
    MaterialDescription pane = make_glossy("pane", MaterialType::glass, {1, 1, 1}, 0.5f);
    pane.thin = false;
    d.meshes.push_back(
        make_mesh(make_quad({-1.5, 0.3, -1.2}, {0.1, 0.3, -1.2}, {0.1, 1.2, -1}, {-1.5, 1.2, -1}, pane)));
    d.lights.push_back(light_of(LightType::point, {3, 3, 3}, {-0.7, 0.8, -1.8}));
    d.lights.push_back(light_of(LightType::sphere, {6, 6, 5}, {1.2, 1.6, 1}, 0.4));
    MaterialDescription panel = make_emitter("panel", {5, 5, 5});
    panel.emission_map = picture_of("colours", Encoding::srgb);
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-1.4, 1.5, -0.4}, {-0.4, 1.5, -0.4}, {-0.4, 1.5, 0.6}, {-1.4, 1.5, 0.6}, {1, 1}, panel)));
    d.lights.push_back(sky_map_of({0.5f, 0.5f, 0.6f}, {10, 40, 0}));
    d.camera = make_camera({0.1, 0.7, 4}, {0, 0.1, 0}, 40);
    return d;
}

std::span<const TestScene> test_scenes()
{
    static constexpr TestScene all[] = {{"cornell", cornell_scene},       {"spheres", spheres_scene},
                                        {"lights", lights_scene},         {"instances", instances_scene},
                                        {"textured", textured_scene},     {"holes", holes_scene},
                                        {"glossy", glossy_scene},         {"media", media_scene},
                                        {"scattering", scattering_scene}, {"fog", fog_scene},
                                        {"shapes", shapes_scene}};
    return all;
}
std::vector<NamedScene> all_test_scenes()
{
    std::vector<NamedScene> all;
    for (const TestScene& s : test_scenes()) all.push_back({s.name, s.make()});
    return all;
}

SceneDescription scaled_by(SceneDescription d, double s)
{
    const auto resize = [s](TransformDescription& t) {
        t.translate *= s;
        t.scale *= s;
    };
    for (auto& m : d.meshes) {
        const bool instanced = [&] {
            for (const auto& i : d.instances)
                if (i.mesh == m.name) return true;
            return false;
        }();
        if (!instanced) resize(m.transform);
    }
    for (auto& i : d.instances) resize(i.transform);
    for (auto& x : d.spheres) x.center *= s, x.radius *= s;
    for (auto& m : d.materials) {
        m.absorption /= static_cast<float>(s), m.scattering /= static_cast<float>(s);
        m.subsurface_radius *= static_cast<float>(s);
    }
    if (d.fog) {
        d.fog->absorption /= static_cast<float>(s), d.fog->scattering /= static_cast<float>(s);
        for (std::optional<Vec3d>* corner : {&d.fog->low, &d.fog->high})
            if (*corner) **corner *= s;
        if (d.fog->height) *d.fog->height *= s;
    }
    for (auto& p : d.planes) {
        p.point *= s;
        if (p.axes)
            for (Vec3d& axis : *p.axes) axis *= s;
        for (Wave& w : p.waves) w.amplitude *= s;
        // The texture coordinates of a plane are lengths.
        for (auto& m : d.materials)
            if (m.name == p.material && m.base_color_map)
                m.base_color_map->use.scale = m.base_color_map->use.scale * static_cast<float>(1 / s);
    }
    for (auto& l : d.lights) {
        l.position *= s, l.radius *= s;
        if (l.type == LightType::point) l.power *= static_cast<float>(s * s);
    }
    if (d.camera) {
        d.camera->position *= s, d.camera->target *= s, d.camera->aperture *= s;
        if (d.camera->focus) *d.camera->focus *= s;
    }
    return d;
}

Camera camera_of(const SceneDescription& d, const Scene& scene, uint32_t width, uint32_t height)
{
    if (d.camera) return {d, scene.normalisation, width, height};
    return {fit_camera(subject_bounds(d), static_cast<double>(width) / height), scene.normalisation, width, height};
}

}  // namespace lancer
