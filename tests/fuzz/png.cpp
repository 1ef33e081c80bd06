// PNG pictures. A mutation that left the check sums of chunks wrong would test little but those.
#include <zlib.h>

#include <algorithm>

#include "fuzz/picture.h"
#include "io/image/png.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace {

// Each chunk is its length (big-endian), four letters, its bytes, and the check sum of letters and bytes.
void mend_check_sums(uint8_t* data, size_t size)
{
    constexpr size_t signature = 8, frame = 12;
    for (size_t at = signature; at + frame <= size;) {
        const size_t length =
            size_t{data[at]} << 24 | size_t{data[at + 1]} << 16 | size_t{data[at + 2]} << 8 | data[at + 3];
        if (length > size - at - frame) return;
        const uLong sum = crc32(0, data + at + 4, static_cast<uInt>(length + 4));
        for (size_t i = 0; i < 4; ++i) data[at + 8 + length + i] = static_cast<uint8_t>(sum >> (24 - 8 * i));
        at += frame + length;
    }
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed)
{
    const size_t mutated = LLVMFuzzerMutate(data, size, most);
    if (seed % 16 != 0) mend_check_sums(data, mutated);
    return mutated;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string& path = fuzz::as_file(fuzz::as_text(data, size));
    fuzz::try_picture(path, read_png_raster_header, read_png_raster);
    fuzz::reads([&] { read_png_info(path); });
    return 0;
}
