// The surface at a hit: point, normals, material. It is computed from the hit alone, whichever accelerator found it.
#pragma once

#include <optional>

#include "core/color.h"
#include "core/ray.h"
#include "geometry/geometry.h"
#include "materials/textures/texture.h"
#include "scene/triangle_interaction.h"

namespace lancer {

struct Scene;
struct MeshShading;
struct TangentFrame;

struct Surface {
    Vec3 p;
    Vec3 p_error;  // bound of p's rounding error, per axis; see offset_origin()
    Vec3 n;        // geometric, unit, on the side the ray came from
    Vec3 ns;       // shading, unit, in the hemisphere of n and turned towards the ray
    Vec3 origin;   // origin of rays to the side of n, offset by p_error; with the terminator fix above p
    Vec3 side;     // normal that decides the side of a direction: n, or with the terminator fix ns
    bool front;    // the ray came from the side the geometric normal of the shape points to
    uint32_t material;
    uint32_t light;  // id of the light at this point, or Scene::none
    float t;
    float area = 0;               // area of the triangle, scene units; else 0
    Vec2 on_triangle{};           // barycentric weights of its second and third corner
    Vec2d uv{};                   // texture coordinates; only set if the material reads textures
    float uv_width = 0;           // footprint of the ray cone, in uv
    Vec2 uv_along{};              // planes: additional extent along the ray; see Footprint
    float eta = 0;                // relative index of refraction from the media of the ray; 0: from the material
    Vec3 ns_front{};              // shading normal on the front side, not faced forward or limited
    Color vertex_color{1, 1, 1};  // of the mesh; white if it has none
    Vec2 tangent{1, 0};           // see local_tangent(); only set if the material has a tangent
    float second_uv_width = 0;    // as uv_width, of:
    Vec2 second_uv{};             // the second set of texture coordinates; only set if the material reads it
    uint32_t leaf_hint = Ray::no_leaf_hint;  // Ray::leaf_hint of rays that start here
};

// How texture coordinates lie on a plane, in units of the file: uv = (dot(p - origin, u), dot(p - origin, v)).
struct PlaneMap {
    Vec3d origin{}, u{1, 0, 0}, v{0, 1, 0};
    Vec3d step_u{1, 0, 0},
        step_v{0, 1, 0};  // steps in the plane by which u, by which v grows by 1, and the other stays
};

// A ray cone, for texture filtering: Akenine-Moeller et al., "Improved Shader and Texture Level of Detail Using Ray
// Cones", JCGT 10(1), 2021.
struct RayCone {
    float width = 0;   // at the ray's origin, scene units
    float spread = 0;  // growth of the width per unit of distance
};

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, RayCone cone = {});
// The same with the interaction of a triangle hit already computed; other hits ignore `place`.
Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, RayCone cone, const TriangleInteraction& place);

// ShadingPoint of a hit of a non-instanced triangle without normal maps. front: side of the surface; width: of the ray
// cone; area: of the triangle.
ShadingPoint shading_point_at(const Scene& scene, const Hit& hit, bool front, float width, float area);

// Origin of a ray in direction w, offset from the surface.
inline Vec3 ray_origin(const Surface& s, Vec3 w)
{
    return dot(w, s.side) < 0 ? offset_origin(s.p, s.p_error, s.n, -s.n) : s.origin;
}

// Flips n and ns to the side of wo, which points away from the surface. n: geometric, ns: shading. Returns whether wo
// is on the front side. T: float or a vector of them.
template <class T>
auto face_forward(Vec3T<T>& n, Vec3T<T>& ns, const Vec3T<T>& wo)
{
    const auto front = dot(n, wo) > T{};
    n = select(front, n, -n), ns = select(front, ns, -ns);
    return front;
}
// A shading normal may face away from the ray although the surface does not: then it is mirrored about the silhouette,
// which is continuous there and keeps it in the hemisphere of n.
template <class T>
void turn_to_ray(Vec3T<T>& ns, const Vec3T<T>& wo)
{
    const T c = dot(ns, wo);
    if (movemask(c < T{}) != 0) ns = select(c < T{}, normalize(ns - wo * (2.0f * c)), ns);
}

// Texture coordinates of a sphere: longitude and latitude, both to [0, 1]; u grows from -z over -x, +z and +x, v from
// -y to +y. n: unit, outwards.
Vec2 sphere_uv(Vec3 n);

// Bound of the error, per axis, of a point of a sphere that was computed in double and rounded to float.
// rounding: rounding_on() the sphere.
template <class T>
Vec3T<T> sphere_point_error(T rounding, const Vec3T<T>& p)
{
    return abs(p) * (T{} + gamma(4)) + Vec3T<T>{rounding, rounding, rounding};
}
inline float rounding_on(const Sphere& s)
{
    return rounding_in_double(static_cast<float>(max_component(abs(s.center)) + s.radius));
}
inline Vec3 sphere_point_error(const Sphere& s, Vec3 p) { return sphere_point_error(rounding_on(s), p); }

// A point on a triangle, for light sampling.
struct TrianglePoint {
    Vec3 p, p_error, n;      // n: geometric, unit, on the front side
    float area;              // of the whole triangle, scene units
    Vec2 uv{}, second_uv{};  // texture coordinates, of those sets that the mesh keeps
};
// uv: barycentric weights of the second and third corner.
TrianglePoint triangle_point(const Scene& scene, uint32_t instance, uint32_t mesh, uint32_t triangle, Vec2 uv);

// Texture coordinates of the point, of both sets; {} where the mesh has none.
struct UvSets {
    Vec2 first{}, second{};
};
UvSets texture_uvs(const MeshShading& shading, uint32_t triangle, Vec2 uv);

// The frame of the texture coordinates at a hit, for what has a direction on the surface. n: unit, the shading normal
// on the front side. Orthonormal: x is along +u, y towards +v, z is n. On a mesh whose material reads_tangents() x goes
// on without a step from triangle to triangle; elsewhere it is of the triangle alone. Nothing where there is none: at
// poles of spheres, and where a mesh has no texture coordinates. time: Ray::time.
std::optional<TangentFrame> tangent_frame_at(const Scene& scene, const Hit& hit, float time, Vec3 n);

}  // namespace lancer
