// What grows: tubes of wood and cards of leaves, for the forest and the twigs of the still life.
#pragma once

#include <algorithm>
#include <array>

#include "make_common.h"

// A square of picture that carries leaves: from `base` along `reach`, `side` to both sides, folded along its middle by
// `fold`, a vector.
struct Card {
    Point base, reach, side, fold;
};

struct Tube {
    std::vector<Point> axis;
    std::vector<double> radius;
};

// Sides of a tube; the picture of the bark repeats `around` times round it and once every `period` metres along it.
inline void write_tube(Obj& obj, const Tube& tube, int sides, double around, double period)
{
    const int rings = static_cast<int>(tube.axis.size());
    Point out{1, 0, 0.2};
    double along = 0;
    for (int i = 0; i < rings; ++i) {
        const Point before = tube.axis[static_cast<size_t>(std::max(i - 1, 0))];
        const Point after = tube.axis[static_cast<size_t>(std::min(i + 1, rings - 1))];
        const Point direction = unit(after - before);
        out = across(direction, out);
        const Point left = cross(direction, out), here = tube.axis[static_cast<size_t>(i)];
        if (i > 0) along += length(here - tube.axis[static_cast<size_t>(i - 1)]);
        for (int k = 0; k <= sides; ++k) {
            const double a = 2 * pi * k / sides;
            const Point n = out * std::cos(a) + left * std::sin(a);
            obj.position(here + n * tube.radius[static_cast<size_t>(i)]);
            obj.uv(around * k / sides, along / period);
            obj.normal(n, 1);
        }
        if (i == 0) continue;
        const int row = sides + 1;
        for (int k = 0; k < sides; ++k) {
            const int a = k - 2 * row, b = a + 1, c = b + row, d = a + row;
            obj.face({a, b, c, d}, true, true);
        }
    }
}

// Thin wood without normals or pictures: three sides.
inline void write_twig(Obj& obj, const Tube& tube)
{
    Point out{1, 0, 0.2};
    for (size_t i = 0; i < tube.axis.size(); ++i) {
        const Point direction = unit(tube.axis[std::min(i + 1, tube.axis.size() - 1)] - tube.axis[i > 0 ? i - 1 : 0]);
        out = across(direction, out);
        const Point left = cross(direction, out);
        for (int k = 0; k < 3; ++k) {
            const double a = 2 * pi * k / 3;
            obj.position(tube.axis[i] + (out * std::cos(a) + left * std::sin(a)) * tube.radius[i]);
        }
        if (i == 0) continue;
        for (int k = 0; k < 3; ++k) obj.face({k - 6, (k + 1) % 3 - 6, (k + 1) % 3 - 3, k - 3}, false, false);
    }
}

inline void write_card_uvs(Obj& obj)
{
    for (const double v : {0.0, 1.0})
        for (const double u : {0.0, 0.5, 1.0}) obj.uv(u, v);
}

inline void write_cards(Obj& obj, const std::vector<Card>& cards, const std::string& material)
{
    obj.material(material);
    for (const Card& c : cards) {
        for (const double v : {0.0, 1.0})
            for (const double u : {-1.0, 0.0, 1.0})
                obj.position(c.base + c.reach * v + c.side * u - c.fold * (1 - std::fabs(u)));
        obj.face({-6, -5, -2, -3}, {1, 2, 5, 4});
        obj.face({-5, -4, -1, -2}, {2, 3, 6, 5});
    }
}

// A card that grows along `direction`, its face turned to `up` but for a random lean.
inline Card leaf_card(Point base, Point direction, Point up, double reach, double width, double lean, Random& random)
{
    direction = unit(direction);
    const Point wish = unit(up) + Point{random.spread(lean), random.spread(lean), random.spread(lean)};
    const Point normal = across(direction, wish), side = cross(direction, normal);
    return {base, direction * reach, side * (width / 2), normal * (width * random.in(0.05, 0.16))};
}

inline Tube bent_tube(Point base, Point direction, double reach, double thick, double thin, int rings, double lift,
                      double wobble, Random& random)
{
    Tube t;
    Point p = base, d = unit(direction);
    for (int i = 0; i < rings; ++i) {
        const double s = static_cast<double>(i) / (rings - 1);
        t.axis.push_back(p);
        t.radius.push_back(thick + (thin - thick) * s);
        d = unit(d + Point{random.spread(wobble), lift / rings + random.spread(wobble), random.spread(wobble)});
        p = p + d * (reach / (rings - 1));
    }
    return t;
}

inline Point along(const Tube& t, double s)
{
    const double at = s * static_cast<double>(t.axis.size() - 1);
    const auto i = std::min(static_cast<size_t>(at), t.axis.size() - 2);
    return t.axis[i] + (t.axis[i + 1] - t.axis[i]) * (at - static_cast<double>(i));
}
inline Point direction_at(const Tube& t, double s)
{
    const auto i = std::min(static_cast<size_t>(s * static_cast<double>(t.axis.size() - 1)), t.axis.size() - 2);
    return unit(t.axis[i + 1] - t.axis[i]);
}
