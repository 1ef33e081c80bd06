// What the interiors are built of: boxes with bevelled edges, turned and bent pieces, cushions, sheets, and walls with
// openings. No normals are written: smoothing groups say what is round, `s off` what is flat.
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "make_common.h"

inline Point blend(Point a, Point b, double t) { return a * (1 - t) + b * t; }

class Pieces {
public:
    using Profile = std::vector<std::array<double, 2>>;  // radius and height
    // A rectangle with rounded corners, seen from above: half its width and depth, the radius of the corners, height.
    struct Ring {
        double x, z, radius, y;
    };
    struct Opening {  // in a wall: from left to right and from bottom to top
        double left, right, bottom, top;
    };

    Pieces(const std::string& path, const std::string& library, double unit, int decimals)
        : obj_(path, library, unit, decimals)
    {
    }

    void material(const std::string& name) { obj_.material(name); }
    // What follows stands there: tipped over backwards, then turned counter-clockwise as seen from above.
    void place(Point at, double turn_deg = 0, double tip_deg = 0)
    {
        const auto direction = [](double deg) {
            return std::array{std::cos(deg * pi / 180), std::sin(deg * pi / 180)};
        };
        at_ = at, turn_ = direction(turn_deg), tip_ = direction(-tip_deg);
    }

    // Flat pieces

