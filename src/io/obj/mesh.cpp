#include "io/obj/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mesh_values.h"
#include "io/obj/smooth.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

constexpr uint32_t none = UINT32_MAX;

}  // namespace

ObjMeshBuilder::ObjMeshBuilder(const ObjSummary& summary, const UsedMaterials& materials, bool uvs, MeshData& mesh)
    : summary_(summary), materials_(materials), mesh_(mesh), slots_(materials_.size() + 1, none), keeps_uvs_(uvs)
{
    if (uvs) {
        mesh_.uvs.reserve(summary.texcoords);
        mesh_.uv_triangles.reserve(summary.triangles);
        for (const auto& m : materials_) textured_.push_back(m && reads_textures(*m));
    }
    textured_.resize(materials_.size() + 1);
    mesh_.materials.reserve(materials_.size() + 1);
    mesh_.positions.reserve(summary.vertices);
    mesh_.normals.reserve(summary.face_normals ? summary.normals : 0);
    mesh_.triangles.reserve(summary.triangles);
    mesh_.normal_triangles.reserve(summary.face_normals ? summary.triangles : 0);
    material_ = materials_.size();
    use_smoothing(0);
}

void ObjMeshBuilder::add_vertex(Vec3d p)
{
    if (vertices_++ < mesh_.positions.size()) return;
    if (!is_finite(p)) non_finite_.add(mesh_.positions.size());
    mesh_.positions.push_back(p);
}

// A normal of no length, or of what is no number, is kept as zero until the end: indices count it.
void ObjMeshBuilder::add_normal(Vec3d n)
{
    if (normals_++ < mesh_.normals.size() || !summary_.face_normals) return;
    if (max_component(abs(n)) == 0) zero_normals_.add(mesh_.normals.size());
    mesh_.normals.push_back(unit_normal(n));
}

// Kept until the end likewise; what is not two finite numbers arrives here beyond float.
void ObjMeshBuilder::add_uv(double u, double v)
{
    if (uvs_++ < mesh_.uvs.size()) return;
    const Vec2 uv = uv_of(u, v);
    if (is_broken(uv)) broken_uvs_.add(mesh_.uvs.size());
    mesh_.uvs.push_back(uv);
}

void ObjMeshBuilder::add_face(std::span<const ObjCorner> corners)
{
    const size_t n = corners.size();
    const uint64_t face = faces_++;
    if (n < 3 || vertices_ > mesh_.positions.size()) return;
    face_.clear();
    face_normals_.clear();
    face_uvs_.clear();
    polygon_.clear();
    size_t with_normal = 0, with_uv = 0;
    for (size_t i = 0; i < n; ++i) {
        face_.push_back(static_cast<uint32_t>(resolve(corners[i].vertex, vertices_)));
        uint32_t normal = none;
        if (corners[i].normal != 0) {
            ++with_normal;
            normal = static_cast<uint32_t>(resolve(corners[i].normal, normals_));
        }
        face_normals_.push_back(normal);
        uint32_t uv = none;
        if (keeps_uvs_ && corners[i].texcoord != 0) {
            ++with_uv;
            uv = static_cast<uint32_t>(resolve(corners[i].texcoord, uvs_));
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

// False for a triangle without area.
bool ObjMeshBuilder::add_triangle(const std::array<uint32_t, 3>& corners)
{
    if (!has_area(polygon_[corners[0]], polygon_[corners[1]], polygon_[corners[2]])) return false;
    mesh_.triangles.push_back({face_[corners[0]], face_[corners[1]], face_[corners[2]]});
    const uint32_t slot = material_slot();
    if (mesh_.materials.size() > 1) {
        if (mesh_.face_material.empty()) mesh_.face_material.reserve(summary_.triangles);
        mesh_.face_material.resize(mesh_.triangles.size() - 1, 0);
        mesh_.face_material.push_back(slot);
    }
    if (smooths(summary_)) groups_.push_back(group_);
    if (summary_.face_normals) add_normals(corners);
    if (keeps_uvs_) add_uvs(corners);
    return true;
}

void ObjMeshBuilder::add_normals(const std::array<uint32_t, 3>& corners)
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

void ObjMeshBuilder::add_uvs(const std::array<uint32_t, 3>& corners)
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
uint32_t ObjMeshBuilder::material_slot()
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

void ObjMeshBuilder::end_part(std::string_view text, uint32_t lines_before)
{
    const auto find = [&](Tally& t, uint64_t before) {
        if (t.count != 0 && t.line == 0) t.line = lines_before + line_of(text, t.kind, t.first - before);
    };
    find(non_finite_, before_.vertices);
    find(zero_normals_, before_.normals);
    find(broken_uvs_, before_.uvs);
    for (Tally* t : {&zero_area_, &partial_normals_, &partial_uvs_, &missing_uvs_}) find(*t, before_.faces);
}

bool ObjMeshBuilder::finish(std::string_view text, Diagnostics& diagnostics)
{
    const auto at = [&](const Tally& t) {
        return Location{mesh_.file, t.line ? t.line : line_of(text, t.kind, t.first), 0};
    };
    const auto warn = [&](const Tally& t, const char* message) {
        if (t.count) diagnostics.warning(at(t), message, t.count);
    };
    warn(zero_normals_, "vn of zero length or not of three finite numbers; faces that use it are flat");
    warn(partial_normals_, "face with normals at some corners only: they are ignored there");
    warn(broken_uvs_, "vt is not finite numbers; faces that use it get no texture coordinates");
    warn(partial_uvs_, "face with texture coordinates at some corners only: they are ignored there");
    warn(missing_uvs_, "face without texture coordinates has a material with a texture");
    warn(zero_area_, "zero-area face dropped");
    if (non_finite_.count) {
        diagnostics.error(at(non_finite_), "a coordinate is not a finite number");
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
    if (!groups_.empty()) smooth(mesh_, groups_, summary_.smoothing.largest_deg);
    if (!has_uvs_) {
        mesh_.uvs = {};
        mesh_.uv_triangles = {};
    }
    // Nothing refers to these any more; every normal of a mesh has unit length and every coordinate is finite.
    std::replace(mesh_.normals.begin(), mesh_.normals.end(), Vec3{}, Vec3{0, 0, 1});
    std::replace_if(mesh_.uvs.begin(), mesh_.uvs.end(), is_broken, Vec2{});
    return true;
}

}  // namespace lancer
