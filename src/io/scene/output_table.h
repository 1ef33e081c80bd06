// [output] of a scene file: how pictures for displays (PNG, PPM) are made of the light. It is no part of the scene.
#pragma once

#include <optional>

#include "io/image/tonemap.h"
#include "io/toml_reader.h"
#include "scene/description/exposure.h"

namespace lancer {

struct OutputDescription {
    std::optional<Exposure> exposure;  // stops in [-64, 64]
    std::optional<ToneMap> tonemap;
    std::optional<bool> denoise;
};

OutputDescription read_output_table(const TomlTable& table);

}  // namespace lancer
