#include "app/compared_channels.h"

#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "app/console.h"
#include "app/paths.h"
#include "io/image/exr.h"

namespace lancer {
namespace {

std::set<std::string> further_channels(const std::string& path)
{
    std::set<std::string> names;
    for (const ExrInfo::Channel& c : read_exr_info(path).channels) names.insert(c.name);
    for (const char* color : {"R", "G", "B"}) names.erase(color);
    return names;
}

bool same_value(float a, float b)
{
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

size_t differing_pixels(const std::vector<float>& a, const std::vector<float>& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += same_value(a[i], b[i]) ? 0 : 1;
    return count;
}

}  // namespace

DifferingChannels differing_channels(const std::string& path, const std::string& reference)
{
    DifferingChannels result;
    if (extension_of(path) != ".exr" || extension_of(reference) != ".exr") return result;
    const std::set<std::string> ours = further_channels(path), theirs = further_channels(reference);
    std::set<std::string> all = ours;
    all.insert(theirs.begin(), theirs.end());
    result.count = all.size();
    for (const std::string& name : all) {
        const bool in_both = ours.contains(name) && theirs.contains(name);
        const std::vector<float> values = read_exr_channel(ours.contains(name) ? path : reference, name);
        const size_t pixels = in_both ? differing_pixels(values, read_exr_channel(reference, name)) : values.size();
        if (pixels > 0) result.differing.emplace_back(name, pixels);
    }
    return result;
}

void print_differing_channels(const DifferingChannels& channels)
{
    if (channels.count == 0) return;
    std::string list;
    for (const auto& [name, pixels] : channels.differing)
        list += (list.empty() ? ": " : ", ") + name + format_text(" %zu", pixels);
    print_result(format_text("%-20s %zu of %zu", "differing_channels", channels.differing.size(), channels.count) +
                 list);
}

}  // namespace lancer
