// How the channels of an EXR picture are compressed.
#pragma once

#include "core/enum_names.h"

namespace lancer {

// dwaa and dwab lose what is hardly seen; the others keep every bit.
enum class ExrCompression { none, rle, zips, zip, piz, dwaa, dwab };
template <>
inline constexpr auto enum_names<ExrCompression> = std::to_array<std::string_view>({"none", "rle", "zips", "zip", "piz",
                                                                                    "dwaa", "dwab"});

}  // namespace lancer
