// Films without checkpoints and limits: what they keep, and all their samples.
#pragma once

#include <functional>
#include <stop_token>

#include "render/renderer.h"

namespace lancer {

// Makes room for what the settings need besides sums: numbers of samples, replicates.
void keep_for_settings(const RenderSettings& settings, Film& film);

// Adds all samples of every pixel to an empty film, with the bits of lancer render. report: the part that is done, from
// any thread. False if it was stopped: the film is then not fit for use. Must be called inside with_threads.
bool fill_film(const Renderer& renderer, const Camera& camera, Film& film, uint32_t spp, const std::stop_token& stop,
               const std::function<void(double)>& report);

}  // namespace lancer
