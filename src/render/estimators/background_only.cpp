#include "render/estimators/background_only.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "core/lanes/lanes.h"
#include "core/parallel.h"

namespace lancer {
namespace {

constexpr double reach = 2.5;           // pixels around a ray's own that its sample may come from, and one to spare
constexpr double least_distance = 1e3;  // errors from the camera from which on they are but a small angle
constexpr uint32_t least_tile = 4, most_columns = 1024;
constexpr uint32_t small = 4;              // cells each way that a group of triangles may cover as a whole
constexpr uint32_t looked_at = 16;         // cells each way in which it is asked whether all are covered already
constexpr size_t together = 8;             // neighbours in the list of a mesh are mostly neighbours in space
constexpr size_t piece_size = 1024;        // triangles that one thread takes at least
constexpr size_t most_parts = 8;           // at once, each with marks of its own
constexpr uint64_t triangles_of_box = 12;  // of an instance
constexpr uint64_t most_per_pixel = 4;     // triangles: to look at more takes longer than some samples of the sky do

bool sees_one_colour(const Scene& scene)
{
    return !scene.environment_map && !scene.background && !scene.glow && scene.media.empty() &&
           scene.geometry.planes.empty();
}

// Counts the rectangles that cover each cell of a grid: four corners are marked for each and summed at the end.
class Coverage {
public:
    Coverage(const Camera& camera, uint32_t width, uint32_t height)
        : camera_(camera),
          cell_(std::max(least_tile, (std::max(width, height) + most_columns - 1) / most_columns)),
          columns_((width + cell_ - 1) / cell_),
          rows_((height + cell_ - 1) / cell_),
          marks_(size_t{columns_ + 1} * (rows_ + 1)),
          covered_(size_t{columns_} * rows_),
          // Float directions and the traversal of boxes are accurate to about 1e-6 radians.
          margin_(reach + 4e-6 / static_cast<double>(camera.pixel_spread()))
    {
        const double m = margin_;
        sides_ = {Side{1, 0, m}, Side{-1, 0, width + m}, Side{0, 1, m}, Side{0, -1, height + m}, Side{0, 0, 1}};
        const Camera::Seen x = camera.seen_along({1, 0, 0}), y = camera.seen_along({0, 1, 0}),
                           z = camera.seen_along({0, 0, 1});
        position_ = to_double(camera.position());
        across_ = {x.x, y.x, z.x}, down_ = {x.y, y.y, z.y};
        away_ = {x.depth, y.depth, z.depth};
    }
    bool is_useful() const { return margin_ < 0.25 * cell_ * std::max(columns_, rows_); }

