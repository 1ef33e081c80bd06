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

// As docs/benchmarks.md has them, by bench_features (saved/...) and scripts/startup.sh.
constexpr std::string_view time_of_kernel = "1 to 51 % of the time", time_of_module = "250 ms";
constexpr uint64_t bytes_of_module = 106'000'000;

}  // namespace

std::vector<UnusedFeature> unused_features_of(const Renderer& renderer, Profile kernel)
{
    UnusedFeatures list = renderer.scene().unused_features;
    const Features has = features_of(renderer.scene());
    std::string kinds;
    uint64_t absent = 0;
    for (size_t i = 0; i < feature_names.size(); ++i) {
        if (has.has(static_cast<Feature>(i))) continue;
        kinds += (absent++ == 0 ? "" : ", ") + std::string(feature_names[i]);
    }
    list.add("scene features: " + kinds, absent);
    if (kernel != Profile::all) list.add("general kernel", 1, 0, time_of_kernel);
    if (!is_mapped("lancer_oiio.so")) list.add("OpenImageIO module, not loaded", 1, bytes_of_module, time_of_module);
    return list.all();
}

std::string to_string(const UnusedFeature& l)
{
    std::string text = std::to_string(l.count) + " " + l.what;
    if (l.bytes) text += format_text("; saves %.3f MB", 1e-6 * static_cast<double>(l.bytes));
    if (!l.time.empty()) text += (l.bytes ? " and " : "; saves ") + l.time;
    return text;
}

}  // namespace lancer
