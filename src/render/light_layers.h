// The light of a picture in layers: see LayerLayout. Every contribution to a sample is added to the layer of its group
// of lights and to that of its segment, in double, and rounded once for the file.
#pragma once

#include <vector>

#include "core/film.h"
#include "core/image.h"
#include "integrators/path_actions.h"
#include "scene/lights/groups.h"

namespace lancer {

// Adds a contribution to the layers of a sample. group: index in LightGroups::names.
inline void add_radiance(RadianceSum* layers, const LayerLayout& layout, uint8_t group, PathSegment segment,
                         Color radiance)
{
    if (layout.groups > 0) layers[group] += radiance;
    if (layout.has_segments) layers[layout.groups + static_cast<uint32_t>(segment)] += radiance;
}

// The layers of a sample that is the sky alone.
inline std::vector<RadianceSum> layers_of_sky(const LightGroups& groups, const LayerLayout& layout, Color sky)
{
    std::vector<RadianceSum> layers(layout.size());
    add_radiance(layers.data(), layout, groups.of_sky, PathSegment::view, sky);
    return layers;
}

// The channels of the layers that a film has, means over the samples of a pixel: light.GROUP.R .G .B of each group, and
// emission.R .G .B, direct.R .G .B and indirect.R .G .B. denoised: pixels to write in place of the film's, layer by
// layer, or empty.
std::vector<ImagePlane> layer_planes(const Film& film, const std::vector<std::string>& groups,
                                     const std::vector<std::vector<Color>>& denoised = {});

}  // namespace lancer
