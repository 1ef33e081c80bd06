// The files that a render writes, and what stands in their headers.
#pragma once

#include "app/options/options.h"
#include "core/image.h"
#include "io/image/metadata.h"
#include "report/stats_json.h"
#include "scene/description/description.h"

namespace lancer {

// Throws Error (failed) if a file could not be written now; nothing is changed.
void probe_outputs(const RenderOptions& options);

// Throws Error (usage) if an output, be it through a link, is a file that the scene was read from.
void refuse_input_as_output(const RenderOptions& options, const SceneDescription& scene);

// Each pixel is the mean of its own samples; one without any is black.
Image to_image(const Film& film);

// What the picture says about its making. The pixels are the same for the same scene and settings, these are not.
Metadata make_metadata(const RunStats& stats);

// Planes go into EXR pictures only, the tone map into the others.
void write_outputs(const RenderOptions& options, ToneMap tonemap, const Film& film,
                   const std::vector<ImagePlane>& planes, const Metadata& metadata);

}  // namespace lancer
