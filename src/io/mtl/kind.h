// What kind of surface the keys of an MTL material describe. No single key is trusted: programs write illum 4 on
// opaque materials, and Tf on all. The table stands in docs/scene-format.md, "Materials of an OBJ file".
#pragma once

#include <string>

#include "io/mtl/scan.h"

namespace lancer {

enum class MtlKind {
    physical,   // Pr, Pm and their maps: metal, plastic or a mix of both
    glass,      // refracts
    metal,      // reflects Kd, as Blender writes metals without Pr and Pm
    reflector,  // reflects Ks: a classic mirror, or a metal if Ns is low or the program is KeyShot
    coated,     // Kd below a coat
    matt,       // Kd
};

struct MtlDecision {
    MtlKind kind = MtlKind::matt;
    std::string why;        // the keys that decided
    bool doubtful = false;  // other keys say something else
};

// Whether Blender wrote it from a Principled BSDF. Its older exporter, which named no version, wrote the materials of
// Blender before 2.80 under the same header, with a Ni of 1. Those keys mean what the specification says.
bool is_principled(const MtlEntry& entry);

// The part of the rays that d or Tr stops, in [0, 1]; 1 without them, and for Tr 1 alone.
float stopped_part(const MtlEntry& entry);

// Whether Tf filters light. Black and white are written without meaning anything, and Blender writes the amount of
// transmission there.
bool filters_light(const MtlEntry& entry);

MtlDecision decide_kind(const MtlEntry& entry);

}  // namespace lancer
