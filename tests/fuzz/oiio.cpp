// Pictures that the module of OpenImageIO decodes: HDR, TIFF, WebP, DDS, GIF, BMP, PNM. Others have targets of their
// own.
#include "fuzz/picture.h"
#include "io/image/read.h"

// Opens the module, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***)
{
    lancer::read_raster(lancer::fuzz::as_file("P5\n1 1\n255\n0"));
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    using namespace std::string_view_literals;
    const std::string_view bytes = fuzz::as_text(data, size);
    for (const std::string_view other : {"\x76\x2f\x31\x01"sv, "\x89PNG"sv, "\xff\xd8\xff"sv})
        if (bytes.starts_with(other)) return 0;
    fuzz::try_picture(fuzz::as_file(bytes), read_raster_header,
                      [](const std::string& path) { return *read_raster(path); });
    return 0;
}
