// Collects the media of materials while the scene is built.
#pragma once

#include <cstdint>

#include "core/error.h"
#include "scene/description/description.h"
#include "scene/scene.h"

namespace lancer {

// Whether paths of an integrator follow what media scatter; for others media absorb alone.
bool follows_scattering(IntegratorKind kind);

// The id of what is behind a surface of this material, or none; listed in scene.media. Says what cannot be. bsdf: of
// the same material. kind: of the integrator.
uint16_t add_medium(const MaterialDescription& material, const Material& bsdf, IntegratorKind kind, Scene& scene,
                    Diagnostics& diagnostics);

// Fills the scene with fog. Its bounds must be known; lights: those with a place are in the fog.
void add_fog(const FogDescription& fog, const std::vector<LightDescription>& lights, IntegratorKind kind, Scene& scene,
             Diagnostics& diagnostics);

// Whether a description says what is inside.
bool has_inside(const MaterialDescription& material);

// Whether the medium affects rays inside it.
bool matters(const Medium& medium);

// Removes all media if none has a priority, absorbs or scatters, so that rendering skips them. Warns of those whose
// free paths float does not resolve.
void finish_media(Scene& scene, Diagnostics& diagnostics);

// Finds the media without a light inside: Medium::is_dark. After all lights are listed.
void mark_dark_media(Scene& scene);

}  // namespace lancer
