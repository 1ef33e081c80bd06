// The C interface between the program and the module lancer_subdivide, which alone is linked with OpenSubdiv and is
// loaded only when a mesh asks for the scheme of Catmull and Clark. No C++ types or exceptions cross it.
#pragma once

#include <cstdint>

extern "C" {

struct LancerSubdivided;  // the result

// Numbers of a vertex besides its place, and of a pair of texture coordinates.
enum : uint32_t { lancer_subdivide_vertex_numbers = 4, lancer_subdivide_uv_numbers = 4 };

struct LancerCage {
    uint32_t vertices, faces, uvs, levels;
    const int32_t *face_sizes, *corners;  // of each face; its corners, as indices of vertices, face after face
    const int32_t* uv_corners;            // likewise indices of uv_values; null if uvs is 0
    const double* positions;              // three of each vertex
    const float *vertex_values, *uv_values;
};

struct LancerSubdividedInfo {
    uint32_t vertices, faces, uvs;  // all faces are quads
    char message[256];              // the reason, after a failure
};

// Changes with every change of this file: a module left over from another build is refused.
constexpr int32_t lancer_subdivide_current_version = 1;

int32_t lancer_subdivide_version();
// Null: see info->message.
LancerSubdivided* lancer_subdivide_refine(const LancerCage* cage, LancerSubdividedInfo* info);
// Into arrays of the sizes that info says; those of texture coordinates may be null. parents: of each face, the face of
// the cage that it is a part of.
void lancer_subdivide_copy(const LancerSubdivided* made, double* positions, float* vertex_values, float* uv_values,
                           uint32_t* corners, uint32_t* uv_corners, uint32_t* parents);
void lancer_subdivide_close(LancerSubdivided* made);
}