    // Corners counter-clockwise.
    void quad(Point a, Point b, Point c, Point d)
    {
        smooth(false);
        for (const Point& q : {a, b, c, d}) vertex(q);
        obj_.face({-4, -3, -2, -1}, false, false);
    }
    // The same with coordinates of a picture, in lengths: u runs from a to b and v from a to d.
    void pictured_quad(Point a, Point b, Point c, Point d)
    {
        smooth(false);
        const double u = length(b - a), v = length(d - a);
        vertex(a, 0, 0), vertex(b, u, 0), vertex(c, u, v), vertex(d, 0, v);
        obj_.face({-4, -3, -2, -1}, true, false);
    }
    // bevel: how much is cut off the edges.
    void box(Point low, Point high, double bevel = 0)
    {
        smooth(false);
        const Point middle = (low + high) * 0.5;
        if (bevel <= 0) {
            for (int c = 0; c < 8; ++c) vertex(corner(low, high, c));
            for (int a = 0; a < 3; ++a)
                for (int s = 0; s < 2; ++s)
                    face_of_box(
                        a, s, [](int c) { return c; }, 8, middle, low, high, 0);
            return;
        }
        for (int c = 0; c < 8; ++c)
            for (int a = 0; a < 3; ++a) vertex(bevelled(low, high, bevel, c, a));
        for (int a = 0; a < 3; ++a)
            for (int s = 0; s < 2; ++s)
                face_of_box(
                    a, s, [a](int c) { return 3 * c + a; }, 24, middle, low, high, bevel);
        const auto at = [&](int k) { return bevelled(low, high, bevel, k / 3, k % 3); };
        for (int a = 0; a < 3; ++a)
            for (int k = 0; k < 4; ++k) {
                const int b = (a + 1) % 3, c = (a + 2) % 3, from = (k & 1) << b | (k >> 1) << c, to = from | 1 << a;
                outward({3 * from + b, 3 * to + b, 3 * to + c, 3 * from + c}, at, 24, middle);
            }
        for (int c = 0; c < 8; ++c) outward({3 * c, 3 * c + 1, 3 * c + 2}, at, 24, middle);
    }
    // A box whose faces have coordinates of a picture, in lengths, u along its longest side; `shift` moves the picture.
    void board(Point low, Point high, double bevel, double shift)
    {
        const std::array<double, 3> size{high.x - low.x, high.y - low.y, high.z - low.z};
        const int along = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
        const Point middle = (low + high) * 0.5;
        smooth(false);
        const auto face = [&](std::vector<Point> p) {
            const Point n = cross(p[1] - p[0], p[2] - p[0]);
            if (dot(n, p[0] - middle) < 0) std::reverse(p.begin(), p.end());
            std::vector<int> corners;
            const std::array<double, 3> facing{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
            const int axis = static_cast<int>(std::max_element(facing.begin(), facing.end()) - facing.begin());
            const int u = axis == along ? (along + 1) % 3 : along, v = 3 - u - axis;
            for (const Point& q : p) {
                const std::array<double, 3> c{q.x, q.y, q.z};
                vertex(q, c[static_cast<size_t>(u)] + shift, c[static_cast<size_t>(v)] + 0.37 * shift);
                corners.push_back(static_cast<int>(corners.size()) - static_cast<int>(p.size()));
            }
            obj_.face(corners, true, false);
        };
        const auto at = [&](int c, int a) { return bevelled(low, high, bevel, c, a); };
        for (int a = 0; a < 3; ++a) {
            const int b = 1 << (a + 1) % 3, d = 1 << (a + 2) % 3;
            for (int s = 0; s < 2; ++s)
                face({at(s << a, a), at(s << a | b, a), at(s << a | b | d, a), at(s << a | d, a)});
            for (int k = 0; k < 4; ++k) {
                const int from = (k & 1) * b | (k >> 1) * d, to = from | 1 << a;
                face({at(from, (a + 1) % 3), at(to, (a + 1) % 3), at(to, (a + 2) % 3), at(from, (a + 2) % 3)});
            }
        }
        for (int c = 0; c < 8; ++c) face({at(c, 0), at(c, 1), at(c, 2)});
    }
    // A flat piece with sides that slope: its four corners below and above, counter-clockwise as seen from outside.
    void facets(const std::vector<Point>& low, const std::vector<Point>& high)
    {
        smooth(false);
        for (const Point& q : low) vertex(q);
        for (const Point& q : high) vertex(q);
        for (int k = 0; k < 4; ++k) obj_.face({k - 8, (k + 1) % 4 - 8, (k + 1) % 4 - 4, k - 4}, false, false);
        obj_.face({-4, -3, -2, -1}, false, false);
    }
    // From `origin`, as wide as `across` and as high as `up`; it faces their product, its back lies `depth` behind.
    void wall(Point origin, Point across, Point up, double depth, const std::vector<Opening>& openings)
    {
        smooth(false);
        const double width = length(across), height = length(up);
        const Point u = unit(across), v = unit(up), back = cross(v, u) * depth;
        std::vector<double> xs{0, width}, ys{0, height};
        for (const Opening& o : openings)
            xs.insert(xs.end(), {o.left, o.right}), ys.insert(ys.end(), {o.bottom, o.top});
        for (auto* cuts : {&xs, &ys}) {
            std::sort(cuts->begin(), cuts->end());
            cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
        }
        const auto at = [&](double x, double y) { return origin + u * x + v * y; };
        for (size_t i = 0; i + 1 < xs.size(); ++i)
            for (size_t j = 0; j + 1 < ys.size(); ++j) {
                const double x = (xs[i] + xs[i + 1]) / 2, y = (ys[j] + ys[j + 1]) / 2;
                const auto open = [&](const Opening& o) {
                    return x > o.left && x < o.right && y > o.bottom && y < o.top;
                };
                if (std::any_of(openings.begin(), openings.end(), open)) continue;
                const Point a = at(xs[i], ys[j]), b = at(xs[i + 1], ys[j]), c = at(xs[i + 1], ys[j + 1]),
                            d = at(xs[i], ys[j + 1]);
                quad(a, b, c, d);
                if (depth > 0) quad(b + back, a + back, d + back, c + back);
            }
        if (depth <= 0) return;
        for (const Opening& o : openings) {
            const Point a = at(o.left, o.bottom), b = at(o.right, o.bottom), c = at(o.right, o.top),
                        d = at(o.left, o.top);
            quad(a, b, b + back, a + back), quad(c, d, d + back, c + back);
            quad(b, c, c + back, b + back), quad(d, a, a + back, d + back);
        }
    }

    // Round pieces

    // Turned about the upward axis through `foot`; the profile runs upwards where its outside is away from the axis.
    void turned(Point foot, const Profile& profile, int around)
    {
        smooth(true);
        for (size_t j = 0; j < profile.size(); ++j) {
            for (int k = 0; k < around; ++k) {
                const double a = 2 * pi * k / around;
                vertex(foot + Point{profile[j][0] * std::cos(a), profile[j][1], profile[j][0] * std::sin(a)});
            }
            if (j > 0) belt(around, profile[j - 1][0] == 0, profile[j][0] == 0);
        }
    }
    // A bent rod along `axis`, closed at both ends.
    void rod(const std::vector<Point>& axis, double radius, int around)
    {
        smooth(true);
        Point out{1, 0.2, 0.1};
        for (size_t i = 0; i < axis.size(); ++i) {
            const Point direction = unit(axis[std::min(i + 1, axis.size() - 1)] - axis[i > 0 ? i - 1 : 0]);
            out = across(direction, out);
            const Point left = cross(out, direction);
            for (int k = 0; k < around; ++k) {
                const double a = 2 * pi * k / around;
                vertex(axis[i] + (out * std::cos(a) + left * std::sin(a)) * radius);
            }
            if (i == 0) cap(around, true);
            if (i > 0) belt(around, false, false);
        }
        cap(around, false);
    }
    // Through rings of one kind: tubs, basins, cushions. Rings upwards where the outside is outside; closed at the
    // first and the last.
    void rounded(const std::vector<Ring>& rings, int segments)
    {
        smooth(true);
        const int around = 4 * (segments + 1);
        for (size_t j = 0; j < rings.size(); ++j) {
            const Ring& r = rings[j];
            for (int q = 0; q < 4; ++q)
                for (int k = 0; k <= segments; ++k) {
                    const double a = (q + static_cast<double>(k) / segments) * pi / 2;
                    const double sx = q == 0 || q == 3 ? 1 : -1, sz = q < 2 ? 1 : -1;
                    vertex({sx * (r.x - r.radius) + r.radius * std::cos(a), r.y,
                            sz * (r.z - r.radius) + r.radius * std::sin(a)});
                }
            if (j == 0) cap(around, true);
            if (j > 0) belt(around, false, false);
        }
        cap(around, false);
    }
    // A cushion: rounded on all edges by `radius`, its top and bottom raised in the middle by `full`.
    void cushion(Point low, Point high, double radius, double full, int segments = 5)
    {
        const Point kept = at_;
        at_ = placed((low + high) * 0.5);
        const double x = (high.x - low.x) / 2, y = (high.y - low.y) / 2, z = (high.z - low.z) / 2;
        std::vector<Ring> rings;
        const int steps = 8;
        for (int side = 0; side < 2; ++side) {
            const double s = side ? 1 : -1;
            std::vector<Ring> half;
            for (int k = 1; k <= 3; ++k) {
                const double t = k / 4.0, rise = full * (1 - t * t);
                half.push_back({(x - radius) * t, (z - radius) * t, 0.3 * t * std::min(x, z), s * (y + rise)});
            }
            for (int k = 0; k <= steps / 2; ++k) {
                const double a = pi / 2 * (1 - 2.0 * k / steps);
                half.push_back({x - radius + radius * std::cos(a), z - radius + radius * std::cos(a),
                                radius + 0.3 * (std::min(x, z) - radius) * (1 - std::cos(a)),
                                s * (y - radius + radius * std::sin(a))});
            }
            if (side) std::reverse(half.begin(), half.end());
            rings.insert(rings.end(), half.begin(), half.end());
        }
        rounded(rings, segments);
        at_ = kept;
    }
    // A sheet of nu x nv cells through surface(u, v), both in [0, 1]; it faces d/du x d/dv.
    void sheet(int nu, int nv, const std::function<Point(double, double)>& surface)
    {
        smooth(true);
        for (int j = 0; j <= nv; ++j) {
            for (int i = 0; i <= nu; ++i) vertex(surface(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
            if (j == 0) continue;
            for (int i = 0; i < nu; ++i) {
                const int a = i - 2 * (nu + 1), b = a + nu + 1;
                obj_.face({a, a + 1, b + 1, b}, false, false);
            }
        }
    }
    int triangles() const { return obj_.triangles(); }

private:
    static Point corner(Point low, Point high, int c)
    {
        return {c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z};
    }
    // The one of the three points at a corner that lies on the face across `axis`.
    static Point bevelled(Point low, Point high, double bevel, int c, int axis)
    {
        const Point inset{axis == 0 ? 0 : bevel, axis == 1 ? 0 : bevel, axis == 2 ? 0 : bevel};
        return corner(low + inset, high - inset, c);
    }
    Point placed(Point p) const
    {
        const Point q{p.x, p.y * tip_[0] - p.z * tip_[1], p.y * tip_[1] + p.z * tip_[0]};
        return at_ + Point{q.x * turn_[0] + q.z * turn_[1], q.y, q.z * turn_[0] - q.x * turn_[1]};
    }
    void vertex(Point p) { obj_.position(placed(p)); }
    void vertex(Point p, double u, double v) { vertex(p), obj_.uv(u, v); }
    void smooth(bool wanted)
    {
        if (wanted != smooth_) obj_.smoothing(wanted);
        smooth_ = wanted;
    }
    // Of the last `count` vertices these, counted from the first of them, so that the face looks away from `middle`.
    void outward(std::vector<int> corners, const std::function<Point(int)>& at, int count, Point middle)
    {
        const Point a = at(corners[0]), b = at(corners[1]), c = at(corners[2]);
        if (dot(cross(b - a, c - a), a - middle) < 0) std::reverse(corners.begin(), corners.end());
        for (int& k : corners) k -= count;
        obj_.face(corners, false, false);
    }
    void face_of_box(int axis, int side, const std::function<int(int)>& number, int count, Point middle, Point low,
                     Point high, double bevel)
    {
        const int b = 1 << (axis + 1) % 3, d = 1 << (axis + 2) % 3, s = side << axis, per = count / 8;
        const auto at = [&](int k) { return bevelled(low, high, bevel, k / per, axis); };
        outward({number(s), number(s | b), number(s | b | d), number(s | d)}, at, count, middle);
    }
    // Between the last two rings.
    void belt(int around, bool from_point, bool to_point)
    {
        for (int k = 0; k < around; ++k) {
            const int a = k - 2 * around, b = (k + 1) % around - 2 * around;
            if (from_point)
                obj_.face({a, a + around, b + around}, false, false);
            else if (to_point)
                obj_.face({a, a + around, b}, false, false);
            else
                obj_.face({a, a + around, b + around, b}, false, false);
        }
    }
    // The last ring, closed; seen from below counter-clockwise if it is the first one.
    void cap(int around, bool first)
    {
        std::vector<int> corners;
        for (int k = 0; k < around; ++k) corners.push_back(first ? k - around : -1 - k);
        obj_.face(corners, false, false);
    }

    Obj obj_;
    Point at_;
    std::array<double, 2> turn_{1, 0}, tip_{1, 0};  // cosine and sine
    bool smooth_ = false;
};
