#include "reference/surface.h"

#include <algorithm>

namespace reference {
namespace {

struct Tangents {
    Vec u, v;  // steps by which u, by which v grows by 1
};

// The vector that has these products with the three.
Vec solve(Vec a, Vec b, Vec c, double with_a, double with_b, double with_c)
{
    const double volume = dot(a, cross(b, c));
    return (cross(b, c) * with_a + cross(c, a) * with_b + cross(a, b) * with_c) * (1 / volume);
}

// Blinn, "Simulation of Wrinkled Surfaces", 1978; as gradients: Mikkelsen, "Surface Gradient-Based Bump Mapping
// Framework", JCGT 9(3), 2020.
Vec bumped(const Material& m, Uv uv, const Tangents& t, Vec ns)
{
    Uv slope = m.bump->slope(uv) * double{m.what.bump_scale};
    if (m.bump->is_waves()) slope = {slope.u / norm(t.u), slope.v / norm(t.v)};
    return unit(ns - solve(unit(t.u), unit(t.v), ns, slope.u, slope.v, 0));
}
// Of a triangle with tangents at its corners.
Vec from_map(const Material& m, Uv uv, const Triangle& t, const Hit& hit)
{
    const Rgb c = m.normals->eval(uv);
    const double w[] = {1 - hit.v - hit.w, hit.v, hit.w};
    const auto weigh = [&](const std::array<Vec, 3>& v) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; };
    const Vec x = weigh(*t.tangents), z = t.normals ? weigh(*t.normals) : t.n;
    const Vec y = cross(z, x) * t.bitangent_sign;
    return unit(x * (2 * c.r - 1) + y * (2 * c.g - 1) + z * (2 * c.b - 1));
}
// y of the map along +v.
Vec from_map(const Material& m, Uv uv, const Tangents& t, Vec ns)
{
    const Rgb c = m.normals->eval(uv);
    const Vec x = unit(t.u - ns * dot(ns, t.u));
    Vec y = cross(ns, x);
    if (dot(ns, cross(t.u, t.v)) < 0) y = -y;
    return unit(x * (2 * c.r - 1) + y * (2 * c.g - 1) + ns * (2 * c.b - 1));
}

// On what mirrors the normal leans no further than leaves the mirror image of wo above the surface: by a hundredth, or
// by 0.9 of the height of wo.
Vec keep_mirror_image_above(Vec n, Vec ns, Vec wo)
{
    const Vec image = mirror_image(wo, ns);
    const double least = std::min(0.01, 0.9 * dot(n, wo));
    if (dot(image, n) >= least) return ns;
    const Vec along = image - n * dot(image, n);
    if (!(norm(along) > 0)) return n;
    return unit(wo + unit(along) * std::sqrt(1 - least * least) + n * least);
}

std::optional<Tangents> triangle(const Triangle& t, const Hit& hit, Surface& s)
{
    const double w[] = {1 - hit.v - hit.w, hit.v, hit.w};
    s.p = t.a * w[0] + t.b * w[1] + t.c * w[2];
    s.n = s.ns = t.n;
    s.material = t.material;
    if (t.normals) {
        const auto& n = *t.normals;
        s.ns = unit(n[0] * w[0] + n[1] * w[1] + n[2] * w[2]);
        if (dot(s.ns, s.n) < 0) s.n = -s.n;  // the file's normals say which side is the front
    }
    if (t.colors) s.vertex_color = (*t.colors)[0] * w[0] + (*t.colors)[1] * w[1] + (*t.colors)[2] * w[2];
    if (!t.uvs) return {};
    const auto& uv = *t.uvs;
    s.uv = uv[0] * w[0] + uv[1] * w[1] + uv[2] * w[2];
    const Uv d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const double det = d1.u * d2.v - d1.v * d2.u;
    if (det == 0) return {};
    const Vec e1 = t.b - t.a, e2 = t.c - t.a;
    return Tangents{(e1 * d2.v - e2 * d1.v) * (1 / det), (e2 * d1.u - e1 * d2.u) * (1 / det)};
}

std::optional<Tangents> sphere(const Sphere& ball, Vec there, Surface& s)
{
    s.n = s.ns = unit(there - ball.center);
    s.p = ball.center + s.n * ball.radius;
    s.material = ball.material;
    const Vec n = s.n;
    s.uv = {0.5 + std::atan2(n.x, n.z) / (2 * pi), 1 - std::acos(std::clamp(n.y, -1.0, 1.0)) / pi};
    const double around = std::hypot(n.x, n.z);
    if (around == 0) return {};
    // Derivatives of the place by longitude and latitude.
    return Tangents{Vec{n.z, 0, -n.x} * (2 * pi * ball.radius),
                    Vec{-n.y * n.x / around, around, -n.y * n.z / around} * (pi * ball.radius)};
}

}  // namespace

