#include "scene/build/sheets.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "core/disjoint_sets.h"
#include "scene/build/holes.h"
#include "scene/build/slab.h"

namespace lancer {
namespace {

// Above this ratio of the sum of its normals to its area an open part is a sheet even if faces of other materials go on
// at its borders, like a pane in a wall; below it they close a body, like a label on a bottle.
constexpr double most_sheet_like = 2.0 / 3;

// Holes of scanned bodies, slits between faces and a face of wrong winding do not make a sheet of a body: what is open
// may be this part of its area.
constexpr double most_open = 0.05;

class Finder {
public:
    Finder(const MeshData& data, const Transform& place, std::span<const uint32_t> material_of,
           std::span<const FaceMaterial> materials)
        : data_(data), place_(place), material_of_(material_of), materials_(materials)
    {
    }

    FoundSheets find()
    {
        std::vector<uint32_t> which;
        for (uint32_t t = 0; t < data_.triangles.size(); ++t)
            if (role_of_triangle(t) != GlassRole::none) which.push_back(t);
        faces_ = weld_faces(data_, place_, which);
        for (const uint32_t t : faces_.number) material_.push_back(material_of_[t]);
        copies_ = find_coincident(faces_, material_);
        drop_copies_of_faces();
        list_parts();
        for (size_t p = 0; p < parts_.size(); ++p) decide(p);
        decide_sheets();
        std::sort(found_.thin.begin(), found_.thin.end());
        std::sort(found_.absent.begin(), found_.absent.end());
        return std::move(found_);
    }

private:
    struct Part {
        std::vector<uint32_t> faces;    // those that stand for others or for themselves
        std::vector<uint32_t> copies;   // the others
        std::span<FaceAtEdge> edges{};  // of all
        bool is_balanced = true;        // all faces bound a volume, or none
        bool kept_is_balanced = true;   // so do those that stand for others
        bool is_manifold = true;        // of those, two meet at each edge
    };
    GlassRole role_of_triangle(uint32_t t) const { return materials_[material_of_[t]].role; }
    GlassRole role(uint32_t face) const { return materials_[material_[face]].role; }
    void count(uint32_t face, SheetKind kind) { ++found_.counts[{material_[face], kind}]; }

    // Of what lets rays pass, or is thin by its material, one of several faces in a place counts.
    void drop_copies_of_faces()
    {
        if (!copies_.has_any()) return;
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            if (role(f) == GlassRole::glass || copies_.stands(f) || !looks_like_its_first(f)) continue;
            if (const uint32_t half = copies_.half[f]; half != CoincidentFaces::none && !looks_like_its_first(half))
                continue;
            found_.absent.push_back(faces_.number[f]);
            count(f, SheetKind::face_twice);
        }
    }
    // Whether textures show the same there: copies of quads may have another diagonal, but they share corners.
    bool looks_like_its_first(uint32_t face) const
    {
        const uint32_t other = copies_.first[face], other_half = copies_.half[other];
        if (!materials_[material_[face]].reads_uv || data_.uvs.empty()) return true;
        const auto uv_at = [&](uint32_t f, uint32_t vertex) -> const Vec2* {
            const uint32_t t = faces_.number[f];
            const auto& uvs = data_.uv_triangles[t];
            for (size_t k = 0; k < 3; ++k)
                if (const uint32_t v = data_.triangles[t][k];
                    uvs[k] != MeshData::no_uv && place_.point(data_.positions[v]) == faces_.positions[vertex])
                    return &data_.uvs[uvs[k]];
            return nullptr;
        };
        for (const uint32_t vertex : faces_.corners[face]) {
            const Vec2 *const a = uv_at(face, vertex), *b = uv_at(other, vertex);
            if (!b && other_half != CoincidentFaces::none) b = uv_at(other_half, vertex);
            if (a && b && !(*a == *b)) return false;
        }
        return true;
    }

