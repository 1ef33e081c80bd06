#include "reference/closest.h"

namespace reference {
namespace {

double component(Vec v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: corners are sheared along the ray, so
// that both triangles at an edge see one edge function with two signs. What is not sure in double is done again in long
// double; exactly on an edge both are met.
struct Sheared {
    int kx, ky, kz;
    long double sx, sy;

    explicit Sheared(Vec d)
    {
        kz = std::abs(d.x) > std::abs(d.y) ? (std::abs(d.x) > std::abs(d.z) ? 0 : 2)
                                           : (std::abs(d.y) > std::abs(d.z) ? 1 : 2);
        kx = (kz + 1) % 3, ky = (kz + 2) % 3;
        sx = static_cast<long double>(component(d, kx)) / component(d, kz);
        sy = static_cast<long double>(component(d, ky)) / component(d, kz);
    }
    template <class T>
    struct Flat {
        T x, y;
    };
    template <class T>
    Flat<T> operator()(Vec p, Vec org) const
    {
        const T z = static_cast<T>(component(p, kz)) - static_cast<T>(component(org, kz));
        return {static_cast<T>(component(p, kx)) - static_cast<T>(component(org, kx)) - static_cast<T>(sx) * z,
                static_cast<T>(component(p, ky)) - static_cast<T>(component(org, ky)) - static_cast<T>(sy) * z};
    }
};

// Whether the ray goes by inside of the triangle; the three edge functions. sure: false if rounding might decide.
template <class T>
bool inside(const Sheared& shear, const Triangle& t, Vec org, T (&edge)[3], bool& sure)
{
    const auto a = shear.operator()<T>(t.a, org), b = shear.operator()<T>(t.b, org), c = shear.operator()<T>(t.c, org);
    sure = true;
    const T extent =
        std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y), std::abs(c.x), std::abs(c.y)});
    const T size = extent + std::abs(static_cast<T>(norm(org)));
    const auto of = [&](auto p, auto q) {
        const T value = p.x * q.y - p.y * q.x;
        if (std::abs(value) <= 64 * std::numeric_limits<T>::epsilon() * size * extent) sure = false;
        return value;
    };
    edge[0] = of(b, c), edge[1] = of(c, a), edge[2] = of(a, b);
    const bool positive = edge[0] >= 0 && edge[1] >= 0 && edge[2] >= 0;
    const bool negative = edge[0] <= 0 && edge[1] <= 0 && edge[2] <= 0;
    return positive || negative;
}

void try_triangle(const Triangle& t, const Sheared& shear, const Ray& ray, Shape shape, Hit& best)
{
    bool sure = true;
    double edge[3];
    bool is_inside = inside<double>(shear, t, ray.org, edge, sure);
    if (!is_inside && sure) return;
    if (!sure) {
        long double exact[3];
        is_inside = inside<long double>(shear, t, ray.org, exact, sure);
        for (int i = 0; i < 3; ++i) edge[i] = static_cast<double>(exact[i]);
    }
    const double sum = edge[0] + edge[1] + edge[2];
    if (!is_inside || sum == 0) return;
    const double slope = dot(t.n, ray.dir), distance = dot(t.n, t.a - ray.org) / slope;
    if (slope == 0 || !(distance > 0) || distance >= best.t) return;
    best = {shape, distance, edge[1] / sum, edge[2] / sum};
}

// Both distances come from the product of the two and the larger one: Press et al., "Numerical Recipes", section 5.6;
// the discriminant from the distance of the line: Haines et al., "Precision Improvements for Ray/Sphere Intersection",
// Ray Tracing Gems, 2019. From a place on the sphere one of them is 0.
void try_sphere(const Sphere& s, const Ray& ray, Shape shape, bool starts_on_it, Hit& best)
{
    const Vec from = ray.org - s.center;
    using Long = long double;
    const Long b = Long{from.x} * ray.dir.x + Long{from.y} * ray.dir.y + Long{from.z} * ray.dir.z;
    const auto take = [&](Long t) {
        if (t > 0 && static_cast<double>(t) < best.t) best = {shape, static_cast<double>(t)};
    };
    if (starts_on_it) return take(-2 * b);
    const Long x = from.x - b * ray.dir.x, y = from.y - b * ray.dir.y, z = from.z - b * ray.dir.z, r = s.radius;
    const Long beside = x * x + y * y + z * z, discriminant = r * r - beside;
    if (discriminant < 0) return;
    const Long product = Long{from.x} * from.x + Long{from.y} * from.y + Long{from.z} * from.z - r * r;
    const Long far = b > 0 ? -b - std::sqrt(discriminant) : -b + std::sqrt(discriminant);
    if (far == 0) return;
    take(far);
    take(product / far);
}

void try_plane(const Plane& p, const Ray& ray, Shape shape, Hit& best)
{
    const double slope = dot(p.n, ray.dir), t = dot(p.n, p.point - ray.org) / slope;
    if (slope != 0 && t > 0 && t < best.t) best = {shape, t};
}

}  // namespace

Hit closest(const World& world, const Ray& ray, Shape left, double t_max)
{
    Hit best;
    best.t = t_max;
    const Sheared shear(ray.dir);
    for (size_t i = 0; i < world.triangles.size(); ++i)
        if (const Shape shape{Kind::triangle, i}; shape != left)
            try_triangle(world.triangles[i], shear, ray, shape, best);
    for (size_t i = 0; i < world.spheres.size(); ++i) {
        const Shape shape{Kind::sphere, i};
        try_sphere(world.spheres[i], ray, shape, shape == left, best);
    }
    for (size_t i = 0; i < world.planes.size(); ++i)
        if (const Shape shape{Kind::plane, i}; shape != left) try_plane(world.planes[i], ray, shape, best);
    return best;
}

}  // namespace reference
