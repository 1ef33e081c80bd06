// Cuts a plane polygon into triangles by taking off ears: convex corners whose triangle holds no other corner. A
// corner that fails is tried again only after its neighbours or the corner in its way have gone, and the corners in
// the way are found with a grid, so that 100,000 corners take a fraction of a second.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace lancer {

struct PlanePoint {
    double x = 0, y = 0;
    friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

// Twice the area, positive if counter-clockwise.
inline double signed_area(PlanePoint a, PlanePoint b, PlanePoint c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class EarClipper {
public:
    using Triangle = std::array<uint32_t, 3>;

    // Appends at most n - 2 triangles of a counter-clockwise polygon of at least three points within [-1, 1]. Where
    // the outline crosses itself the triangles may overlap, but the number stays bounded.
    void operator()(const std::vector<PlanePoint>& points, std::vector<Triangle>& triangles)
    {
        points_ = points.data();
        start(static_cast<uint32_t>(points.size()));
        uint32_t corner = 0;
        bool stuck = false;
        for (auto left = static_cast<uint32_t>(points.size()); left > 3; --left) {
            stuck = stuck || work_ > max_work;
            if (!stuck && !next_ear(corner)) stuck = !find_flat(corner, left);
            if (area(corner) != 0) triangles.push_back({previous_[corner], corner, next_[corner]});
            corner = remove(corner);
        }
        triangles.push_back({previous_[corner], corner, next_[corner]});
    }

private:
    // A corner to try, as long as its neighbours are those of then: older ones are skipped.
    struct Candidate {
        uint32_t corner, version;
    };
    struct Waiting {
        Candidate candidate;
        uint32_t next;
    };
    static constexpr uint32_t none = UINT32_MAX;
    static constexpr uint64_t max_work = 3'000'000'000;  // tests of a corner against an ear: some ten seconds

    double area(uint32_t i) const { return signed_area(points_[previous_[i]], points_[i], points_[next_[i]]); }
    bool gone(uint32_t i) const { return next_[i] == i; }

    void start(uint32_t n)
    {
        previous_.resize(n);
        next_.resize(n);
        for (uint32_t i = 0; i < n; ++i) {
            previous_[i] = i == 0 ? n - 1 : i - 1;
            next_[i] = i + 1 == n ? 0 : i + 1;
        }
        make_grid(n);
        waiting_.clear();
        waits_for_.assign(n, none);
        queue_.clear();
        version_.assign(n, 0);
        for (uint32_t i = 0; i < n; ++i) enqueue({i, 0});
        head_ = 0;
        work_ = 0;
    }

    void enqueue(Candidate c)
    {
        if (c.version == version_[c.corner] && area(c.corner) > 0) queue_.push_back(c);
    }

    bool next_ear(uint32_t& ear)
    {
        while (head_ < queue_.size()) {
            const Candidate c = queue_[head_++];
            if (c.version != version_[c.corner]) continue;
            const uint32_t obstacle = find_obstacle(c.corner);
            if (obstacle == none) {
                ear = c.corner;
                return true;
            }
            waiting_.push_back({c, waits_for_[obstacle]});
            waits_for_[obstacle] = static_cast<uint32_t>(waiting_.size() - 1);
        }
        return false;
    }

    // A corner on a straight line: it goes without a triangle, but only when no ear is left that would use it.
    bool find_flat(uint32_t& corner, uint32_t left)
    {
        uint32_t i = corner;
        for (; left > 0 && area(i) != 0; --left, ++work_) i = next_[i];
        if (left > 0) corner = i;
        return left > 0;
    }

    // Returns a corner that is left.
    uint32_t remove(uint32_t i)
    {
        const uint32_t before = previous_[i], after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        next_[i] = i;
        ++version_[i];
        // To the end of the queue: taking neighbours one after the other would make a fan of slivers.
        enqueue({before, ++version_[before]});
        enqueue({after, ++version_[after]});
        for (uint32_t w = waits_for_[i]; w != none; w = waiting_[w].next) enqueue(waiting_[w].candidate);
        return after;
    }

    // Only a corner that is not convex at the start can ever lie inside an ear: about one to a cell, row by row.
    void make_grid(uint32_t n)
    {
        const auto is_reflex = [&](uint32_t i) { return !(area(i) > 0); };
        const auto cell_of = [&](uint32_t i) { return cell(points_[i].y) * cells_ + cell(points_[i].x); };
        uint32_t count = 0;
        for (uint32_t i = 0; i < n; ++i) count += is_reflex(i) ? 1 : 0;
        cells_ = 1 + static_cast<uint32_t>(std::sqrt(count));
        first_.assign(cells_ * cells_ + 1, 0);
        for (uint32_t i = 0; i < n; ++i)
            if (is_reflex(i)) ++first_[cell_of(i)];
        uint32_t end = 0;
        for (uint32_t& f : first_) f = end += f;  // each cell is then filled from its end
        reflex_.resize(count);
        for (uint32_t i = 0; i < n; ++i)
            if (is_reflex(i)) reflex_[--first_[cell_of(i)]] = i;
    }

    uint32_t cell(double x) const
    {
        const double place = (x + 1) / 2 * cells_;
        return place > 0 ? std::min(static_cast<uint32_t>(std::min(place, 1e9)), cells_ - 1) : 0;
    }

    // A corner inside or on the border of the triangle at i. Corners in the place of one of its three do not count:
    // outlines with a hole run along a bridge twice.
    uint32_t find_obstacle(uint32_t i)
    {
        const PlanePoint a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
        const auto [left, right] = std::minmax({a.x, b.x, c.x});
        const auto [low, high] = std::minmax({a.y, b.y, c.y});
        for (uint32_t row = cell(low); row <= cell(high); ++row) {
            const uint32_t end = first_[row * cells_ + cell(right) + 1];
            for (uint32_t k = first_[row * cells_ + cell(left)]; k < end; ++k, ++work_) {
                const PlanePoint p = points_[reflex_[k]];
                if (gone(reflex_[k]) || p == a || p == b || p == c) continue;
                if (signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0)
                    return reflex_[k];
            }
        }
        return none;
    }

    const PlanePoint* points_ = nullptr;
    std::vector<uint32_t> previous_, next_;  // of the corners left; a corner that has gone is its own next
    std::vector<Candidate> queue_;           // convex corners to try, from head_ on
    std::vector<uint32_t> version_;          // grows when a neighbour goes
    std::vector<uint32_t> waits_for_;        // for each corner: the first in waiting_ that it is in the way of
    std::vector<Waiting> waiting_;
    uint32_t cells_ = 1;  // of the grid, in each direction
    std::vector<uint32_t> first_, reflex_;
    size_t head_ = 0;
    uint64_t work_ = 0;
};

}  // namespace lancer