    void list_parts()
    {
        edges_ = edges_of(faces_, [&](uint32_t f) { return role(f) == GlassRole::glass; });
        DisjointSets parts(faces_.size());
        for_each_edge(edges_, [&](std::span<const FaceAtEdge> at) {
            for (const FaceAtEdge& e : at) parts.join(at[0].face, e.face);
        });
        std::vector<uint32_t> number(faces_.size(), UINT32_MAX);
        part_of_.assign(faces_.size(), UINT32_MAX);
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            if (role(f) != GlassRole::glass) continue;
            uint32_t& n = number[parts.find(f)];
            if (n == UINT32_MAX) n = static_cast<uint32_t>(parts_.size()), parts_.emplace_back();
            (copies_.stands(f) ? parts_[n].faces : parts_[n].copies).push_back(f);
            part_of_[f] = n;
        }
        std::stable_sort(edges_.begin(), edges_.end(),
                         [&](const FaceAtEdge& a, const FaceAtEdge& b) { return part_of_[a.face] < part_of_[b.face]; });
        for (size_t i = 0, end; i < edges_.size(); i = end) {
            const uint32_t p = part_of_[edges_[i].face];
            for (end = i; end < edges_.size() && part_of_[edges_[end].face] == p;) ++end;
            parts_[p].edges = std::span(edges_).subspan(i, end - i);
        }
    }
    void look_at_edges(Part& part) const
    {
        for_each_edge(part.edges, [&](std::span<const FaceAtEdge> at) {
            int all = 0, kept = 0, kept_faces = 0;
            for (const FaceAtEdge& e : at) {
                const int turn = e.forward ? 1 : -1;
                all += turn;
                if (copies_.stands(e.face)) kept += turn, ++kept_faces;
            }
            part.is_balanced &= all == 0;
            part.kept_is_balanced &= kept == 0;
            part.is_manifold &= kept_faces == 2;
        });
    }

    void decide(size_t p)
    {
        Part& part = parts_[p];
        look_at_edges(part);
        const bool has_copies = !part.copies.empty();
        const auto is_nearly_closed = [&] { return open_part(faces_, copies_, part.edges, part.faces) <= most_open; };
        if (!has_copies && (part.is_balanced || materials_[material_[part.faces[0]]].is_liquid || is_nearly_closed())) {
            add_body(part.faces);
            if (part.is_balanced && six_volumes(part.faces) < 0)
                found_.inward.push_back({material_[part.faces[0]], found_.bodies.back()});
            return;
        }
        if (has_copies) {
            const bool is_body = part.kept_is_balanced || (part.is_manifold && can_be_turned(part));
            // Bodies of one material side by side need all that they share.
            if (!is_body && part.is_balanced && !is_all_doubled(part)) {
                found_.bodies.push_back(box_of(part.faces));
                return;
            }
            if (is_body || is_nearly_closed()) {
                turn_outwards(part.faces);
                for (const uint32_t f : part.faces) drop_others(f);
                count(part.faces[0], SheetKind::body_twice);
                return add_body(part.faces);
            }
        }
        sheets_.push_back(p);
    }
    // Whether each face has as many copies on one side as on the other, so that nothing is between them.
    bool is_all_doubled(const Part& part) const
    {
        std::unordered_map<uint32_t, int> balance;
        for (const uint32_t f : part.faces) ++balance[f];
        for (const uint32_t f : part.copies) balance[copies_.first[f]] += copies_.is_reversed[f] ? -1 : 1;
        return std::all_of(balance.begin(), balance.end(), [](const auto& b) { return b.second == 0; });
    }

