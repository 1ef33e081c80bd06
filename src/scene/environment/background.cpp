#include "scene/environment/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "core/warp.h"
#include "scene/environment/environment.h"
#include "scene/scene.h"

namespace lancer {
namespace {

// The colours of a sky by the sine of the elevation, straight lines between stops; the first is at the horizon.
struct SkyStop {
    float height;
    Color color;
};
constexpr std::array gradient{SkyStop{0, {1, 1, 1}}, SkyStop{0.5f, {0, 0, 1}}, SkyStop{1, {0, 0, 0}}};
constexpr std::array dusk{SkyStop{0, {1, 1, 1}}, SkyStop{0.5f, {0, 0, 1}}, SkyStop{1, {0, 0, 0.5f}}};
constexpr std::array dawn{SkyStop{0, {1, 1, 0.3f}}, SkyStop{0.2f, {0.5f, 0.1f, 0.1f}},
                          SkyStop{0.4f, {0.1f, 0.1f, 0.2f}}, SkyStop{0.6f, {0, 0, 0.1f}}, SkyStop{1, {0, 0, 0.1f}}};
constexpr std::array noon{SkyStop{0, {0.75f, 0.85f, 1}}, SkyStop{0.3f, {0.35f, 0.6f, 1}},
                          SkyStop{1, {0.1f, 0.3f, 0.8f}}};
constexpr std::array night{SkyStop{0, {0.04f, 0.05f, 0.12f}}, SkyStop{0.3f, {0.01f, 0.015f, 0.05f}},
                           SkyStop{1, {0.002f, 0.003f, 0.015f}}};

std::span<const SkyStop> stops_of(SkyType type)
{
    switch (type) {
        case SkyType::gradient:
            return gradient;
        case SkyType::dusk:
            return dusk;
        case SkyType::dawn:
            return dawn;
        case SkyType::noon:
            return noon;
        case SkyType::night:
            return night;
        default:
            return {};
    }
}

Color between_stops(std::span<const SkyStop> stops, float height)
{
    size_t i = 1;
    while (i + 1 < stops.size() && height > stops[i].height) ++i;
    const SkyStop &a = stops[i - 1], &b = stops[i];
    return mix(a.color, b.color, std::clamp((height - a.height) / (b.height - a.height), 0.0f, 1.0f));
}

// Where a direction below the horizon meets the ground, in patterns of the checker, each two heights of the eye wide;
// and the sides of the rectangle, along the axes of the pattern, that varies as much as what a cone covers there. The
// cone is an ellipse, `spread` times the distance wide and longer by its slant along the way.
struct GroundPlace {
    double x, y, distance;
    double width_x = 0, width_y = 0;

