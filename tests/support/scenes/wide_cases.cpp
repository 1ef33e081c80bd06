#include "support/scenes/wide_cases.h"

#include "support/scenes/dark_rooms.h"

namespace lancer {

SceneDescription smooth_scene()
{
    SceneDescription d = lights_scene();
    MeshData smooth = *make_uv_sphere(5, 8, 0.08, make_lambert("smooth", {0.8f, 0.6f, 0.5f}));
    for (const Vec3d& p : smooth.positions) smooth.normals.push_back(to_float(normalize(p + Vec3d{0, 0.4, 0})));
    smooth.normal_triangles = smooth.triangles;
    d.meshes[1].data = std::make_shared<const MeshData>(std::move(smooth));
    d.lights.clear();
    return d;
}

SceneDescription flat_scene(uint32_t rows, uint32_t columns)
{
    SceneDescription d = smooth_scene();
    d.meshes[1].data = make_uv_sphere(rows, columns, 0.08, make_lambert("rough", {0.8f, 0.6f, 0.5f}));
    return d;
}

SceneDescription sky_scene()
{
    SceneDescription d = smooth_scene();
    d.meshes.pop_back();  // the panel
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}

SceneDescription many_lamps(int count)
{
    SceneDescription d = smooth_scene();
    d.meshes.pop_back();
    for (int i = 0; i < count; ++i) {
        const double x = -1.9 + 4.0 / count * i;
        const float power = i == 7 ? 1e-5f : 2 + 0.1f * static_cast<float>(i);
        d.meshes.push_back(
            make_mesh(make_quad({x, 1.2, -0.3}, {x + 0.05, 1.2, -0.3}, {x + 0.05, 1.2, 0.3}, {x, 1.2, 0.3},
                                make_emitter("lamp" + std::to_string(i), {power, 2, 1}))));
    }
    return d;
}

SceneDescription looked_up_scene()
{
    SceneDescription d = smooth_scene();
    MaterialDescription wall = make_lambert("wall", {0.8f, 0.8f, 0.8f});
    wall.base_color_map = picture_of("colours", Encoding::srgb);
    wall.bump_map = heights_of("waves");
    wall.bump_scale = 4;
    d.meshes[0] = make_mesh(make_mapped_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2}, {4, 3}, wall));
    MeshData coloured = *d.meshes[1].data;
    for (size_t i = 0; i < coloured.positions.size(); ++i)
        coloured.colors.push_back({0.3f, 0.02f * static_cast<float>(i % 40), 0.9f});
    d.meshes[1].data = std::make_shared<const MeshData>(std::move(coloured));
    MaterialDescription tile = make_gauze("tile", {0.9f, 0.8f, 0.7f}, 0.8f, 5);
    tile.normal_map = picture_of("tilted normals", Encoding::linear);
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-0.5, -0.6, 0.9}, {0.6, -0.6, 0.8}, {0.6, 0.3, 0.8}, {-0.5, 0.3, 0.9}, {1, 1}, tile)));
    return d;
}

SceneDescription looked_up_under_sky()
{
    SceneDescription d = looked_up_scene();
    d.meshes.erase(d.meshes.begin() + 2);
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}

SceneDescription all_lights()
{
    SceneDescription d = instances_scene();
    d.lights.push_back(light_of(LightType::point, {2, 2, 2}, {-1.5, 2, 1.5}));
    d.lights.push_back(light_of(LightType::sphere, {10, 12, 14}, {1.5, 2, 1}, 0.2));
    d.lights.push_back(directional_of({1, 0.9f, 0.8f}, {0.5, -1, -0.6}));
    LightDescription spot = light_of(LightType::spot, {3, 3, 2}, {0.5, 2.5, -1});
    spot.direction = {-0.2, -1, 0.4}, spot.inner_deg = 15, spot.outer_deg = 40;
    d.lights.push_back(spot);
    d.lights.push_back(sky_of({0.2f, 0.2f, 0.3f}));
    d.spheres.push_back(sphere_of({0, 0.9, 0.2}, 0.3, "floor"));
    MaterialDescription screen = make_emitter("screen", {3, 3, 3});
    screen.emission_map = picture_of("colours", Encoding::srgb);
    d.meshes.push_back(
        make_mesh(make_mapped_quad({-2, 0, -0.5}, {-1.6, 0, 0}, {-1.6, 0.6, 0}, {-2, 0.6, -0.5}, {2, 2}, screen)));
    MaterialDescription grille = make_gauze("grille", {}, 0.8f, 5);
    grille.emission = {6, 5, 4};
    d.meshes.push_back(
        make_mesh(make_mapped_quad({1.6, 0, 0}, {2, 0, -0.5}, {2, 0.6, -0.5}, {1.6, 0.6, 0}, {1, 1}, grille)));
    return d;
}

