#include "io/image/exr_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace lancer {
namespace {

std::string in_capitals(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

struct Layer {
    std::string name;
    std::vector<std::string> channels;  // full names

    // The full name of the channel that is called so within the layer; empty: there is none.
    std::string find(std::string_view last) const
    {
        for (const std::string& channel : channels)
            if (in_capitals(channel.substr(channel.rfind('.') + 1)) == last) return channel;
        return {};
    }
    bool has(std::string_view last) const { return !find(last).empty(); }
};

std::vector<Layer> layers_of(const std::vector<std::string>& channels)
{
    std::vector<Layer> layers;
    for (const std::string& channel : channels) {
        const size_t dot = channel.rfind('.');
        const std::string name = dot == std::string::npos ? "" : channel.substr(0, dot);
        auto it = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
        if (it == layers.end()) it = layers.insert(layers.end(), {name, {}});
        it->channels.push_back(channel);
    }
    return layers;
}

enum class LayerKind { color, luminance, other, none };

// Fills `found`, but for its part.
LayerKind read_layer(const Layer& layer, ExrChannels& found)
{
    found.alpha = layer.find("A");
    if (layer.has("R") && layer.has("G") && layer.has("B")) {
        found.colors = {layer.find("R"), layer.find("G"), layer.find("B")};
        return LayerKind::color;
    }
    if (layer.has("RY") || layer.has("BY")) return LayerKind::none;
    if (layer.has("Y") && !layer.has("X")) {
        found.colors = {layer.find("Y")};
        return LayerKind::luminance;
    }
    std::vector<std::string> rest = layer.channels;
    if (rest.size() > 1) rest.erase(std::remove(rest.begin(), rest.end(), found.alpha), rest.end());
    if (rest.empty() || rest.size() > 3) return LayerKind::none;
    if (rest.size() == 1) {
        if (rest[0] == found.alpha) found.alpha.clear();
    } else if (rest.size() == 2 && layer.has("R") + layer.has("G") + layer.has("B") == 2) {
        rest = {layer.find("R"), layer.find("G"), layer.find("B")};
    }
    if (rest.size() == 2) rest.emplace_back();
    found.colors = rest;
    return LayerKind::other;
}

// The lower, the earlier.
int rank_of(LayerKind kind, const std::string& layer)
{
    const std::string last = in_capitals(layer.substr(layer.rfind('.') + 1));
    const bool is_whole = last == "COMBINED" || last == "BEAUTY" || last == "RGBA";
    return 3 * static_cast<int>(kind) + (layer.empty() ? 0 : is_whole ? 1 : 2);
}

}  // namespace

std::optional<ExrChannels> choose_exr_channels(const std::vector<std::vector<std::string>>& parts)
{
    std::optional<ExrChannels> best;
    int best_rank = 0;
    for (size_t part = 0; part < parts.size(); ++part)
        for (const Layer& layer : layers_of(parts[part])) {
            ExrChannels found{.part = part, .colors = {}};
            const LayerKind kind = read_layer(layer, found);
            const int rank = rank_of(kind, layer.name);
            if (kind == LayerKind::none || (best && rank >= best_rank)) continue;
            best = std::move(found);
            best_rank = rank;
        }
    return best;
}

}  // namespace lancer