    // Adds a triangle whose corners are known up to `error`, scene units.
    void add(const std::array<Vec3d, 3>& corners, double error)
    {
        std::array<Camera::Seen, 3> seen;
        double least = INFINITY;
        for (size_t i = 0; i < 3; ++i) seen[i] = camera_.seen(corners[i]), least = std::min(least, seen[i].depth);
        const double blur = error / static_cast<double>(camera_.pixel_spread());
        if (least > least_distance * error) return add_rectangle(seen, blur / least);
        add_clipped({seen.begin(), seen.end()}, error);
    }
    // Adds everything inside a box if its projection is so small that testing the content would give no more detail, or
    // if it is covered already. Else returns false and adds nothing.
    bool add_as_whole(const Bounds& box, double error)
    {
        const Vec3d way = box.center() - position_, half = (box.upper - box.lower) * 0.5;
        const double depth = dot(away_, way), deep = dot(abs(away_), half), least = depth - deep, most = depth + deep;
        if (!(least > least_distance * error)) return false;
        const double x = dot(across_, way), wide = dot(abs(across_), half);
        const double y = dot(down_, way), high = dot(abs(down_), half);
        const auto lowest = [&](double at) { return at / (at < 0 ? least : most); };
        const auto highest = [&](double at) { return at / (at < 0 ? most : least); };
        const auto cells = cells_between(lowest(x - wide), lowest(y - high), highest(x + wide), highest(y + high),
                                         error / static_cast<double>(camera_.pixel_spread()) / least);
        if (!cells || !is_within(*cells, looked_at)) return false;
        if (is_covered(*cells)) return true;
        if (!is_within(*cells, small)) return false;
        mark(*cells);
        return true;
    }
    std::vector<uint8_t> uncovered() const
    {
        std::vector<uint8_t> open(size_t{columns_} * rows_);
        std::vector<int64_t> above(columns_);
        for (uint32_t y = 0; y < rows_; ++y) {
            int64_t along = 0;
            for (uint32_t x = 0; x < columns_; ++x) {
                along += marks_[size_t{y} * (columns_ + 1) + x];
                above[x] += along;
                open[size_t{y} * columns_ + x] = above[x] == 0;
            }
        }
        return open;
    }
    // A new counter that starts with the present coverage.
    Coverage next() const
    {
        Coverage c = *this;
        std::fill(c.marks_.begin(), c.marks_.end(), 0);
        return c;
    }
    // Adds the counts of another one with the same grid.
    void add(const Coverage& other)
    {
        for (size_t i = 0; i < marks_.size(); ++i) marks_[i] += other.marks_[i];
        for (size_t i = 0; i < covered_.size(); ++i) covered_[i] |= other.covered_[i];
    }
    bool any_open() const
    {
        const std::vector<uint8_t> open = uncovered();
        return std::find(open.begin(), open.end(), 1) != open.end();
    }
    uint32_t cell() const { return cell_; }
    uint32_t columns() const { return columns_; }

private:
    // The inner side of an edge of the film, seen from the camera: x * p.x + y * p.y + depth * p.depth >= 0.
    struct Side {
        double x, y, depth;
        double at(const Camera::Seen& p) const { return x * p.x + y * p.y + depth * p.depth; }
    };

    // The bounds on the film of what lies in front of the camera; the whole film if it reaches the camera.
    void add_clipped(std::vector<Camera::Seen> polygon, double error)
    {
        const double blur = error / static_cast<double>(camera_.pixel_spread());
        double least = INFINITY;
        for (const Side& side : sides_) {
            std::vector<Camera::Seen> inside;
            for (size_t i = 0; i < polygon.size(); ++i) {
                const Camera::Seen &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                const double at_a = side.at(a) + blur, at_b = side.at(b) + blur;
                if (at_a >= 0) inside.push_back(a);
                if ((at_a >= 0) == (at_b >= 0)) continue;
                const double t = at_a / (at_a - at_b);
                inside.push_back({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.depth + (b.depth - a.depth) * t});
            }
            polygon = std::move(inside);
        }
        if (polygon.empty()) return;
        for (const Camera::Seen& p : polygon) least = std::min(least, p.depth);
        if (!(least > least_distance * error)) return mark({0, 0, columns_, rows_});
        add_rectangle(polygon, blur / least);
    }
    struct Cells {
        uint32_t left, top, right, bottom;  // right and bottom: behind the last
    };
    // Nothing if the bounds are unknown.
    template <class Points>
    std::optional<Cells> cells_around(const Points& points, double blur) const
    {
        double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
        for (const Camera::Seen& p : points) {
            const double x = p.x / p.depth, y = p.y / p.depth;
            x0 = std::min(x0, x), y0 = std::min(y0, y), x1 = std::max(x1, x), y1 = std::max(y1, y);
        }
        return cells_between(x0, y0, x1, y1, blur);
    }
    std::optional<Cells> cells_between(double x0, double y0, double x1, double y1, double blur) const
    {
        const double m = margin_ + blur;
        if (!(std::isfinite(x0 + x1 + y0 + y1))) return {};
        const auto first = [&](double at, uint32_t n) {
            return static_cast<uint32_t>(std::clamp(std::floor((at - m) / cell_), 0.0, static_cast<double>(n)));
        };
        const auto end = [&](double at, uint32_t n) {
            return static_cast<uint32_t>(std::clamp(std::floor((at + m) / cell_) + 1, 0.0, static_cast<double>(n)));
        };
        return Cells{first(x0, columns_), first(y0, rows_), end(x1, columns_), end(y1, rows_)};
    }
    template <class Points>
    void add_rectangle(const Points& points, double blur)
    {
        mark(cells_around(points, blur).value_or(Cells{0, 0, columns_, rows_}));
    }
    void mark(const Cells& c)
    {
        if (c.left >= c.right || c.top >= c.bottom) return;
        const auto at = [&](uint32_t x, uint32_t y) -> int64_t& { return marks_[size_t{y} * (columns_ + 1) + x]; };
        ++at(c.left, c.top), --at(c.right, c.top), --at(c.left, c.bottom), ++at(c.right, c.bottom);
        if (is_within(c, looked_at))
            for (uint32_t y = c.top; y < c.bottom; ++y) std::fill_n(row(c, y), c.right - c.left, 1);
    }
    static bool is_within(const Cells& c, uint32_t each_way)
    {
        return c.right - c.left <= each_way && c.bottom - c.top <= each_way;
    }
    // Adds small rectangles; large ones are only counted.
    bool is_covered(const Cells& c)
    {
        for (uint32_t y = c.top; y < c.bottom; ++y)
            if (std::find(row(c, y), row(c, y) + (c.right - c.left), 0) != row(c, y) + (c.right - c.left)) return false;
        return true;
    }
    std::vector<uint8_t>::iterator row(const Cells& c, uint32_t y)
    {
        return covered_.begin() + static_cast<std::ptrdiff_t>(size_t{y} * columns_ + c.left);
    }

