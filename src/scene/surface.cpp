#include "scene/surface.h"

#include <optional>

#include "scene/scene.h"
#include "scene/shading_normal.h"

namespace lancer {
namespace {

using UvCorners = std::array<Vec2, 3>;

// Texture coordinates of a triangle's corners; nothing if the mesh has none.
std::optional<UvCorners> corner_uvs(const MeshShading& shading, uint32_t triangle)
{
    const auto* const i = shading.uv_triangles.find(triangle);
    if (!i) return {};
    return std::array{shading.uvs[(*i)[0]], shading.uvs[(*i)[1]], shading.uvs[(*i)[2]]};
}
// Of the second set, of a triangle that has texture coordinates; those of the first if the mesh keeps one alone.
UvCorners second_corner_uvs(const MeshShading& shading, uint32_t triangle)
{
    const std::vector<Vec2>& uvs = shading.second_uvs.empty() ? shading.uvs : shading.second_uvs;
    const CornerTable::Corners& i = *shading.uv_triangles.find(triangle);
    return {uvs[i[0]], uvs[i[1]], uvs[i[2]]};
}

Vec2 weighed(const std::array<Vec2, 3>& corners, Vec2 uv)
{
    return corners[0] * first_weight(uv) + corners[1] * uv.x + corners[2] * uv.y;
}

// Tangents of a triangle, scene units; nothing if it has no area in texture space.
std::optional<Tangents> triangle_tangents(const Scene& scene, const Hit& hit, float time, const std::array<Vec2, 3>& t)
{
    const Mesh& mesh = scene.geometry.meshes[hit.geometry];
    const auto& i = mesh.triangles[hit.primitive];
    const Vec3d a = to_double(mesh.positions[i[0]]);
    Vec3d e1 = to_double(mesh.positions[i[1]]) - a, e2 = to_double(mesh.positions[i[2]]) - a;
    if (hit.instance != Hit::no_instance) {
        const InstanceAt placing = scene.geometry.instance_at(hit.instance, time);
        e1 = placing->to_world.vector(e1), e2 = placing->to_world.vector(e2);
    }
    const Vec2 d1 = t[1] - t[0], d2 = t[2] - t[0];
    const double det =
        static_cast<double>(d1.x) * static_cast<double>(d2.y) - static_cast<double>(d1.y) * static_cast<double>(d2.x);
    const double sign = det < 0 ? -1 : 1;
    const Vec3d u = e1 * (sign * static_cast<double>(d2.y)) - e2 * (sign * static_cast<double>(d1.y));
    const Vec3d v = e2 * (sign * static_cast<double>(d1.x)) - e1 * (sign * static_cast<double>(d2.x));
    const double lu = length(u), lv = length(v);
    if (det == 0 || !(lu > 0) || !(lv > 0)) return {};
    const double unit = 1 / (std::abs(det) * scene.normalisation.scale);
    return Tangents{to_float(u / lu), to_float(v / lv), {static_cast<float>(lu * unit), static_cast<float>(lv * unit)}};
}

// Scale from lengths on the triangle to uv: side of the uv square with the area of a unit square on the triangle.
float uv_per_length(const std::array<Vec2, 3>& t, float area)
{
    const Vec2 a = t[1] - t[0], b = t[2] - t[0];
    return area > 0 ? std::sqrt(0.5f * std::abs(a.x * b.y - a.y * b.x) / area) : 0;
}

Vec3 flat_normal(const Mesh& mesh, uint32_t triangle)
{
    const auto& t = mesh.triangles[triangle];
    const Vec3d a = to_double(mesh.positions[t[0]]);
    return to_float(normalize(cross(to_double(mesh.positions[t[1]]) - a, to_double(mesh.positions[t[2]]) - a)));
}
// What the tangents and normals of corners are interpolated to; nothing where no tangents are stored. As Mikkelsen's
// thesis has it, the sums are not normalised: what bakes a map inverts the same three vectors.
std::optional<TangentFrame> stored_frame(const Scene& scene, const Hit& hit, float time)
{
    const CornerTangents& tangents = scene.shading[hit.geometry].tangents;
    const auto* const named = tangents.triangles.find(hit.primitive);
    if (!named) return {};
    const Mesh& mesh = scene.geometry.meshes[hit.geometry];
    const CornerNormals& normals = scene.shading[hit.geometry].normals;
    const auto* const corners = normals.find(mesh, hit.primitive);
    std::array<Vec3, 3> along, normal;
    if (!corners) normal.fill(flat_normal(mesh, hit.primitive));
    for (size_t k = 0; k < 3; ++k) {
        along[k] = tangents.values[(*named)[k]].along;
        if (corners) normal[k] = normals.value(mesh, (*corners)[k]);
    }
    float sign = tangents.values[(*named)[0]].sign;
    if (hit.instance != Hit::no_instance) {
        const InstanceAt at_time = scene.geometry.instance_at(hit.instance, time);
        const Instance& placing = *at_time;
        for (size_t k = 0; k < 3; ++k) {
            along[k] = to_float(normalize(placing.to_world.vector(to_double(along[k]))));
            normal[k] = to_float(normalize(placing.to_mesh.normal_by_inverse(to_double(normal[k]))));
        }
        if (placing.to_world.determinant() < 0) sign = -sign;
    }
    const float first = first_weight(hit.uv);
    const auto weigh = [&](const std::array<Vec3, 3>& v) { return v[0] * first + v[1] * hit.uv.x + v[2] * hit.uv.y; };
    const Vec3 x = weigh(along), z = weigh(normal);
    return TangentFrame{x, cross(z, x) * sign, z};
}

uint32_t light_of(const Scene& scene, const Hit& hit)
{
    const RankedBitset& emitters = scene.shading[hit.geometry].emitters;
    if (emitters.empty() || !emitters.has(hit.primitive)) return Scene::none;
    const uint32_t first = hit.instance == Hit::no_instance ? scene.mesh_first_light[hit.geometry]
                                                            : scene.instance_first_light[hit.instance];
    return first + emitters.before(hit.primitive);
}

Color vertex_color(const Scene& scene, const Hit& hit)
{
    const std::vector<Color>& colors = scene.shading[hit.geometry].colors;
    const Mesh& mesh = scene.geometry.meshes[hit.geometry];
    const auto color = [&](size_t k) { return colors[mesh.triangles[hit.primitive][k] / mesh.rows]; };
    const float w = std::max(0.0f, 1 - hit.uv.x - hit.uv.y);
    return color(0) * w + color(1) * hit.uv.x + color(2) * hit.uv.y;
}

// The shadow terminator fix: the interpolated normals of a coarse mesh suggest a rounder shape than there is, and its
// triangles shadow their neighbours in visible steps. Rays start from the rounder shape instead: the mean of the
// projections of the point onto the tangent planes of the corners. Hanika, "Hacking the Shadow Terminator", Ray Tracing
// Gems II, chapter 4. It is optional, as it leaks light where the mesh really shadows itself.
Vec3 shading_origin(const Scene& scene, const Hit& hit, float time, Vec3 p)
{
    const MeshShading& shading = scene.shading[hit.geometry];
    const Mesh& mesh = scene.geometry.meshes[hit.geometry];
    const CornerNormals::Corners* const normals = shading.normals.find(mesh, hit.primitive);
    if (!normals) return p;
    const std::array<float, 3> weights{1 - hit.uv.x - hit.uv.y, hit.uv.x, hit.uv.y};
    Vec3d moved = to_double(p);
    for (size_t k = 0; k < 3; ++k) {
        Vec3d corner = to_double(mesh.positions[mesh.triangles[hit.primitive][k]]);
        Vec3d n = to_double(shading.normals.value(mesh, (*normals)[k]));
        if (hit.instance != Hit::no_instance) {
            const InstanceAt placing = scene.geometry.instance_at(hit.instance, time);
            corner = placing->to_world.point(corner);
            n = normalize(placing->to_mesh.normal_by_inverse(n));
        }
        const double below = std::min(0.0, dot(to_double(p) - corner, n));
        moved -= n * (below * static_cast<double>(weights[k]));
    }
    return to_float(moved);
}

// Of a sphere, by its unit normal on the outside; lengths are not set. Nothing at the poles.
std::optional<Tangents> sphere_tangents(Vec3 n)
{
    const double x = static_cast<double>(n.x), y = static_cast<double>(n.y), z = static_cast<double>(n.z);
    const double around = std::sqrt(x * x + z * z);
    if (!(around > 0)) return {};
    return Tangents{to_float(Vec3d{z, 0, -x} / around), to_float(Vec3d{-y * x / around, around, -y * z / around})};
}

bool is_by_second_uv(const Scene& scene, uint32_t texture)
{
    const auto* image = texture == no_texture ? nullptr : std::get_if<ImageTexture>(&scene.textures[texture]);
    return image && image->use().by_second_uv;
}

void map_sphere(Surface& s, const Sphere& sphere, const Normalisation& normalisation, float width,
                std::optional<Tangents>& tangents)
{
    const double x = static_cast<double>(s.n.x), z = static_cast<double>(s.n.z);
    const double around = std::sqrt(x * x + z * z);
    s.uv = sphere_uv(s.n);
    const double area = 2 * pi_d * pi_d * sphere.radius * sphere.radius * around;
    s.uv_width = area > 0 ? width * static_cast<float>(1 / std::sqrt(area)) : 1;
    tangents = sphere_tangents(s.n);
    if (!tangents) return;
    const double half_turn = pi_d * sphere.radius / normalisation.scale;
    tangents->unit = {static_cast<float>(2 * half_turn * around), static_cast<float>(half_turn)};
}

// p: in scene units. d: of the ray, unit.
void map_plane(Surface& s, const Normalisation& normalisation, const PlaneMap& map, Vec3d p, Vec3d n, Vec3d d,
               float width, std::optional<Tangents>& tangents)
{
    const auto to_uv = [&](Vec3d x) { return Vec2d{dot(x, map.u), dot(x, map.v)}; };
    s.uv = to_uv(normalisation.to_file(p) - map.origin);
    const double w = static_cast<double>(width) / normalisation.scale;
    s.uv_width = static_cast<float>(w * std::sqrt(length(cross(map.u, map.v))));
    // The intersection of the cone with the plane is elongated by 1 / cosine.
    const double cos = std::abs(dot(n, d));
    if (cos > 0) {
        const Vec2d along = to_uv((d - n * dot(n, d)) * (w / cos));
        s.uv_along = {static_cast<float>(along.x), static_cast<float>(along.y)};
    }
    const double lu = length(map.step_u), lv = length(map.step_v);
    tangents = Tangents{
        to_float(map.step_u / lu), to_float(map.step_v / lv), {static_cast<float>(lu), static_cast<float>(lv)}};
}

}  // namespace

ShadingPoint shading_point_at(const Scene& scene, const Hit& hit, bool front, float width, float area)
{
    ShadingPoint p{.front = front, .textures = scene.textures.data()};
    const MeshShading& shading = scene.shading[hit.geometry];
    if (!shading.colors.empty()) p.vertex_color = vertex_color(scene, hit);
    if (const auto uvs = corner_uvs(shading, hit.primitive)) {
        p.uv = weighed(*uvs, hit.uv), p.uv_width = width * uv_per_length(*uvs, area);
        if (scene.traits[shading.material_of(hit.primitive)].reads_second_uv) {
            const UvCorners second = second_corner_uvs(shading, hit.primitive);
            p.second_uv = weighed(second, hit.uv), p.second_uv_width = width * uv_per_length(second, area);
        }
    }
    return p;
}

UvSets texture_uvs(const MeshShading& shading, uint32_t triangle, Vec2 uv)
{
    const auto uvs = corner_uvs(shading, triangle);
    if (!uvs) return {};
    const Vec2 first = weighed(*uvs, uv);
    return {first, shading.second_uvs.empty() ? first : weighed(second_corner_uvs(shading, triangle), uv)};
}

TrianglePoint triangle_point(const Scene& scene, uint32_t instance, uint32_t mesh, uint32_t triangle, Vec2 uv)
{
    const TriangleInteraction s = triangle_interaction(scene, instance, mesh, triangle, uv);
    const UvSets uvs = texture_uvs(scene.shading[mesh], triangle, uv);
    return {s.p, s.p_error, s.n, s.area, uvs.first, uvs.second};
}

Vec2 sphere_uv(Vec3 n)
{
    const double x = static_cast<double>(n.x), y = static_cast<double>(n.y), z = static_cast<double>(n.z);
    return {static_cast<float>(0.5 + std::atan2(x, z) / (2 * pi_d)),
            static_cast<float>(0.5 + std::atan2(y, std::sqrt(x * x + z * z)) / pi_d)};
}

std::optional<TangentFrame> tangent_frame_at(const Scene& scene, const Hit& hit, float time, Vec3 n)
{
    if (hit.kind == Kind::plane) {
        const PlaneMap& map = scene.plane_maps[hit.primitive];
        return frame_about(n, {to_float(normalize(map.step_u)), to_float(normalize(map.step_v))});
    }
    if (hit.kind == Kind::sphere) {
        const auto tangents = sphere_tangents(n);
        return tangents ? frame_about(n, *tangents) : std::nullopt;
    }
    if (const std::optional<TangentFrame> f = stored_frame(scene, hit, time)) return frame_about(n, {f->x, f->y});
    const auto uvs = corner_uvs(scene.shading[hit.geometry], hit.primitive);
    const auto tangents = uvs ? triangle_tangents(scene, hit, time, *uvs) : std::nullopt;
    return tangents ? frame_about(n, *tangents) : std::nullopt;
}

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, RayCone cone)
{
    if (hit.kind != Kind::triangle) return surface_at(scene, ray, hit, cone, {});
    return surface_at(scene, ray, hit, cone,
                      triangle_interaction(scene, hit.instance, hit.geometry, hit.primitive, hit.uv, ray.time));
}

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, RayCone cone, const TriangleInteraction& placed)
{
    Surface s;
    s.t = hit.t;
    s.light = Scene::none;
    const float width = cone.width + cone.spread * hit.t;
    std::optional<Tangents> tangents;   // of the bump map
    std::optional<TangentFrame> frame;  // of the normal map, where the mesh keeps one
    const auto reads_uv = [&] { return scene.traits[s.material].reads_uv; };
    // Spheres and planes: the hit point in double, projected back onto the surface; only the rounding to float remains.
    const auto along = [&](double t) { return to_double(ray.org) + to_double(ray.dir) * t; };
    switch (hit.kind) {
        case Kind::sphere: {
            const SphereAt at_time = scene.geometry.sphere_at(hit.primitive, ray.time);
            const Sphere& sphere = *at_time;
            // From far away the rounding of t is a large part of a small sphere, and points at its rim would face away.
            const auto c = crossing(sphere, ray);
            const double t = c ? (hit.exit ? c->exit : c->enter) : static_cast<double>(hit.t);
            const Vec3d n = normalize(along(t) - sphere.center);
            s.p = to_float(sphere.center + n * sphere.radius);
            s.p_error = sphere_point_error(sphere, s.p);
            s.n = s.ns = to_float(n);
            s.material = scene.sphere_material[hit.primitive];
            s.light = scene.sphere_light[hit.primitive];
            if (reads_uv()) map_sphere(s, sphere, scene.normalisation, width, tangents);
            break;
        }
        case Kind::plane: {
            const Plane& plane = scene.geometry.planes[hit.primitive];
            // Towards the horizon squares of the error lie along the plane.
            const double t = intersect(plane, ray).value_or(static_cast<double>(hit.t));
            const Vec3d there = along(t), p = there - plane.normal * (dot(plane.normal, there) - plane.offset);
            s.p = to_float(p);
            s.p_error = abs(s.p) * gamma(4);
            s.n = s.ns = to_float(plane.normal);
            s.material = scene.plane_material[hit.primitive];
            if (reads_uv())
                map_plane(s, scene.normalisation, scene.plane_maps[hit.primitive], p, plane.normal, to_double(ray.dir),
                          width, tangents);
            break;
        }
        default: {
            s.p = placed.p, s.p_error = placed.p_error, s.n = placed.n, s.ns = placed.ns, s.area = placed.area;
            s.on_triangle = hit.uv;
            s.material = scene.shading[hit.geometry].material_of(hit.primitive);
            s.light = light_of(scene, hit);
            if (!scene.shading[hit.geometry].colors.empty()) s.vertex_color = vertex_color(scene, hit);
            if (const auto uvs = corner_uvs(scene.shading[hit.geometry], hit.primitive)) {
                s.uv = weighed(*uvs, hit.uv);
                s.uv_width = width * uv_per_length(*uvs, placed.area);
                const MaterialTraits& traits = scene.traits[s.material];
                bool bump_by_second = false;
                if (traits.reads_second_uv) {
                    const UvCorners second = second_corner_uvs(scene.shading[hit.geometry], hit.primitive);
                    s.second_uv = weighed(second, hit.uv);
                    s.second_uv_width = width * uv_per_length(second, placed.area);
                    bump_by_second = is_by_second_uv(scene, traits.bump);
                }
                if (traits.normal_map != no_texture) frame = stored_frame(scene, hit, ray.time);
                if (traits.bump != no_texture || (traits.tilts() && !frame))
                    tangents = triangle_tangents(
                        scene, hit, ray.time,
                        bump_by_second ? second_corner_uvs(scene.shading[hit.geometry], hit.primitive) : *uvs);
            }
        }
    }
    if (hit.kind != Kind::triangle) s.second_uv = {static_cast<float>(s.uv.x), static_cast<float>(s.uv.y)};
    s.leaf_hint = hit.leaf_hint;
    s.front = true;  // so far everything is said of the front
    const MaterialTraits& traits = scene.traits[s.material];
    if (!frame && tangents && traits.normal_map != no_texture) frame = frame_about(s.ns, *tangents);
    if ((tangents || frame) && traits.tilts()) {
        s.ns = mapped_normal(traits, scene.shading_point(s), tangents, frame, s.ns);
        // The perturbed normal may face away from the ray.
        if (const float c = dot(s.ns, s.n); c < 0) s.ns = normalize(s.ns - s.n * c);
    }
    s.ns_front = s.ns;
    const Vec3 wo = -ray.dir;
    s.front = face_forward(s.n, s.ns, wo);
    s.origin = offset_origin(s.p, s.p_error, s.n, s.n);
    s.side = s.n;
    // In legacy mode normals stay as they are.
    if (!scene.legacy && !(s.ns == s.n)) {
        turn_to_ray(s.ns, wo);
        if (traits.mirrors) s.ns = keep_reflection_outside(s.n, s.ns, wo);
        if (scene.terminator_fix && s.front && hit.kind == Kind::triangle) {
            s.origin = offset_origin(shading_origin(scene, hit, ray.time, s.p), s.p_error, s.n, s.n);
            s.side = s.ns;
        }
    }
    if (traits.has_tangent) [[unlikely]]
        s.tangent = local_tangent(tangent_frame_at(scene, hit, ray.time, s.ns_front), s.ns);
    return s;
}

}  // namespace lancer
