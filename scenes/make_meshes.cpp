// Writes the generated meshes of this folder: make_meshes OUTPUT_FOLDER
// shell.obj, a sea shell with spiral ridges; knot.obj, a torus knot; backdrop.obj, a floor that curves up into a wall.
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

struct Point {
    double x, y, z;
};
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Point unit(Point a)
{
    const double l = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    return {a.x / l, a.y / l, a.z / l};
}

constexpr double pi = 3.14159265358979323846;
using Surface = std::function<Point(double u, double v)>;  // both in [0, 1]

// A grid of quads over the surface, with the surface's own normals: du x dv, or its opposite if `flip`.
bool write_grid(const std::string& path, const std::string& material, const Surface& f, int nu, int nv, bool flip)
{
    std::FILE* out = std::fopen(path.c_str(), "w");
    if (!out) {
        std::fprintf(stderr, "make_meshes: cannot write %s\n", path.c_str());
        return false;
    }
    std::fprintf(out, "mtllib materials.mtl\nusemtl %s\n", material.c_str());
    for (int i = 0; i <= nu; ++i)
        for (int j = 0; j <= nv; ++j) {
            const double u = static_cast<double>(i) / nu, v = static_cast<double>(j) / nv, h = 1e-4;
            const Point p = f(u, v);
            const Point n = unit(cross(f(u + h, v) - f(u - h, v), f(u, v + h) - f(u, v - h)));
            const double s = flip ? -1 : 1;
            std::fprintf(out, "v %.5f %.5f %.5f\nvn %.4f %.4f %.4f\n", p.x, p.y, p.z, s * n.x, s * n.y, s * n.z);
        }
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            const int a = i * (nv + 1) + j + 1, b = a + nv + 1, c = b + 1, d = a + 1;
            if (flip)
                std::fprintf(out, "f %d//%d %d//%d %d//%d %d//%d\n", d, d, c, c, b, b, a, a);
            else
                std::fprintf(out, "f %d//%d %d//%d %d//%d %d//%d\n", a, a, b, b, c, c, d, d);
        }
    return std::fclose(out) == 0;
}

// A tube whose radius and distance from the axis grow by the same factor every turn, as in Thompson, "On Growth and
// Form", chapter 11, with ridges along the turn.
Point shell(double u, double v)
{
    const double turns = 6.25, theta = 2 * pi * turns * u, phi = 2 * pi * v;
    const double s = std::exp(0.088 * (theta - 2 * pi * turns));
    const double tube = 0.42 * (1 + 0.06 * std::cos(9 * phi));
    const double r = s * (0.42 + tube * std::cos(phi));
    return {r * std::cos(theta), s * (1.15 * tube * std::sin(phi) - 2.1) + 2.1, r * std::sin(theta)};
}

Point knot_axis(double t)
{
    const double a = 2 * pi * t, r = 2 + std::cos(3 * a);
    return {r * std::cos(2 * a), r * std::sin(2 * a), -std::sin(3 * a)};
}
Point knot(double u, double v)
{
    const double h = 1e-4;
    const Point c = knot_axis(u), before = knot_axis(u - h), after = knot_axis(u + h);
    const Point t = unit(after - before);
    const Point out = unit(Point{c.x, c.y, 0});
    const Point side = unit(cross(t, out)), up = cross(side, t);
    const double x = 0.42 * std::cos(2 * pi * v), y = 0.42 * std::sin(2 * pi * v);
    return {c.x + up.x * x + side.x * y, c.y + up.y * x + side.y * y, c.z + up.z * x + side.z * y};
}

// Floor, quarter circle of radius 3, wall.
Point backdrop(double u, double v)
{
    const double x = 40 * (u - 0.5), length = 20 + 1.5 * pi + 20, s = v * length, bend = s - 20;
    if (bend <= 0) return {x, 0, 14 - s};
    if (bend < 1.5 * pi) return {x, 3 - 3 * std::cos(bend / 3), -6 - 3 * std::sin(bend / 3)};
    return {x, 3 + bend - 1.5 * pi, -9};
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_meshes OUTPUT_FOLDER\n");
        return 2;
    }
    const std::string folder = std::string(argv[1]) + "/";
    const bool ok = write_grid(folder + "shell.obj", "shell", shell, 230, 54, true) &&
                    write_grid(folder + "knot.obj", "knot", knot, 320, 24, true) &&
                    write_grid(folder + "backdrop.obj", "backdrop", backdrop, 1, 120, true);
    return ok ? 0 : 1;
}
