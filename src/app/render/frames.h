// Numbered scene files and pictures.
#pragma once

#include "app/options/options.h"

namespace lancer {

// Runs of # become the number, with as many digits at least: "f.####.exr", 7: "f.0007.exr".
std::string with_number(std::string name, uint32_t number);
// The options of one frame.
RenderOptions options_of_frame(const RenderOptions& all, uint32_t frame);

// Whether a picture is complete and says that it has this identity (app/render/identity.h).
bool is_finished_picture(const std::string& path, const std::string& identity);

}  // namespace lancer
