#include "app/defaults/default_light.h"

#include <algorithm>
#include <cmath>

#include "app/console.h"
#include "app/defaults/default_ground.h"
#include "app/defaults/key_light.h"
#include "app/defaults/toml_text.h"
#include "core/frame.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "io/toml_write.h"
#include "render/estimators/own_light.h"
#include "scene/build/scene_builder.h"
#include "scene/environment/environment.h"
#include "scene/placement.h"

namespace lancer {
namespace {

// A constant sky and a key light, nearly white, so that surfaces show their own colours: the key is 2.4 times as strong
// as the sky on a surface that faces it. With both, a white surface on the ground has a radiance of about 0.5.
constexpr Color sky_radiance{0.197f, 0.2f, 0.203f};
constexpr Color key_irradiance{1.55f, 1.51f, 1.45f};  // of a surface that faces it
// Seen as 21 degrees across, for soft shadows. So far away that it lights all of the ground alike, up to the horizon.
constexpr double sine_of_key = 0.18, distance_of_key = 1e5;  // in radii of the subject
constexpr double most_open = 0.4;                            // beyond, a view is out of doors
constexpr double least_lit = 1 / 3.0;
constexpr double most_albedo = 0.8;

// Emissive materials count only if a face uses them.
bool emits(const MeshData& mesh)
{
    const auto shines = [&](size_t material) {
        return material < mesh.materials.size() && !is_black(mesh.materials[material].emission);
    };
    if (mesh.face_material.empty()) return shines(0);
    return std::any_of(mesh.face_material.begin(), mesh.face_material.end(), shines);
}

bool has_emitting_faces(const SceneDescription& scene)
{
    const auto shines = [](const MaterialDescription& m) { return !is_black(m.emission); };
    return std::any_of(scene.materials.begin(), scene.materials.end(), shines) ||
           std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const MeshDescription& m) { return m.material.empty() && emits(*m.data); });
}

// Settings of its own: the light that is added must not depend on those of the picture.
OwnLight own_light(const SceneDescription& scene, double aspect, const RasterSource& pictures,
                   const PictureMemory& memory)
{
    RenderSettings settings;
    settings.size = {static_cast<uint32_t>(std::clamp(std::lround(720 * aspect), 1l, 65535l)), 720};
    Diagnostics ignored;  // the real scene reports the same problems
    const Renderer renderer(SceneBuilder(scene, settings, ignored, pictures, memory), configure(settings, 256),
                            ignored);
    return measure_own_light(renderer, *scene.camera, settings.size, double{luminance(sky_radiance)});
}

std::string percent(double x) { return format_text("%.0f %%", 100 * x); }

struct Judgement {
    bool needs_sky = true;
    float strength = 1;  // of what is added, so that lamps of any unit do not leave it in the dark
    std::string why;
};

Judgement judge(const SceneDescription& scene, double aspect, const RasterSource& pictures, const PictureMemory& memory)
{
    if (!has_emitting_faces(scene)) return {.why = "nothing in the mesh emits light"};
    const OwnLight own = own_light(scene, aspect, pictures, memory);
    const std::string share = "the mesh's own lamps light " + percent(own.lit) + " of what is seen";
    const std::string open = percent(own.open) + " of a sky would reach it";
    if (own.open <= most_open && own.lit >= least_lit) return {false, 1, share + ", and only " + open};
    const double level = own.lit >= least_lit ? std::max(1.0, own.level) : 1;
    return {true, static_cast<float>(std::exp2(std::round(std::log2(level)))), share + ", and " + open};
}

LightDescription make_sky(float strength)
{
    LightDescription sky;
    sky.type = LightType::environment;
    sky.power = sky_radiance * strength;
    return sky;
}

// way: to it, unit.
LightDescription make_key(const SceneDescription& scene, Vec3d way, float strength)
{
    const Bounds subject = subject_bounds(scene);
    const double r = subject.radius() > 0 ? subject.radius() : 1;
    LightDescription key;
    key.type = LightType::sphere;
    key.position = (subject.empty() ? Vec3d{} : subject.center()) + way * (distance_of_key * r);
    key.radius = sine_of_key * distance_of_key * r;
    key.power = key_irradiance * (strength / static_cast<float>(pi_d * sine_of_key * sine_of_key));
    return key;
}

// With which the ground is as bright as the sky: no horizon shows.
Color albedo_of_ground(Vec3d way_to_key, Vec3d up)
{
    const double slant = dot(way_to_key, up);
    const auto albedo = [&](float sky, float key) {
        return static_cast<float>(std::min(most_albedo, sky / (sky + std::max(0.0, slant) * key / pi_d)));
    };
    return {albedo(sky_radiance.r, key_irradiance.r), albedo(sky_radiance.g, key_irradiance.g),
            albedo(sky_radiance.b, key_irradiance.b)};
}

