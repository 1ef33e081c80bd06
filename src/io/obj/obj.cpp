// Parsing is done by tinyobjloader through its callbacks: they keep the order of faces and materials, need no memory
// per face and do not wrap the number of corners at 256. obj_scan checks its input first. Large files are parsed in
// parallel (obj_chunks) if they are plain.
#include "io/obj/obj.h"

#include <tiny_obj_loader.h>

#include <filesystem>
#include <istream>

#include "core/hash.h"
#include "core/names.h"
#include "io/file_content.h"
#include "io/mtl/library.h"
#include "io/obj/chunks.h"
#include "io/obj/colors.h"
#include "io/obj/feed.h"
#include "io/obj/mesh.h"
#include "io/obj/scan.h"
#include "io/text_file.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

static_assert(sizeof(tinyobj::real_t) == sizeof(double), "the library for double must be linked");

// Receives the parser's callbacks.
struct Listener {
    ObjMeshBuilder& builder;
    std::vector<ObjCorner> corners;
};

void feed(std::string_view text, const ObjSummary& summary, ObjFeed::Part part, ObjMeshBuilder& builder)
{
    builder.restart();
    tinyobj::callback_t callbacks;
    using Real = tinyobj::real_t;
    callbacks.vertex_cb = [](void* self, Real x, Real y, Real z, Real) {
        static_cast<Listener*>(self)->builder.add_vertex({x, y, z});
    };
    callbacks.normal_cb = [](void* self, Real x, Real y, Real z) {
        static_cast<Listener*>(self)->builder.add_normal({x, y, z});
    };
    if (builder.keeps_uvs())
        callbacks.texcoord_cb = [](void* self, Real u, Real v, Real) {
            static_cast<Listener*>(self)->builder.add_uv(u, v);
        };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int n) {
        auto& listener = *static_cast<Listener*>(self);
        listener.corners.clear();
        for (int i = 0; i < n; ++i)
            listener.corners.push_back({corners[i].vertex_index, corners[i].texcoord_index, corners[i].normal_index});
        listener.builder.add_face(listener.corners);
    };
    callbacks.usemtl_cb = [](void* self, const char* number, int) {
        static_cast<Listener*>(self)->builder.use_material(std::stoul(number));
    };
    callbacks.object_cb = [](void* self, const char* group) {
        static_cast<Listener*>(self)->builder.use_smoothing(static_cast<uint32_t>(std::stoul(group)));
    };
    ObjFeed buffer(text, summary, part, builder.keeps_uvs());
    std::istream stream(&buffer);
    std::string warnings, errors;
    Listener listener{builder, {}};
    tinyobj::LoadObjWithCallback(stream, callbacks, &listener, nullptr, &warnings, &errors);
}

// The material of each name; none, with a warning, if no material file defines it.
UsedMaterials read_materials(const std::string& path, const ObjSummary& summary, const MeshOptions& options,
                             MeshData& mesh, Diagnostics& diagnostics)
{
    MaterialFiles files = find_material_files(path, summary.libraries, options.assets, diagnostics);
    MaterialLibrary library;
    for (const std::string& file : files.found) {
        const FileContent content(file, Unpack::yes);
        if (!content.problem().empty() || !content.is_text()) {
            MaterialFiles::Missing& missing = files.missing.emplace_back();
            missing.where.file = file;
            missing.name = std::filesystem::path(file).filename().string();
            missing.problem = "is ignored: " + (content.problem().empty() ? "it holds NUL bytes" : content.problem());
            continue;
        }
        mesh.material_files.push_back(file);
        mesh.content_hash = hash_bytes(content.bytes(), mesh.content_hash);
        library.add_file(file, content.text(), options.assets, diagnostics);
    }
    UsedMaterials used;
    used.reserve(summary.materials.size());
    bool all_are_known = true;
    for (const ObjSummary::Name& use : summary.materials) {
        used.push_back(library.describe(use.name, diagnostics));
        all_are_known = all_are_known && used.back();
        if (!used.back() && files.missing.empty())
            diagnostics.warning({path, use.line, 0},
                                NamedProblem{"unknown material", use.name, "; the default grey is used"}, use.count);
    }
    const std::string instead = all_are_known ? "" : "; the default grey is used for what no other file defines";
    for (const MaterialFiles::Missing& m : files.missing)
        diagnostics.warning(m.where, NamedProblem{"material file", m.name, " " + m.problem + instead});
    return used;
}

// Builds the mesh of a scanned file. chunks: the parallel parser, or null; it returns the memory of the content to the
// system meanwhile.
std::shared_ptr<const MeshData> build(const std::string& path, const FileContent& content, const ObjSummary& summary,
                                      const ObjChunks* chunks, const MeshOptions& options, Diagnostics& diagnostics)
{
    auto mesh = std::make_shared<MeshData>();
    mesh->file = path;
    mesh->content_hash = content.hash();
    const UsedMaterials materials = read_materials(path, summary, options, *mesh, diagnostics);
    bool textured = false;
    for (const auto& m : materials) {
        if (!m || !reads_textures(*m)) continue;
        textured = true;
        if (!options.pictures) continue;
        // Pictures are read in the background.
        for (const TextureUse* use : shading_textures_of(*m))
            if (*use && (*use)->type == TextureType::image) options.pictures((*use)->file);
    }
    ObjMeshBuilder builder(summary, materials, summary.texcoords > 0 && (options.uvs || textured), *mesh);
    const std::string_view text = content.text();
    if (chunks) {
        if (!chunks->feed(builder, give_back)) return nullptr;
    } else {
        // Triangulation needs all vertices; a second pass counts them for relative indices.
        if (summary.forward_references) feed(text, summary, ObjFeed::Part::vertices, builder);
        feed(text, summary, ObjFeed::Part::all, builder);
    }
    if (!builder.finish(text, diagnostics)) return nullptr;
    if (summary.vertex_colors) mesh->colors = read_vertex_colors(text, path, diagnostics);
    return mesh;
}

}  // namespace

std::shared_ptr<const MeshData> load_obj(const std::string& path, Diagnostics& diagnostics, const MeshOptions& options)
{
    std::optional<FileContent> content(std::in_place, path, Unpack::yes);
    const auto fail = [&](const std::string& message, ErrorKind kind) {
        diagnostics.error({path, 0, 0}, message, kind);
        return nullptr;
    };
    if (content->missing()) return fail(content->problem(), ErrorKind::missing_input);
    if (!content->problem().empty()) return fail(content->problem(), ErrorKind::invalid_input);
    if (!content->is_text()) return fail("not an OBJ file: it holds NUL bytes", ErrorKind::invalid_input);

    if (content->bytes().size() >= options.parallel_from) {
        // The other parser finds and reports the problem.
        Diagnostics said;
        std::optional<ObjChunks> chunks = ObjChunks::survey(content->text(), options.chunk);
        if (chunks) chunks->set_smoothing(options.smoothing);
        auto mesh = chunks ? build(path, *content, chunks->summary(), &*chunks, options, said) : nullptr;
        if (mesh) {
            diagnostics.append(said);
            return mesh;
        }
        if (chunks) {
            content.reset();  // its first part is gone
            MeshOptions whole = options;
            whole.parallel_from = SIZE_MAX;
            return load_obj(path, diagnostics, whole);
        }
    }
    std::optional<ObjSummary> summary = scan_obj(content->text(), path, diagnostics);
    if (!summary) return nullptr;
    summary->smoothing = options.smoothing;
    return build(path, *content, *summary, nullptr, options, diagnostics);
}

}  // namespace lancer
