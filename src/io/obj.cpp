// tinyobjloader does the parsing, through its callbacks: they keep the order of faces and materials, cost no memory
// per face and do not wrap the number of corners at 256. What it is fed has been checked in obj_scan and mtl_scan.
#include "io/obj.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <sstream>

#include "core/hash.h"
#include "core/names.h"
#include "io/mtl_scan.h"
#include "io/obj_scan.h"
#include "io/triangulate.h"

namespace lancer {
namespace {

static_assert(sizeof(tinyobj::real_t) == sizeof(double), "the library for double must be linked");

constexpr uint32_t none = UINT32_MAX;
constexpr Color grey{0.8f, 0.8f, 0.8f};

float to_range(double v, float low, float high, bool& changed)
{
    const auto clamped = std::clamp(v, static_cast<double>(low), static_cast<double>(high));
    changed = changed || clamped != v;
    return static_cast<float>(clamped);
}

MaterialDescription describe_material(const MtlEntry& entry, const tinyobj::material_t& values, const std::string& file,
                                      Diagnostics& diagnostics)
{
    MaterialDescription m;
    m.name = entry.name;
    m.where = {file, entry.line, 0};
    bool changed = false;
    const auto& kd = values.diffuse;
    const auto& ke = values.emission;
    if (entry.ke_line) {
        constexpr float most = std::numeric_limits<float>::max();
        m.emission = {to_range(ke[0], 0, most, changed), to_range(ke[1], 0, most, changed),
                      to_range(ke[2], 0, most, changed)};
        if (changed) diagnostics.warning({file, entry.ke_line, 0}, "Ke below 0 or beyond float clamped");
        changed = false;
    }
    // A lamp that says nothing of its own colour reflects nothing; any other material must be seen somehow.
    m.base_color = is_black(m.emission) ? grey : Color{};
    if (entry.kd_line) {
        m.base_color = {to_range(kd[0], 0, 1, changed), to_range(kd[1], 0, 1, changed), to_range(kd[2], 0, 1, changed)};
        if (changed) diagnostics.warning({file, entry.kd_line, 0}, "Kd outside [0, 1] clamped");
    }
    return m;
}

// The materials of all files by name.
class MaterialLibrary {
public:
    void add_file(const std::string& path, std::string_view text, Diagnostics& diagnostics)
    {
        const MtlScan scan = scan_mtl(text, path, diagnostics);
        constexpr size_t at_once = 1000;  // the parser's materials take kilobytes each
        for (size_t begin = 0; begin < scan.materials.size(); begin += at_once) {
            const size_t end = std::min(begin + at_once, scan.materials.size());
            const std::vector<tinyobj::material_t> values = parse(scan, begin, end);
            for (size_t i = 0; i < std::min(values.size(), end - begin); ++i) {
                const MtlEntry& entry = scan.materials[begin + i];
                if (index_.try_emplace(entry.name, static_cast<uint32_t>(materials_.size())).second)
                    materials_.push_back(describe_material(entry, values[i], path, diagnostics));
                else
                    diagnostics.warning({path, entry.line, 0},
                                        "material of this name exists already; the first is used");
            }
        }
    }
    const MaterialDescription* find(const std::string& name) const
    {
        const auto found = index_.find(name);
        return found == index_.end() ? nullptr : &materials_[found->second];
    }

private:
    static std::vector<tinyobj::material_t> parse(const MtlScan& scan, size_t begin, size_t end)
    {
        const size_t from = scan.materials[begin].begin;
        const size_t to = end == scan.materials.size() ? scan.text.size() : scan.materials[end].begin;
        std::istringstream stream(scan.text.substr(from, to - from));
        std::map<std::string, int> index;
        std::vector<tinyobj::material_t> values;
        std::string warnings, errors;
        tinyobj::LoadMtl(&index, &values, &stream, &warnings, &errors);
        return values;
    }

