// PPM pictures, binary or text, as the ray tracer wrote them that --legacy reproduces. The format: netpbm's ppm(5).
#pragma once

#include <string>

#include "core/image.h"
#include "io/image/metadata.h"
#include "io/image/to_bytes.h"

namespace lancer {

class AtomicFile;

// The data window, 8 bit, see to_bytes.h; ascii: the form P3, else P6. Each metadata pair is a comment "# lancer:NAME
// VALUE" of the header. The file appears whole or not at all; the second form fills a file made earlier, its owner
// commits it. Throws Error (failed).
void write_ppm(const std::string& path, const Image& image, const Metadata& metadata = {},
               const ByteOptions& options = {}, bool ascii = false);
void write_ppm(AtomicFile& file, const Image& image, const Metadata& metadata = {}, const ByteOptions& options = {},
               bool ascii = false);

}  // namespace lancer
