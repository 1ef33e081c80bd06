#include "geometry/edge_lanes.h"

#include "geometry/triangle_float.h"

namespace lancer {

uint32_t contain_origin(uint32_t lanes, const ShearedLanes& s)
{
    uint32_t inside = 0;
    for_each_lane(lanes, [&](uint32_t i) {
        const double ax = s.ax[i], ay = s.ay[i], bx = s.bx[i], by = s.by[i], cx = s.cx[i], cy = s.cy[i];
        const double u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        // All 0: the triangle is seen edge-on. Its neighbours share that edge.
        if (is_inside(u, v, w) && u + v + w != 0) inside |= uint32_t{1} << i;
    });
    return inside;
}

}  // namespace lancer