SceneDescription many_lights()
{
    SceneDescription d = all_lights();
    for (int i = 0; i < 80; ++i)
        d.lights.push_back(light_of(LightType::point, {0.1f, 0.1f, 0.1f}, {0.05 * i - 2, 1, 1}));
    return d;
}

SceneDescription sun_and_sky()
{
    SceneDescription d = sky_scene();
    d.lights.push_back(directional_of({3, 3, 3}, {0.5, -1, -0.6}));
    return d;
}

SceneDescription lamp_and_sky()
{
    SceneDescription d = smooth_scene();
    d.lights.push_back(sky_of({0.2f, 0.3f, 0.4f}));
    return d;
}

SceneDescription mapped_sky()
{
    SceneDescription d = lamp_and_sky();
    d.lights = {sky_map_of({0.5f, 0.5f, 0.5f}, {10, 20, 30}), light_of(LightType::point, {1, 1, 1}, {0, 3, 0})};
    d.background.emplace();
    d.background->sky = SkyType::dusk;
    d.background->ground = GroundType::checker;
    d.background->glow = true;
    return d;
}

SceneDescription all_materials()
{
    SceneDescription d = glossy_scene();
    d.materials.push_back(make_glossy("mirror", MaterialType::mirror, {0.9f, 0.8f, 0.7f}, 0));
    d.materials.push_back(make_glossy("glass", MaterialType::glass, {1, 1, 1}, 0));
    d.materials.push_back(make_interface("classic", course_material("glass")));
    d.materials.push_back(make_interface("gleaming", course_material("red_plastic")));
    d.materials.push_back(make_gauze("gauze", {0.7f, 0.6f, 0.3f}, 0.5f));
    d.materials.back().type = MaterialType::plastic;
    d.materials.push_back(make_translucent("paper", {0.3f, 0.4f, 0.5f}, {0.6f, 0.5f, 0.3f}));
    MaterialDescription layered = default_description(MaterialType::principled);
    layered.name = "layered";
    layered.coat = layered.fuzz = layered.film = 0.5f, layered.transmission = 0.3f, layered.metallic = 0.3f;
    layered.anisotropy = 0.7f;
    d.materials.push_back(layered);
    d.spheres.push_back(sphere_of({0.8, -0.4, 1.1}, 0.2, "layered"));
    d.spheres.push_back(sphere_of({-0.3, -0.4, 1}, 0.2, "paper"));
    d.spheres.push_back(sphere_of({-0.8, -0.3, 0.9}, 0.2, "mirror"));
    d.spheres.push_back(sphere_of({0.3, -0.3, 0.8}, 0.2, "glass"));
    d.spheres.push_back(sphere_of({0.1, 0.4, 0.3}, 0.2, "classic"));
    d.spheres.push_back(sphere_of({0.8, 0.4, 0}, 0.2, "gleaming"));
    d.spheres.push_back(sphere_of({-0.6, 0.6, 0.4}, 0.2, "gauze"));
    d.spheres.push_back(sphere_of({1.3, 0.6, -0.6}, 0.3, ""));
    for (const float roughness : {0.0f, 0.5f}) {
        MaterialDescription sheet = make_glossy("sheet", MaterialType::glass, {0.7f, 0.9f, 0.8f}, roughness);
        sheet.thin = true;
        const double x = 1.6 * double{roughness};
        d.meshes.insert(d.meshes.begin(), make_mesh(make_quad({x - 0.7, -0.5, 1.3}, {x, -0.5, 1.4}, {x, 0.2, 1.3},
                                                              {x - 0.7, 0.2, 1.2}, sheet)));
    }
    return d;
}

SceneDescription materials_under_sky()
{
    SceneDescription d = all_materials();
    d.meshes.pop_back();  // the panel
    d.lights = {sky_of({0.5f, 0.7f, 0.9f})};
    return d;
}

