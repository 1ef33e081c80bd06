#include "io/image/ppm.h"

#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lancer {

void write_ppm(AtomicFile& file, const Image& image, const Metadata& metadata, const ByteOptions& options, bool ascii)
{
    if (image.data.empty() || image.pixels.size() != image.data.area())
        throw Error(ErrorKind::failed, {file.path()}, "cannot write a picture without pixels");
    std::string text = ascii ? "P3\n" : "P6\n";
    for (const auto& [name, value] : metadata) {
        std::string line = "# lancer:" + name + " " + to_string(value);
        // A comment ends where its line does.
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        text += line + "\n";
    }
    text += std::to_string(image.data.width()) + " " + std::to_string(image.data.height()) + "\n255\n";
    const std::vector<uint8_t> bytes = to_bytes(image, options);
    if (ascii) {
        // A pixel on each line: the format wants none longer than 70 characters.
        for (size_t i = 0; i < bytes.size(); i += 3)
            text += std::to_string(bytes[i]) + " " + std::to_string(bytes[i + 1]) + " " + std::to_string(bytes[i + 2]) +
                    "\n";
    }
    file.write(text.data(), text.size());
    if (!ascii) file.write(bytes.data(), bytes.size());
}

void write_ppm(const std::string& path, const Image& image, const Metadata& metadata, const ByteOptions& options,
               bool ascii)
{
    AtomicFile file(path);
    write_ppm(file, image, metadata, options, ascii);
    file.commit();
}

}  // namespace lancer
