// The light of a picture in layers: see LayerLayout. Every contribution to a sample is added to the layer of its group
// of lights, to that of its segment and to those of its lobes, in double, and rounded once for the file.
#pragma once

#include <vector>

#include "core/film.h"
#include "core/image.h"
#include "integrators/path_actions.h"
#include "scene/lights/groups.h"

namespace lancer {

// Adds a contribution to the layers of a sample. group: index in LightGroups::names.
inline void add_radiance(RadianceSum* layers, const LayerLayout& layout, uint8_t group, PathSegment segment,
                         const LobeShare& lobes, Color radiance)
{
    if (layout.groups > 0) layers[group] += radiance;
    if (layout.has_segments) layers[layout.groups + static_cast<uint32_t>(segment)] += radiance;
    if (!layout.has_lobes) return;
    RadianceSum* const of_lobes = layers + layout.first_lobe();
    RadianceSum& diffuse = of_lobes[static_cast<uint32_t>(Lobe::diffuse)];
    RadianceSum& rest = of_lobes[static_cast<uint32_t>(lobes.rest)];
    // The two products of each channel add up to it without rounding, but for that of double.
    const auto divide = [](float part, float all, double& some, double& other) {
        const double product = double{part} * double{all};
        some += product, other += double{all} - product;
    };
    divide(lobes.diffuse.r, radiance.r, diffuse.r, rest.r);
    divide(lobes.diffuse.g, radiance.g, diffuse.g, rest.g);
    divide(lobes.diffuse.b, radiance.b, diffuse.b, rest.b);
}

// The layers of a sample that is the sky alone.
inline std::vector<RadianceSum> layers_of_sky(const LightGroups& groups, const LayerLayout& layout, Color sky)
{
    std::vector<RadianceSum> layers(layout.size());
    add_radiance(layers.data(), layout, groups.of_sky, PathSegment::view, {}, sky);
    return layers;
}

// The channels of the layers that a film has, means over the samples of a pixel: light.GROUP.R .G .B of each group, and
// emission.R .G .B, direct.R .G .B and indirect.R .G .B, and lobe.emission.R .G .B and so on. denoised: pixels to write
// in place of the film's, layer by layer, or empty.
std::vector<ImagePlane> layer_planes(const Film& film, const std::vector<std::string>& groups,
                                     const std::vector<std::vector<Color>>& denoised = {});

}  // namespace lancer