Surface surface_at(const World& world, const Ray& ray, const Hit& hit)
{
    Surface s{};
    s.shape = hit.shape;
    s.vertex_color = {1, 1, 1};
    std::optional<Tangents> tangents;
    const Vec there = ray.org + ray.dir * hit.t;
    if (hit.shape.kind == Kind::triangle) {
        tangents = triangle(world.triangles[hit.shape.index], hit, s);
    } else if (hit.shape.kind == Kind::sphere) {
        tangents = sphere(world.spheres[hit.shape.index], there, s);
    } else {
        const Plane& p = world.planes[hit.shape.index];
        s.p = there - p.n * dot(p.n, there - p.point);
        s.n = s.ns = p.n;
        s.material = p.material;
        s.uv = {dot(s.p - p.uv_origin, p.u), dot(s.p - p.uv_origin, p.v)};
        tangents = Tangents{p.step_u, p.step_v};
    }
    const Material& m = world.materials[s.material];
    if (tangents && (m.bump || m.normals)) {
        const Triangle* const t = hit.shape.kind == Kind::triangle ? &world.triangles[hit.shape.index] : nullptr;
        if (m.normals) s.ns = t && t->tangents ? from_map(m, s.uv, *t, hit) : from_map(m, s.uv, *tangents, s.ns);
        if (m.bump) s.ns = bumped(m, s.uv, *tangents, s.ns);
        // What is steeper than the surface is seen from its edge.
        if (dot(s.ns, s.n) < 0) s.ns = unit(s.ns - s.n * dot(s.ns, s.n));
    }
    const Vec wo = -ray.dir;
    s.front = dot(s.n, wo) > 0;
    if (!s.front) s.n = -s.n, s.ns = -s.ns;
    // A shading normal that faces away from the ray is mirrored about the silhouette.
    if (const double c = dot(s.ns, wo); c < 0) s.ns = unit(s.ns - wo * (2 * c));
    if (m.mirrors) s.ns = keep_mirror_image_above(s.n, s.ns, wo);
    return s;
}

double opacity(const World& world, const Surface& s)
{
    const Material& m = world.materials[s.material];
    const double texture = m.opacity ? m.opacity->eval(s.uv).r : 1;
    return std::clamp(double{m.what.opacity} * texture, 0.0, 1.0);
}

Rgb emission(const World& world, const Surface& s)
{
    const Material& m = world.materials[s.material];
    if (!s.front && !m.what.emission_both_sides) return {};
    const Rgb e = rgb(m.what.emission);
    return m.emission ? e * m.emission->eval(s.uv) : e;
}

Bsdf bsdf_at(const World& world, const Surface& s, double index, Random& random)
{
    const Material* m = &world.materials[s.material];
    while (m->is_mix()) {
        const double texture = m->weight ? m->weight->eval(s.uv).r : 1;
        const bool second = random.next() < std::clamp(double{m->what.weight} * texture, 0.0, 1.0);
        m = &world.materials[second ? m->second : m->first];
    }
    const lancer::MaterialDescription& what = m->what;
    Bsdf b;
    b.color = rgb(what.base_color) * s.vertex_color;
    if (m->base) b.color = b.color * m->base->eval(s.uv);
    const double rough = std::clamp(double{what.roughness} * (m->roughness ? m->roughness->eval(s.uv).r : 1), 0.0, 1.0);
    b.alpha = rough * rough < 1e-5 ? 0 : rough * rough;
    switch (what.type) {
        case lancer::MaterialType::translucent: {
            b.kind = Bsdf::Kind::translucent;
            Rgb through = rgb(what.transmittance);
            if (m->transmittance) through = through * m->transmittance->eval(s.uv);
            const double scale = 1 / std::max(1.0, largest(b.color + through));
            b.diffuse = b.color * scale, b.through = through * scale;
            break;
        }
        case lancer::MaterialType::mirror:
            b.kind = Bsdf::Kind::mirror;
            b.alpha = 0;
            break;
        case lancer::MaterialType::metal:
            b.kind = Bsdf::Kind::metal;
            if (what.eta && what.k) b.conductor = {rgb(*what.eta), rgb(*what.k)};
            if (b.alpha > 0 && world.multiscatter) {
                const Rgb mean = b.conductor ? b.color * m->mean_of_conductor : b.color * (20.0 / 21) + grey(1.0 / 21);
                b.even = even_lobes(FacetsOf::metal, 1, b.alpha, mean);
            }
            break;
        case lancer::MaterialType::glass:
            b.kind = what.thin.value_or(false) ? Bsdf::Kind::sheet : Bsdf::Kind::glass;
            if (b.kind == Bsdf::Kind::sheet) {
                b.index = double{what.ior};
                if (b.alpha > 0 && world.multiscatter) b.even = even_lobes(FacetsOf::sheet, b.index, b.alpha, b.color);
                break;
            }
            b.index = index > 0 ? index : s.front ? double{what.ior} : 1 / double{what.ior};
            if (b.alpha > 0 && world.multiscatter) b.even = even_lobes(FacetsOf::glass, b.index, b.alpha, b.color);
            break;
        case lancer::MaterialType::plastic:
            b.kind = Bsdf::Kind::plastic;
            b.index = double{what.ior};
            b.coat = rgb(what.specular);
            b.coat_albedo = m->coat.get();
            break;
        case lancer::MaterialType::principled:
            b.kind = Bsdf::Kind::principled;
            b.principled = m->principled.get();
            break;
        case lancer::MaterialType::interface: {
            b.kind = Bsdf::Kind::interface;
            const lancer::Phong& p = what.phong;
            const double inside = double{p.inside_ior} / double{p.outside_ior};
            b.index = index > 0 ? index : s.front ? inside : 1 / inside;
            b.shininess = double{p.shininess};
            b.refracts = p.refraction > 0;
            const Rgb specular = rgb(p.specular);
            const double sharp = double{p.reflexion} + double{p.refraction};
            b.diffuse = b.color * double{p.diffusion}, b.gloss = specular * double{p.diffusion};
            b.mirror = specular * sharp;
            if (b.refracts) b.through = b.color * sharp;
            const Rgb all = b.diffuse + b.gloss +
                            Rgb{std::max(b.mirror.r, b.through.r), std::max(b.mirror.g, b.through.g),
                                std::max(b.mirror.b, b.through.b)};
            const double scale = 1 / std::max(1.0, largest(all));
            for (Rgb* lobe : {&b.diffuse, &b.gloss, &b.mirror, &b.through}) *lobe = *lobe * scale;
            break;
        }
        default:
            b.kind = Bsdf::Kind::lambert;
    }
    return b;
}

}  // namespace reference
