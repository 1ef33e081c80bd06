#include "io/gltf/gltf.h"

#include <map>
#include <set>
#include <utility>

#include "core/hash.h"
#include "io/gltf/instances.h"
#include "io/gltf/mesh.h"
#include "io/gltf/nodes.h"
#include "io/shared_mesh.h"

namespace lancer {
namespace {

// Adds "file: error: reason", "file:line: error: reason" or "error: reason" as its parts.
void add_error(const Error& e, const std::string& file, Diagnostics& diagnostics)
{
    constexpr std::string_view mark = ": error: ";
    const std::string text = e.what();
    const size_t at = text.starts_with(file) ? text.find(mark, file.size()) : std::string::npos;
    if (at == std::string::npos)
        return diagnostics.error({file, 0, 0}, text.substr(text.starts_with(mark.substr(2)) ? mark.size() - 2 : 0),
                                 e.kind());
    const std::string line = text.substr(file.size(), at - file.size());
    diagnostics.error({file, line.size() > 1 ? static_cast<uint32_t>(std::stoul(line.substr(1))) : 0, 0},
                      text.substr(at + mark.size()), e.kind());
}

class GltfLoader {
public:
    GltfLoader(const std::string& path, const MeshOptions& options)
        : options_(options), doc_(path), buffers_(doc_, options.assets), primitives_(doc_, buffers_, options.uvs)
    {
    }

    std::shared_ptr<const MeshData> load()
    {
        if (!doc_.list("animations").empty())
            doc_.warn(*doc_.root().member("animations"), "animations are not used: all is where its nodes place it");
        open_meshes();
        request_pictures();
        std::vector<SharedMesh> shared;
        if (options_.shared) shared = take_shared();
        auto mesh = build(placed_);
        if (mesh->triangles.empty() && shared.empty())
            doc_.fail(doc_.root(), "the default scene has no triangle with an area");
        std::shared_ptr<const MeshData> result = mesh->triangles.empty() ? shared.front().data : mesh;
        if (options_.shared) *options_.shared = std::move(shared);
        return result;
    }
    void tell(Diagnostics& diagnostics) const { doc_.warnings().tell(doc_.path(), diagnostics); }

private:
    struct Placed {
        const JsonValue* mesh;
        const std::vector<GltfPrimitive>* primitives;
        Transform to_world;
    };

    std::shared_ptr<MeshData> build(const std::vector<Placed>& all)
    {
        auto mesh = std::make_shared<MeshData>();
        mesh->file = doc_.path();
        GltfMeshBuilder builder(doc_, *mesh);
        size_t vertices = 0, triangles = 0;
        for (const Placed& p : all)
            for (const GltfPrimitive& primitive : *p.primitives)
                vertices += primitive.positions.count, triangles += primitive.triangles();
        builder.reserve(vertices, triangles);
        for (const Placed& p : all) builder.add(*p.primitives, p.to_world);
        builder.finish(options_.smoothing);
        mesh->material_files = buffers_.files();
        mesh->content_hash = buffers_.files().empty()
                                 ? doc_.content().hash()
                                 : hash_bytes(std::to_string(buffers_.hash()), doc_.content().hash());
        return mesh;
    }

    // Where one mesh is placed; whether any of its transforms shears, so that no instance has it.
    struct Use {
        size_t triangles = 0;
        std::vector<TransformDescription> places;
        bool is_sheared = false, is_taken = false;

