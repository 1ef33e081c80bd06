// A small picture of a view, from which estimators judge the light before the first sample of the real one.
#pragma once

#include <vector>

#include "render/renderer.h"
#include "scene/description/description.h"

namespace lancer {

// About 3000 pixels of 32 samples, at most as many as `size`, with its aspect. Mean radiance and base colour of each.
class SmallPicture {
public:
    // Samples are drawn as those of a picture of its size, with the renderer's settings. Must be called inside
    // with_threads.
    SmallPicture(const Renderer& renderer, const CameraDescription& view, PictureSize size, PixelGrid grid);

    uint32_t width() const { return film_.width; }
    uint32_t height() const { return film_.height; }
    size_t index(uint32_t x, uint32_t y) const { return film_.index(x, y); }
    const Camera& camera() const { return camera_; }
    double luminance(size_t pixel) const;
    double base_color(size_t pixel) const;  // its luminance; misses count as black

private:
    Film film_;
    Camera camera_;
};

struct Weighted {
    double value, weight;
};
// The value below which the part `share` of the weight lies; 0 of nothing.
double quantile(std::vector<Weighted> values, double share);

}  // namespace lancer
