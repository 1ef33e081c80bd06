#include "app/asset_files.h"

#include <algorithm>
#include <set>

#include "core/hash.h"
#include "io/input_file.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

void add(std::vector<std::string>& files, const std::string& file)
{
    if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

void add_pictures(std::vector<std::string>& files, const MaterialDescription& m)
{
    for (const TextureUse* use : textures_of(m))
        if (*use) add(files, (*use)->file);
}

// The names of materials that something of the scene wears, mixes with or stands in.
std::set<std::string> used_materials(const SceneDescription& scene)
{
    std::set<std::string> used;
    const auto use = [&](const std::string& name, const std::optional<Bands>& bands = {}) {
        used.insert(name);
        if (bands) used.insert(bands->material);
    };
    for (const MeshDescription& m : scene.meshes) use(m.material, m.bands);
    for (const SphereDescription& s : scene.spheres) use(s.material);
    for (const PlaneDescription& p : scene.planes) use(p.material, p.bands);
    for (const MaterialOverride& o : scene.overrides) use(o.material);
    if (scene.camera) use(scene.camera->inside);
    for (size_t before = 0; before != used.size();) {
        before = used.size();
        for (const MaterialDescription& m : scene.materials)
            if (m.type == MaterialType::mix && used.count(m.name)) use(m.first), use(m.second);
    }
    return used;
}

enum class Which {
    named,  // in some file
    used,   // by what is drawn: the others are not opened
};

std::vector<std::string> picture_files(const SceneDescription& scene, Which which)
{
    std::vector<std::string> files;
    std::set<const MeshData*> seen;
    const std::set<std::string> used = used_materials(scene);
    const auto wants = [&](const std::string& material) { return which == Which::named || used.count(material); };
    for (const MeshDescription& mesh : scene.meshes)
        if (mesh.data && (which == Which::named || mesh.material.empty()) && seen.insert(mesh.data.get()).second)
            for (const MaterialDescription& m : mesh.data->materials) add_pictures(files, m);
    for (const MaterialDescription& m : scene.materials)
        if (wants(m.name)) add_pictures(files, m);
    for (const MaterialOverride& o : scene.overrides)
        if (o.change) add_pictures(files, o.change({}));
    for (const LightDescription& light : scene.lights) add(files, light.file);
    if (scene.background) {
        add(files, scene.background->sky_picture.file);
        add(files, scene.background->ground_picture.file);
    }
    return files;
}

uint64_t hash_file(const std::string& path)
{
    constexpr size_t at_once = size_t{1} << 20;
    uint64_t hash = 0;
    try {
        InputFile file(path);
        std::string block(at_once, '\0');
        for (size_t n = at_once; n == at_once;) {
            n = file.read(block.data(), at_once);
            hash = hash_bytes({block.data(), n}, hash);
        }
    } catch (const Error&) {
        return 0;
    }
    return hash;
}

}  // namespace

std::vector<std::string> input_files(const SceneDescription& scene)
{
    std::vector<std::string> files{scene.file};
    std::set<const MeshData*> seen;
    for (const MeshDescription& mesh : scene.meshes) {
        if (!mesh.data || !seen.insert(mesh.data.get()).second) continue;
        add(files, mesh.data->file);
        for (const std::string& file : mesh.data->material_files) add(files, file);
    }
    for (const std::string& file : picture_files(scene, Which::named)) add(files, file);
    return files;
}

void hash_assets(SceneDescription& scene, FileHashes* known)
{
    constexpr uint64_t odd = 0x9e3779b97f4a7c15u;
    std::set<const MeshData*> seen;
    for (const MeshDescription& mesh : scene.meshes)
        if (mesh.data && seen.insert(mesh.data.get()).second)
            scene.content_hash = scene.content_hash * odd + mesh.data->content_hash;
    FileHashes own;
    FileHashes& hashes = known ? *known : own;
    for (const std::string& file : picture_files(scene, Which::used)) {
        const auto [entry, is_new] = hashes.try_emplace(file);
        if (is_new) entry->second = hash_file(file);
        scene.content_hash = scene.content_hash * odd + entry->second;
    }
}

}  // namespace lancer