SceneDescription materials_under_lamps(int count)
{
    SceneDescription d = many_lamps(count);
    d.materials = {make_glossy("glass", MaterialType::glass, {1, 1, 1}, 0),
                   make_glossy("frosted", MaterialType::glass, {0.9f, 1, 0.9f}, 0.4f),
                   make_glossy("steel", MaterialType::metal, {0.6f, 0.6f, 0.7f}, 0.5f),
                   make_glossy("lacquer", MaterialType::plastic, {0.6f, 0.2f, 0.2f}, 0.3f)};
    for (int i = 0; i < 4; ++i) {
        d.spheres.push_back(sphere_of({0.6 * i - 1, 0.2, 0.7}, 0.25, d.materials[static_cast<size_t>(i)].name));
        d.spheres.push_back(sphere_of({0.6 * i - 0.9, -0.5, 1}, 0.2, d.materials[static_cast<size_t>(i)].name));
    }
    return d;
}

SceneDescription smooth_materials()
{
    SceneDescription d = smooth_scene();
    MeshData steel = *d.meshes[1].data;
    steel.materials = {make_glossy("steel", MaterialType::metal, {0.6f, 0.6f, 0.7f}, 0.3f)};
    d.meshes[1].data = std::make_shared<const MeshData>(std::move(steel));
    d.meshes.push_back(make_mesh(make_cube(make_glossy("ice", MaterialType::glass, {0.9f, 1, 0.9f}, 0.1f)),
                                 {{-0.6, -0.3, 0.9}, {20, 30, 0}, {0.3, 0.3, 0.3}}));
    return d;
}

SceneDescription pictured_materials()
{
    SceneDescription d = materials_under_lamps(3);
    MaterialDescription wall = make_glossy("varnish", MaterialType::plastic, {0.9f, 0.8f, 0.7f}, 0.4f);
    wall.base_color_map = picture_of("colours", Encoding::srgb);
    d.meshes[0] = make_mesh(make_mapped_quad({-2, -0.8, 2}, {2, -0.8, 2}, {2, -0.8, -2}, {-2, -0.8, -2}, {4, 3}, wall));
    MeshData painted = *d.meshes[1].data;
    painted.materials = {make_glossy("paint", MaterialType::plastic, {0.8f, 0.8f, 0.8f}, 0.2f)};
    for (size_t i = 0; i < painted.positions.size(); ++i)
        painted.colors.push_back({0.3f, 0.02f * static_cast<float>(i % 40), 0.9f});
    d.meshes[1].data = std::make_shared<const MeshData>(std::move(painted));
    MaterialDescription half = make_glossy("half metal", MaterialType::plastic, {0.8f, 0.6f, 0.4f}, 0.3f);
    half.metallic = 1;
    half.metallic_map = picture_of("colours", Encoding::linear, Channel::red);
    half.roughness_map = picture_of("waves", Encoding::linear, Channel::red);
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-0.5, -0.6, 0.9}, {0.6, -0.6, 0.8}, {0.6, 0.3, 0.8}, {-0.5, 0.3, 0.9}, {2, 3}, half)));
    MaterialDescription brushed = default_description(MaterialType::principled);
    brushed.name = "brushed", brushed.metallic = 1.0f, brushed.anisotropy = 0.8f, brushed.roughness = 0.6f;
    brushed.roughness_map = picture_of("waves", Encoding::linear, Channel::red);
    d.meshes.push_back(make_mesh(
        make_mapped_quad({-1.7, -0.7, 0.6}, {-0.9, -0.7, 0.8}, {-0.9, 0, 0.5}, {-1.7, 0, 0.4}, {1, 1}, brushed)));
    MaterialDescription leaf = make_translucent("leaf", {0.9f, 0.9f, 0.9f}, {0.5f, 0.6f, 0.3f});
    leaf.base_color_map = leaf.transmittance_map = picture_of("colours", Encoding::srgb);
    leaf.bump_map = heights_of("waves");
    d.meshes.push_back(
        make_mesh(make_mapped_quad({0.7, -0.7, 1}, {1.5, -0.7, 0.9}, {1.4, 0.1, 0.6}, {0.6, 0.1, 0.7}, {1, 2}, leaf)));
    return d;
}

