#include "support/agreement.h"

namespace lancer {

double exact_distance(const Geometry& g, const Ray& ray, const Hit& hit)
{
    if (hit.kind == Kind::sphere) {
        const auto c = crossing(g.spheres[hit.primitive], ray);
        return c ? (hit.exit ? c->exit : c->enter) : hit.t;
    }
    if (hit.kind == Kind::plane) return intersect(g.planes[hit.primitive], ray).value_or(hit.t);
    Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
    if (hit.instance != Hit::no_instance) {
        const Transform& m = g.instances[hit.instance].to_mesh;
        org = m.point(org), dir = m.vector(dir);
    }
    const auto h = intersect_plane_of(g.meshes[hit.geometry], hit.primitive, org, dir);
    return h ? h->t : hit.t;
}

}  // namespace lancer
