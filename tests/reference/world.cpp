#include "reference/world.h"

#include <set>
#include <stdexcept>

#include "reference/material_list.h"
#include "reference/tangents.h"

namespace reference {
namespace {

Uv uv_of(lancer::Vec2 t) { return {double{t.x}, double{t.y}}; }

Rgb vertex_color(lancer::Color c, lancer::VertexColors meaning)
{
    const Rgb v = rgb(c);
    if (meaning == lancer::VertexColors::linear) return v;
    return {decoded_srgb(v.r), decoded_srgb(v.g), decoded_srgb(v.b)};
}

// Materials of the faces of a mesh: one for all, or one for each in the file.
std::vector<size_t> materials_of(const lancer::MeshDescription& mesh, MaterialList& list)
{
    if (mesh.bands) return {list.banded(mesh.material, *mesh.bands, lancer::TextureType::rim)};
    if (!mesh.material.empty()) return {list.named(mesh.material)};
    std::vector<size_t> ids;
    for (const auto& m : mesh.data->materials) ids.push_back(list.of_file(m));
    if (ids.empty()) ids.push_back(list.named(""));
    return ids;
}

void add_triangles(World& world, const lancer::MeshDescription& mesh, uint32_t mesh_index, uint32_t instance,
                   const Placing& place, const std::vector<size_t>& materials)
{
    const lancer::MeshData& data = *mesh.data;
    for (uint32_t i = 0; i < data.triangles.size(); ++i) {
        const auto corner = [&](size_t k) { return vec(data.positions[data.triangles[i][k]]); };
        Triangle t{place.point(corner(0)), place.point(corner(1)), place.point(corner(2)),
                   unit(place.linear.normal(cross(corner(1) - corner(0), corner(2) - corner(0))))};
        t.mesh = mesh_index, t.instance = instance, t.primitive = i;
        t.material = materials[materials.size() == 1 || data.face_material.empty() ? 0 : data.face_material[i]];
        if (!data.normals.empty() && data.normal_triangles[i][0] != lancer::MeshData::no_normal) {
            const auto normal = [&](size_t k) {
                return unit(place.linear.normal(vec(data.normals[data.normal_triangles[i][k]])));
            };
            t.normals = {normal(0), normal(1), normal(2)};
        }
        if (!data.uvs.empty() && data.uv_triangles[i][0] != lancer::MeshData::no_uv) {
            const auto uv = [&](size_t k) { return uv_of(data.uvs[data.uv_triangles[i][k]]); };
            t.uvs = {uv(0), uv(1), uv(2)};
            if (const auto tangents = world.materials[t.material].normals ? tangents_of(data, i) : std::nullopt) {
                const auto along = [&](size_t k) { return unit(place.linear(tangents->along[k])); };
                t.tangents = {along(0), along(1), along(2)};
                t.bitangent_sign = place.linear.determinant() < 0 ? -tangents->sign : tangents->sign;
            }
        }
        if (!data.colors.empty() && mesh.vertex_colors != lancer::VertexColors::none) {
            const auto color = [&](size_t k) {
                return vertex_color(data.colors[data.triangles[i][k]], mesh.vertex_colors);
            };
            t.colors = {color(0), color(1), color(2)};
        }
        world.triangles.push_back(t);
    }
}

void add_meshes(World& world, const lancer::SceneDescription& d, MaterialList& list)
{
    std::set<std::string> instanced;
    for (const auto& i : d.instances) instanced.insert(i.mesh);
    for (uint32_t m = 0; m < d.meshes.size(); ++m) {
        const lancer::MeshDescription& mesh = d.meshes[m];
        const std::vector<size_t> materials = materials_of(mesh, list);
        const Placing own(mesh.transform);
        if (mesh.name.empty() || !instanced.count(mesh.name)) {
            add_triangles(world, mesh, m, UINT32_MAX, own, materials);
            continue;
        }
        uint32_t number = 0;
        for (const auto& i : d.instances)
            i.for_each([&](const lancer::TransformDescription& t) {
                if (i.mesh == mesh.name) add_triangles(world, mesh, m, number, Placing(t) * own, materials);
                ++number;
            });
    }
}

void add_planes(World& world, const lancer::SceneDescription& d, MaterialList& list)
{
    for (const auto& p : d.planes) {
        Plane plane{};
        plane.point = vec(p.point), plane.n = unit(vec(p.normal));
        plane.material = p.bands      ? list.banded(p.material, *p.bands, lancer::TextureType::grid)
                         : p.is_water ? list.water(p)
                                      : list.named(p.material);
        if (p.axes) {
            plane.uv_origin = plane.point;
            const Vec u = vec((*p.axes)[0]), v = vec((*p.axes)[1]);
            plane.u = u * (1 / dot(u, u)), plane.v = v * (1 / dot(v, v));
            // The dual basis within the plane.
            const double uu = dot(plane.u, plane.u), vv = dot(plane.v, plane.v), uv = dot(plane.u, plane.v);
            const double det = uu * vv - uv * uv;
            plane.step_u = (plane.u * vv - plane.v * uv) * (1 / det);
            plane.step_v = (plane.v * uu - plane.u * uv) * (1 / det);
        } else {
            // Floors and ceilings; walls, where v goes up.
            const Vec n = plane.n;
            plane.u = std::abs(n.y) > 0.9 ? unit({n.y, -n.x, 0}) : unit(cross({0, 1, 0}, n));
            plane.v = cross(n, plane.u);
            plane.step_u = plane.u, plane.step_v = plane.v;
        }
        world.planes.push_back(plane);
    }
}

void add_lights(World& world, const lancer::SceneDescription& d, MaterialList& list, const lancer::RasterSource& images)
{
    for (const auto& l : d.lights) {
        const Rgb power = rgb(l.power);
        switch (l.type) {
            case lancer::LightType::point:
                world.points.push_back({vec(l.position), power});
                break;
            case lancer::LightType::spot:
                world.points.push_back({vec(l.position), power, unit(vec(l.direction)),
                                        std::cos(l.inner_deg * pi / 180), std::cos(l.outer_deg * pi / 180)});
                break;
            case lancer::LightType::directional:
                world.directionals.push_back({-unit(vec(l.direction)), power});
                break;
            case lancer::LightType::sphere: {
                lancer::MaterialDescription m;
                m.base_color = {};
                m.emission = l.power;
                if (!black(power)) world.spheres.push_back({vec(l.position), l.radius, list.add(m)});
                break;
            }
            default:
                if (l.file.empty()) {
                    world.constant_sky += power;
                } else {
                    world.sky_picture = Texels(*images(l.file).get(), lancer::Encoding::srgb, lancer::Channel::color);
                    for (Rgb& t : world.sky_picture->texels)
                        t = {std::max(0.0, t.r), std::max(0.0, t.g), std::max(0.0, t.b)};
                    world.sky_factor = power;
                    world.sky_rotation = rotation(vec(l.rotate_deg));
                }
        }
    }
}

void refuse_unknown(const lancer::SceneDescription& d)
{
    const auto refuse = [](const char* what) {
        throw std::invalid_argument(std::string("the reference knows no ") + what);
    };
    const lancer::RenderSettings& s = d.render;
    if (s.terminator || s.straight_shadows || s.legacy) refuse("terminator, straight_shadows or legacy");
    if (!s.fresnel || !s.soft_shadows || !s.direct || !s.emitters) refuse("switch of [render] that takes light away");
    if (d.fog && !d.fog->low && !d.fog->high && !d.fog->height) refuse("box of fog that follows from the scene");
    if (!d.background) return;
    if (d.background->sky == lancer::SkyType::picture || d.background->ground == lancer::GroundType::picture)
        refuse("picture as background");
}

}  // namespace

bool World::has_bare() const
{
    return std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.is_bare(); });
}

World::World(const lancer::SceneDescription& d, const lancer::RasterSource& images)
{
    refuse_unknown(d);
    multiscatter = d.render.multiscatter;
    MaterialList list(*this, d, images);
    for (const auto& s : d.spheres)
        spheres.push_back({vec(s.center), s.radius,
                           s.part == lancer::SphereDescription::Part::inside_of_bubble ? list.inside_out(s.material)
                                                                                       : list.named(s.material)});
    add_meshes(*this, d, list);
    add_planes(*this, d, list);
    add_lights(*this, d, list, images);
    if (d.camera && !d.camera->inside.empty()) camera_medium = list.named(d.camera->inside);
    background = d.background;
    fog = d.fog;
    glow = background && background->glow;
}

}  // namespace reference