    const Camera& camera_;
    uint32_t cell_, columns_, rows_;
    std::vector<int64_t> marks_;    // a column and a row more than there are cells
    std::vector<uint8_t> covered_;  // cells by rectangles that were small
    double margin_;                 // pixels
    std::array<Side, 5> sides_;
    // Camera::Seen of a vector from the camera's position: dot products.
    Vec3d position_, across_, down_, away_;
};

// The triangles' corners. There is one position of padding.
Bounds bounds_of(const Mesh& mesh, std::span<const std::array<uint32_t, 3>> triangles)
{
    Float4 lower = load4(&mesh.positions[triangles[0][0]].x), upper = lower;
    for (const auto& t : triangles)
        for (const uint32_t v : t) {
            const Float4 p = load4(&mesh.positions[v].x);
            lower = min(lower, p), upper = max(upper, p);
        }
    return {{double{lower[0]}, double{lower[1]}, double{lower[2]}},
            {double{upper[0]}, double{upper[1]}, double{upper[2]}}};
}

std::array<Vec3d, 8> corners_of(const Bounds& b, const Transform& place)
{
    std::array<Vec3d, 8> corners;
    for (size_t i = 0; i < 8; ++i)
        corners[i] =
            place.point({i & 1 ? b.upper.x : b.lower.x, i & 2 ? b.upper.y : b.lower.y, i & 4 ? b.upper.z : b.lower.z});
    return corners;
}

// Rounding error of positions as seen by camera rays; scene units.
struct ErrorAt {
    double camera_reach;
    double operator()(const Vec3d& p) const { return 1e-6 * (max_component(abs(p)) + camera_reach); }
};

// The twelve triangles of a transformed box.
void add_box(Coverage& coverage, const Bounds& b, const Transform& place, const ErrorAt& error_at)
{
    const std::array<Vec3d, 8> corners = corners_of(b, place);
    constexpr std::array<std::array<size_t, 4>, 6> faces{
        {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
    double error = 0;
    for (const Vec3d& c : corners) error = std::max(error, error_at(c));
    for (const auto& f : faces) {
        coverage.add({corners[f[0]], corners[f[1]], corners[f[2]]}, error);
        coverage.add({corners[f[0]], corners[f[2]], corners[f[3]]}, error);
    }
}

// Adds a range of triangles.
void add_group(Coverage& coverage, const Mesh& mesh, std::span<const std::array<uint32_t, 3>> triangles,
               const ErrorAt& error_at)
{
    const Bounds box = bounds_of(mesh, triangles);
    const double error = std::max(error_at(box.lower), error_at(box.upper));
    if (coverage.add_as_whole(box, error)) return;
    if (const size_t half = triangles.size() / 2; half > 0) {
        add_group(coverage, mesh, triangles.first(half), error_at);
        return add_group(coverage, mesh, triangles.subspan(half), error_at);
    }
    const auto& t = triangles[0];
    coverage.add({to_double(mesh.positions[t[0]]), to_double(mesh.positions[t[1]]), to_double(mesh.positions[t[2]])},
                 error);
}

void add_triangles(Coverage& coverage, const Mesh& mesh, std::span<const std::array<uint32_t, 3>> triangles,
                   const ErrorAt& error_at)
{
    for (size_t first = 0; first < triangles.size(); first += together)
        add_group(coverage, mesh, triangles.subspan(first, std::min(together, triangles.size() - first)), error_at);
}

// Adds all non-instanced triangles in parallel. Returns false if no cell is left uncovered, which is common in rooms.
bool add_meshes(Coverage& coverage, const Geometry& g, const ErrorAt& error_at)
{
    struct Piece {
        const Mesh* mesh;
        std::span<const std::array<uint32_t, 3>> triangles;
    };
    std::vector<Piece> pieces;
    for (const Mesh& mesh : g.meshes) {
        if (mesh.instanced) continue;
        const std::span all(mesh.triangles);
        for (size_t first = 0; first < all.size(); first += piece_size)
            pieces.push_back({&mesh, all.subspan(first, std::min(piece_size, all.size() - first))});
    }
    for (size_t first = 0, round; first < pieces.size(); first += round) {
        round = std::min(std::max<size_t>(3 * first, 1), pieces.size() - first);
        std::vector<Coverage> parts(std::min(round, most_parts), coverage.next());
        parallel_for(parts.size(), [&](size_t i) {
            for (size_t k = round * i / parts.size(); k < round * (i + 1) / parts.size(); ++k)
                add_triangles(parts[i], *pieces[first + k].mesh, pieces[first + k].triangles, error_at);
        });
        for (const Coverage& p : parts) coverage.add(p);
        if (!coverage.any_open()) return false;
    }
    return true;
}

}  // namespace

void find_background_only(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height, SamplingPlan& plan)
{
    const uint64_t projected = scene.triangle_count() + triangles_of_box * scene.geometry.instances.size();
    if (!camera.is_pinhole() || !camera.is_still() || !sees_one_colour(scene) ||
        projected > most_per_pixel * width * height)
        return;
    Coverage coverage(camera, width, height);
    if (!coverage.is_useful()) return;
    const Geometry& g = scene.geometry;
    const ErrorAt error_at{max_component(abs(to_double(camera.position())))};
    if (!add_meshes(coverage, g, error_at)) return;
    std::vector<Bounds> of_meshes(g.meshes.size());
    for (size_t number = 0; number < g.instances.size(); ++number) {
        const Instance& i = g.instances[number];
        Bounds& b = of_meshes[i.mesh];
        const Mesh& mesh = g.meshes[i.mesh];
        if (b.empty())
            for (size_t k = 0; k < mesh.vertices(); ++k) b.grow(to_double(mesh.vertex(k)));
        if (b.empty()) continue;
        if (!is_moving(g.motion.instances, number)) {
            add_box(coverage, b, i.to_world, error_at);
            continue;
        }
        Bounds way;
        for (const Transform& place : g.motion.instances[number])
            for (const Vec3d& corner : corners_of(b, place)) way.grow(corner);
        add_box(coverage, way, {}, error_at);
    }
    for (size_t i = 0; i < g.spheres.size(); ++i) {
        Bounds way;
        for_each_place(g.spheres[i], g.motion.spheres, i, [&](const Sphere& s) { way.grow(bounds(s)); });
        add_box(coverage, way, {}, error_at);
    }
    if (!coverage.any_open()) return;
    plan.background_only = coverage.uncovered();
    plan.background_cell = coverage.cell(), plan.background_columns = coverage.columns();
}

}  // namespace lancer
