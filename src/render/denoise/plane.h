// One number for each pixel of a picture, with a margin on all sides in which the picture is mirrored about its edges:
// windows near an edge need no test, and rows can be read eight lanes at a time beyond their end.
#pragma once

#include <functional>
#include <vector>

#include "core/lanes/types.h"

namespace lancer::denoise {

inline constexpr int lanes = int{float_lanes};  // pixels of a row that are computed at once

class Plane {
public:
    // The largest distance from the picture at which a value may be read, to the right with eight lanes.
    static constexpr int margin = 16;

    Plane() = default;
    // Zeros.
    Plane(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    // The pixel (0, y); y in [-margin, height + margin).
    float* row(int y) { return values_.data() + start_of(y); }
    const float* row(int y) const { return values_.data() + start_of(y); }
    // Fills the margin. Must be called when all pixels are known.
    void mirror_edges();

private:
    static constexpr int right_margin = margin + 24;  // a group of fits is 16 pixels wide, a load eight
    int stride() const { return margin + width_ + right_margin; }
    size_t start_of(int y) const
    {
        return static_cast<size_t>(y + margin) * static_cast<size_t>(stride()) + size_t{margin};
    }

    int width_ = 0, height_ = 0;
    std::vector<float> values_;
};

// Calls f(y) for each row of a picture, in parallel.
void for_rows(int height, const std::function<void(int y)>& f);

// The plane whose pixels are f(x, y), with mirrored margins.
template <class F>
Plane plane_of(int width, int height, const F& f)
{
    Plane plane(width, height);
    for_rows(height, [&](int y) {
        for (int x = 0; x < width; ++x) plane.row(y)[x] = f(x, y);
    });
    plane.mirror_edges();
    return plane;
}

// The mean over a square of 2 * radius + 1 pixels; radius <= Plane::margin. The margins of both are mirrored.
Plane box_mean(const Plane& in, int radius);

}  // namespace lancer::denoise
