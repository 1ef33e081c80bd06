// tinyobjloader does the parsing, through its callbacks: they keep the order of faces and materials, cost no memory
// per face and do not wrap the number of corners at 256. What it is fed has been checked in obj_scan.
#include "io/obj.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <optional>

#include "core/hash.h"
#include "core/names.h"
#include "io/mtl_library.h"
#include "io/obj_colors.h"
#include "io/obj_scan.h"
#include "io/text_file.h"
#include "io/triangulate.h"

namespace lancer {
namespace {

static_assert(sizeof(tinyobj::real_t) == sizeof(double), "the library for double must be linked");

constexpr uint32_t none = UINT32_MAX;
constexpr Vec2 broken_uv{std::numeric_limits<float>::infinity(), 0};
bool is_broken(Vec2 uv) { return uv.x == broken_uv.x; }

// Something that happened to some of the elements of a kind, in the order of the file.
struct Tally {
    uint64_t first = 0, count = 0;
    void add(uint64_t element)
    {
        if (count++ == 0) first = element;
    }
};

// For each usemtl name its material; none: the default.
using UsedMaterials = std::vector<std::optional<MaterialDescription>>;

class MeshBuilder {
public:
    // uvs: whether to keep texture coordinates.
    MeshBuilder(const ObjSummary& summary, const UsedMaterials& materials, bool uvs, MeshData& mesh)
        : summary_(summary), materials_(materials), mesh_(mesh), slots_(materials_.size() + 1, none), keeps_uvs_(uvs)
    {
        if (uvs) {
            mesh_.uvs.reserve(summary.texcoords);
            mesh_.uv_triangles.reserve(summary.triangles);
            for (const auto& m : materials_) textured_.push_back(m && reads_textures(*m));
        }
        textured_.resize(materials_.size() + 1);
        mesh_.positions.reserve(summary.vertices);
        mesh_.normals.reserve(summary.face_normals ? summary.normals : 0);
        mesh_.triangles.reserve(summary.triangles);
        mesh_.normal_triangles.reserve(summary.face_normals ? summary.triangles : 0);
        material_ = materials_.size();
    }

    void read(std::string_view text);
    bool finish(std::string_view text, Diagnostics& diagnostics);

private:
    void feed(std::string_view text, ObjFeed::Part part);
    void add_vertex(Vec3d p);
    void add_normal(Vec3d n);
    void add_uv(double u, double v);
    void add_face(const tinyobj::index_t* corners, size_t n);
    bool add_triangle(const std::array<uint32_t, 3>& corners);
    void add_normals(const std::array<uint32_t, 3>& corners);
    void add_uvs(const std::array<uint32_t, 3>& corners);
    uint32_t material_slot();

    static size_t resolve(int index, size_t so_far)
    {
        return index > 0 ? static_cast<size_t>(index) - 1 : so_far - static_cast<size_t>(-static_cast<int64_t>(index));
    }

