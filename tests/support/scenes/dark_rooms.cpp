#include "support/scenes/dark_rooms.h"

#include "support/scenes/things.h"

namespace lancer {

namespace {

MeshDescription wall(Vec3d a, Vec3d b, Vec3d c, Vec3d d)
{
    return make_mesh(make_quad(a, b, c, d, make_lambert("grey", {0.6f, 0.6f, 0.6f})));
}

MeshDescription glossy_floor()
{
    return make_mesh(make_quad({-1, -0.99, 1}, {1, -0.99, 1}, {1, -0.99, -1}, {-1, -0.99, -1},
                               make_glossy("floor", MaterialType::plastic, {0.5f, 0.4f, 0.3f}, 0.2f)));
}

// The walls of a box from -1 to `end` along x, and one with a square hole at x = 1.
SceneDescription box_with_hole(double end, double hole)
{
    SceneDescription d;
    const auto across = [&](double x, double y0, double y1, double z0, double z1) {
        d.meshes.push_back(wall({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}));
    };
    across(-1, -1, 1, -1, 1);
    if (end > 1) across(end, -1, 1, -1, 1);
    across(1, -1, -hole, -1, 1), across(1, hole, 1, -1, 1);
    across(1, -hole, hole, -1, -hole), across(1, -hole, hole, hole, 1);
    for (const double s : {-1.0, 1.0}) {
        d.meshes.push_back(wall({-1, s, -1}, {end, s, -1}, {end, s, 1}, {-1, s, 1}));
        d.meshes.push_back(wall({-1, -1, s}, {end, -1, s}, {end, 1, s}, {-1, 1, s}));
    }
    d.camera = make_camera({0.9, 0.6, 0.9}, {-1, -0.4, -0.6}, 70);
    return d;
}

}  // namespace

SceneDescription room_with_hole(double hole)
{
    SceneDescription d = box_with_hole(3, hole);
    d.meshes.push_back(make_mesh(make_quad({1.8, 0.99, -0.3}, {2.4, 0.99, -0.3}, {2.4, 0.99, 0.3}, {1.8, 0.99, 0.3},
                                           make_emitter("lamp", {40, 40, 40}))));
    return d;
}

SceneDescription room_behind_a_curtain()
{
    SceneDescription d = room_with_hole(0.3);
    d.meshes.push_back(make_mesh(make_quad({0.97, -0.4, -0.4}, {0.97, 0.4, -0.4}, {0.97, 0.4, 0.4}, {0.97, -0.4, 0.4},
                                           make_translucent("curtain", {0.3f, 0.3f, 0.2f}, {0.6f, 0.5f, 0.4f}))));
    return d;
}

SceneDescription room_with_niche()
{
    SceneDescription d = room_with_hole(0.1);
    d.meshes.push_back(make_mesh(make_quad({-0.999, -0.05, -0.05}, {-0.999, 0.05, -0.05}, {-0.999, 0.05, 0.05},
                                           {-0.999, -0.05, 0.05}, make_emitter("glow", {20, 20, 20}))));
    for (const double s : {-0.08, 0.08}) {
        d.meshes.push_back(wall({-1, s, -0.08}, {-0.7, s, -0.08}, {-0.7, s, 0.08}, {-1, s, 0.08}));
        d.meshes.push_back(wall({-1, -0.08, s}, {-0.7, -0.08, s}, {-0.7, 0.08, s}, {-1, 0.08, s}));
    }
    return d;
}

SceneDescription room_beside_a_brighter_one()
{
    SceneDescription d = room_with_hole(0.1);
    d.meshes.push_back(make_mesh(make_quad({-0.6, 0.98, -0.2}, {-0.2, 0.98, -0.2}, {-0.2, 0.98, 0.2}, {-0.6, 0.98, 0.2},
                                           make_emitter("dim lamp", {2, 2, 2}))));
    return d;
}

SceneDescription room_under_a_sun()
{
    SceneDescription d = room_beside_a_brighter_one();
    d.lights = {directional_of({100, 100, 100}, {0, -1, 0})};
    return d;
}

SceneDescription glossy_room_under_a_sky()
{
    SceneDescription d = room_under_a_sun();
    d.meshes.push_back(glossy_floor());
    d.lights.push_back(sky_map_of({3, 3, 3}));
    return d;
}

std::vector<NamedRoom> rooms_with_window()
{
    const LightDescription picture = sky_map_of({3, 3, 3}), even = sky_of({3, 3, 3});
    std::vector<NamedRoom> rooms;
    const auto add = [&](const char* name, const std::vector<LightDescription>& lights, bool glossy) {
        SceneDescription d = box_with_hole(1, 0.3);
        d.lights = lights;
        if (glossy) d.meshes.push_back(glossy_floor());
        rooms.push_back({name, d});
    };
    add("pictured sky", {picture}, false);
    add("pictured sky, glossy", {picture}, true);
    add("even sky", {even}, false);
    add("even sky, glossy", {even}, true);
    add("even sky and sun", {even, directional_of({3, 3, 3}, {-1, -0.4, 0.1})}, false);
    return rooms;
}

}  // namespace lancer
