// Key frames of a camera: twelve places that the hand defines, and the path through those that there are.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/error.h"
#include "scene/description/description.h"

namespace lancer {

class KeyFrames {
public:
    static constexpr uint32_t count = 12;

    void define(uint32_t frame, const CameraDescription& camera) { frames_[frame] = camera; }
    const std::optional<CameraDescription>& at(uint32_t frame) const { return frames_[frame]; }
    uint32_t defined() const;
    // The path at `time`, from 0, the first frame, to defined() - 1, the last one. Position, target, up, field of view
    // and aperture follow the curves of core/key_curve.h, which go through each frame. There must be one.
    CameraDescription along(double time) const;

    // The cameras F1 to F12 of a scene file: [camera.F1] and so on. Bits are kept.
    std::string text() const;
    // Throws Error.
    void read(const std::string& text, const std::string& path);

private:
    std::array<std::optional<CameraDescription>, count> frames_;
};

}  // namespace lancer