    std::map<std::string, uint32_t, std::less<>> index_;
    std::vector<MaterialDescription> materials_;
};

// Something that happened to some of the elements of a kind, in the order of the file.
struct Tally {
    uint64_t first = 0, count = 0;
    void add(uint64_t element)
    {
        if (count++ == 0) first = element;
    }
};

class MeshBuilder {
public:
    // For each usemtl name its material, or null for the default.
    MeshBuilder(const ObjSummary& summary, std::vector<const MaterialDescription*> materials, MeshData& mesh)
        : summary_(summary), materials_(std::move(materials)), mesh_(mesh), slots_(materials_.size() + 1, none)
    {
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
    void add_face(const tinyobj::index_t* corners, size_t n);
    bool add_triangle(const std::array<uint32_t, 3>& corners);
    uint32_t material_slot();

    static size_t resolve(int index, size_t so_far)
    {
        return index > 0 ? static_cast<size_t>(index) - 1 : so_far - static_cast<size_t>(-static_cast<int64_t>(index));
    }

    const ObjSummary& summary_;
    const std::vector<const MaterialDescription*> materials_;
    MeshData& mesh_;
    std::vector<uint32_t> slots_;  // of materials_ and of the default, in mesh_.materials
    size_t material_ = 0;          // in slots_
    uint64_t vertices_ = 0, normals_ = 0, faces_ = 0;
    bool has_normals_ = false;
    Tally non_finite_, zero_normals_, zero_area_, partial_normals_;
    Triangulator triangulate_;
    std::vector<uint32_t> face_, face_normals_;
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
    vertices_ = normals_ = faces_ = 0;
    tinyobj::callback_t callbacks;
    using Real = tinyobj::real_t;
    callbacks.vertex_cb = [](void* self, Real x, Real y, Real z, Real) {
        static_cast<MeshBuilder*>(self)->add_vertex({x, y, z});
    };
    callbacks.normal_cb = [](void* self, Real x, Real y, Real z) {
        static_cast<MeshBuilder*>(self)->add_normal({x, y, z});
    };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int n) {
        static_cast<MeshBuilder*>(self)->add_face(corners, static_cast<size_t>(n));
    };
    callbacks.usemtl_cb = [](void* self, const char* number, int) {
        static_cast<MeshBuilder*>(self)->material_ = std::stoul(number);
    };
    ObjFeed buffer(text, summary_, part);
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

void MeshBuilder::add_face(const tinyobj::index_t* corners, size_t n)
{
    const uint64_t face = faces_++;
    if (n < 3 || vertices_ > mesh_.positions.size()) return;
    face_.clear();
    face_normals_.clear();
    polygon_.clear();
    size_t with_normal = 0;
    for (size_t i = 0; i < n; ++i) {
        face_.push_back(static_cast<uint32_t>(resolve(corners[i].vertex_index, vertices_)));
        uint32_t normal = none;
        if (corners[i].normal_index != 0) {
            ++with_normal;
            normal = static_cast<uint32_t>(resolve(corners[i].normal_index, normals_));
        }
        face_normals_.push_back(normal);
    }
    if (std::any_of(face_.begin(), face_.end(), [&](uint32_t v) { return v >= mesh_.positions.size(); })) return;
    if (with_normal != 0 && with_normal != n) partial_normals_.add(face);
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
    if (!summary_.face_normals) return true;
    std::array<uint32_t, 3> normals;
    bool usable = true;
    for (size_t i = 0; i < 3; ++i) {
        normals[i] = face_normals_[corners[i]];
        usable = usable && normals[i] < mesh_.normals.size() && !(mesh_.normals[normals[i]] == Vec3{});
    }
    if (!usable) normals.fill(MeshData::no_normal);
    has_normals_ = has_normals_ || usable;
    mesh_.normal_triangles.push_back(normals);
    return true;
}

// Materials enter the mesh when the first triangle needs them.
uint32_t MeshBuilder::material_slot()
{
    uint32_t& slot = slots_[std::min(material_, materials_.size())];
    if (slot != none) return slot;
    const MaterialDescription* const material = material_ < materials_.size() ? materials_[material_] : nullptr;
    uint32_t& default_slot = slots_.back();
    if (material || default_slot == none) {
        slot = static_cast<uint32_t>(mesh_.materials.size());
        mesh_.materials.push_back(material ? *material : MaterialDescription{});
        if (material) return slot;
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
    warn(ObjStatement::face, zero_area_, "zero-area face dropped");
    if (non_finite_.count) {
        diagnostics.error(at(ObjStatement::vertex, non_finite_), "a coordinate is not a finite number");
        return false;
    }
    if (vertices_ != summary_.vertices || normals_ != summary_.normals || faces_ != summary_.faces) {
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
    // Nothing refers to these any more; every normal of a mesh has unit length.
    std::replace(mesh_.normals.begin(), mesh_.normals.end(), Vec3{}, Vec3{0, 0, 1});
    return true;
}

// Null for each name that no material file defines, with a warning.
std::vector<const MaterialDescription*> resolve_materials(const ObjSummary& summary, const MaterialLibrary& library,
                                                          const std::string& file, Diagnostics& diagnostics)
{
    std::vector<const MaterialDescription*> found;
    constexpr uint64_t most_named = 10;
    uint64_t unknown = 0;
    for (const ObjSummary::Name& use : summary.materials) {
        found.push_back(library.find(use.name));
        if (found.back()) continue;
        const std::string what =
            ++unknown <= most_named ? "unknown material " + in_quotes(use.name) : "unknown material";
        diagnostics.warning({file, use.line, 0}, what + "; the default grey is used", use.count);
    }
    return found;
}

}  // namespace

std::shared_ptr<const MeshData> load_obj(const std::string& path, Diagnostics& diagnostics)
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
    for (const std::string& file : find_material_files(path, summary->libraries, diagnostics)) {
        const FileContent material_file = read_file(file);
        if (!material_file.problem.empty() || !material_file.is_text()) {
            diagnostics.warning({file, 0, 0}, "ignored: " + (material_file.problem.empty() ? "it holds NUL bytes"
                                                                                           : material_file.problem));
            continue;
        }
        mesh->material_files.push_back(file);
        mesh->content_hash = hash_bytes(material_file.bytes, mesh->content_hash);
        library.add_file(file, material_file.text(), diagnostics);
    }
    MeshBuilder builder(*summary, resolve_materials(*summary, library, path, diagnostics), *mesh);
    builder.read(text);
    if (!builder.finish(text, diagnostics)) return nullptr;
    return mesh;
}

}  // namespace lancer