    const ObjSummary& summary_;
    const UsedMaterials& materials_;
    MeshData& mesh_;
    std::vector<uint32_t> slots_;  // of materials_ and of the default, in mesh_.materials
    size_t material_ = 0;          // in slots_
    const bool keeps_uvs_;
    std::vector<bool> textured_;  // as slots_
    uint64_t vertices_ = 0, normals_ = 0, uvs_ = 0, faces_ = 0;
    bool has_normals_ = false, has_uvs_ = false;
    Tally non_finite_, zero_normals_, broken_uvs_, zero_area_, partial_normals_, partial_uvs_, missing_uvs_;
    Triangulator triangulate_;
    std::vector<uint32_t> face_, face_normals_, face_uvs_;
    std::vector<Vec3d> polygon_;
};

void MeshBuilder::read(std::string_view text)
{
    // A face that is cut into triangles must know its vertices; a second round counts them for relative indices.
    if (summary_.forward_references) feed(text, ObjFeed::Part::vertices);
    feed(text, ObjFeed::Part::all);
}

void MeshBuilder::feed(std::string_view text, ObjFeed::Part part)
{
    vertices_ = normals_ = uvs_ = faces_ = 0;
    tinyobj::callback_t callbacks;
    using Real = tinyobj::real_t;
    callbacks.vertex_cb = [](void* self, Real x, Real y, Real z, Real) {
        static_cast<MeshBuilder*>(self)->add_vertex({x, y, z});
    };
    callbacks.normal_cb = [](void* self, Real x, Real y, Real z) {
        static_cast<MeshBuilder*>(self)->add_normal({x, y, z});
    };
    if (keeps_uvs_)
        callbacks.texcoord_cb = [](void* self, Real u, Real v, Real) { static_cast<MeshBuilder*>(self)->add_uv(u, v); };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int n) {
        static_cast<MeshBuilder*>(self)->add_face(corners, static_cast<size_t>(n));
    };
    callbacks.usemtl_cb = [](void* self, const char* number, int) {
        static_cast<MeshBuilder*>(self)->material_ = std::stoul(number);
    };
    ObjFeed buffer(text, summary_, part, keeps_uvs_);
    std::istream stream(&buffer);
    std::string warnings, errors;
    tinyobj::LoadObjWithCallback(stream, callbacks, this, nullptr, &warnings, &errors);
}

void MeshBuilder::add_vertex(Vec3d p)
{
    if (vertices_++ < mesh_.positions.size()) return;
    if (!is_finite(p)) non_finite_.add(mesh_.positions.size());
    mesh_.positions.push_back(p);
}

// A normal of no length is kept as zero until the end: indices count it.
void MeshBuilder::add_normal(Vec3d n)
{
    if (normals_++ < mesh_.normals.size() || !summary_.face_normals) return;
    const double size = max_component(abs(n));
    if (size == 0) zero_normals_.add(mesh_.normals.size());
    mesh_.normals.push_back(size > 0 ? to_float(normalize(n / size)) : Vec3{});
}

// Kept until the end likewise; what is not two finite numbers arrives here beyond float.
void MeshBuilder::add_uv(double u, double v)
{
    if (uvs_++ < mesh_.uvs.size()) return;
    constexpr double largest = std::numeric_limits<float>::max();
    const bool usable = std::abs(u) <= largest && std::abs(v) <= largest;
    if (!usable) broken_uvs_.add(mesh_.uvs.size());
    mesh_.uvs.push_back(usable ? Vec2{static_cast<float>(u), static_cast<float>(v)} : broken_uv);
}

void MeshBuilder::add_face(const tinyobj::index_t* corners, size_t n)
{
    const uint64_t face = faces_++;
    if (n < 3 || vertices_ > mesh_.positions.size()) return;
    face_.clear();
    face_normals_.clear();
    face_uvs_.clear();
    polygon_.clear();
    size_t with_normal = 0, with_uv = 0;
    for (size_t i = 0; i < n; ++i) {
        face_.push_back(static_cast<uint32_t>(resolve(corners[i].vertex_index, vertices_)));
        uint32_t normal = none;
        if (corners[i].normal_index != 0) {
            ++with_normal;
            normal = static_cast<uint32_t>(resolve(corners[i].normal_index, normals_));
        }
        face_normals_.push_back(normal);
        uint32_t uv = none;
        if (keeps_uvs_ && corners[i].texcoord_index != 0) {
            ++with_uv;
            uv = static_cast<uint32_t>(resolve(corners[i].texcoord_index, uvs_));
        }
        face_uvs_.push_back(uv);
    }
    if (std::any_of(face_.begin(), face_.end(), [&](uint32_t v) { return v >= mesh_.positions.size(); })) return;
    if (with_normal != 0 && with_normal != n) partial_normals_.add(face);
    if (with_uv != 0 && with_uv != n) partial_uvs_.add(face);
    if (with_uv == 0 && textured_[std::min(material_, materials_.size())]) missing_uvs_.add(face);
    for (const uint32_t v : face_) polygon_.push_back(mesh_.positions[v]);
    bool any = false;
    if (n == 3)
        any = add_triangle({0, 1, 2});
    else
        for (const auto& t : triangulate_(polygon_)) any = add_triangle(t) || any;
    if (!any) zero_area_.add(face);
}

// False for a triangle without area: one whose height is below the rounding of its coordinates.
bool MeshBuilder::add_triangle(const std::array<uint32_t, 3>& corners)
{
    const Vec3d p = polygon_[corners[0]], q = polygon_[corners[1]], r = polygon_[corners[2]];
    const double place = std::max({max_component(abs(p)), max_component(abs(q)), max_component(abs(r))});
    if (place == 0) return false;
    const Vec3d a = (q - p) / place, b = (r - p) / place;
    const double longest = std::max({length(a), length(b), length(b - a)});
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    if (length(cross(a, b)) <= rounding * longest) return false;

    mesh_.triangles.push_back({face_[corners[0]], face_[corners[1]], face_[corners[2]]});
    const uint32_t slot = material_slot();
    if (mesh_.materials.size() > 1) {
        if (mesh_.face_material.empty()) mesh_.face_material.reserve(summary_.triangles);
        mesh_.face_material.resize(mesh_.triangles.size() - 1, 0);
        mesh_.face_material.push_back(slot);
    }
    if (summary_.face_normals) add_normals(corners);
    if (keeps_uvs_) add_uvs(corners);
    return true;
}

void MeshBuilder::add_normals(const std::array<uint32_t, 3>& corners)
{
    std::array<uint32_t, 3> normals;
    bool usable = true;
    for (size_t i = 0; i < 3; ++i) {
        normals[i] = face_normals_[corners[i]];
        usable = usable && normals[i] < mesh_.normals.size() && !(mesh_.normals[normals[i]] == Vec3{});
    }
    if (!usable) normals.fill(MeshData::no_normal);
    has_normals_ = has_normals_ || usable;
    mesh_.normal_triangles.push_back(normals);
}

void MeshBuilder::add_uvs(const std::array<uint32_t, 3>& corners)
{
    std::array<uint32_t, 3> uvs;
    bool usable = true;
    for (size_t i = 0; i < 3; ++i) {
        uvs[i] = face_uvs_[corners[i]];
        usable = usable && uvs[i] < mesh_.uvs.size() && !is_broken(mesh_.uvs[uvs[i]]);
    }
    if (!usable) uvs.fill(MeshData::no_uv);
    has_uvs_ = has_uvs_ || usable;
    mesh_.uv_triangles.push_back(uvs);
}

// Materials enter the mesh when the first triangle needs them.
uint32_t MeshBuilder::material_slot()
{
    uint32_t& slot = slots_[std::min(material_, materials_.size())];
    if (slot != none) return slot;
    const bool is_known = material_ < materials_.size() && materials_[material_];
    uint32_t& default_slot = slots_.back();
    if (is_known || default_slot == none) {
        slot = static_cast<uint32_t>(mesh_.materials.size());
        mesh_.materials.push_back(is_known ? *materials_[material_] : MaterialDescription{});
        if (is_known) return slot;
        mesh_.materials.back().name = "default";
        mesh_.materials.back().where = {mesh_.file, 0, 0};
        default_slot = slot;
    }
    return slot = default_slot;
}

bool MeshBuilder::finish(std::string_view text, Diagnostics& diagnostics)
{
    const auto at = [&](ObjStatement kind, const Tally& t) {
        return Location{mesh_.file, line_of(text, kind, t.first), 0};
    };
    const auto warn = [&](ObjStatement kind, const Tally& t, const char* message) {
        if (t.count) diagnostics.warning(at(kind, t), message, t.count);
    };
    warn(ObjStatement::normal, zero_normals_, "normal of zero length ignored");
    warn(ObjStatement::face, partial_normals_, "face with normals at some corners only: they are ignored there");
    warn(ObjStatement::texcoord, broken_uvs_, "vt is not finite numbers; faces that use it get no texture coordinates");
    warn(ObjStatement::face, partial_uvs_,
         "face with texture coordinates at some corners only: they are ignored there");
    warn(ObjStatement::face, missing_uvs_, "face without texture coordinates has a material with a texture");
    warn(ObjStatement::face, zero_area_, "zero-area face dropped");
    if (non_finite_.count) {
        diagnostics.error(at(ObjStatement::vertex, non_finite_), "a coordinate is not a finite number");
        return false;
    }
    if (vertices_ != summary_.vertices || normals_ != summary_.normals || faces_ != summary_.faces ||
        (keeps_uvs_ && uvs_ != summary_.texcoords)) {
        diagnostics.error({mesh_.file, 0, 0}, "the file could not be parsed to its end", ErrorKind::failed);
        return false;
    }
    if (mesh_.triangles.empty()) {
        diagnostics.error({mesh_.file, 0, 0}, "no face has an area");
        return false;
    }
    if (!has_normals_) {
        mesh_.normals = {};
        mesh_.normal_triangles = {};
    }
    if (!has_uvs_) {
        mesh_.uvs = {};
        mesh_.uv_triangles = {};
    }
    // Nothing refers to these any more; every normal of a mesh has unit length and every coordinate is finite.
    std::replace(mesh_.normals.begin(), mesh_.normals.end(), Vec3{}, Vec3{0, 0, 1});
    std::replace_if(mesh_.uvs.begin(), mesh_.uvs.end(), is_broken, Vec2{});
    return true;
}

// None for each name that no material file defines, with a warning.
UsedMaterials describe_materials(const ObjSummary& summary, MaterialLibrary& library, const std::string& file,
                                 Diagnostics& diagnostics)
{
    UsedMaterials used;
    constexpr uint64_t most_named = 10;
    uint64_t unknown = 0;
    for (const ObjSummary::Name& use : summary.materials) {
        used.push_back(library.describe(use.name, diagnostics));
        if (used.back()) continue;
        const std::string what =
            ++unknown <= most_named ? "unknown material " + in_quotes(use.name) : "unknown material";
        diagnostics.warning({file, use.line, 0}, what + "; the default grey is used", use.count);
    }
    return used;
}

}  // namespace

