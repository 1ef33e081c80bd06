#include "app/specialisation.h"

#include <fstream>

#include "app/console.h"
#include "scene/features.h"

namespace lancer {
namespace {

// Whether a library of this name is in the memory of the program.
bool is_mapped(const std::string& name)
{
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);)
        if (line.find(name) != std::string::npos) return true;
    return false;
}

}  // namespace

std::vector<UnusedFeature> unused_features_of(const Renderer& renderer, Profile kernel)
{
    UnusedFeatures list = renderer.scene().unused_features;
    const Features has = features_of(renderer.scene());
    std::string kinds;
    uint64_t absent = 0;
    for (size_t i = 0; i < static_cast<size_t>(Feature::count); ++i) {
        if (has.has(static_cast<Feature>(i))) continue;
        kinds += (absent++ == 0 ? "" : ", ") + name_of(static_cast<Feature>(i));
    }
    list.add("scene features: " + kinds, absent);
    if (kernel != Profile::all) list.add("general kernel", 1);
    if (!is_mapped("lancer_oiio.so")) list.add("OpenImageIO module, not loaded", 1);
    return list.all();
}

std::string to_string(const UnusedFeature& l)
{
    std::string text = std::to_string(l.count) + " " + l.what;
    if (l.bytes) text += format_text("; saves %.3f MB", 1e-6 * static_cast<double>(l.bytes));
    return text;
}

}  // namespace lancer
