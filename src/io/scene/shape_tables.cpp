#include "io/scene/shape_tables.h"

#include <cmath>
#include <utility>

#include "io/scene/camera_tables.h"
#include "io/scene/texture_tables.h"
#include "scene/build/shapes.h"

namespace lancer {
namespace {

class ShapeReader {
public:
    explicit ShapeReader(SceneDescription& scene) : scene_(scene) {}

    void read_plane(const TomlTable& table);
    void read_water(const TomlTable& table);
    void read_bubble(const TomlTable& table);
    void read_triangle(const TomlTable& table);
    void read_pyramid(const TomlTable& table);
    std::vector<NameUse> take_uses() { return std::move(uses_); }

private:
    PlaneDescription read_place(const TomlTable& table);
    std::optional<Bands> read_bands(const TomlTable& table);
    void add_mesh(const TomlTable& table, std::shared_ptr<const MeshData> data);

    SceneDescription& scene_;
    std::vector<NameUse> uses_;
};

// Whether a unit vector can be made of it.
bool check_direction(const TomlTable& table, std::string_view key, Vec3d v)
{
    const double size = length(v);
    if (!(size > 0)) table.error(key, " must not be the zero vector");
    if (std::isinf(size)) table.error(key, " is too long to be made a unit vector");
    return size > 0 && std::isfinite(size);
}

void read_axes(const TomlTable& table, PlaneDescription& plane)
{
    constexpr double least_sine = 1e-6;  // what is left of an angle in numbers that somebody typed
    const std::optional<Vec3d> u = table.vector("u"), v = table.vector("v");
    if (table.has("u") != table.has("v"))
        table.has("u") ? table.error("u", " needs 'v'") : table.error("v", " needs 'u'");
    if (!u || !v) return;
    const bool has_lengths = check_direction(table, "u", *u);
    if (!check_direction(table, "v", *v) || !has_lengths) return;
    const Vec3d n = cross(normalize(*u), normalize(*v));
    if (length(n) < least_sine) return table.error("v", " must not be parallel to 'u'");
    if (table.has("normal") && length(plane.normal) > 0 && length(normalize(n) - normalize(plane.normal)) > least_sine)
        return table.error("normal", " must be the direction of u x v, or not be given");
    plane.normal = n;
    plane.axes = {*u, *v};
}

PlaneDescription ShapeReader::read_place(const TomlTable& table)
{
    PlaneDescription plane;
    plane.where = table.where();
    plane.point = table.vector("point").value_or(plane.point);
    plane.normal = table.vector("normal").value_or(plane.normal);
    check_direction(table, "normal", plane.normal);
    read_axes(table, plane);
    plane.material = read_material_use(table, uses_);
    return plane;
}

std::optional<Bands> ShapeReader::read_bands(const TomlTable& table)
{
    const std::optional<double> width = table.number("band_width", reflectance);
    if (!table.has("band_material")) {
        if (table.has("band_width")) table.error("band_width", " needs 'band_material'");
        return {};
    }
    Bands bands;
    bands.material = read_material_use(table, uses_, "band_material");
    bands.width = static_cast<float>(width.value_or(bands.width));
    if (bands.material.empty()) return {};
    return bands;
}

void ShapeReader::read_plane(const TomlTable& table)
{
    table.allow({"point", "normal", "u", "v", "material", "band_material", "band_width"});
    PlaneDescription plane = read_place(table);
    plane.bands = read_bands(table);
    scene_.planes.push_back(std::move(plane));
}

void ShapeReader::read_water(const TomlTable& table)
{
    table.allow({"point", "normal", "u", "v", "material", "waves"});
    PlaneDescription water = read_place(table);
    water.is_water = true;
    water.waves = read_waves(table, "waves");
    // The waves start from the point.
    if (!water.axes && length(water.normal) > 0) water.axes = default_axes(normalize(water.normal));
    scene_.planes.push_back(std::move(water));
}

void ShapeReader::read_bubble(const TomlTable& table)
{
    table.allow({"center", "radius", "thickness", "material"});
    SphereDescription outside;
    outside.where = table.where();
    outside.center = table.vector("center").value_or(outside.center);
    outside.radius = table.number("radius", above_zero).value_or(outside.radius);
    outside.part = SphereDescription::Part::bubble;
    const double thickness = table.number("thickness", above_zero).value_or(0.02);
    table.require("material");
    outside.material = read_material_use(table, uses_);
    SphereDescription inside = outside;
    inside.radius -= thickness;
    inside.part = SphereDescription::Part::inside_of_bubble;
    if (!(inside.radius > 0))
        return table.error(table.has("thickness") ? "thickness" : "radius",
                           table.has("thickness") ? " must be less than the radius"
                                                  : " must be greater than 'thickness', which is 0.02");
    scene_.spheres.push_back(std::move(outside));
    scene_.spheres.push_back(std::move(inside));
}

void ShapeReader::add_mesh(const TomlTable& table, std::shared_ptr<const MeshData> data)
{
    MeshDescription mesh;
    mesh.where = table.where();
    mesh.data = std::move(data);
    mesh.material = read_material_use(table, uses_);
    mesh.bands = read_bands(table);
    scene_.meshes.push_back(std::move(mesh));
}

void ShapeReader::read_triangle(const TomlTable& table)
{
    table.allow({"a", "b", "c", "material", "band_material", "band_width"});
    std::array<Vec3d, 3> corners;
    bool is_read = true;
    for (size_t i = 0; i < 3; ++i) {
        const char* const key = std::array{"a", "b", "c"}[i];
        const std::optional<Vec3d> corner = table.require(key) ? table.vector(key) : std::nullopt;
        if (corner) corners[i] = *corner;
        is_read = is_read && corner;
    }
    const auto [a, b, c] = corners;
    if (is_read && !(length(cross(b - a, c - a)) > 0)) table.error("c", ": the three corners must not lie on one line");
    add_mesh(table, make_triangle(a, b, c));
}

void ShapeReader::read_pyramid(const TomlTable& table)
{
    table.allow({"center", "side", "up", "material", "band_material", "band_width"});
    const Vec3d center = table.vector("center").value_or(Vec3d{});
    const double side = table.number("side", above_zero).value_or(1);
    const std::optional<Vec3d> said = read_up(table);
    const Vec3d up = said.value_or(Vec3d{0, 1, 0});
    if (up == Vec3d{}) return table.error("up", " must not be the zero vector");
    add_mesh(table, make_pyramid(center, side, up));
}

}  // namespace

std::string read_material_use(const TomlTable& table, std::vector<NameUse>& uses, std::string_view key)
{
    const std::optional<std::string> name = table.text(key);
    if (name) uses.push_back({table.where(key), *name});
    return name.value_or("");
}

std::vector<NameUse> read_shapes(const TomlTable& root, SceneDescription& scene)
{
    ShapeReader reader(scene);
    for (const TomlTable& table : root.tables("plane")) reader.read_plane(table);
    for (const TomlTable& table : root.tables("water")) reader.read_water(table);
    for (const TomlTable& table : root.tables("bubble")) reader.read_bubble(table);
    for (const TomlTable& table : root.tables("triangle")) reader.read_triangle(table);
    for (const TomlTable& table : root.tables("pyramid")) reader.read_pyramid(table);
    return reader.take_uses();
}

}  // namespace lancer
