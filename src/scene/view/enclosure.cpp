#include "scene/view/enclosure.h"

#include <array>
#include <complex>

namespace lancer {
namespace {

using Place = CoarseGrid::Place;

// A point of the lattice and how far the walls around it are.
struct Inside {
    Vec3d position;    // cells
    double floor = 0;  // distance below
    bool has_ceiling = false;
    double ceiling = 0;
};

class Rooms {
public:
    Rooms(const CoarseGrid& grid, const UpFrame& frame) : grid_(grid), frame_(frame) { look_around(); }

    Enclosure judge() const;

private:
    void look_around();
    void look_from(Vec3d position);
    bool is_free(Place p) const;
    CoarseGrid::Sight side(Vec3d position, Vec3d ahead, Vec3d across, Vec3d along) const;
    void note_wall(const CoarseGrid::Place& place, Vec3d dir, double weight);
    bool is_square() const { return walls_ > 0 && std::abs(turned_) > 0.5 * walls_; }
    bool hides_more_than_it_shows() const;
    double long_azimuth_deg() const;
    Enclosure::Viewpoint best_view() const;
    double rate(const Inside& inside, Vec3d ahead) const;

    const CoarseGrid& grid_;
    const UpFrame frame_;
    size_t points_ = 0;
    std::vector<Inside> closed_;
    std::array<size_t, 4> open_{};  // points from which only that side is open
    // Of the walls seen: the mean of exp(4 i azimuth), 1 in size where all are parallel or at right angles.
    std::complex<double> turned_;
    double walls_ = 0;
};

// The middle of nine sights about a direction.
CoarseGrid::Sight Rooms::side(Vec3d position, Vec3d ahead, Vec3d across, Vec3d along) const
{
    CoarseGrid::Sight mean{.front = 0, .back = 0, .free = 0, .distance = 0};
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
            const CoarseGrid::Sight s = grid_.look(position, normalize(ahead + across * (0.5 * i) + along * (0.3 * j)));
            mean.front += s.front / 9, mean.back += s.back / 9, mean.free += s.free / 9;
            if (i == 0 && j == 0) mean.distance = s.distance;
        }
    return mean;
}

bool Rooms::is_free(Place p) const
{
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const Place near{p[0] + x, p[1] + y, p[2] + z};
                if (grid_.contains(near) && !grid_.at(near).empty()) return false;
            }
    return true;
}

void Rooms::look_around()
{
    constexpr int lattice = 12;  // points along an axis
    const Place size = grid_.size();
    Place step;
    for (size_t i = 0; i < 3; ++i) step[i] = std::max(1, size[i] / lattice);
    for (int z = step[2] / 2; z < size[2]; z += step[2])
        for (int y = step[1] / 2; y < size[1]; y += step[1])
            for (int x = step[0] / 2; x < size[0]; x += step[0]) {
                ++points_;
                if (is_free({x, y, z})) look_from({x + 0.5, y + 0.5, z + 0.5});
            }
}

void Rooms::look_from(Vec3d position)
{
    constexpr double is_wall = 0.7, is_open = 0.5;
    const auto is_covered = [](const CoarseGrid::Sight& s, double share) { return s.front + s.back > share; };
    const CoarseGrid::Sight below = side(position, -frame_.up, frame_.front, frame_.right);
    if (!is_covered(below, is_wall)) return;
    size_t walls = 0, inwards = 0;
    std::optional<size_t> open;
    for (size_t i = 0; i < 4; ++i) {
        const Vec3d ahead = frame_.towards(90.0 * static_cast<double>(i), 0);
        const CoarseGrid::Sight sight = side(position, ahead, cross(frame_.up, ahead), frame_.up);
        inwards += sight.front > is_wall ? 1 : 0;
        if (is_covered(sight, is_wall)) {
            ++walls;
        } else if (sight.free > is_open) {
            open = i;
        }
    }
    // What faces outwards all around is the inside of a body.
    const bool is_closed = inwards == 4 && below.front > is_wall;
    if (!is_closed && !(walls == 3 && open)) return;
    const CoarseGrid::Sight above = side(position, frame_.up, frame_.front, frame_.right);
    if (is_closed) closed_.push_back({position, below.distance, above.front > is_open, above.distance});
    if (!is_closed && is_covered(above, is_open)) ++open_[*open];
    for (int i = 0; i < 16; ++i) {
        const Vec3d dir = frame_.towards(22.5 * i + 11.25, 5);
        grid_.follow(position, dir, [&](const Place& p, double, double front, double back) {
            note_wall(p, front > 0 ? dir : -dir, front + back);
        });
    }
}

