#include "app/scene_facts.h"

#include <algorithm>
#include <set>

#include "app/console.h"
#include "app/options/options.h"
#include "core/names.h"
#include "scene/environment/background.h"
#include "scene/features.h"
#include "scene/placement.h"

namespace lancer {
namespace {

template <class T>
uint64_t bytes_of(const std::vector<T>& v)
{
    return v.size() * sizeof(T);
}

template <class T, class F>
uint64_t count(const std::vector<T>& v, const F& is_meant)
{
    return static_cast<uint64_t>(std::count_if(v.begin(), v.end(), is_meant));
}

void count_shapes(const SceneDescription& d, const Scene& scene, SceneFacts& facts)
{
    facts.triangles = scene.triangle_count();
    for (const Mesh& m : scene.geometry.meshes) {
        facts.vertices += m.vertices();
        if (!m.instanced) facts.drawn += m.triangles.size();
    }
    for (const Instance& i : scene.geometry.instances) facts.drawn += scene.geometry.meshes[i.mesh].triangles.size();
    const auto meshes = [&](const char* shape) {
        return count(d.meshes, [&](const MeshDescription& m) { return m.data->shape == shape; });
    };
    using Part = SphereDescription::Part;
    const auto spheres = [&](Part part) {
        return count(d.spheres, [&](const SphereDescription& s) { return s.part == part; });
    };
    const uint64_t water = count(d.planes, [](const PlaneDescription& p) { return p.is_water; });
    facts.shapes = {meshes(""),           meshes("triangle"),    meshes("pyramid"),       instance_count(d),
                    spheres(Part::whole), spheres(Part::bubble), d.planes.size() - water, water};
    facts.bounds = subject_bounds(d);
}

void count_materials(const SceneDescription& d, const Scene& scene, SceneFacts& facts)
{
    for (uint32_t i = 0; i < scene.traits.size(); ++i) {
        const bool is_mix = !scene.mix_of.empty() && scene.mix_of[i] != Scene::none;
        const MaterialType type = scene.type_of(i);
        ++facts.materials[std::string(name_of(is_mix ? MaterialType::mix : type))];
    }
    std::set<std::string> told;
    for (const MeshDescription& mesh : d.meshes)
        for (const MaterialDescription& m : mesh.data->materials) {
            if (m.why.empty() || !told.insert(m.where.file + '\n' + m.name).second) continue;
            facts.reasons.push_back({m.name, std::string(name_of(m.type)), m.why});
        }
    for (const Scene::Note& note : scene.sheets) facts.sheets.push_back(note.text);
    for (const Scene::Note& note : scene.divisions) facts.divisions.push_back(note.text);
}

void count_textures_and_lights(const SceneDescription& d, const Scene& scene, SceneFacts& facts)
{
    for (const Texture& t : scene.textures)
        if (const auto* image = std::get_if<ImageTexture>(&t))
            facts.images.push_back({image->width(), image->height(), image->bytes()});
    facts.other_textures = scene.textures.size() - facts.images.size();
    for (const LightDescription& l : d.lights) ++facts.lights[std::string(name_of(l.type))];
    facts.emitting_triangles =
        count(scene.lights.lights, [](const Light& l) { return std::holds_alternative<TriangleLight>(l); });
}

void name_background(const BackgroundDescription& b, const Scene& scene, SceneFacts& facts)
{
    constexpr std::array skies{"a colour", "gradient", "night", "dawn", "dusk", "noon", "picture"};
    constexpr std::array grounds{"none", "a colour", "checker", "picture"};
    const auto sized = [](const std::string& name, const auto& picture) {
        return picture ? name + format_text(" %dx%d", int(picture->width()), int(picture->height())) : name;
    };
    facts.sky = skies[static_cast<size_t>(b.sky)];
    facts.ground = grounds[static_cast<size_t>(b.ground)];
    facts.has_glow = b.glow;
    if (const Background* made = scene.background.get()) {
        facts.sky = sized(facts.sky, made->sky_picture());
        facts.ground = made->ground_plane() ? sized(facts.ground, made->ground_plane())
                                            : sized(facts.ground, made->ground_picture());
    }
}

SceneFacts::Bytes count_bytes(const Scene& scene, const Accelerator& accelerator)
{
    SceneFacts::Bytes bytes;
    const Geometry& g = scene.geometry;
    bytes.geometry = bytes_of(g.spheres) + bytes_of(g.planes) + bytes_of(g.instances);
    for (const Mesh& m : g.meshes) bytes.geometry += bytes_of(m.positions) + bytes_of(m.triangles);
    for (const MeshShading& s : scene.shading)
        bytes.shading += s.normals.bytes() + bytes_of(s.uvs) + bytes_of(s.second_uvs) + s.uv_triangles.bytes() +
                         s.tangents.bytes() + bytes_of(s.alphas) + s.face_material.bytes() + s.emitters.bytes();
    for (const Texture& t : scene.textures)
        if (const auto* image = std::get_if<ImageTexture>(&t)) bytes.textures += image->bytes();
    bytes.lights = bytes_of(scene.lights.lights);
    bytes.accelerator = accelerator.stats().bytes;
    return bytes;
}

}  // namespace

SceneFacts facts_of(const SceneDescription& d, const Scene& scene, const Accelerator& accelerator)
{
    SceneFacts facts;
    facts.file = d.file;
    count_shapes(d, scene, facts);
    count_materials(d, scene, facts);
    count_textures_and_lights(d, scene, facts);
    if (d.background) name_background(*d.background, scene, facts);
    facts.has_unnamed_camera = d.camera && d.camera->name.empty();
    for (const CameraDescription& c : d.cameras) facts.cameras.push_back(c.name);
    const Features has = features_of(scene);
    for (size_t i = 0; i < static_cast<size_t>(Feature::count); ++i)
        if (has.has(static_cast<Feature>(i))) facts.features.emplace_back(name_of(static_cast<Feature>(i)));
    if (!d.overrides.empty()) facts.features.emplace_back("material overrides");
    facts.bytes = count_bytes(scene, accelerator);
    return facts;
}

}  // namespace lancer
