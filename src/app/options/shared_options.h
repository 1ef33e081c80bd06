// The options that several commands share: of the scene, of how it is rendered, of threads.
#pragma once

#include <string_view>

#include "app/options/file_kinds.h"
#include "app/options/option_parser.h"
#include "app/options/options.h"
#include "scene/description/render_options.h"

namespace lancer {

// Ends of help texts.
inline constexpr const char* exit_codes_help =
    "Exit codes: 0 done; 1 failed at run time; 2 wrong usage; 65 scene or asset invalid; 66 input missing;\n"
    "71 the pictures need more than --memory; ";
inline constexpr const char* interrupted_help = "130 interrupted.\n";

// help: of the argument that names the scene; endings: of the files that it may be.
void add_scene_options(
    OptionParser& p, SceneChoice& o,
    const char* help = "Scene file (.toml) or mesh (.obj, .ply, .gltf, .glb: camera and light are added)",
    std::string_view endings = files::scenes);
// One option for each row of render_options(), and the scene, and how it runs.
void add_picture_options(OptionParser& p, PictureOptions& o);

// Sets a row to what value_text() gives. Throws Error (usage).
void read_setting(const RenderOption& row, const std::string& text, RenderSettings& settings);

void add_memory(OptionParser& p, MemorySize& memory);
// --json: the result as one object of JSON.
void add_json(OptionParser& p, bool& json);
void add_threads(OptionParser& p, std::optional<uint32_t>& threads);
// $LANCER_THREADS, where --threads is not given. After parsing, so that a wrong value in the environment does not
// stand in the way of a right one. Throws Error (usage).
void take_environment(std::optional<uint32_t>& threads);

}  // namespace lancer
