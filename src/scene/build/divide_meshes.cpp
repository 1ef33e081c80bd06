#include "scene/build/divide_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/names.h"
#include "scene/build/displace.h"
#include "scene/build/divide.h"
#include "scene/build/overrides.h"
#include "scene/placement.h"

namespace lancer {
namespace {

// What a triangle takes while it is divided and displaced, with its part of the vertices. Measured.
constexpr uint64_t bytes_per_triangle = 260;

// How large things are in the picture of a camera.
class PixelSize {
public:
    // places: where copies of the mesh stand.
    PixelSize(const CameraDescription* camera, const RenderSettings& settings, const Bounds& subject,
              std::vector<Transform> places, const Bounds& mesh)
        : places_(std::move(places))
    {
        const double fov = camera ? camera->fov_deg : CameraDescription{}.fov_deg;
        pixels_ = settings.size.height / (2 * std::tan(fov * pi_d / 360));
        // Without a camera it is seen from where all of it is in the picture.
        eye_ =
            camera ? camera->position : subject.center() + Vec3d{0, 0, subject.radius() / std::sin(fov * pi_d / 360)};
        // Of many copies those that are near count.
        constexpr size_t most_copies = 8;
        const auto distance = [&](const Transform& m) { return length(m.point(mesh.center()) - eye_); };
        std::stable_sort(places_.begin(), places_.end(),
                         [&](const Transform& a, const Transform& b) { return distance(a) < distance(b); });
        if (places_.size() > most_copies) places_.resize(most_copies);
    }

    // Of an edge seen from the side, from as near as its middle is; no nearer than it is long.
    double of_edge(Vec3d a, Vec3d b) const
    {
        double most = 0;
        for (const Transform& m : places_) {
            const double size = length(m.vector(a - b));
            const double distance = length(m.point((a + b) * 0.5) - eye_);
            most = std::max(most, pixels_ * size / std::max(distance, size));
        }
        return most;
    }

private:
    std::vector<Transform> places_;
    double pixels_ = 1;
    Vec3d eye_{};
};

class MeshDivider {
public:
    MeshDivider(const SceneDescription& d, const RenderSettings& settings, const RasterSource& images,
                const PictureMemory& memory, std::vector<Scene::Note>& notes, Diagnostics& diagnostics)
        : d_(d),
          settings_(settings),
          images_(images),
          memory_(memory),
          notes_(notes),
          diagnostics_(diagnostics),
          placement_(d)
    {
    }

    std::optional<SceneDescription> run()
    {
        std::optional<SceneDescription> made;
        for (size_t i = 0; i < d_.meshes.size(); ++i) {
            const std::vector<Worn> worn = worn_by(d_.meshes[i]);
            if (!is_divided(d_.meshes[i], worn)) continue;
            if (!made) made = d_;
            made->meshes[i].data = divided(i, worn);
        }
        return made;
    }

private:
    // A material of a mesh, as it is rendered, and whether the scene file has a say in it.
    struct Worn {
        MaterialDescription material;
        bool is_of_scene = false;
    };

    std::optional<Worn> named(const std::string& name) const
    {
        for (const MaterialDescription& m : d_.materials)
            if (m.name == name) return Worn{m, true};
        return {};
    }
    std::vector<Worn> worn_by(const MeshDescription& mesh) const
    {
        if (!mesh.data) return {};
        if (!mesh.material.empty()) return {named(mesh.material).value_or(Worn{})};
        std::vector<Worn> all;
        for (const MaterialDescription& m : mesh.data->materials) {
            const MaterialOverride* const change = find_override(d_, m.name);
            if (!change)
                all.push_back({m, false});
            else if (change->material.empty())
                all.push_back({change->change(m), true});
            else
                all.push_back(named(change->material).value_or(Worn{}));
        }
        return all;
    }
    bool is_divided(const MeshDescription& mesh, const std::vector<Worn>& worn)
    {
        if (mesh.subdivision.is_asked) return mesh.data != nullptr;
        bool displaces = false;
        for (const Worn& w : worn) {
            displaces = displaces || (w.is_of_scene && w.material.displacement_map);
            if (!w.is_of_scene && w.material.displacement_map)
                diagnostics_.warning(
                    w.material.where,
                    NamedProblem{"the displacement map of", w.material.name,
                                 " is used where a [[mesh]] gives 'subdivision_edge' or 'subdivision_level'"});
        }
        return displaces;
    }

    std::shared_ptr<const MeshData> divided(size_t index, const std::vector<Worn>& worn)
    {
        const MeshDescription& mesh = d_.meshes[index];
        const SubdivisionDescription& how = mesh.subdivision;
        const PixelSize pixels(camera(), settings_, subject_bounds(d_), places_of(index), bounds_of(*mesh.data));
        const bool by_pixels = how.edge_pixels > 0;
        constexpr uint32_t usual_levels = 8;
        const uint32_t most = how.level.value_or(usual_levels);
        const auto is_long = [&](Vec3d a, Vec3d b, uint32_t) {
            return !by_pixels || pixels.of_edge(a, b) > how.edge_pixels;
        };
        check_memory(mesh, predicted(*mesh.data, most, by_pixels ? &pixels : nullptr, how.edge_pixels));
        DividedMesh made = divide(*mesh.data, most, is_long, [&](uint64_t count) { check_memory(mesh, count); });
        displace_by_maps(made.data, mesh, worn);
        notes_.push_back({mesh.where, std::to_string(mesh.data->triangles.size()) + " triangles were divided into " +
                                          std::to_string(made.data.triangles.size()) + ", " +
                                          std::to_string(made.levels) + " times at most"});
        return std::make_shared<const MeshData>(std::move(made.data));
    }

