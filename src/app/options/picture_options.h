// What the commands that write pictures share: their options, and what these mean together.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/options/option_parser.h"
#include "app/options/options.h"

namespace lancer {

void add_format(OptionParser& p, std::optional<PictureFormat>& format);
void add_jpeg_quality(OptionParser& p, uint32_t& quality);
void add_ocio(OptionParser& p, OcioChoice& o);
// given: the options that were. Throws Error (usage), as all below.
void check_ocio(const std::vector<std::string>& given, const OcioChoice& o);

// Those of lancer render. is_film: those of lancer film.
void add_render_options(OptionParser& p, RenderOptions& o, bool is_film = false);
// What the options of a picture mean together. given: those that were. o: with its outputs.
void complete_picture_options(const std::vector<std::string>& given, RenderOptions& o);

// Where a file is, whatever its name says of the way there.
std::filesystem::path place_of(const std::string& path);
void refuse_doubles(const std::vector<std::string>& files);

}  // namespace lancer
