#include "scene/build/thin_glass.h"

#include <algorithm>
#include <chrono>

#include "core/names.h"
#include "scene/build/material_table.h"
#include "scene/build/mesh_tables.h"
#include "scene/build/sheets.h"

namespace lancer {
namespace {

// Indices of ice, water and alcohol. Glass and plastics have more.
bool is_liquid(float ior) { return ior >= 1.3f && ior <= 1.4f; }

bool touch(const Bounds& a, const Bounds& b)
{
    const auto overlap = [](double l1, double u1, double l2, double u2) { return l1 < u2 && l2 < u1; };
    return overlap(a.lower.x, a.upper.x, b.lower.x, b.upper.x) && overlap(a.lower.y, a.upper.y, b.lower.y, b.upper.y) &&
           overlap(a.lower.z, a.upper.z, b.lower.z, b.upper.z);
}

bool is_within(const Bounds& a, const Bounds& b)
{
    const auto below = [](const Vec3d& x, const Vec3d& y) { return x.x < y.x && x.y < y.y && x.z < y.z; };
    return below(b.lower, a.lower) && below(a.upper, b.upper);
}

// What is said of each kind, after a number and "of glass 'name'" or "of 'name'".
struct Words {
    const char *one, *several, *what;
};
Words words_of(SheetKind kind)
{
    switch (kind) {
        case SheetKind::open:
            return {"sheet of glass", "sheets of glass", "bounds no volume: thin"};
        case SheetKind::doubled:
            return {"sheet of glass", "sheets of glass", "given more than once in the same place: one thin sheet"};
        case SheetKind::slab:
            return {"slab of glass", "slabs of glass", "thinner than 2 % of its extent: one thin sheet"};
        case SheetKind::body_twice:
            return {"body of glass", "bodies of glass",
                    "some faces are given more than once in the same place: used once"};
        case SheetKind::face_twice:
            break;
    }
    return {"triangle of", "triangles of", "given more than once in the same place: used once"};
}

class ThinGlass {
public:
    ThinGlass(const SceneDescription& d, std::span<const Transform> places, MaterialTable& materials, Scene& scene)
        : d_(d), places_(places), materials_(materials), scene_(scene)
    {
        for (uint32_t id = 0; id < scene.materials.size(); ++id) roles_.push_back(role_of(id));
    }
    bool is_asked(uint32_t mesh) const
    {
        return scene_.shading[mesh].uses([&](uint32_t m) { return roles_[m].role != GlassRole::none; });
    }
    bool is_asked() const
    {
        for (uint32_t m = 0; m < scene_.shading.size(); ++m)
            if (is_asked(m)) return true;
        return false;
    }
    void make()
    {
        std::vector<FoundSheets> found(d_.meshes.size());
        for (uint32_t m = 0; m < found.size(); ++m)
            if (is_asked(m)) found[m] = find_sheets(*d_.meshes[m].data, places_[m], materials_of(m), roles_);
        list_bodies(found);
        for (uint32_t m = 0; m < found.size(); ++m) {
            decide_slabs(m, found[m]);
            apply(m, found[m]);
        }
    }
    void warn(Diagnostics& diagnostics) const
    {
        for (const auto& [which, n] : inside_out_)
            diagnostics.warning(file_of(which.first),
                                std::to_string(n) + (n == 1 ? " body" : " bodies") + " of glass " +
                                    in_quotes(scene_.material_names[which.second]) +
                                    " with faces that look inwards: inside and outside have changed "
                                    "places; turn the faces round");
    }

private:
    FaceMaterial role_of(uint32_t id) const
    {
        const MaterialTraits& traits = scene_.traits[id];
        // A copy that emits on its own side is no copy.
        if (!scene_.emission[id].is_dark()) return {};
        const bool is_mix = !scene_.mix_of.empty() && scene_.mix_of[id] != Scene::none;
        const auto* glass = is_mix ? nullptr : std::get_if<Glass>(&scene_.materials[id]);
        FaceMaterial m{.reads_uv = traits.reads_uv};
        if (glass && materials_.may_be_thin(id)) {
            m.role = GlassRole::glass;
            m.is_liquid = is_liquid(glass->ior);
            m.may_be_slab = alpha_of_roughness(glass->roughness.value) == 0 && !traits.tilts() && !traits.has_holes() &&
                            !m.is_liquid;
        } else if (glass && glass->thin) {
            m.role = GlassRole::sheet;
        } else if (traits.has_holes()) {
            m.role = GlassRole::veil;
        }
        return m;
    }
    std::vector<uint32_t> materials_of(uint32_t mesh) const
    {
        std::vector<uint32_t> all(d_.meshes[mesh].data->triangles.size());
        for (uint32_t t = 0; t < all.size(); ++t) all[t] = scene_.shading[mesh].material_of(t);
        return all;
    }