    GroundPlace(Vec3d d, double spread) : x(-0.5 * d.x / d.z), y(-0.5 * d.y / d.z), distance(std::sqrt(x * x + y * y))
    {
        if (!(spread > 0)) return;
        const double slant2 = 0.25 + distance * distance;
        const double along = 2 * slant2 * spread, across = std::sqrt(slant2) * spread;
        const double cx = distance > 0 ? x / distance : 1, cy = distance > 0 ? y / distance : 0;
        const double along2 = along * along, across2 = across * across;
        width_x = std::sqrt(along2 * cx * cx + across2 * cy * cy);
        width_y = std::sqrt(along2 * cy * cy + across2 * cx * cx);
    }
};

// 1 in the first half of each unit, -1 in the second: its mean over [x - width / 2, x + width / 2].
double mean_of_halves(double x, double width)
{
    const double a = x - width / 2, b = x + width / 2;
    const auto half = [](double v) { return std::floor(2 * v); };
    if (half(a) == half(b)) return half(a) == 2 * std::floor(half(a) / 2) ? 1 : -1;
    const auto integral = [](double v) {
        const double part = v - std::floor(v);
        return std::min(part, 1 - part);
    };
    return std::clamp((integral(b) - integral(a)) / width, -1.0, 1.0);
}

constexpr double far_patterns = 30;       // where a ground has passed into the horizon
constexpr float even = 0.2f, odd = 0.4f;  // the greys of the checker

float checker(const GroundPlace& p)
{
    const double unlike = 0.5 * (1 - mean_of_halves(p.x, p.width_x) * mean_of_halves(p.y, p.width_y));
    return even + (odd - even) * static_cast<float>(unlike);
}

// A direction with z up. The axes that were there first keep their handedness.
Vec3d upright(Vec3 dir, bool z_up)
{
    const Vec3d d = to_double(dir);
    return z_up ? d : Vec3d{d.x, -d.z, d.y};
}

}  // namespace

Background::Background(const BackgroundDescription& what, const Raster* sky, const Raster* ground, bool legacy,
                       uint32_t texture_limit)
    : what_(what), legacy_(legacy)
{
    if (sky) sky_.emplace(what.sky_picture, *sky);
    if (ground && what.ground_picture.projection == Projection::planar) {
        plane_.emplace(*ground, ImageUse{}, texture_limit);
    } else if (ground) {
        ground_.emplace(what.ground_picture, *ground);
    }
    fade_ = what.fade.value_or(horizon());
}

Color Background::horizon() const
{
    if (!sky_) return sky({1, 0, 0});
    constexpr int places = 256;
    std::array<double, 3> sum{};
    for (int i = 0; i < places; ++i) {
        const double angle = 2 * pi_d * i / places;
        const Color c = sky({std::cos(angle), std::sin(angle), 0});
        sum[0] += static_cast<double>(c.r), sum[1] += static_cast<double>(c.g), sum[2] += static_cast<double>(c.b);
    }
    const auto mean = [&](int i) { return static_cast<float>(sum[static_cast<size_t>(i)] / places); };
    return {mean(0), mean(1), mean(2)};
}

Color Background::sky(Vec3d d) const
{
    if (what_.sky == SkyType::color) return what_.sky_color;
    if (!sky_) return between_stops(stops_of(what_.sky), static_cast<float>(std::clamp(d.z, 0.0, 1.0)));
    const Color c = sky_->eval(d);
    constexpr double edge = 0.05;
    if (!legacy_ || what_.sky_picture.projection != Projection::lachaud || d.z >= edge) return c;
    return mix(c, {0.5f, 0.5f, 0.5f}, static_cast<float>((edge - std::max(0.0, d.z)) / edge));
}

Color Background::ground(Vec3d d, double spread) const
{
    if (what_.ground == GroundType::color) return what_.ground_color;
    // A lens that looks down sees what one that looks up would see of the world turned over.
    if (ground_) return ground_->eval(is_fish_eye(what_.ground_picture.projection) ? Vec3d{d.x, -d.y, -d.z} : d);
    const BackgroundPicture& picture = what_.ground_picture;
    if (plane_ && picture.rotate_deg != 0) d = make_transform({}, {0, 0, -picture.rotate_deg}, {1, 1, 1}).vector(d);
    const GroundPlace place(d, legacy_ ? 0 : spread);
    const auto t = static_cast<float>(std::min(place.distance, far_patterns) / far_patterns);
    if (t >= 1) return fade_;
    if (!plane_) {
        const float grey = checker(place);
        return mix({grey, grey, grey}, fade_, t);
    }
    const double copies = 2 / picture.size;
    const Color c = plane_->eval({static_cast<float>(place.x * copies), static_cast<float>(place.y * copies)},
                                 static_cast<float>(std::sqrt(place.width_x * place.width_y) * copies));
    return mix(Color{std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)} * picture.scale, fade_, t);
}

Color Background::eval(Vec3 dir, float spread) const
{
    const Vec3d d = upright(dir, what_.z_up);
    const bool below = d.z < 0 && what_.ground != GroundType::none;
    return (below ? ground(d, static_cast<double>(spread)) : sky(d)) * what_.strength;
}

bool Background::is_same_around(double height) const
{
    return height < 0 && what_.ground != GroundType::none ? what_.ground == GroundType::color : !sky_;
}

uint64_t Background::bad_texels() const
{
    return (sky_ ? sky_->bad_texels() : 0) + (ground_ ? ground_->bad_texels() : 0) +
           (plane_ ? plane_->not_finite() : 0);
}

uint64_t Background::bytes() const
{
    return (sky_ ? sky_->bytes() : 0) + (ground_ ? ground_->bytes() : 0) + (plane_ ? plane_->bytes() : 0);
}

