#include "app/view/path_lines.h"

#include <algorithm>
#include <cmath>

#include "scene/camera.h"

namespace lancer {
namespace {

uint32_t color_of(PathLine::Kind kind)
{
    switch (kind) {
        case PathLine::Kind::ray:
            return 0xffffffff;
        case PathLine::Kind::leaves_scene:
            return 0xc0ffb060;
        case PathLine::Kind::light_arrives:
            return 0xc040e0ff;
        case PathLine::Kind::light_is_blocked:
            return 0x804040ff;
    }
    return 0;
}

}  // namespace

std::vector<PathLine> paths_of_pixel(const Renderer& renderer, const Camera& camera, PictureSize size, uint32_t x,
                                     uint32_t y, uint32_t samples)
{
    const Scene& scene = renderer.scene();
    std::vector<PathLine> lines;
    const auto add = [&](PathLine::Kind kind, const Ray& ray, float t) {
        const double end = std::min(double{t}, std::max(scene.bounds.extent(), 1.0));
        const auto place = [&](double along) {
            return scene.normalisation.to_file(to_double(ray.org) + to_double(ray.dir) * along);
        };
        lines.push_back({kind, place(0), place(end)});
    };
    const auto shadow = [&](const Ray& ray, Color, bool is_blocked) {
        add(is_blocked ? PathLine::Kind::light_is_blocked : PathLine::Kind::light_arrives, ray, ray.t_max);
    };
    const PathListener listener{.ray =
                                    [&](const PathState& s, const Hit& hit) {
                                        add(hit ? PathLine::Kind::ray : PathLine::Kind::leaves_scene, s.ray,
                                            hit ? hit.t : s.ray.t_max);
                                    },
                                .vertex = [](const PathState&, const Surface&) {},
                                .added = [](const PathState&, Color) {},
                                .shadow = shadow,
                                .mirrored_shadow = shadow};
    for (uint32_t i = 0; i < samples; ++i) renderer.replay(camera, size.width, size.height, {x, y, i}, listener);
    return lines;
}

std::vector<Mark> marks_of(const std::vector<PathLine>& lines, const CameraDescription& camera, PictureSize size)
{
    // About the camera, so that float holds scenes far from the origin.
    const Camera projection(camera, {.center = camera.position, .scale = 1}, size.width, size.height);
    const double least_depth = 1e-3 * length(camera.target - camera.position);
    std::vector<Mark> marks;
    for (const PathLine& line : lines) {
        Camera::Seen a = projection.seen(line.from - camera.position), b = projection.seen(line.to - camera.position);
        if (a.depth < least_depth && b.depth < least_depth) continue;
        // The projection is linear before it is divided by the depth.
        const auto clip = [&](Camera::Seen& end, const Camera::Seen& other) {
            if (end.depth >= least_depth) return;
            const double part = (least_depth - end.depth) / (other.depth - end.depth);
            end = {end.x + (other.x - end.x) * part, end.y + (other.y - end.y) * part, least_depth};
        };
        clip(a, b), clip(b, a);
        marks.push_back({.kind = Mark::Kind::line,
                         .x0 = a.x / a.depth,
                         .y0 = a.y / a.depth,
                         .x1 = b.x / b.depth,
                         .y1 = b.y / b.depth,
                         .color = color_of(line.kind)});
    }
    return marks;
}

}  // namespace lancer
