// Finds the faces of a mesh whose glass has no inside. A pane is often drawn as one quad, as a quad for each side in
// the same place, or as a slab that is too thin to matter; refraction at each face, as if it bounded a body, would then
// lose or make light. What is found becomes a thin sheet (materials/thin_sheet.h).
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/bounds.h"
#include "core/transform.h"
#include "scene/description/description.h"

namespace lancer {

enum class GlassRole : uint8_t {
    none,   // opaque, or said to be a body: by thin = false, an absorption or a priority
    glass,  // its shape decides
    sheet,  // thin = true
    veil,   // lets part of the rays pass, by its opacity
};
struct FaceMaterial {
    GlassRole role = GlassRole::none;
    bool may_be_slab = false;  // a slab of it looks like a sheet: smooth, without bumps
    bool is_liquid = false;    // an open part is the surface of what lies below it
    bool reads_uv = false;
};

enum class SheetKind : uint8_t {
    open,        // bounds no volume
    doubled,     // two or more faces in the same place that bound no volume
    slab,        // a closed slab, or two faces that look away from each other, with little between them
    body_twice,  // a closed body with two or more faces in the same place
    face_twice,  // faces in the same place with an opacity, or said to be thin
};

// Thickest slab that counts as a sheet, over the smaller of its other extents.
inline constexpr double thinnest_body = 0.02;

// Numbers of triangles of the mesh.
struct FoundSheets {
    struct Slab {
        std::vector<uint32_t> kept, rest;  // faces of one side, which become the sheet, and all others
        uint32_t material = 0;
        Bounds box;
        size_t body = 0;  // its place in `bodies`
    };
    std::vector<uint32_t> thin;    // become thin sheets
    std::vector<uint32_t> absent;  // copies of others
    std::vector<Slab> slabs;       // become sheets unless they touch another body
    std::vector<Bounds> bodies;    // boxes of closed bodies of glass, slabs included; scene units
    struct Inward {
        uint32_t material = 0;
        Bounds box;
    };
    std::vector<Inward> inward;  // of these the ones whose faces look inwards: cavities, or bodies inside out
    std::map<std::pair<uint32_t, SheetKind>, uint64_t> counts;  // of parts, by material; of face_twice of faces
};

// place: from the mesh to scene units. material_of: of each triangle, an index into `materials`.
FoundSheets find_sheets(const MeshData& data, const Transform& place, std::span<const uint32_t> material_of,
                        std::span<const FaceMaterial> materials);

}  // namespace lancer
