#include "scene/shading_normal.h"

#include <algorithm>
#include <cmath>

#include "core/frame.h"

namespace lancer {
namespace {

// Of pictures in texels, of waves in units of the file.
Vec2 slope_of(const Texture& heights, const ShadingPoint& point, const Tangents& t)
{
    if (const auto* image = std::get_if<ImageTexture>(&heights))
        return image->slope(point.uv_of(*image), point.footprint_of(*image).width);
    if (const auto* waves = std::get_if<Waves>(&heights)) {
        const Vec2 slope = waves->slope(point.uv, point.footprint());
        return {slope.x / t.unit.x, slope.y / t.unit.y};
    }
    return {};
}

// Of heights: the slope becomes a gradient on the surface, whatever the angle between the tangents.
Vec3 bumped(const MaterialTraits& traits, const ShadingPoint& point, const Tangents& t, Vec3 ns)
{
    const Vec2 slope = slope_of(point.textures[traits.bump], point, t) * traits.bump_scale;
    if (slope == Vec2{}) return ns;
    const float volume = dot(ns, cross(t.u, t.v));
    if (volume == 0) return ns;
    const Vec3 gradient = (cross(t.v, ns) * slope.x + cross(ns, t.u) * slope.y) / volume;
    return normalize(ns - gradient);
}

Vec3 from_map(const MaterialTraits& traits, const ShadingPoint& point, const TangentFrame& t, Vec3 ns)
{
    const Color c = point.eval(traits.normal_map);
    const Vec3 m = t.x * (2 * c.r - 1) + t.y * (2 * c.g - 1) + t.z * (2 * c.b - 1);
    const float size = length(m);
    return size > 0 ? m / size : ns;
}

}  // namespace

std::optional<TangentFrame> frame_about(Vec3 ns, const Tangents& t)
{
    const Vec3 along = t.u - ns * dot(ns, t.u);
    const float l = length(along);
    if (!(l > 0)) return {};
    const Vec3 x = along / l;
    return TangentFrame{x, cross(ns, x) * std::copysign(1.0f, dot(ns, cross(t.u, t.v))), ns};
}

Vec3 mapped_normal(const MaterialTraits& traits, const ShadingPoint& point, const std::optional<Tangents>& bump,
                   const std::optional<TangentFrame>& frame, Vec3 ns)
{
    if (traits.normal_map != no_texture && frame) ns = from_map(traits, point, *frame, ns);
    if (traits.bump != no_texture && bump) ns = bumped(traits, point, *bump, ns);
    return ns;
}

Vec2 local_tangent(const std::optional<TangentFrame>& tangents, Vec3 ns)
{
    if (!tangents) return {1, 0};
    const Frame frame(ns);
    const Vec2 along{dot(tangents->x, frame.x), dot(tangents->x, frame.y)};
    const float size = std::sqrt(along.x * along.x + along.y * along.y);
    return size > 0 ? Vec2{along.x / size, along.y / size} : Vec2{1, 0};
}

Vec3 keep_reflection_outside(Vec3 n, Vec3 ns, Vec3 wo)
{
    const MirrorImage image(n, ns, wo);
    if (image.is_outside()) return ns;
    // The mirror direction moves up in the plane of itself and n until it has this height; the normal is halfway.
    const Vec3 flat = image.to - n * image.height;
    const float l = length(flat);
    if (!(l > 0)) return n;
    return normalize(wo + flat * (std::sqrt(1 - image.least * image.least) / l) + n * image.least);
}

}  // namespace lancer