    bool bounds_body(uint32_t material) const { return scene_.traits[material].medium != no_medium; }
    // Boxes of all bodies that refract, scene units; those of meshes are there in the order of `found`.
    void list_bodies(const std::vector<FoundSheets>& found)
    {
        for (uint32_t m = 0; m < found.size(); ++m) {
            first_body_.push_back(bodies_.size());
            if (!scene_.geometry.meshes[m].instanced)
                bodies_.insert(bodies_.end(), found[m].bodies.begin(), found[m].bodies.end());
        }
        for (const Instance& i : scene_.geometry.instances)
            for (const Bounds& b : found[i.mesh].bodies) bodies_.push_back(transformed(b, i.to_world));
        for (size_t i = 0; i < scene_.geometry.spheres.size(); ++i) {
            if (!bounds_body(scene_.sphere_material[i])) continue;
            const Sphere& s = scene_.geometry.spheres[i];
            const Vec3d r{s.radius, s.radius, s.radius};
            bodies_.push_back({s.center - r, s.center + r});
        }
    }
    bool is_below_water(const Bounds& b) const
    {
        for (size_t i = 0; i < scene_.geometry.planes.size(); ++i) {
            const Plane& plane = scene_.geometry.planes[i];
            const Vec3d& n = plane.normal;
            const Vec3d lowest{n.x > 0 ? b.lower.x : b.upper.x, n.y > 0 ? b.lower.y : b.upper.y,
                               n.z > 0 ? b.lower.z : b.upper.z};
            if (bounds_body(scene_.plane_material[i]) && dot(n, lowest) < plane.offset) return true;
        }
        return false;
    }
    // Light goes from the slab into what it touches, or is inside of: such a body has an inside.
    bool is_alone(uint32_t mesh, const FoundSheets& found, const FoundSheets::Slab& slab) const
    {
        const bool instanced = scene_.geometry.meshes[mesh].instanced;
        const std::vector<Bounds>& others = instanced ? found.bodies : bodies_;
        const size_t self = instanced ? slab.body : first_body_[mesh] + slab.body;
        for (size_t i = 0; i < others.size(); ++i)
            if (i != self && touch(others[i], slab.box)) return false;
        return instanced || !is_below_water(slab.box);
    }
    void decide_slabs(uint32_t mesh, FoundSheets& found) const
    {
        for (const FoundSheets::Slab& slab : found.slabs) {
            if (!is_alone(mesh, found, slab)) continue;
            found.thin.insert(found.thin.end(), slab.kept.begin(), slab.kept.end());
            found.absent.insert(found.absent.end(), slab.rest.begin(), slab.rest.end());
            ++found.counts[{slab.material, SheetKind::slab}];
        }
    }

    // A cavity of a body looks inwards, too, but is inside of it.
    bool is_cavity(uint32_t mesh, const FoundSheets& found, const Bounds& box) const
    {
        const std::vector<Bounds>& all = scene_.geometry.meshes[mesh].instanced ? found.bodies : bodies_;
        return std::any_of(all.begin(), all.end(), [&](const Bounds& b) { return is_within(box, b); });
    }
    Location file_of(uint32_t mesh) const
    {
        const MeshDescription& m = d_.meshes[mesh];
        return m.data->shape.empty() ? Location{m.data->file} : m.where;
    }
    void apply(uint32_t mesh, const FoundSheets& found)
    {
        for (const FoundSheets::Inward& body : found.inward)
            if (!is_cavity(mesh, found, body.box)) ++inside_out_[{mesh, body.material}];
        if (!found.thin.empty()) {
            std::vector<uint32_t> of_faces = materials_of(mesh);
            for (const uint32_t t : found.thin) of_faces[t] = materials_.thin_version(of_faces[t]);
            set_materials(scene_.shading[mesh], of_faces);
        }
        // No ray meets a triangle without an area; all tables keep their places.
        for (const uint32_t t : found.absent) {
            auto& corners = scene_.geometry.meshes[mesh].triangles[t];
            corners[1] = corners[2] = corners[0];
        }
        for (const auto& [what, n] : found.counts) {
            const Words words = words_of(what.second);
            scene_.sheets.push_back({file_of(mesh), std::to_string(n) + " " + (n == 1 ? words.one : words.several) +
                                                        " " + in_quotes(scene_.material_names[what.first]) + ": " +
                                                        words.what});
        }
    }

    const SceneDescription& d_;
    std::span<const Transform> places_;
    MaterialTable& materials_;
    Scene& scene_;
    std::vector<FaceMaterial> roles_;  // of each material
    std::vector<Bounds> bodies_;
    std::vector<size_t> first_body_;                                // of each mesh
    std::map<std::pair<uint32_t, uint32_t>, uint64_t> inside_out_;  // of meshes and materials
};

}  // namespace

void make_thin_glass(const SceneDescription& description, std::span<const Transform> places, MaterialTable& materials,
                     Scene& scene, Diagnostics& diagnostics)
{
    const auto begin = std::chrono::steady_clock::now();
    ThinGlass glass(description, places, materials, scene);
    if (!glass.is_asked()) return;
    glass.make();
    glass.warn(diagnostics);
    scene.analyses.push_back(
        {"thin glass", std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()});
}

}  // namespace lancer
