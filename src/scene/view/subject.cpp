#include "scene/view/subject.h"

#include "scene/placement.h"

namespace lancer {
namespace {

// Instances of more triangles than that are shown by their boxes.
constexpr size_t most_triangles = 1 << 22;

struct Shape {
    std::vector<Vec3d> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

// From 0 to 1, outward.
const Shape& unit_cube()
{
    static const Shape cube{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
                            {{0, 2, 3},
                             {0, 3, 1},
                             {4, 5, 7},
                             {4, 7, 6},
                             {0, 1, 5},
                             {0, 5, 4},
                             {2, 6, 7},
                             {2, 7, 3},
                             {0, 4, 6},
                             {0, 6, 2},
                             {1, 3, 7},
                             {1, 7, 5}}};
    return cube;
}

// Of radius 1, outward, by latitude and longitude.
Shape make_unit_sphere()
{
    constexpr uint32_t rings = 12, columns = 24;
    Shape s;
    for (uint32_t ring = 0; ring <= rings; ++ring)
        for (uint32_t column = 0; column < columns; ++column) {
            const double theta = pi_d * ring / rings, phi = 2 * pi_d * column / columns;
            s.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
        }
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = ring * columns + column, b = ring * columns + (column + 1) % columns;
            s.triangles.push_back({a, a + columns, b});
            s.triangles.push_back({b, a + columns, b + columns});
        }
    return s;
}

const Shape& unit_sphere()
{
    static const Shape sphere = make_unit_sphere();
    return sphere;
}

bool is_within(const Bounds& b, Vec3d p)
{
    return p.x >= b.lower.x && p.y >= b.lower.y && p.z >= b.lower.z && p.x <= b.upper.x && p.y <= b.upper.y &&
           p.z <= b.upper.z;
}

}  // namespace

void Subject::add(std::span<const Vec3d> positions, Triangles triangles, const Transform& to_file)
{
    const Transform to_subject{{unit_, 0, 0}, {0, unit_, 0}, {0, 0, unit_}, -bounds_.lower * unit_};
    parts_.push_back({positions, triangles, compose(to_subject, to_file)});
}

void Subject::add_box(const Bounds& box, const Transform& to_file)
{
    if (box.empty()) return;
    const Vec3d side = box.upper - box.lower;
    add(unit_cube().positions, unit_cube().triangles,
        compose(to_file, {{side.x, 0, 0}, {0, side.y, 0}, {0, 0, side.z}, box.lower}));
}

Subject::Subject(const SceneDescription& d) : bounds_(subject_bounds(d))
{
    const double extent = bounds_.extent();
    if (!(extent > 0 && std::isfinite(extent) && std::isfinite(1 / extent))) return;
    unit_ = 1 / extent;
    const Placement placement(d);
    for (size_t i = 0; i < d.meshes.size(); ++i)
        if (!placement.instanced[i])
            add(d.meshes[i].data->positions, d.meshes[i].data->triangles, to_transform(d.meshes[i].transform));
    size_t triangles = 0;
    const auto mesh_of = [&](const InstanceDescription& instance) -> const MeshDescription* {
        const auto it = placement.by_name.find(instance.mesh);
        return it == placement.by_name.end() ? nullptr : &d.meshes[it->second];
    };
    const std::vector<Bounds> boxes = bounds_of_instanced(d, placement);
    for (const InstanceDescription& instance : d.instances)
        if (const MeshDescription* mesh = mesh_of(instance))
            triangles += mesh->data->triangles.size() * instance.count();
    for (const InstanceDescription& instance : d.instances)
        if (const MeshDescription* mesh = mesh_of(instance)) {
            instance.for_each([&](const TransformDescription& t) {
                const Transform m = compose(to_transform(t), to_transform(mesh->transform));
                if (triangles > most_triangles) {
                    add_box(boxes[static_cast<size_t>(mesh - d.meshes.data())], m);
                } else {
                    add(mesh->data->positions, mesh->data->triangles, m);
                }
            });
        }
    // Those that the bounds leave out are walls or skies.
    for (const SphereDescription& s : d.spheres)
        if (is_within(bounds_, s.center))
            add(unit_sphere().positions, unit_sphere().triangles,
                {{s.radius, 0, 0}, {0, s.radius, 0}, {0, 0, s.radius}, s.center});
}

}  // namespace lancer
