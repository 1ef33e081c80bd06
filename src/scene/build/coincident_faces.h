// Faces that lie on each other: given twice, once for each side, or on both sides again. Quads are found whichever
// diagonal each copy was split along.
#pragma once

#include <limits>

#include "scene/build/welded_faces.h"

namespace lancer {

struct CoincidentFaces {
    static constexpr uint32_t none = UINT32_MAX;

    std::vector<uint32_t> first;    // of each face the one that stands for all that lie on it; itself if it is that one
    std::vector<bool> is_reversed;  // seen from the other side than the one that stands for it
    std::vector<uint32_t> back;     // of each that stands for others, one that is reversed; else none

    // Of quads found by their corners: the other half of each face; else none.
    std::vector<uint32_t> half;

    bool stands(uint32_t face) const { return first[face] == face; }
    bool has_any() const { return any_; }

private:
    friend CoincidentFaces find_coincident(const WeldedFaces&, std::span<const uint32_t>);
    bool any_ = false;
};

// group: of each face; only faces of the same group count as copies of each other.
CoincidentFaces find_coincident(const WeldedFaces& faces, std::span<const uint32_t> group);

}  // namespace lancer
