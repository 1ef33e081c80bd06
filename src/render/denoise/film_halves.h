// A film with sets of samples as the denoiser's input.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/film.h"
#include "core/image.h"
#include "render/denoise/denoise.h"

namespace lancer {

// Two halves and the pixel variance, in memory of their own.
struct HalfPlanes {
    static constexpr size_t of_half = 3 + std::tuple_size_v<SampleSet::Features>;
    // Of each half: colour, albedo, normal, distance.
    std::array<std::array<std::vector<float>, of_half>, 2> halves;
    std::array<float, 2> samples{1, 1};  // of a pixel, on average
    std::vector<float> variance;

    // Both refer to this.
    DenoiseInput input(uint32_t width, uint32_t height) const;
};

// Which sets of a film the halves are made of. Without those held out only films of four sets have samples.
enum class UsedSets { all, without_held_out };
HalfPlanes halves_of(const Film& film, UsedSets used = UsedSets::all);

// The picture of a film that has sets, denoised: the pixels of its crop. Uses the threads of with_threads(). Without
// pixels if it is stopped.
Denoised denoise_film(const Film& film, UsedSets used = UsedSets::all, const std::stop_token& stop = {});

// The names of the channels that hold halves in a picture file, "denoise.a.R", in the order of HalfPlanes; the last one
// is of the variance.
std::vector<std::string> names_of_halves();
std::vector<ImagePlane> planes_of(HalfPlanes halves);
// What Open Image Denoise takes beside the picture, of a film that has sets: albedo and normal of the first surface
// that spreads light, "oidn.albedo.R" to "oidn.normal.Z"; 0 where nothing is hit.
std::vector<ImagePlane> guide_planes(const Film& film);
// The inverse of planes_of(): planes in the order of these names. samples: as HalfPlanes::samples.
HalfPlanes halves_from(std::vector<std::vector<float>> planes, const std::array<float, 2>& samples);

}  // namespace lancer