        // Copies of a small mesh are traced faster than its instances, until there are so many that memory ends.
        bool is_shared() const
        {
            constexpr size_t least_triangles = 1000, most_copied = 10'000'000;
            const bool pays = triangles >= least_triangles || triangles * places.size() > most_copied;
            return !is_sheared && places.size() >= 2 && pays;
        }
    };
    std::map<const JsonValue*, Use> uses() const
    {
        std::vector<std::optional<TransformDescription>> parts(placed_.size());
        for_each_index(parts.size(), [&](size_t i) { parts[i] = parts_of(placed_[i].to_world); });
        std::map<const JsonValue*, Use> uses;
        for (size_t i = 0; i < parts.size(); ++i) {
            const auto [entry, is_new] = uses.try_emplace(placed_[i].mesh);
            Use& use = entry->second;
            for (const GltfPrimitive& primitive : *placed_[i].primitives)
                if (is_new) use.triangles += primitive.triangles();
            if (parts[i])
                use.places.push_back(*parts[i]);
            else
                use.is_sheared = true;
        }
        return uses;
    }

    // Takes from placed_ what pays to be kept once.
    std::vector<SharedMesh> take_shared()
    {
        std::map<const JsonValue*, Use> uses = this->uses();
        std::vector<SharedMesh> shared;
        std::set<std::string> names;
        std::vector<Placed> rest;
        for (const Placed& p : placed_) {
            Use& use = uses[p.mesh];
            if (!use.is_taken && !use.is_shared()) {
                rest.push_back(p);
                continue;
            }
            if (std::exchange(use.is_taken, true)) continue;
            std::shared_ptr<const MeshData> data = build({{p.mesh, p.primitives, {}}});
            if (!data->triangles.empty()) shared.push_back({name_of_mesh(*p.mesh, names), data, std::move(use.places)});
        }
        placed_ = std::move(rest);
        return shared;
    }

    std::string name_of_mesh(const JsonValue& mesh, std::set<std::string>& names) const
    {
        const std::string* const said = doc_.text(mesh, "name");
        const std::string wanted =
            said && !said->empty() ? *said : "mesh " + std::to_string(doc_.number_of(mesh, "meshes"));
        std::string own = wanted;
        for (size_t n = 2; !names.insert(own).second; ++n) own = wanted + " " + std::to_string(n);
        return own;
    }

    void open_meshes()
    {
        for (const GltfPlaced& p : read_gltf_nodes(doc_).meshes) {
            if (p.node && p.node->member("skin"))
                doc_.warn(*p.node, "skins are not used: the mesh has the shape in which it is stored");
            std::optional<std::vector<Transform>> instances;
            if (p.node) instances = read_gltf_instances(*p.node, doc_, buffers_);
            if (!instances) {
                place(p, p.to_world);
                continue;
            }
            placed_.reserve(placed_.size() + instances->size());
            for (const Transform& in_node : *instances) place(p, compose(p.to_world, in_node));
        }
    }

    void place(const GltfPlaced& p, const Transform& to_world)
    {
        if (to_world.determinant() == 0) {
            doc_.warn(*p.node, "a node that scales its mesh to nothing is left out");
            return;
        }
        const auto [entry, is_new] = meshes_.try_emplace(p.what);
        if (is_new) entry->second = primitives_.open(*p.what);
        placed_.push_back({p.what, &entry->second, to_world});
    }

    // Pictures are read in the background.
    void request_pictures() const
    {
        if (!options_.pictures) return;
        for (const auto& [number, material] : primitives_.materials())
            for (const TextureUse* use : shading_textures_of(material.description))
                if (*use) options_.pictures((*use)->file);
    }

    const MeshOptions& options_;
    GltfDocument doc_;
    GltfBuffers buffers_;
    GltfPrimitives primitives_;
    std::map<const JsonValue*, std::vector<GltfPrimitive>> meshes_;
    std::vector<Placed> placed_;
};

}  // namespace

std::shared_ptr<const MeshData> load_gltf(const std::string& path, Diagnostics& diagnostics, const MeshOptions& options)
{
    std::optional<GltfLoader> loader;
    try {
        loader.emplace(path, options);
        auto mesh = loader->load();
        loader->tell(diagnostics);
        return mesh;
    } catch (const Error& e) {
        if (loader) loader->tell(diagnostics);
        add_error(e, path, diagnostics);
        return nullptr;
    }
}

}  // namespace lancer
