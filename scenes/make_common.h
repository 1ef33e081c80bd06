// What the generators of this folder share: points, random numbers and noise that are the same everywhere, and an OBJ
// file written with few digits.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

constexpr double pi = 3.14159265358979323846;

// What a generator was given. Ends it with 2 if that is not one argument. usage: its name and that of the argument.
inline std::string only_argument(int argc, char** argv, const char* usage)
{
    if (argc == 2) return argv[1];
    std::fprintf(stderr, "usage: %s\n", usage);
    std::exit(2);
}

struct Point {
    double x = 0, y = 0, z = 0;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }
inline Point unit(Point a) { return a * (1 / length(a)); }
// A unit vector across `a`, as near to `wish` as can be.
inline Point across(Point a, Point wish)
{
    const Point b = wish - a * (dot(a, wish) / dot(a, a));
    return length(b) > 1e-6 ? unit(b) : unit(cross(a, {1, 0.1, 0}));
}

inline uint32_t hash(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

class Random {
public:
    explicit Random(uint32_t seed) : state_(hash(seed + 1)) {}
    double next() { return hash(state_ += 0x9e3779b9u) / 4294967296.0; }
    double in(double a, double b) { return a + (b - a) * next(); }
    double spread(double a) { return in(-a, a); }

private:
    uint32_t state_;
};

// Value noise in [0, 1]; it repeats after `period` cells each way.
inline double noise(double x, double y, int period, uint32_t seed)
{
    const auto at = [&](int i, int j) {
        const auto wrap = [&](int k) { return static_cast<uint32_t>(((k % period) + period) % period); };
        return hash(wrap(i) + hash(wrap(j) + hash(seed))) / 4294967296.0;
    };
    const auto smooth = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double u = smooth(x - i), v = smooth(y - j);
    return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) + (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}
// Octaves of it, each half as strong and twice as fine; still in [0, 1].
inline double fractal(double x, double y, int octaves, int period, uint32_t seed)
{
    double sum = 0, strength = 1, total = 0;
    for (int o = 0; o < octaves; ++o) {
        sum += strength * noise(x, y, period, seed + static_cast<uint32_t>(o));
        total += strength;
        x *= 2, y *= 2, strength /= 2, period *= 2;
    }
    return sum / total;
}

inline double between(double a, double b, double x)  // 0 below a, 1 above b, smooth
{
    const double t = std::fmin(std::fmax((x - a) / (b - a), 0), 1);
    return t * t * (3 - 2 * t);
}

// An OBJ file. Faces name their corners from the end, so that large meshes need few digits.
class Obj {
public:
    // Positions are written in this unit, rounded to so many decimals.
    Obj(const std::string& path, const std::string& library, double unit, int decimals)
        : path_(path), unit_(unit), decimals_(decimals), file_(std::fopen(path.c_str(), "w"))
    {
        if (!file_) fail();
        if (!library.empty()) std::fprintf(file_, "mtllib %s\n", library.c_str());
    }
    Obj(const Obj&) = delete;
    Obj& operator=(const Obj&) = delete;
    ~Obj()
    {
        if (std::fclose(file_) != 0) fail();
        std::printf("%s: %d triangles\n", path_.c_str(), triangles_);
    }

    void material(const std::string& name) { std::fprintf(file_, "usemtl %s\n", name.c_str()); }
    // Whether the faces that follow are round together, for files without normals.
    void smoothing(bool wanted) { std::fputs(wanted ? "s 1\n" : "s off\n", file_); }
    void position(Point p)
    {
        const double fine = std::pow(10, decimals_);
        const auto rounded = [&](double x) { return std::round(x / unit_ * fine) / fine + 0.0; };  // and no -0
        std::fprintf(file_, "v %.6g %.6g %.6g\n", rounded(p.x), rounded(p.y), rounded(p.z));
    }
    void uv(double u, double v) { std::fprintf(file_, "vt %.4g %.4g\n", u, v); }
    void normal(Point n, int digits = 2)
    {
        std::fprintf(file_, "vn %.*f %.*f %.*f\n", digits, n.x, digits, n.y, digits, n.z);
    }
    // Corners as numbers counted from the end, -1 the last written; uvs and normals, if any, have the same numbers.
    void face(std::vector<int> corners, bool uvs, bool normals)
    {
        std::fputc('f', file_);
        for (const int c : corners) {
            std::fprintf(file_, " %d", c);
            if (uvs) std::fprintf(file_, "/%d", c);
            if (normals) std::fprintf(file_, uvs ? "/%d" : "//%d", c);
        }
        std::fputc('\n', file_);
        triangles_ += static_cast<int>(corners.size()) - 2;
    }
    // Corners that have uvs by numbers of their own, from the start.
    void face(std::vector<int> corners, std::vector<int> uvs)
    {
        std::fputc('f', file_);
        for (size_t i = 0; i < corners.size(); ++i) std::fprintf(file_, " %d/%d", corners[i], uvs[i]);
        std::fputc('\n', file_);
        triangles_ += static_cast<int>(corners.size()) - 2;
    }
    int triangles() const { return triangles_; }

private:
    [[noreturn]] void fail() const
    {
        std::fprintf(stderr, "cannot write %s\n", path_.c_str());
        std::exit(1);
    }
    std::string path_;
    double unit_;
    int decimals_;
    std::FILE* file_;
    int triangles_ = 0;
};
