#include "io/ply/faces.h"

#include <atomic>
#include <cmath>

#include "core/parallel.h"
#include "io/mesh_values.h"
#include "io/obj/triangulate.h"

namespace lancer {
namespace {

constexpr size_t faces_at_once = 1 << 16;  // that a thread reads
constexpr std::array<uint32_t, 3> dropped{UINT32_MAX, UINT32_MAX, UINT32_MAX};

class FaceReader {
public:
    FaceReader(const PlyElement& element, bool are_strips, bool swaps, bool keeps_uvs, MeshData& mesh,
               Diagnostics& diagnostics)
        : element_(element), are_strips_(are_strips), swaps_(swaps), mesh_(mesh), diagnostics_(diagnostics)
    {
        for (size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (!property.count) continue;
            if (property.name == "vertex_indices" || property.name == "vertex_index") corners_of_ = p;
            if (keeps_uvs && property.name == "texcoord") uvs_of_ = p;
        }
    }
    bool has_corners() const { return corners_of_.has_value(); }
    bool has_uvs() const { return uvs_of_.has_value(); }

    // Where each face is a triangle and has one list, all have the same size: they are read in parallel. False if not.
    bool read_triangles(PlyCursor& cursor)
    {
        const auto lists = std::count_if(element_.properties.begin(), element_.properties.end(),
                                         [](const PlyProperty& p) { return p.count.has_value(); });
        if (cursor.is_text() || are_strips_ || lists != 1) return false;
        const PlyProperty& list = element_.properties[*corners_of_];
        size_t before = 0;
        for (size_t p = 0; p < *corners_of_; ++p) before += size_of(element_.properties[p].type);
        const size_t of_count = size_of(*list.count), of_index = size_of(list.type);
        const size_t size = element_.least_size() + 3 * of_index, count = static_cast<size_t>(element_.count);
        if (count > cursor.left() / size) return false;
        const char* const first = cursor.here() + before;
        mesh_.triangles.resize(count);
        std::atomic<bool> fits = true;
        std::atomic<size_t> flat = 0;
        parallel_for((count + faces_at_once - 1) / faces_at_once, [&](size_t b) {
            size_t without_area = 0;
            for (size_t i = b * faces_at_once; i < std::min(count, (b + 1) * faces_at_once) && fits; ++i) {
                const char* at = first + i * size;
                if (load_number(at, *list.count, swaps_) != 3) {
                    fits = false;
                    return;
                }
                std::array<uint32_t, 3> corners{};
                for (size_t k = 0; k < 3; ++k) {
                    const double index = load_number(at + of_count + k * of_index, list.type, swaps_);
                    if (!is_vertex(index)) {
                        fits = false;  // the other way tells of which face
                        return;
                    }
                    corners[k] = static_cast<uint32_t>(index);
                }
                const bool counts = spans_area(corners);
                without_area += counts ? 0 : 1;
                mesh_.triangles[i] = counts ? corners : dropped;
            }
            flat += without_area;
        });
        if (!fits) {
            mesh_.triangles.clear();
            return false;
        }
        if ((without_area_ = flat) != 0) std::erase(mesh_.triangles, dropped);
        cursor.skip(count * size);
        return true;
    }
    bool read_one_by_one(PlyCursor& cursor)
    {
        for (uint64_t i = 0; i < element_.count; ++i) {
            corners_.clear(), uvs_.clear();
            for (size_t p = 0; p < element_.properties.size(); ++p)
                if (!read_property(p, cursor)) return fail(cursor, i, "no number, or the end of the file, in");
            if (!add_corners(cursor, i)) return false;
        }
        return true;
    }
    void warn() const
    {
        if (without_area_) diagnostics_.warning({mesh_.file, 0, 0}, "zero-area face dropped", without_area_);
        if (unfit_uvs_)
            diagnostics_.warning({mesh_.file, 0, 0},
                                 "face without one pair of finite texture coordinates for each corner gets none",
                                 unfit_uvs_);
    }

private:
    bool is_vertex(double index) const
    {
        return index >= 0 && index < static_cast<double>(mesh_.positions.size()) && index == std::floor(index);
    }
    bool spans_area(const std::array<uint32_t, 3>& t) const
    {
        return has_area(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]);
    }
    bool fail(const PlyCursor& cursor, uint64_t face, const std::string& what) const
    {
        diagnostics_.error({mesh_.file, cursor.line(), 0}, what + (are_strips_ ? " strip " : " face ") +
                                                               std::to_string(face) + " of " +
                                                               std::to_string(element_.count));
        return false;
    }
    bool read_property(size_t p, PlyCursor& cursor)
    {
        const PlyProperty& property = element_.properties[p];
        const std::optional<double> first = cursor.next(property.count.value_or(property.type));
        if (!first || !property.count) return first.has_value();
        if (!(*first >= 0 && *first <= static_cast<double>(cursor.room_for(property.type)))) return false;
        std::vector<double>* const list = p == corners_of_ ? &corners_ : p == uvs_of_ ? &uvs_ : nullptr;
        for (auto n = static_cast<size_t>(*first); n > 0; --n) {
            const std::optional<double> value = cursor.next(property.type);
            if (!value) return false;
            if (list) list->push_back(*value);
        }
        return true;
    }
    bool add_corners(const PlyCursor& cursor, uint64_t face)
    {
        const auto is_end = [&](double index) { return are_strips_ && index == -1; };
        if (!std::all_of(corners_.begin(), corners_.end(), [&](double i) { return is_vertex(i) || is_end(i); }))
            return fail(cursor, face,
                        "there are " + std::to_string(mesh_.positions.size()) + " vertices, and other numbers in");
        if (are_strips_)
            add_strips();
        else
            add_polygon();
        return true;
    }
    // Every second triangle of a strip is turned around. Some are without area on purpose, to turn a corner.
    void add_strips()
    {
        size_t begin = 0;
        for (size_t i = 0; i < corners_.size(); ++i) {
            if (corners_[i] == -1) begin = i + 1;
            if (i < begin + 2 || corners_[i] == -1) continue;
            const size_t turned = (i - begin) % 2;
            add_triangle({index(i - 2 + turned), index(i - 1 - turned), index(i)});
        }
    }
    void add_polygon()
    {
        const size_t n = corners_.size();
        const bool has_uvs = uvs_of_ && fit_uvs();
        const auto add = [&](const std::array<uint32_t, 3>& t) {
            if (!add_triangle({index(t[0]), index(t[1]), index(t[2])})) return false;
            if (!uvs_of_) return true;
            std::array<uint32_t, 3> own{MeshData::no_uv, MeshData::no_uv, MeshData::no_uv};
            if (has_uvs)
                for (size_t k = 0; k < 3; ++k) {
                    own[k] = static_cast<uint32_t>(mesh_.uvs.size());
                    mesh_.uvs.push_back(uv_at(t[k]));
                }
            mesh_.uv_triangles.push_back(own);
            return true;
        };
        bool any = false;
        if (n == 3) {
            any = add({0, 1, 2});
        } else {
            polygon_.clear();
            for (size_t i = 0; i < n; ++i) polygon_.push_back(mesh_.positions[index(i)]);
            for (const auto& t : triangulate_(polygon_)) any = add(t) || any;
        }
        without_area_ += any ? 0 : 1;
    }
    bool add_triangle(const std::array<uint32_t, 3>& t)
    {
        const bool counts = spans_area(t);
        if (counts) mesh_.triangles.push_back(t);
        return counts;
    }
    bool fit_uvs()
    {
        bool fit = uvs_.size() == 2 * corners_.size();
        for (size_t k = 0; fit && k < corners_.size(); ++k) fit = !is_broken(uv_at(k));
        unfit_uvs_ += fit ? 0 : 1;
        return fit;
    }
    Vec2 uv_at(size_t corner) const { return uv_of(uvs_[2 * corner], uvs_[2 * corner + 1]); }
    uint32_t index(size_t corner) const { return static_cast<uint32_t>(corners_[corner]); }

    const PlyElement& element_;
    const bool are_strips_, swaps_;
    MeshData& mesh_;
    Diagnostics& diagnostics_;
    std::optional<size_t> corners_of_, uvs_of_;  // properties
    uint64_t without_area_ = 0, unfit_uvs_ = 0;
    std::vector<double> corners_, uvs_;
    std::vector<Vec3d> polygon_;
    Triangulator triangulate_;
};

}  // namespace

bool read_ply_faces(const PlyElement& element, bool are_strips, bool swaps, bool keeps_uvs, PlyCursor& cursor,
                    MeshData& mesh, Diagnostics& diagnostics)
{
    FaceReader reader(element, are_strips, swaps, keeps_uvs, mesh, diagnostics);
    if (!reader.has_corners()) {
        diagnostics.error({mesh.file, 0, 0}, "faces have no list vertex_indices");
        return false;
    }
    if (reader.has_uvs()) mesh.uvs.clear();
    if (!reader.read_triangles(cursor) && !reader.read_one_by_one(cursor)) return false;
    reader.warn();
    return true;
}

}  // namespace lancer