    // Takes for each face the copy of that side that makes all bound a volume, where there is one.
    bool can_be_turned(Part& part) const
    {
        std::unordered_map<uint32_t, std::vector<std::pair<uint32_t, bool>>> neighbours;  // and whether they agree
        for_each_edge(part.edges, [&](std::span<const FaceAtEdge> at) {
            std::vector<FaceAtEdge> kept;
            for (const FaceAtEdge& e : at)
                if (copies_.stands(e.face)) kept.push_back(e);
            const bool agree = kept[0].forward != kept[1].forward;
            neighbours[kept[0].face].emplace_back(kept[1].face, agree);
            neighbours[kept[1].face].emplace_back(kept[0].face, agree);
        });
        for (const bool begin : {false, true}) {
            std::unordered_map<uint32_t, bool> turned{{part.faces[0], begin}};
            std::vector<uint32_t> left{part.faces[0]};
            bool works = !begin || copies_.back[part.faces[0]] != CoincidentFaces::none;
            while (works && !left.empty()) {
                const uint32_t f = left.back();
                left.pop_back();
                for (const auto& [other, agree] : neighbours[f]) {
                    const bool turn = turned[f] != !agree;
                    const auto [it, is_new] = turned.emplace(other, turn);
                    works = works && it->second == turn && (!turn || copies_.back[other] != CoincidentFaces::none);
                    if (is_new) left.push_back(other);
                }
            }
            // Faces that only corners connect to the first stay as they are.
            if (!works || turned.size() != part.faces.size()) continue;
            for (uint32_t& f : part.faces)
                if (turned[f]) f = copies_.back[f];
            return true;
        }
        return false;
    }
    // What its faces bound; below 0 if they look inwards.
    double six_volumes(std::span<const uint32_t> body) const
    {
        double volume = 0;
        const Vec3d o = faces_.positions[faces_.corners[body[0]][0]];
        for (const uint32_t f : body) {
            const auto& [a, b, c] = faces_.corners[f];
            volume += dot(faces_.positions[a] - o, cross(faces_.positions[b] - o, faces_.positions[c] - o));
        }
        return volume;
    }
    void turn_outwards(std::vector<uint32_t>& body) const
    {
        if (six_volumes(body) >= 0) return;
        std::vector<uint32_t> other;
        for (const uint32_t f : body) {
            const uint32_t back = other_side(f);
            if (back == CoincidentFaces::none) return;
            other.push_back(back);
        }
        body = std::move(other);
    }
    uint32_t other_side(uint32_t face) const { return copies_.stands(face) ? copies_.back[face] : copies_.first[face]; }
    // All copies of a kept face but itself.
    void drop_others(uint32_t kept)
    {
        const uint32_t first = copies_.first[kept];
        if (first != kept) found_.absent.push_back(faces_.number[first]);
        if (by_first_.empty())
            for (uint32_t f = 0; f < faces_.size(); ++f)
                if (!copies_.stands(f)) by_first_[copies_.first[f]].push_back(f);
        const auto it = by_first_.find(first);
        if (it == by_first_.end()) return;
        for (const uint32_t f : it->second)
            if (f != kept) found_.absent.push_back(faces_.number[f]);
    }

    Bounds box_of(std::span<const uint32_t> part) const
    {
        Bounds box;
        for (const uint32_t f : part)
            for (const uint32_t v : faces_.corners[f]) box.grow(faces_.positions[v]);
        return box;
    }
    std::vector<uint32_t> numbers_of(std::span<const uint32_t> part) const
    {
        std::vector<uint32_t> numbers;
        for (const uint32_t f : part) numbers.push_back(faces_.number[f]);
        return numbers;
    }
    bool is_one_material(std::span<const uint32_t> part) const
    {
        return std::all_of(part.begin(), part.end(), [&](uint32_t f) { return material_[f] == material_[part[0]]; });
    }
    void add_slab(std::span<const uint32_t> kept, std::span<const uint32_t> rest, const Bounds& box)
    {
        found_.slabs.push_back({numbers_of(kept), numbers_of(rest), material_[kept[0]], box, found_.bodies.size()});
        found_.bodies.push_back(box);
    }
    void add_body(std::span<const uint32_t> body)
    {
        const Bounds box = box_of(body);
        if (is_one_material(body) && materials_[material_[body[0]]].may_be_slab)
            if (const auto split = split_slab(faces_, body, thinnest_body))
                return add_slab(split->front, split->rest, box);
        found_.bodies.push_back(box);
    }

