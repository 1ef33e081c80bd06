// JPEG pictures, but for those of four channels, which the module of OpenImageIO reads.
#include "io/image/jpeg.h"
#include "fuzz/picture.h"
#include "io/image/sizes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const auto read_header = [](const std::string& path) {
        InputFile file(path);
        return read_jpeg_size(file);
    };
    const auto read = [](const std::string& path) {
        InputFile file(path);
        std::optional<Raster> raster = read_jpeg(file);
        if (!raster) throw file.invalid("of four channels");
        return std::move(*raster);
    };
    fuzz::try_picture(fuzz::as_file(fuzz::as_text(data, size)), read_header, read);
    return 0;
}
