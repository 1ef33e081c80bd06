// The program that wrote a material file, as a comment before its first material says. The same keys mean different
// things by different programs; docs/scene-format.md, "What programs write", has them with their sources.
#pragma once

#include <cstdint>
#include <string_view>

namespace lancer {

enum class MtlProgram : uint8_t {
    other,    // none of these: keys mean what the MTL specification says
    blender,  // writes Principled BSDFs, or older materials: see is_principled() of mtl/kind.h
    keyshot,
    meshlab,
    sketchup,
};

struct MtlOrigin {
    MtlProgram program = MtlProgram::other;
    int version = 0;  // of Blender, before the first point; 0: not said
};

// `comment`: a line that begins with '#'. `other` if it names none of them.
MtlOrigin origin_in_comment(std::string_view comment);

}  // namespace lancer