// Principled spheres side by side, each with something that few have: neighbouring points are of different kinds.
static SceneDescription kinds_of_principled()
{
    SceneDescription d = all_lights();
    using Change = void (*)(MaterialDescription&);
    const Change kinds[] = {[](MaterialDescription&) {},
                            [](MaterialDescription& m) {
                                m.coat = 0.8f, m.coat_color = Color{0.9f, 0.5f, 0.2f};
                            },
                            [](MaterialDescription& m) { m.fuzz = 0.7f, m.coat = 0.5f, m.coat_roughness = 0.4f; },
                            [](MaterialDescription& m) { m.film = 0.8f; },
                            [](MaterialDescription& m) { m.film = 1, m.metallic = 1.0f, m.anisotropy = 0.5f; },
                            [](MaterialDescription& m) { m.anisotropy = 0.8f, m.anisotropy_rotation = 0.1f; },
                            [](MaterialDescription& m) { m.diffuse_roughness = 0.9f; },
                            [](MaterialDescription& m) { m.film = 0.4f, m.roughness = 0, m.diffuse_roughness = 0.3f; },
                            [](MaterialDescription& m) { m.transmission = 0.6f, m.fuzz = 0.2f; },
                            [](MaterialDescription& m) { m.transmission = 1, m.film = 1, m.thin = true; }};
    for (int i = 0; i < 40; ++i) {
        MaterialDescription m = default_description(MaterialType::principled);
        m.name = "kind" + std::to_string(i), m.roughness = 0.2f + 0.1f * static_cast<float>(i / 10);
        m.metallic = 0.2f, m.specular = Color{0.9f, 0.8f, 1};
        kinds[i % 10](m);
        d.materials.push_back(m);
        d.spheres.push_back(sphere_of({0.2 * (i % 10) - 0.9, 0.2 * (i / 10) - 0.6, 1.2}, 0.1, m.name));
    }
    // Only the tangent differs from point to point.
    for (const float rotation : {0.0f, 0.3f}) {
        MaterialDescription brushed = default_description(MaterialType::principled);
        brushed.name = "brushed" + std::to_string(d.meshes.size()), brushed.metallic = 1.0f, brushed.roughness = 0.5f;
        brushed.anisotropy = 0.9f, brushed.anisotropy_rotation = rotation;
        const double x = rotation > 0 ? 0.2 : -1.2;
        d.meshes.push_back(make_mesh(
            make_mapped_quad({x, 0.1, 1}, {x + 1, 0.1, 1.2}, {x + 1, 0.5, 0.9}, {x, 0.5, 1.1}, {1, 1}, brushed)));
    }
    return d;
}

SceneDescription balls_of_light()
{
    SceneDescription d = all_materials();
    d.meshes.pop_back();  // the panel
    d.lights = {light_of(LightType::sphere, {10, 12, 14}, {1.5, 2, 1}, 0.2),
                light_of(LightType::sphere, {400, 300, 200}, {-1.5, 5, 1}, 0.05), sky_of({0.2f, 0.2f, 0.3f})};
    d.render.mis_compensation = false;  // the sky is one of the lights
    MaterialDescription shown = make_emitter("shown", {30, 30, 30});
    shown.emission_map = picture_of("colours", Encoding::srgb);
    d.materials.push_back(shown);
    d.spheres.push_back(sphere_of({-1.6, 0.5, 1}, 0.2, "shown"));
    d.meshes.push_back(make_mesh(make_quad({1.4, 0, -0.3}, {1.4, 0, 0.3}, {1.4, 0.6, 0.3}, {1.4, 0.6, -0.3},
                                           make_emitter("plain", {30, 20, 10}))));
    return d;
}

SceneDescription balls_beside_a_sky()
{
    SceneDescription d = balls_of_light();
    d.render.mis_compensation = true;
    return d;
}

SceneDescription a_dim_ball_more()
{
    SceneDescription d = balls_of_light();
    d.lights.push_back(light_of(LightType::sphere, {0.01f, 0.02f, 0.01f}, {0.5, 1.5, 1}, 0.1));
    return d;
}

SceneDescription many_balls()
{
    SceneDescription d = balls_of_light();
    for (int i = 0; i < 80; ++i)
        d.lights.push_back(light_of(LightType::sphere, {1, 0.5f, 0.2f}, {0.05 * i - 2, 1.6, 1}, 0.02));
    return d;
}