    const CameraDescription* camera() const
    {
        return d_.first_camera ? &*d_.first_camera : d_.camera ? &*d_.camera : nullptr;
    }
    std::vector<Transform> places_of(size_t index) const
    {
        const Transform own = to_transform(d_.meshes[index].transform);
        if (!placement_.instanced[index]) return {own};
        std::vector<Transform> all;
        for (const InstanceDescription& i : d_.instances)
            if (i.mesh == d_.meshes[index].name)
                i.for_each([&](const TransformDescription& t) { all.push_back(compose(to_transform(t), own)); });
        return all;
    }

    // About as many triangles as there will be, before any is made: of each by the edges of it that are not its
    // longest.
    static uint64_t predicted(const MeshData& data, uint32_t most, const PixelSize* pixels, double edge_pixels)
    {
        const double all = std::ldexp(1.0, static_cast<int>(2 * most));
        if (!pixels) return static_cast<uint64_t>(std::min(1e18, static_cast<double>(data.triangles.size()) * all));
        double sum = 0;
        for (const auto& t : data.triangles) {
            std::array<double, 3> parts{};
            for (size_t k = 0; k < 3; ++k) {
                const double size = pixels->of_edge(data.positions[t[k]], data.positions[t[(k + 1) % 3]]);
                const double levels = std::ceil(std::log2(std::max(1.0, size / edge_pixels)));
                parts[k] = std::exp2(std::min(levels, static_cast<double>(most)));
            }
            std::sort(parts.begin(), parts.end());
            sum += parts[0] * parts[1];
        }
        return static_cast<uint64_t>(std::min(1e18, sum));
    }
    void check_memory(const MeshDescription& mesh, uint64_t triangles) const
    {
        if (triangles > UINT32_MAX / 3)
            throw Error(ErrorKind::no_memory, mesh.where,
                        "dividing this mesh would make " + std::to_string(triangles) +
                            " triangles, more than 1431655765: a larger 'subdivision_edge' or a lower "
                            "'subdivision_level' makes fewer");
        const uint64_t bytes = triangles * bytes_per_triangle;
        if (bytes <= memory_.limit) return;
        throw Error(ErrorKind::no_memory, mesh.where,
                    "dividing this mesh makes about " + std::to_string(triangles) + " triangles and takes about " +
                        std::to_string(bytes / 1000000) + " MB, and --memory allows " + memory_.limit_text +
                        ": a larger 'subdivision_edge' or a lower 'subdivision_level' takes less");
    }

    // The heights of a material; nothing, after a warning, where its picture cannot be read.
    std::optional<ImageTexture> heights_of(const MaterialDescription& m)
    {
        const TextureDescription& t = *m.displacement_map;
        try {
            const RasterFuture picture = images_ ? images_(t.file) : RasterFuture{};
            if (!picture.valid()) throw Error(ErrorKind::failed, "nothing reads pictures here");
            memory_.wait_for(t.file);
            return ImageTexture(*picture.get(), t.use);
        } catch (const Error& e) {
            diagnostics_.warning(
                t.where,
                NamedProblem{"picture", t.file, " is not used, and displaces nothing: " + std::string(e.what())});
            return {};
        }
    }
    void displace_by_maps(MeshData& data, const MeshDescription& mesh, const std::vector<Worn>& worn)
    {
        std::vector<std::optional<ImageTexture>> heights(worn.size());
        std::vector<Displacement> all(worn.size());
        bool any = false;
        for (size_t i = 0; i < worn.size(); ++i) {
            const MaterialDescription& m = worn[i].material;
            if (!m.displacement_map) continue;
            if (data.uvs.empty()) {
                diagnostics_.warning(
                    mesh.where,
                    NamedProblem{"material", m.name, " displaces nothing: the mesh has no texture coordinates"});
                continue;
            }
            heights[i] = heights_of(m);
            if (!heights[i]) continue;
            all[i] = {&*heights[i], m.displacement_scale, m.displacement_midlevel};
            any = true;
        }
        if (any) displace(data, all);
    }

    const SceneDescription& d_;
    const RenderSettings& settings_;
    const RasterSource& images_;
    const PictureMemory& memory_;
    std::vector<Scene::Note>& notes_;
    Diagnostics& diagnostics_;
    const Placement placement_;
};

}  // namespace

std::optional<SceneDescription> divide_meshes(const SceneDescription& description, const RenderSettings& settings,
                                              const RasterSource& images, const PictureMemory& memory,
                                              std::vector<Scene::Note>& notes, Diagnostics& diagnostics)
{
    return MeshDivider(description, settings, images, memory, notes, diagnostics).run();
}

}  // namespace lancer