// dir: of a ray that sees the wall from the front.
void Rooms::note_wall(const Place& place, Vec3d dir, double weight)
{
    // The mean normal of what faces the ray.
    const auto& facing = grid_.at(place).facing;
    Vec3d n{facing[dir.x > 0 ? 1 : 0] * (dir.x > 0 ? -1.0 : 1.0), facing[dir.y > 0 ? 3 : 2] * (dir.y > 0 ? -1.0 : 1.0),
            facing[dir.z > 0 ? 5 : 4] * (dir.z > 0 ? -1.0 : 1.0)};
    const double level = std::hypot(dot(n, frame_.front), dot(n, frame_.right));
    if (!(level > 0.7 * length(n))) return;  // no wall
    const double azimuth = std::atan2(dot(n, frame_.right), dot(n, frame_.front));
    turned_ += std::polar(weight, 4 * azimuth);
    walls_ += weight;
}

// By the number of triangles: what is modelled finely is to be seen.
bool Rooms::hides_more_than_it_shows() const
{
    // What is seen from outside at all, and from the front.
    std::vector<float> seen(grid_.cell_count()), seen_front(grid_.cell_count());
    const Place size = grid_.size();
    const Vec3d center{0.5 * size[0], 0.5 * size[1], 0.5 * size[2]};
    const double radius = length(center);
    const int half = static_cast<int>(std::ceil(radius));
    for (int view = 0; view < 10; ++view) {
        const Vec3d towards =
            view < 8 ? frame_.towards(45.0 * view, view % 2 ? 35 : 5) : frame_.towards(0, view == 8 ? 89 : -89);
        const Vec3d across = normalize(cross(frame_.upright_from(towards), towards)), along = cross(towards, across);
        for (int i = -half; i <= half; ++i)
            for (int j = -half; j <= half; ++j)
                grid_.follow(center + towards * (2 * radius) + across * (1.0 * i) + along * (1.0 * j), -towards,
                             [&](const Place& p, double, double front, double back) {
                                 const size_t cell = grid_.index(p);
                                 seen[cell] = std::max(seen[cell], static_cast<float>(front + back));
                                 seen_front[cell] = std::max(seen_front[cell], static_cast<float>(front));
                             });
    }
    double hidden = 0, shown = 0;
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x) {
                const CoarseGrid::Cell& cell = grid_.at({x, y, z});
                const size_t i = grid_.index({x, y, z});
                if (seen[i] < 0.1f) hidden += static_cast<double>(cell.triangles);
                if (seen_front[i] >= 0.1f) shown += static_cast<double>(cell.triangles);
            }
    return hidden > shown;
}

// How far and how much is seen; plain walls are worth less than others, walls seen from behind and the sky nothing.
double Rooms::rate(const Inside& inside, Vec3d ahead) const
{
    const Vec3d across = cross(frame_.up, ahead);
    double sum = 0;
    for (int i = -3; i <= 3; ++i)
        for (int j = -1; j <= 1; ++j) {
            const Vec3d dir = normalize(ahead + across * (0.25 * i) + frame_.up * (0.3 * j));
            grid_.follow(inside.position, dir, [&](const Place& p, double distance, double front, double) {
                const double detail = std::min(1.0, static_cast<double>(grid_.at(p).triangles));
                sum += front * std::sqrt(distance) * (0.3 + 0.7 * detail);
            });
        }
    if (!inside.has_ceiling) return sum;
    // At the height of the eyes of who stands there.
    const double height = inside.floor / (inside.floor + inside.ceiling);
    return sum * (1 - 0.7 * std::abs(height - 0.45));
}

// Of the axis, to the right or to the front, along which the points inside reach farther.
double Rooms::long_azimuth_deg() const
{
    Bounds b;
    for (const Inside& inside : closed_)
        b.grow(Vec3d{dot(inside.position, frame_.right), dot(inside.position, frame_.front), 0});
    return b.upper.x - b.lower.x > b.upper.y - b.lower.y ? 90 : 0;
}

Enclosure::Viewpoint Rooms::best_view() const
{
    double best = -1, distance = 1;
    Enclosure::Viewpoint view{};
    const double along = long_azimuth_deg();
    for (const Inside& inside : closed_)
        for (const double turned : {0.0, -22.5, 22.5, 180.0, 157.5, 202.5}) {
            const Vec3d ahead = frame_.towards(along + turned, 0);
            const double rating = rate(inside, ahead);
            if (rating <= best) continue;
            best = rating;
            distance = std::max(1.0, grid_.look(inside.position, ahead).distance);
            view = {CoarseGrid::to_subject(inside.position), CoarseGrid::to_subject(ahead * distance)};
        }
    return view;
}

Enclosure Rooms::judge() const
{
    Enclosure e;
    if (!is_square()) return e;
    constexpr double least_open = 0.1, least_closed = 0.02;  // of the points
    for (size_t i = 0; i < 4; ++i)
        if (static_cast<double>(open_[i]) > least_open * static_cast<double>(points_))
            e.open_azimuth_deg = 90.0 * static_cast<double>(i);
    if (e.open_azimuth_deg) return e;
    if (static_cast<double>(closed_.size()) > least_closed * static_cast<double>(points_) && hides_more_than_it_shows())
        e.inside = best_view();
    return e;
}

}  // namespace

Enclosure find_enclosure(const CoarseGrid& grid, const UpFrame& frame) { return Rooms(grid, frame).judge(); }

}  // namespace lancer
