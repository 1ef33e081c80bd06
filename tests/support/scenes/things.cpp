#include "support/scenes/things.h"

namespace lancer {

std::shared_ptr<const MeshData> make_mesh_data(std::vector<Vec3d> positions,
                                               std::vector<std::array<uint32_t, 3>> triangles,
                                               MaterialDescription material)
{
    MeshData data;
    data.positions = std::move(positions);
    data.triangles = std::move(triangles);
    data.materials.push_back(std::move(material));
    return std::make_shared<const MeshData>(std::move(data));
}

std::shared_ptr<const MeshData> make_mapped_quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, Vec2 uv,
                                                 MaterialDescription material)
{
    MeshData data = *make_quad(a, b, c, d, std::move(material));
    data.uvs = {{0, 0}, {uv.x, 0}, uv, {0, uv.y}};
    data.uv_triangles = data.triangles;
    return std::make_shared<const MeshData>(std::move(data));
}

TextureUse picture_of(const std::string& name, Encoding encoding, Channel channel)
{
    TextureDescription t;
    t.file = name;
    t.use.encoding = encoding;
    t.use.channel = channel;
    return t;
}

std::shared_ptr<const MeshData> make_uv_sphere(uint32_t rows, uint32_t columns, double bump,
                                               MaterialDescription material)
{
    std::vector<Vec3d> p{{0, 0, 1}};
    for (uint32_t r = 1; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            const double theta = pi_d * r / rows, phi = 2 * pi_d * c / columns;
            const double radius = 1 + bump * std::sin(5 * theta) * std::cos(7 * phi);
            p.push_back(Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)} *
                        radius);
        }
    p.push_back({0, 0, -1});
    const auto last = static_cast<uint32_t>(p.size() - 1);
    const auto at = [&](uint32_t row, uint32_t column) { return 1 + (row - 1) * columns + column % columns; };
    std::vector<std::array<uint32_t, 3>> t;
    for (uint32_t c = 0; c < columns; ++c) t.push_back({0, at(1, c), at(1, c + 1)});
    for (uint32_t r = 1; r + 1 < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            t.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
            t.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
        }
    for (uint32_t c = 0; c < columns; ++c) t.push_back({at(rows - 1, c), last, at(rows - 1, c + 1)});
    return make_mesh_data(std::move(p), std::move(t), std::move(material));
}

std::shared_ptr<const MeshData> make_cube(MaterialDescription material)
{
    std::vector<Vec3d> p;
    for (int i = 0; i < 8; ++i) p.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
    return make_mesh_data(std::move(p),
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
                           {1, 7, 5}},
                          std::move(material));
}

CameraDescription make_camera(Vec3d position, Vec3d target, double fov_deg)
{
    CameraDescription c;
    c.position = position;
    c.target = target;
    c.fov_deg = fov_deg;
    return c;
}

SphereDescription sphere_of(Vec3d center, double radius, std::string material, Location where)
{
    SphereDescription s;
    s.where = std::move(where);
    s.center = center;
    s.radius = radius;
    s.material = std::move(material);
    return s;
}

PlaneDescription plane_of(Vec3d point, Vec3d normal, std::string material, Location where)
{
    PlaneDescription p;
    p.where = std::move(where);
    p.point = point;
    p.normal = normal;
    p.material = std::move(material);
    return p;
}

LightDescription light_of(LightType type, Color power, Vec3d position, double radius, Location where)
{
    LightDescription l;
    l.where = std::move(where);
    l.type = type;
    l.position = position;
    l.radius = radius;
    l.power = power;
    return l;
}

LightDescription directional_of(Color irradiance, Vec3d direction)
{
    LightDescription l = light_of(LightType::directional, irradiance);
    l.direction = direction;
    return l;
}

LightDescription sky_map_of(Color factor, Vec3d rotate_deg, Location where)
{
    LightDescription l = light_of(LightType::environment, factor, {}, 1, std::move(where));
    l.file = "sky";
    l.rotate_deg = rotate_deg;
    return l;
}

InstanceDescription instance_of(std::string mesh, TransformDescription transform, Location where)
{
    InstanceDescription i;
    i.where = std::move(where);
    i.mesh = std::move(mesh);
    i.transform = transform;
    return i;
}

MaterialDescription make_gauze(std::string name, Color albedo, float opacity, float squares)
{
    MaterialDescription m = make_lambert(std::move(name), albedo);
    m.opacity = opacity;
    if (squares > 0) {
        TextureDescription checker;
        checker.type = TextureType::checker;
        checker.use.scale = {squares, squares};
        m.opacity_map = checker;
    }
    return m;
}

MaterialDescription make_glossy(std::string name, MaterialType type, Color base_color, float roughness)
{
    MaterialDescription m = make_lambert(std::move(name), base_color);
    m.type = type;
    m.roughness = roughness;
    return m;
}

MaterialDescription make_copper(std::string name, float roughness)
{
    MaterialDescription m = make_glossy(std::move(name), MaterialType::metal, {1, 1, 1}, roughness);
    m.eta = Color{0.2f, 0.92f, 1.1f};
    m.k = Color{3.91f, 2.45f, 2.14f};
    return m;
}

MaterialDescription make_translucent(std::string name, Color reflected, Color transmitted)
{
    MaterialDescription m = make_glossy(std::move(name), MaterialType::translucent, reflected, 0);
    m.transmittance = transmitted;
    return m;
}

}  // namespace lancer
