// Sweeps beside rows L of the stability matrix: how far a light is, and how low.
#include <cmath>

#include "stability/sweep.h"
#include "support/scenes/lit_places.h"

namespace lancer::stability {
namespace {

// The density with which directions to a ball are drawn, of which 1 - cos is the inverse.
Sweep over_distance()
{
    SweepCurve ours{"lancer", {}}, naive{"float, 1 - cos", {}};
    for (double x = 1.0001; x < 1.1e6; x *= x < 1.5 ? 1.05 : std::sqrt(10.0)) {
        const Scene scene = sphere_at(x, 1);
        const Surface from = receiver(to_float(scene.normalisation.to_scene({0, 0, 0})), {0, 1, 0});
        const Sphere& s = scene.geometry.spheres.back();
        const Vec3d to = s.center - to_double(from.origin);
        const long double sin2 = static_cast<long double>(s.radius) * s.radius / dot(to, to);
        const long double exact = sin2 / (1 + std::sqrt(1 - sin2));
        const auto sample = sample_light(scene, from, 0, {0.3f, 0.4f});
        const auto sine2 = static_cast<float>(sin2);
        const float plain = 1 - std::sqrt(1 - sine2);
        if (sample)
            ours.points.push_back({x, static_cast<double>(std::abs(
                                          1 / (2 * std::numbers::pi_v<long double> * sample->pdf * exact) - 1))});
        naive.points.push_back({x, static_cast<double>(std::abs(plain / exact - 1))});
    }
    return {"Solid angle of a ball of light", "distance in radii", "relative error", {ours, naive}};
}

// Irradiance straight below a point of light: of lancer, whose rays leave the surface by the bound of its rounding, and
// of a ray that leaves it by a fixed step.
Sweep over_height()
{
    SweepCurve ours{"lancer", {}}, naive{"origin moved by 1e-4", {}};
    for (double x = 1; x > 0.9e-7; x /= std::sqrt(10.0)) {
        SceneDescription d;
        d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}));
        d.spheres = {sphere_of({3, 0, 0}, 0.5), sphere_of({-3, 0, 0}, 0.5)};
        d.lights.push_back(light_of(LightType::point, {1, 1, 1}, {0.1, x, 0.2}));
        const Stage stage(d);
        const auto& lamp = std::get<PointLight>(stage.scene.delta_lights[0]);
        const Plane& plane = stage.scene.geometry.planes[0];
        const double h = dot(plane.normal, to_double(lamp.position)) - plane.offset;
        const auto surface = stage.look(lamp.position, {0, -1, 0});
        if (!surface || !(h > 0)) continue;
        const auto s = sample_light(stage.scene, *surface, 0, {});
        const double exact = double{lamp.intensity.r} / (h * h);
        const double found = s ? double{s->radiance.r} * double{dot(s->wi, surface->ns)} : 0;
        const double step = 1e-4 * stage.scene.normalisation.scale, left = h - step;
        ours.points.push_back({x, std::abs(found / exact - 1)});
        naive.points.push_back({x, left > 0 ? std::abs(h * h / (left * left) - 1) : 1});
    }
    return {"Irradiance below a low point of light",
            "height over the plane, scene of size 7",
            "relative error",
            {ours, naive}};
}

}  // namespace

std::vector<Sweep> light_sweeps() { return {over_distance(), over_height()}; }

}  // namespace lancer::stability
