#include "app/defaults/default_light.h"

#include <algorithm>

#include "app/console.h"
#include "app/defaults/toml_text.h"
#include "scene/placement.h"

namespace lancer {
namespace {

// Emissive materials count only if a face uses them.
bool emits(const MeshData& mesh)
{
    const auto shines = [&](size_t material) {
        return material < mesh.materials.size() && !is_black(mesh.materials[material].emission);
    };
    if (mesh.face_material.empty()) return shines(0);
    return std::any_of(mesh.face_material.begin(), mesh.face_material.end(), shines);
}

// Whether a light is there or may be: materials given by name are there for a reason.
bool emits(const SceneDescription& scene)
{
    const auto shines = [](const MaterialDescription& m) { return !is_black(m.emission); };
    return !scene.lights.empty() || scene.background ||
           std::any_of(scene.materials.begin(), scene.materials.end(), shines) ||
           std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const MeshDescription& m) { return m.material.empty() && emits(*m.data); });
}

std::vector<LightDescription> default_lights(const Bounds& subject)
{
    const double r = subject.radius() > 0 ? subject.radius() : 1;
    LightDescription sky, sun;
    sky.type = LightType::environment;
    sky.power = {0.4f, 0.46f, 0.55f};
    sun.type = LightType::sphere;
    sun.position = (subject.empty() ? Vec3d{} : subject.center()) + normalize(Vec3d{-0.55, 1, 0.75}) * (10 * r);
    sun.radius = r;  // seen as 11 degrees across: soft shadows, little noise
    sun.power = {62, 57, 48};
    return {sky, sun};
}

}  // namespace

std::string add_default_light(SceneDescription& scene)
{
    if (emits(scene)) return {};
    std::string added;
    for (LightDescription& light : default_lights(subject_bounds(scene))) {
        light.where = {scene.file, 0, 0};
        const bool sun = light.type == LightType::sphere;
        added += std::string("[[light]]\ntype = \"") + (sun ? "sphere" : "environment") + "\"\n";
        if (sun) added += "center = " + to_toml(light.position) + "\nradius = " + shortest(light.radius) + "\n";
        added += "radiance = " + to_toml(light.power) + "\n";
        scene.lights.push_back(std::move(light));
    }
    return added;
}

}  // namespace lancer