SceneDescription inside_a_ball()
{
    SceneDescription d = balls_of_light();
    d.lights.pop_back();  // the sky
    MaterialDescription around = make_emitter("around", {0.2f, 0.2f, 0.1f});
    around.emission_both_sides = true;
    d.materials.push_back(around);
    d.spheres.push_back(sphere_of({0, 0, 0}, 6, "around"));
    return d;
}

SceneDescription points_of_light()
{
    SceneDescription d = balls_of_light();
    d.render.soft_shadows = false;
    return d;
}

SceneDescription materials_and_many_lights()
{
    SceneDescription d = all_materials();
    for (int i = 0; i < 80; ++i)
        d.lights.push_back(light_of(LightType::point, {0.1f, 0.1f, 0.1f}, {0.05 * i - 2, 1.4, 1}));
    return d;
}

// The room before the curtain has a light as well.
SceneDescription curtain_between_lights()
{
    SceneDescription d = room_behind_a_curtain();
    d.lights = {light_of(LightType::sphere, {2, 2, 2}, {0, 0.5, 0}, 0.3)};
    return d;
}

// Through a lens whose focus moves as well.
static SceneDescription from_a_moving_camera()
{
    SceneDescription d = smooth_scene();
    CameraDescription c = d.camera ? *d.camera : make_camera({0, 0.5, 4}, {0, 0, 0}, 40);
    c.type = CameraType::thin_lens, c.aperture = 0.05;
    d.camera = c;
    for (const double t : {0.0, 0.5, 1.0}) {
        c.position.x = d.camera->position.x + 0.3 * t * t, c.focus = 3 + t;
        d.camera_path.push_back(c);
    }
    d.camera = d.camera_path.front();
    return d;
}

// Instances and spheres of all materials; those that shine stay.
static SceneDescription things_that_move(SceneDescription d)
{
    for (InstanceDescription& i : d.instances)
        for (const double x : {0.0, 1.0, 2.0}) {
            TransformDescription place = i.transform;
            place.translate += Vec3d{0.1 * x, 0.05 * x, 0}, place.rotate_deg.y += 30 * x;
            i.path.push_back(place);
        }
    for (SphereDescription& s : d.spheres)
        for (const double x : {0.0, 1.0}) s.path.push_back({s.center + Vec3d{0, 0.2 * x, 0.1 * x}, s.radius});
    return d;
}

std::vector<WideCase> wide_cases()
{
    std::vector<WideCase> cases{{"smooth", smooth_scene()},
                                {"sky", sky_scene()},
                                {"lamps", many_lamps(20)},
                                {"tree", many_lamps(50)},
                                {"textures", looked_up_scene()},
                                {"kinds of principled", kinds_of_principled()},
                                {"textures, sky", looked_up_under_sky()},
                                {"lights", all_lights()},
                                {"many lights", many_lights()},
                                {"sun, sky", sun_and_sky()},
                                {"lamp, sky", lamp_and_sky()},
                                {"sky map", mapped_sky()},
                                {"materials", all_materials()},
                                {"materials, sky", materials_under_sky()},
                                {"materials, lamps", materials_under_lamps(20)},
                                {"materials, tree", materials_under_lamps(50)},
                                {"materials, lights", materials_and_many_lights()},
                                {"balls", balls_of_light()},
                                {"balls beside a sky", balls_beside_a_sky()},
                                {"behind a window", room_with_hole(0.3)},
                                {"behind a curtain", curtain_between_lights()},
                                {"under a sun", room_under_a_sun()},
                                {"beside a brighter room", room_beside_a_brighter_one()},
                                {"glossy under a sky", glossy_room_under_a_sky()},
                                {"a dim ball more", a_dim_ball_more()},
                                {"many balls", many_balls()},
                                {"inside a ball", inside_a_ball()},
                                {"points", points_of_light()},
                                {"smooth materials", smooth_materials()},
                                {"pictured materials", pictured_materials()},
                                {"few flat triangles", flat_scene(5, 8)},
                                {"many flat triangles", flat_scene(30, 40)},
                                {"from a moving camera", from_a_moving_camera()},
                                {"things that move", things_that_move(all_lights())},
                                {"materials that move", things_that_move(all_materials())}};
    for (const NamedRoom& room : rooms_with_window()) cases.push_back({room.name, room.description});
    return cases;
}

}  // namespace lancer