std::string text_of(const LightDescription& light)
{
    std::string text = std::string("[[light]]\ntype = \"") + std::string(name_of(light.type)) + "\"\n";
    if (!light.file.empty()) {
        text += "file = " + to_toml_string(light.file) + "\n";
        if (light.rotate_deg != Vec3d{}) text += "rotate = " + to_toml(light.rotate_deg) + "\n";
        return text;
    }
    if (light.type == LightType::sphere)
        text += "center = " + to_toml(light.position) + "\nradius = " + shortest(light.radius) + "\n";
    return text + "radiance = " + to_toml(light.power) + "\n";
}

std::string text_of(const PlaneDescription& plane, const MaterialDescription& material)
{
    return "[[plane]]\npoint = " + to_toml(plane.point) + "\nnormal = " + to_toml(plane.normal) +
           "\nmaterial = " + to_toml_string(material.name) + "\n[material." + material.name +
           "]\nbase_color = " + to_toml(material.base_color) + "\n";
}

// With which a ground under this picture is as bright, on the mean, as the picture close below its horizon.
Color albedo_of_ground(const EnvironmentMap& map, Vec3d up)
{
    constexpr uint32_t samples = 1 << 14, around = 256;
    const Vec3 z = to_float(up);
    Color irradiance, horizon;
    for (uint32_t i = 0; i < samples && !map.is_black(); ++i) {
        const EnvironmentSample s = map.sample(Sampler::independent2(0, i));
        const float cosine = dot(s.wi, z);
        if (cosine > 0 && s.pdf > 0) irradiance += s.radiance * (cosine / (s.pdf * samples));
    }
    const Frame frame(z);
    for (const double below_deg : {2.0, 4.0, 6.0, 8.0})
        for (uint32_t i = 0; i < around; ++i) {
            const double height = -std::sin(below_deg * pi_d / 180), turn = 2 * pi_d * i / around;
            const double across = std::sqrt(1 - height * height);
            const Vec3d way{across * std::cos(turn), across * std::sin(turn), height};
            horizon += map.eval(frame.to_world(to_float(way))) / (4 * around);
        }
    const auto albedo = [](float seen, float by) {
        return by > 0 ? static_cast<float>(std::clamp(pi_d * double{seen} / double{by}, 0.0, most_albedo)) : 0;
    };
    return {albedo(horizon.r, irradiance.r), albedo(horizon.g, irradiance.g), albedo(horizon.b, irradiance.b)};
}

// The environment of --env, which load_scene() has put into the scene, and the ground below it.
DefaultLight complete_environment(SceneDescription& scene, const SceneChoice& choice, const DefaultView& view,
                                  const RasterSource& pictures, const PictureMemory& memory)
{
    const Vec3d up = view.up;
    LightDescription& light = scene.lights.back();
    if (std::abs(up.z) > std::abs(up.y)) light.rotate_deg = {90, 0, 0};  // its top is +y
    DefaultLight added{text_of(light), "environment " + choice.env};
    if (!choice.ground || !wants_ground(scene, view)) return added;
    PendingPictures pending;
    pending.environment = {light, pictures(light.file)};
    check_picture_memory(pending, memory, RenderSettings{}.texture_limit);
    memory.wait_for(light.file);
    const EnvironmentMap map(pending.environment->image.get(), light.power, {}, light.rotate_deg);
    add_ground(scene, up, albedo_of_ground(map, up));
    return {added.text + text_of(scene.planes.back(), scene.materials.back()), added.note + ", and a ground"};
}

}  // namespace

DefaultLight add_default_light(SceneDescription& scene, const SceneChoice& choice, const DefaultView& view,
                               double aspect, const RasterSource& pictures, const PictureMemory& memory)
{
    if (!choice.env.empty()) return complete_environment(scene, choice, view, pictures, memory);
    if (!scene.lights.empty() || scene.background) return {};
    const Judgement judged = judge(scene, aspect, pictures, memory);
    if (!judged.needs_sky) return {"# no sky: " + judged.why + "\n", "no sky: " + judged.why};
    DefaultLight added;
    const auto add = [&](LightDescription light) {
        light.where = {scene.file};
        added.text += text_of(light);
        scene.lights.push_back(std::move(light));
    };
    const bool has_ground = choice.ground && wants_ground(scene, view);
    const Vec3d way = way_to_key(scene, view.up, aspect);
    add(make_sky(judged.strength));
    add(make_key(scene, way, judged.strength));
    if (has_ground) {
        add_ground(scene, view.up, albedo_of_ground(way, view.up));
        added.text += text_of(scene.planes.back(), scene.materials.back());
    }
    added.note = std::string("added a sky and a key light") + (has_ground ? " and a ground" : "") + ": " + judged.why;
    added.text = "# " + added.note + "\n" + added.text;
    return added;
}

}  // namespace lancer
