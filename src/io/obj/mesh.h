// The statements of an OBJ file, one after the other, become a mesh: what they mean, whoever parsed them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/obj/scan.h"
#include "io/obj/triangulate.h"
#include "scene/description/description.h"

namespace lancer {

// For each name in ObjSummary::materials its material; none: the default.
using UsedMaterials = std::vector<std::optional<MaterialDescription>>;

// As written: from 1, or negative from the last one so far; 0: none.
struct ObjCorner {
    int32_t vertex = 0, texcoord = 0, normal = 0;
};

class ObjMeshBuilder {
public:
    // summary: of the whole file. uvs: whether to keep texture coordinates. All must live as long as the builder.
    ObjMeshBuilder(const ObjSummary& summary, const UsedMaterials& materials, bool uvs, MeshData& mesh);

    bool keeps_uvs() const { return keeps_uvs_; }
    // The file again from its first statement. Vertices, normals and texture coordinates that are there already stay.
    void restart() { vertices_ = normals_ = uvs_ = faces_ = 0; }

    void add_vertex(Vec3d p);
    void add_normal(Vec3d n);
    // Only if they are kept; beyond float for what is not two finite numbers.
    void add_uv(double u, double v);
    // Indices in range.
    void add_face(std::span<const ObjCorner> corners);
    // index: into ObjSummary::materials.
    void use_material(size_t index) { material_ = index; }
    // 0: none.
    void use_smoothing(uint32_t group) { group_ = is_one_group(summary_) ? 1 : group; }

    // Where the file is not kept until the end: before and after the statements of each part of it, so that messages
    // know their lines. lines_before: in the file.
    void begin_part() { before_ = {vertices_, normals_, uvs_, faces_}; }
    void end_part(std::string_view text, uint32_t lines_before);

    // After the last statement. text: of the file, for the lines of messages. False after adding an error.
    bool finish(std::string_view text, Diagnostics& diagnostics);

private:
    // Something that happened to some of the elements of a kind, in the order of the file.
    struct Tally {
        ObjStatement kind;
        uint64_t first = 0, count = 0;
        uint32_t line = 0;  // of the first; 0: not known yet
        void add(uint64_t element)
        {
            if (count++ == 0) first = element;
        }
    };

    bool add_triangle(const std::array<uint32_t, 3>& corners);
    void add_normals(const std::array<uint32_t, 3>& corners);
    void add_uvs(const std::array<uint32_t, 3>& corners);
    uint32_t material_slot();

    static size_t resolve(int32_t index, size_t so_far)
    {
        return index > 0 ? static_cast<size_t>(index) - 1 : so_far - static_cast<size_t>(-static_cast<int64_t>(index));
    }

    const ObjSummary& summary_;
    const UsedMaterials& materials_;
    MeshData& mesh_;
    std::vector<uint32_t> slots_;  // of materials_ and of the default, in mesh_.materials
    size_t material_ = 0;          // in slots_
    uint32_t group_ = 0;
    std::vector<uint32_t> groups_;  // of the triangles, if smooths(summary_)
    const bool keeps_uvs_;
    std::vector<bool> textured_;  // as slots_
    uint64_t vertices_ = 0, normals_ = 0, uvs_ = 0, faces_ = 0;
    struct {
        uint64_t vertices = 0, normals = 0, uvs = 0, faces = 0;
    } before_;  // the part
    bool has_normals_ = false, has_uvs_ = false;
    Tally non_finite_{ObjStatement::vertex}, zero_normals_{ObjStatement::normal}, broken_uvs_{ObjStatement::texcoord};
    Tally zero_area_{ObjStatement::face}, partial_normals_{ObjStatement::face}, partial_uvs_{ObjStatement::face};
    Tally missing_uvs_{ObjStatement::face};
    Triangulator triangulate_;
    std::vector<uint32_t> face_, face_normals_, face_uvs_;
    std::vector<Vec3d> polygon_;
};

}  // namespace lancer
