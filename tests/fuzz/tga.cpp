// Targa pictures.
#include "io/image/tga.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    fuzz::try_picture(fuzz::as_file(fuzz::as_text(data, size)), read_tga_header, read_tga);
    return 0;
}
