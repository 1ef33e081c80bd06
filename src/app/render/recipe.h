// All that makes pictures of a film, without the scene: what a checkpoint carries so that parts of a picture can be
// merged where there is only the program.
#pragma once

#include "app/options/options.h"
#include "app/render/checkpoint_stream.h"
#include "app/render/outputs.h"
#include "render/mattes.h"
#include "report/stats_json.h"
#include "scene/placement.h"

namespace lancer {

struct PictureRecipe {
    RenderOptions options;  // what becomes of the film: AOVs, background, halves, denoising, style
    RunStats stats;         // context, scene and settings, with the number of samples
    DisplayCurve curve;
    Normalisation normalisation;
    std::vector<std::string> light_groups;  // LightGroups::names
    std::vector<MatteManifest> manifests;   // with --aov cryptomatte
    std::optional<ExrCamera> camera{};      // there once the scene is built
    bool keeps_blocks_open = false;
};

// How samples are dealt to the sets that denoising needs; nothing if it is not asked for.
std::optional<SetDeal> sets_of(const RenderOptions& options, const RenderSettings& settings);
// Of the options that decide what files hold besides the picture itself.
uint64_t hash_of_contents(const RenderOptions& options);

// A film without samples, with room for what the options ask for.
Film empty_film(const PictureRecipe& recipe);

void save_recipe(Saver& to, const PictureRecipe& recipe);
// Throws Error (invalid_input).
PictureRecipe load_recipe(Loader& from);

}  // namespace lancer
