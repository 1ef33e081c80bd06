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

void print_differing_channels(const std::string& path, const std::string& reference)
{
    if (extension_of(path) != ".exr" || extension_of(reference) != ".exr") return;
    const std::set<std::string> ours = further_channels(path), theirs = further_channels(reference);
    std::set<std::string> all = ours;
    all.insert(theirs.begin(), theirs.end());
    if (all.empty()) return;
    size_t count = 0;
    std::string list;
    for (const std::string& name : all) {
        const bool in_both = ours.contains(name) && theirs.contains(name);
        const std::vector<float> values = read_exr_channel(ours.contains(name) ? path : reference, name);
        const size_t pixels = in_both ? differing_pixels(values, read_exr_channel(reference, name)) : values.size();
        if (pixels == 0) continue;
        list += (count++ == 0 ? ": " : ", ") + name + format_text(" %zu", pixels);
    }
    print_result(format_text("%-20s %zu of %zu", "differing_channels", count, all.size()) + list);
}

}  // namespace lancer
