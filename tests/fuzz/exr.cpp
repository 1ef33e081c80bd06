// OpenEXR pictures: as textures, as references, as what lancer info and lancer verify read.
#include "io/image/exr.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string& path = fuzz::as_file(fuzz::as_text(data, size));
    ExrInfo info;
    // Most inputs are refused by their header. Those need not be read four times.
    constexpr size_t most_pixels = 1 << 14;
    if (!fuzz::reads([&] { info = read_exr_info(path); }) || info.data.area() > most_pixels) return 0;
    fuzz::try_picture(path, read_exr_raster_header, read_exr_raster);
    fuzz::reads([&] {
        const Image image = read_exr(path);
        fuzz::require(image.pixels.size() == image.data.area());
    });
    std::vector<std::string> names;
    for (const ExrInfo::Channel& channel : info.channels)
        if (names.size() < 4) names.push_back(channel.name);
    fuzz::reads([&] { read_exr_channels(path, names); });
    return 0;
}
