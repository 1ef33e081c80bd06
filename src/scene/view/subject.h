// What an automatic view is to show: the triangles of a description, in units of its bounds. choose_view() and what it
// asks read it. Nothing is copied; a description of many instances is not taken apart.
#pragma once

#include <span>
#include <vector>

#include "core/bounds.h"
#include "core/transform.h"
#include "scene/description/description.h"

namespace lancer {

class Subject {
public:
    explicit Subject(const SceneDescription& description);

    const Bounds& bounds() const { return bounds_; }  // in units of the file
    // Whether it has a size that can be computed with. Else it has no triangles.
    bool is_usable() const { return unit_ > 0; }
    // The sides of the bounds; the longest is 1.
    Vec3d size() const { return (bounds_.upper - bounds_.lower) * unit_; }
    // Positions are in [0, size()].
    Vec3d from_file(Vec3d p) const { return (p - bounds_.lower) * unit_; }
    Vec3d to_file(Vec3d p) const { return p / unit_ + bounds_.lower; }
    double to_file(double length) const { return length / unit_; }

    // f(a, b, c) for each triangle, in the order of its winding.
    template <class F>
    void each_triangle(const F& f) const
    {
        for (const Part& part : parts_)
            for (const auto& [i, j, k] : part.triangles)
                f(part.to_subject.point(part.positions[i]), part.to_subject.point(part.positions[j]),
                  part.to_subject.point(part.positions[k]));
    }
    // f(p) for each position.
    template <class F>
    void each_point(const F& f) const
    {
        for (const Part& part : parts_)
            for (const Vec3d& p : part.positions) f(part.to_subject.point(p));
    }

private:
    using Triangles = std::span<const std::array<uint32_t, 3>>;
    struct Part {
        std::span<const Vec3d> positions;
        Triangles triangles;
        Transform to_subject;
    };
    void add(std::span<const Vec3d> positions, Triangles triangles, const Transform& to_file);
    void add_box(const Bounds& box, const Transform& to_file);

    Bounds bounds_;
    double unit_ = 0;
    std::vector<Part> parts_;
};

}  // namespace lancer
