#include "app/version.h"

#include "core/lanes/native.h"
#include "core/parallel.h"
#include "geometry/embree/embree.h"
#include "io/image/exr.h"
#include "io/image/png.h"

namespace lancer {

std::string version_text()
{
    return "lancer " LANCER_VERSION "\nEmbree " + embree_version() + "\n" + parallel_version() + "\nOpenEXR " +
           exr_version() + "\nlibpng " + png_version() + "\ncompiled by " + compiler_text() +
           ", " LANCER_BUILD_TYPE ", " + instruction_text();
}

std::string version_number() { return LANCER_VERSION; }
std::string version_date() { return LANCER_DATE; }

std::string compiler_text()
{
#ifdef __clang__
    return "clang " __clang_version__;
#else
    return "gcc " __VERSION__;
#endif
}

std::string instruction_text()
{
    const std::string lanes = native::is_portable ? ", portable lanes" : "";
#if defined(__aarch64__)
    return "arm64" + lanes;
#elif defined(__AVX512F__)
    return "AVX-512" + lanes;
#else
    return "x86-64-v3 (AVX2, FMA)" + lanes;
#endif
}

}  // namespace lancer
