// How a medium spreads light: the phase function of Henyey and Greenstein, "Diffuse Radiation in the Galaxy", 1941.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/frame.h"
#include "core/warp.h"

namespace lancer {

struct HenyeyGreenstein {
    float g = 0;  // mean cosine of the deflection, in (-1, 1): > 0 forwards, < 0 backwards, 0 evenly

    // Part of the light per solid angle that goes on along `to` after it came along `from`; both unit. It is also the
    // density of sample(). The cosine comes from the difference of both, as a narrow lobe needs it.
    float eval(Vec3 from, Vec3 to) const
    {
        const double h = std::abs(double{g});
        const Vec3d apart = g < 0 ? to_double(from) + to_double(to) : to_double(to) - to_double(from);
        const double base = (1 - h) * (1 - h) + h * dot(apart, apart);
        return static_cast<float>((1 - h * h) / (4 * pi_d * base * std::sqrt(base)));
    }
    // A direction after `from`, unit; u in [0, 1).
    Vec3 sample(Vec3 from, Vec2 u) const
    {
        constexpr float even = 1e-6f;  // below, the formula loses all digits and differs by less than they say
        if (std::abs(g) < even) return square_to_sphere(u);
        // 1 - cos and the sine, which a narrow lobe needs more precisely than the cosine.
        const double h = std::abs(double{g}), over = 1 - h + 2 * h * double{u.x}, s = (1 - h * h) / over;
        const double away = (1 - h) * (1 - double{u.x}) * (s + 1 - h) / over;
        const auto sin = static_cast<float>(std::sqrt(std::max(0.0, away * (2 - away))));
        const SinCos turn = sin_cos_2pi(u.y);
        const Frame frame(g < 0 ? -from : from);
        return normalize(frame.to_world({sin * turn.cos, sin * turn.sin, static_cast<float>(1 - away)}));
    }
};

}  // namespace lancer
