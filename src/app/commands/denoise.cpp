// lancer denoise: a saved picture that carries the halves of its samples.
#include <algorithm>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/options/options.h"
#include "app/render/content.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/image/exr.h"
#include "render/denoise/film_halves.h"

namespace lancer {
namespace {

HalfPlanes read_halves(const std::string& path, const Metadata& metadata)
{
    const ExrInfo info = read_exr_info(path);
    const std::vector<std::string> names = names_of_halves();
    for (const std::string& name : names)
        if (std::none_of(info.channels.begin(), info.channels.end(), [&](const auto& c) { return c.name == name; }))
            throw Error(ErrorKind::invalid_input, {path},
                        "has no channel " + in_quotes(name) + ": render it with --aov denoise");
    const auto samples = [&](size_t half) {
        const MetadataValue* const found = find_value(metadata, names_of_samples[half]);
        const double* const number = found ? std::get_if<double>(found) : nullptr;
        return number ? static_cast<float>(*number) : 1.0f;
    };
    return halves_from(read_exr_channels(path, names), {samples(0), samples(1)});
}

// The header of the picture, and that it was denoised.
Metadata denoised_metadata(Metadata metadata)
{
    std::erase_if(metadata,
                  [](const auto& m) { return m.first == names_of_samples[0] || m.first == names_of_samples[1]; });
    for (auto& [name, value] : metadata) {
        if (name != "bias") continue;
        const std::string before = to_string(value);
        value = before == "none" ? "denoised" : before + ", denoised";
    }
    return metadata;
}

void check_outputs(const DenoiseOptions& options)
{
    for (const std::string& path : options.outputs) {
        std::error_code absent;
        if (std::filesystem::equivalent(path, options.picture, absent))
            throw Error(ErrorKind::usage, {}, "--output: " + in_quotes(path) + " would overwrite the picture");
        const AtomicFile probe(path);
    }
}

}  // namespace

int run_denoise(int argc, char** argv)
{
    const auto options = parse_denoise(argc, argv);
    if (!options) return exit_done;
    Metadata metadata;
    const Image noisy = read_exr(options->picture, &metadata);
    const HalfPlanes halves = read_halves(options->picture, metadata);
    check_outputs(*options);
    if (options->ocio.is_given()) open_ocio(options->ocio);  // its errors come before the work
    Denoised denoised;
    with_threads(options->threads.value_or(available_threads()), [&] {
        denoised = denoise_picture(
            halves.input(static_cast<uint32_t>(noisy.data.width()), static_cast<uint32_t>(noisy.data.height())));
    });
    Image image = noisy;
    image.pixels = denoised.pixels;
    write_outputs(options->outputs, {.image = rows_of(image),
                                     .planes = layers_of_denoised(noisy, denoised),
                                     .metadata = denoised_metadata(std::move(metadata)),
                                     .style = {.format = options->format,
                                               .curve = {options->exposure, options->tonemap},
                                               .jpeg_quality = options->jpeg_quality,
                                               .ocio = options->ocio,
                                               .exr = {.camera = read_exr_info(options->picture).camera}}});
    print_written(options->outputs);
    return exit_done;
}

}  // namespace lancer
