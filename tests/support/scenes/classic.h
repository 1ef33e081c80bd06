// Materials and modes for the tests of the classic integrators: the course's thirteen materials as it lists them, and
// scenes in its mode.
#pragma once

#include <string>
#include <vector>

#include "support/shoot.h"

namespace lancer {

struct CourseMaterial {
    std::string name;
    Phong phong;
};
inline std::vector<CourseMaterial> course_materials()
{
    const auto make = [](const char* name, Color ambient, Color diffuse, Color specular, float shininess,
                         std::array<float, 3> parts, float ior = 1) {
        return CourseMaterial{name, {ambient, diffuse, specular, shininess, parts[0], parts[1], parts[2], ior, 1}};
    };
    return {
        make("white_plastic", {.1f, .1f, .1f}, {.7f, .7f, .7f}, {1, 1, .98f}, 5, {.9f, .1f, 0}),
        make("red_plastic", {.1f, 0, 0}, {.85f, .05f, .05f}, {1, .8f, .8f}, 5, {1, .05f, 0}),
        make("bronze", {.1125f, .0675f, .054f}, {.714f, .4284f, .18144f}, {.9f, .8f, .7f}, 56, {.5f, .75f, 0}),
        make("emerald", {0, .01f, 0}, {.09568f, .77424f, .1f}, {.9f, 1, .9f}, 76.8f, {.15f, .5f, .65f}, 1.5f),
        make("glass", {}, {.95f, .95f, 1}, {1, 1, 1}, 80, {.01f, .05f, .98f}, 1.5f),
        make("black_matter", {.05f, .05f, .05f}, {.1f, .1f, .1f}, {.2f, .2f, .2f}, .5f, {1, 0, 0}),
        make("sand", {.1f, .075f, .05f}, {1, .9f, .7f}, {1, 1, .98f}, 2, {1, 0, 0}),
        make("mirror", {}, {.05f, .05f, .05f}, {.98f, .99f, 1}, 80, {.01f, .99f, 0}),
        make("blue_water", {.1f, .1f, .2f}, {.1f, .6f, .8f}, {1, 1, 1}, 70, {.01f, .2f, .8f}, 1.3f),
        make("grey_matter", {}, {.45f, .45f, .45f}, {.5f, .5f, .5f}, .5f, {1, 0, 0}),
        make("steel", {.05f, .05f, .05f}, {.3f, .3f, .31f}, {.7f, .7f, .71f}, 10, {.8f, .2f, 0}),
        make("ruby", {.15f, 0, 0}, {.7f, 0, .05f}, {1, .9f, .9f}, 76.8f, {.25f, .25f, .5f}, 1.5f),
        make("grey_metallic", {.05f, .05f, .05f}, {.75f, .75f, .8f}, {1, 1, 1}, 30, {.9f, .1f, 0}),
    };
}
inline Phong course_material(const std::string& name)
{
    for (const CourseMaterial& m : course_materials())
        if (m.name == name) return m.phong;
    ADD_FAILURE() << "no material " << name;
    return {};
}

inline MaterialDescription make_interface(std::string name, const Phong& phong)
{
    MaterialDescription m = make_lambert(std::move(name), phong.diffuse);
    m.type = MaterialType::interface;
    m.phong = phong;
    return m;
}
inline Phong inside_out(Phong p)
{
    std::swap(p.inside_ior, p.outside_ior);
    return p;
}

// A shell that is `thickness` thin, of material `name` and, inside, of it inside out.
inline void add_bubble(SceneDescription& d, const std::string& name, Vec3d center, double radius,
                       double thickness = 0.02)
{
    const Phong p = course_material(name);
    d.materials.push_back(make_interface(name, p));
    d.materials.push_back(make_interface(name + " inside out", inside_out(p)));
    d.spheres.push_back(sphere_of(center, radius, name));
    d.spheres.push_back(sphere_of(center, radius - thickness, name + " inside out"));
}

template <class Integrator>
Integrator of_depth(uint32_t max_depth)
{
    Integrator i;
    i.max_depth = max_depth;
    return i;
}

// `how` in the mode of the past or not, and the scene with it.
template <class Integrator>
Film shoot_classic(SceneDescription d, Integrator how, bool legacy, Shot shot)
{
    how.legacy = legacy;
    shot.integrator = how;
    d.render.legacy = legacy;
    d.render.integrator = Integrator::kind;
    return shoot(d, shot);
}

}  // namespace lancer
