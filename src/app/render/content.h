// What the picture files of a render hold.
#pragma once

#include "app/options/options.h"
#include "app/render/outputs.h"
#include "core/film.h"
#include "render/denoise/denoise.h"

namespace lancer {

// film and denoised must outlive the result. denoised: empty where only the noisy picture is written. metadata: of
// make_metadata(); that of halves is added.
PictureContent content_of(const Film& film, const Denoised& denoised, const RenderOptions& options, Metadata metadata,
                          const DisplayCurve& curve, const Normalisation& normalisation);

// What the file of a denoised picture has besides: the noisy one, and the error to expect.
std::vector<ImagePlane> layers_of_denoised(const Image& noisy, const Denoised& denoised);

}  // namespace lancer
