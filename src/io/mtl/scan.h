// Parses material files (MTL): the keys of each material, with checked values. mtl/material.h interprets them.
// tinyobjloader reads these files too, but cannot tell an absent key from its default (an absent Kd is black) and
// accepts any text as a number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"
#include "core/error.h"
#include "io/mtl/map.h"
#include "io/mtl/program.h"

namespace lancer {

template <class T>
struct MtlValue {
    T value{};
    uint32_t line = 0;  // 0: not given, or not usable and warned about
    explicit operator bool() const { return line != 0; }
};

enum class MtlMapKind : uint8_t { kd, ks, ke, d, pr, pm, ps, pc, pcr, aniso, anisor, bump, normal, disp };

struct MtlEntry {
    std::string name;  // with what may be a comment behind it
    uint32_t line = 0;
    MtlOrigin origin;
    MtlValue<Color> kd, ks, tf;                       // in [0, 1]
    MtlValue<Color> ka;                               // finite, >= 0; of files by Blender alone
    MtlValue<Color> ke;                               // finite, >= 0
    MtlValue<float> ns;                               // finite, >= 0
    MtlValue<float> ni;                               // in [0.001, 10]
    MtlValue<float> d, tr, pr, pm;                    // in [0, 1]
    MtlValue<float> ps, pc, pcr, aniso, anisor;       // in [0, 1]
    MtlValue<int> illum;                              // 0 to 10
    std::vector<std::pair<MtlMapKind, MtlMap>> maps;  // each kind at most once

    const MtlMap* map(MtlMapKind kind) const
    {
        for (const auto& [k, m] : maps)
            if (k == kind) return &m;
        return nullptr;
    }
};

// The materials in the order of the file.
std::vector<MtlEntry> scan_mtl(std::string_view text, const std::string& file, Diagnostics& diagnostics);

}  // namespace lancer
