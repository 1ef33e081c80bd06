#include "app/render/layer_names.h"

#include <array>
#include <string_view>

namespace lancer {
namespace {

// Layers, or whole names of channels. Nuke splits a name at its first dot and knows Z as its depth. Blender's names are
// those of its passes. It takes them as passes of a layer without a name, beside R, G and B as the combined picture;
// with a layer before them it would see that picture alone.
struct AovNames {
    std::string_view lancer, nuke, blender;
};
constexpr std::array rows{
    AovNames{"normal", "N", "Normal"},
    AovNames{"position", "P", "Position"},
    AovNames{"depth", "distance", "distance"},
    AovNames{"Z", "Z", "Depth.Z"},
    AovNames{"uv", "UV", "UV"},
    AovNames{"flat", "flat", "DiffCol"},
    AovNames{"emission", "emission", "Emit"},
    AovNames{"oidn.albedo", "oidn_albedo", "Denoising Albedo"},
    AovNames{"oidn.normal", "oidn_normal", "Denoising Normal"},
};

}  // namespace

std::string layer_name(const std::string& channel, LayerNames names)
{
    if (names == LayerNames::lancer) return channel;
    const size_t dot = channel.rfind('.');
    const std::string layer = channel.substr(0, dot), suffix = dot == std::string::npos ? "" : channel.substr(dot);
    for (const AovNames& row : rows)
        if (layer == row.lancer) return std::string(names == LayerNames::nuke ? row.nuke : row.blender) + suffix;
    constexpr std::string_view group = "light.", lobe = "lobe.";
    if (layer.starts_with(lobe)) return "lobe_" + layer.substr(lobe.size()) + suffix;
    if (!layer.starts_with(group)) return channel;
    return (names == LayerNames::nuke ? "light_" : "Combined_") + layer.substr(group.size()) + suffix;
}

}  // namespace lancer
