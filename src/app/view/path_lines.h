// The paths of a pixel as lines over the picture: what `lancer pixel` prints, drawn where it happens.
#pragma once

#include <mutex>
#include <vector>

#include "app/view/window_types.h"
#include "render/renderer.h"

namespace lancer {

struct PathLine {
    enum class Kind { ray, leaves_scene, light_arrives, light_is_blocked } kind = Kind::ray;
    Vec3d from{}, to{};  // in the units of the scene file
};

// The rays of the first samples of a pixel; those that go on for ever end after one extent of the scene. camera: of the
// whole picture, as that has it. Must be called inside with_threads.
std::vector<PathLine> paths_of_pixel(const Renderer& renderer, const Camera& camera, PictureSize size, uint32_t x,
                                     uint32_t y, uint32_t samples);

// As they look from a camera, without what is behind it.
std::vector<Mark> marks_of(const std::vector<PathLine>& lines, const CameraDescription& camera, PictureSize size);

// Lines that one thread finds and another shows.
class SharedLines {
public:
    void set(std::vector<PathLine> lines)
    {
        const std::lock_guard lock(mutex_);
        lines_ = std::move(lines);
    }
    std::vector<PathLine> get() const
    {
        const std::lock_guard lock(mutex_);
        return lines_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<PathLine> lines_;
};

}  // namespace lancer
