#include "io/ply/ply.h"

#include <algorithm>

#include "core/names.h"
#include "io/file_content.h"
#include "io/mesh_values.h"
#include "io/obj/smooth.h"
#include "io/ply/faces.h"
#include "io/ply/vertices.h"

namespace lancer {
namespace {

// Whether as many as the header says can be in what is left of the file, so that no memory is taken for what is not.
bool can_hold(const PlyElement& element, const PlyCursor& cursor)
{
    const size_t least = cursor.is_text() ? std::max<size_t>(1, 2 * element.properties.size())
                                          : std::max<size_t>(1, element.least_size());
    return element.count <= (cursor.left() + 1) / least;
}

// False at the end of the file, or where text has no number.
bool skip(const PlyElement& element, PlyCursor& cursor)
{
    if (!cursor.is_text() && !element.has_list()) {
        cursor.skip(static_cast<size_t>(element.count) * element.least_size());
        return true;
    }
    for (uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& p : element.properties) {
            const std::optional<double> first = cursor.next(p.count.value_or(p.type));
            if (!first || (p.count && !cursor.skip_numbers(p.type, *first))) return false;
        }
    return true;
}

// Each corner has the normal of its vertex; a face has none if a corner has none.
void use_normals_of_vertices(MeshData& mesh)
{
    mesh.normal_triangles = mesh.triangles;
    bool any = false;
    for (auto& t : mesh.normal_triangles) {
        const bool usable = std::none_of(t.begin(), t.end(), [&](uint32_t v) { return mesh.normals[v] == Vec3{}; });
        if (!usable) t.fill(MeshData::no_normal);
        any = any || usable;
    }
    if (!any) mesh.normals = {}, mesh.normal_triangles = {};
    std::replace(mesh.normals.begin(), mesh.normals.end(), Vec3{}, Vec3{0, 0, 1});
}

// Likewise, unless faces have texture coordinates of their own.
void use_uvs(MeshData& mesh)
{
    if (mesh.uv_triangles.empty()) {
        mesh.uv_triangles = mesh.triangles;
        for (auto& t : mesh.uv_triangles)
            if (std::any_of(t.begin(), t.end(), [&](uint32_t v) { return is_broken(mesh.uvs[v]); }))
                t.fill(MeshData::no_uv);
    }
    if (std::all_of(mesh.uv_triangles.begin(), mesh.uv_triangles.end(),
                    [](const auto& t) { return t[0] == MeshData::no_uv; }))
        mesh.uvs = {}, mesh.uv_triangles = {};
    std::replace_if(mesh.uvs.begin(), mesh.uvs.end(), is_broken, Vec2{});
}

bool read_elements(const PlyHeader& header, std::string_view bytes, bool keeps_uvs, MeshData& mesh,
                   Diagnostics& diagnostics)
{
    PlyCursor cursor(bytes, header);
    const auto fail = [&](const std::string& message) {
        diagnostics.error({mesh.file, cursor.line(), 0}, message);
        return false;
    };
    bool has_vertices = false, has_faces = false;
    for (const PlyElement& element : header.elements) {
        if (element.count == 0) continue;
        if (!can_hold(element, cursor))
            return fail("the header says " + std::to_string(element.count) + " of element " + in_quotes(element.name) +
                        ", more than the file can hold");
        const bool are_strips = element.name == "tristrips";
        if (element.name == "vertex" && !has_vertices) {
            if (!read_ply_vertices(element, header.swaps(), keeps_uvs, cursor, mesh, diagnostics)) return false;
            has_vertices = true;
        } else if ((element.name == "face" || are_strips) && !has_faces) {
            if (!has_vertices) return fail("faces stand before vertices");
            if (!read_ply_faces(element, are_strips, header.swaps(), keeps_uvs, cursor, mesh, diagnostics))
                return false;
            has_faces = true;
        } else if (!skip(element, cursor)) {
            return fail("the file ends in element " + in_quotes(element.name));
        }
    }
    if (!has_faces) return fail(has_vertices ? "the file has vertices, and no faces" : "the file has no vertices");
    return true;
}

}  // namespace

std::shared_ptr<const MeshData> load_ply(const std::string& path, Diagnostics& diagnostics, const MeshOptions& options)
{
    const FileContent content(path, Unpack::yes);
    const auto fail = [&](const std::string& message, ErrorKind kind) {
        diagnostics.error({path, 0, 0}, message, kind);
        return nullptr;
    };
    if (content.missing()) return fail(content.problem(), ErrorKind::missing_input);
    if (!content.problem().empty()) return fail(content.problem(), ErrorKind::invalid_input);
    const std::optional<PlyHeader> header = read_ply_header(content.bytes(), path, diagnostics);
    if (!header) return nullptr;

    auto mesh = std::make_shared<MeshData>();
    mesh->file = path;
    mesh->content_hash = content.hash();
    if (!read_elements(*header, content.bytes(), options.uvs, *mesh, diagnostics)) return nullptr;
    if (mesh->triangles.empty()) return fail("no face has an area", ErrorKind::invalid_input);
    MaterialDescription& material = mesh->materials.emplace_back();
    material.name = "default", material.where = {path, 0, 0};
    if (!mesh->normals.empty()) use_normals_of_vertices(*mesh);
    if (!mesh->uvs.empty()) use_uvs(*mesh);
    if (mesh->normals.empty() && options.smoothing.faces == Smoothing::Faces::all)
        smooth(*mesh, std::vector<uint32_t>(mesh->triangles.size(), 1), options.smoothing.largest_deg);
    return mesh;
}

}  // namespace lancer