    // Of open parts: pairs that are the two sides of a slab, bodies that other materials close, and sheets.
    void decide_sheets()
    {
        struct Side {
            FlatFaces flat;
            size_t part;
        };
        std::vector<Side> sides;
        for (const size_t p : sheets_) {
            const Part& part = parts_[p];
            if (!part.copies.empty() || !is_one_material(part.faces) ||
                !materials_[material_[part.faces[0]]].may_be_slab)
                continue;
            if (const auto flat = as_flat(faces_, part.faces)) sides.push_back({*flat, p});
        }
        std::stable_sort(sides.begin(), sides.end(),
                         [](const Side& a, const Side& b) { return a.flat.area < b.flat.area; });
        std::vector<bool> is_done(parts_.size());
        for (size_t i = 0; i < sides.size(); ++i)
            for (size_t j = i + 1; j < sides.size() && !is_done[sides[i].part]; ++j) {
                if (sides[j].flat.area > 1.05 * sides[i].flat.area) break;
                const Part &a = parts_[sides[i].part], &b = parts_[sides[j].part];
                if (is_done[sides[j].part] || material_[a.faces[0]] != material_[b.faces[0]] ||
                    !are_sides_of_slab(sides[i].flat, sides[j].flat, thinnest_body))
                    continue;
                is_done[sides[i].part] = is_done[sides[j].part] = true;
                append(found_.thin, a.faces), append(found_.absent, b.faces);
                count(a.faces[0], SheetKind::slab);
            }
        for (const size_t p : sheets_)
            if (!is_done[p]) add_sheet(p);
    }
    void append(std::vector<uint32_t>& to, std::span<const uint32_t> part) const
    {
        for (const uint32_t f : part) to.push_back(faces_.number[f]);
    }
    void add_sheet(size_t p)
    {
        const Part& part = parts_[p];
        if (part.copies.empty() && !is_sheet_like(part.faces) && is_closed_by_others(part)) {
            found_.bodies.push_back(box_of(part.faces));
            return;
        }
        append(found_.thin, part.faces), append(found_.absent, part.copies);
        count(part.faces[0], part.copies.empty() ? SheetKind::open : SheetKind::doubled);
    }
    bool is_sheet_like(std::span<const uint32_t> part) const
    {
        Vec3d sum{};
        double area = 0;
        for (const uint32_t f : part) sum += faces_.normal(f), area += length(faces_.normal(f));
        return length(sum) > most_sheet_like * area;
    }
    bool is_closed_by_others(const Part& part)
    {
        if (!others_)
            others_.emplace(data_, place_, faces_, [&](uint32_t t) { return role_of_triangle(t) != GlassRole::glass; });
        return others_->close(part.edges);
    }

    const MeshData& data_;
    const Transform& place_;
    std::span<const uint32_t> material_of_;
    std::span<const FaceMaterial> materials_;
    WeldedFaces faces_;
    std::vector<uint32_t> material_;  // of each face
    CoincidentFaces copies_;
    std::vector<FaceAtEdge> edges_;
    std::vector<Part> parts_;
    std::vector<uint32_t> part_of_;
    std::vector<size_t> sheets_;  // parts that bound no volume
    std::unordered_map<uint32_t, std::vector<uint32_t>> by_first_;
    std::optional<OtherEdges> others_;  // once they are asked for
    FoundSheets found_;
};

}  // namespace

FoundSheets find_sheets(const MeshData& data, const Transform& place, std::span<const uint32_t> material_of,
                        std::span<const FaceMaterial> materials)
{
    return Finder(data, place, material_of, materials).find();
}

}  // namespace lancer