Color glow_of_lights(const Scene& scene, Vec3 org, Vec3 dir)
{
    Color sum;
    const auto add = [&](Vec3 to_light, Color color) {
        // The angle of two unit vectors, without what their product loses where it is close to 1.
        const float angle = 2 * std::atan2(length(to_light - dir), length(to_light + dir));
        const float part = 1 - angle * static_cast<float>(180 / pi_d) / 4;
        if (part > 0) sum += color * (part * part);
    };
    // Those infinitely far away first: sums of floats depend on the order.
    for (const bool far : {true, false})
        for (const DeltaLight& any : scene.delta_lights) {
            const UndimmedLight light =
                std::visit([&](const auto& l) { return l.undimmed(org, scene.normalisation.scale); }, any);
            const float distance = light.infinite ? 1 : length(light.way);
            if (light.infinite == far && distance > 0) add(light.way / distance, light.color);
        }
    return sum;
}

// 1024 x 512 cells: a third of a degree each, finer than all that the named skies and the checker have but for their
// edges, and half a million look-ups at most, which are made in a thirtieth of a second. A cell takes the mean over
// places no further apart than the texels of the pictures, sixteen at most. What lies between places has the density of
// its neighbours, or at least that of the floor: it costs noise and no bias, as radiance is never looked up in the
// table.
std::shared_ptr<const EnvironmentMap> make_background_table(const Scene& scene)
{
    constexpr uint32_t width = 1024, height = 512;
    constexpr double least = 0.01;  // density where nothing seems to shine, of the mean
    double finest = scene.environment_map ? scene.environment_map->height() / pi_d : 0;
    for (const auto* picture : {&scene.background->sky_picture(), &scene.background->ground_picture()})
        if (*picture) finest = std::max(finest, (*picture)->pixels_per_radian());
    const auto side = static_cast<uint32_t>(std::clamp(std::ceil(finest * pi_d / height), 1.0, 4.0));

    // Up is the pole, so that the horizon is a border between cells.
    const bool z_up = scene.background->z_up();
    Raster raster{.width = width, .height = height, .channels = 1, .bytes = {}, .floats = {}, .is_float = true};
    raster.floats.resize(raster.value_count());
    std::vector<double> rows(height);
    // Of the places along the way from pole to pole, and around.
    std::vector<SinCos> polars, longitudes;
    for (uint32_t i = 0; i < height * side; ++i)
        polars.push_back(sin_cos_2pi((static_cast<float>(i) + 0.5f) / static_cast<float>(2 * height * side)));
    for (uint32_t i = 0; i < width * side; ++i) {
        const float u = 0.5f - (static_cast<float>(i) + 0.5f) / static_cast<float>(width * side);
        longitudes.push_back(sin_cos_2pi(u < 0 ? u + 1 : u));
    }
    const auto mean_of_cell = [&](size_t row, size_t column) {
        double sum = 0;
        for (uint32_t k = 0; k < side * side; ++k) {
            const SinCos polar = polars[row * side + k / side], longitude = longitudes[column * side + k % side];
            const Vec3 d{longitude.sin * polar.sin, polar.cos, longitude.cos * polar.sin};
            const Color c = scene.radiance_from(z_up ? Vec3{d.x, -d.z, d.y} : d);
            sum += luminance(static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b));
        }
        return std::min(sum / (side * side), 1e30);
    };
    // Most skies are the same all around: one cell tells the row.
    const auto is_same_in = [&](size_t row) {
        const SinCos* const places = &polars[row * side];
        return !scene.environment_map && std::all_of(places, places + side, [&](const SinCos& polar) {
            return scene.background->is_same_around(static_cast<double>(polar.cos));
        });
    };
    parallel_for(height, [&](size_t row) {
        const bool same = is_same_in(row);
        double mean = mean_of_cell(row, 0), sum = 0;
        for (uint32_t column = 0; column < width; ++column) {
            if (column > 0 && !same) mean = mean_of_cell(row, column);
            raster.floats[row * width + column] = static_cast<float>(mean);
            sum += mean;
        }
        rows[row] = sum;
    });
    double total = 0;
    for (const double row : rows) total += row;
    const auto floor = static_cast<float>(least * total / (double{width} * height));
    return std::make_shared<const EnvironmentMap>(std::make_shared<const Raster>(std::move(raster)), Color{1, 1, 1},
                                                  Color{floor, floor, floor}, Vec3d{z_up ? 90.0 : 0.0, 0, 0},
                                                  scene.sky_compensation);
}

}  // namespace lancer