std::shared_ptr<const MeshData> load_obj(const std::string& path, Diagnostics& diagnostics, const MeshOptions& options)
{
    const FileContent content = read_file(path);
    const auto fail = [&](const std::string& message, ErrorKind kind) {
        diagnostics.error({path, 0, 0}, message, kind);
        return nullptr;
    };
    if (content.missing) return fail(content.problem, ErrorKind::missing_input);
    if (!content.problem.empty()) return fail(content.problem, ErrorKind::invalid_input);
    if (!content.is_text()) return fail("not an OBJ file: it holds NUL bytes", ErrorKind::invalid_input);

    const std::string_view text = content.text();
    const std::optional<ObjSummary> summary = scan_obj(text, path, diagnostics);
    if (!summary) return nullptr;

    auto mesh = std::make_shared<MeshData>();
    mesh->file = path;
    mesh->content_hash = hash_bytes(content.bytes, 0);
    MaterialLibrary library;
    for (const std::string& file : find_material_files(path, summary->libraries, options.assets, diagnostics)) {
        const FileContent material_file = read_file(file);
        if (!material_file.problem.empty() || !material_file.is_text()) {
            diagnostics.warning({file, 0, 0}, "ignored: " + (material_file.problem.empty() ? "it holds NUL bytes"
                                                                                           : material_file.problem));
            continue;
        }
        mesh->material_files.push_back(file);
        mesh->content_hash = hash_bytes(material_file.bytes, mesh->content_hash);
        library.add_file(file, material_file.text(), options.assets, diagnostics);
    }
    const UsedMaterials materials = describe_materials(*summary, library, path, diagnostics);
    bool textured = false;
    for (const auto& m : materials) {
        if (!m || !reads_textures(*m)) continue;
        textured = true;
        if (!options.pictures) continue;
        // Pictures are read beside the faces.
        for (const TextureUse* use : textures_of(*m))
            if (*use && (*use)->type == TextureType::image) options.pictures((*use)->file);
    }
    const bool uvs = summary->texcoords > 0 && (options.uvs || textured);
    MeshBuilder builder(*summary, materials, uvs, *mesh);
    builder.read(text);
    if (!builder.finish(text, diagnostics)) return nullptr;
    if (summary->vertex_colors) mesh->colors = read_vertex_colors(text, path, diagnostics);
    return mesh;
}

}  // namespace lancer
