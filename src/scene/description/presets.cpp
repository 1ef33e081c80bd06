#include "scene/description/presets.h"

#include <algorithm>
#include <array>

namespace lancer {
namespace {

struct Preset {
    std::string_view name;
    Phong phong;
};

// ambient, diffuse, specular, shininess, diffusion, reflexion, refraction, index inside, index outside
constexpr std::array<Preset, 13> presets{
    {{"white_plastic", {{0.1f, 0.1f, 0.1f}, {0.7f, 0.7f, 0.7f}, {1, 1, 0.98f}, 5, 0.9f, 0.1f, 0, 1, 1}},
     {"red_plastic", {{0.1f, 0, 0}, {0.85f, 0.05f, 0.05f}, {1, 0.8f, 0.8f}, 5, 1, 0.05f, 0, 1, 1}},
     {"bronze",
      {{0.1125f, 0.0675f, 0.054f}, {0.714f, 0.4284f, 0.18144f}, {0.9f, 0.8f, 0.7f}, 56, 0.5f, 0.75f, 0, 1, 1}},
     {"emerald", {{0, 0.01f, 0}, {0.09568f, 0.77424f, 0.1f}, {0.9f, 1, 0.9f}, 76.8f, 0.15f, 0.5f, 0.65f, 1.5f, 1}},
     {"glass", {{0, 0, 0}, {0.95f, 0.95f, 1}, {1, 1, 1}, 80, 0.01f, 0.05f, 0.98f, 1.5f, 1}},
     {"black_matter", {{0.05f, 0.05f, 0.05f}, {0.1f, 0.1f, 0.1f}, {0.2f, 0.2f, 0.2f}, 0.5f, 1, 0, 0, 1, 1}},
     {"sand", {{0.1f, 0.075f, 0.05f}, {1, 0.9f, 0.7f}, {1, 1, 0.98f}, 2, 1, 0, 0, 1, 1}},
     {"mirror", {{0, 0, 0}, {0.05f, 0.05f, 0.05f}, {0.98f, 0.99f, 1}, 80, 0.01f, 0.99f, 0, 1, 1}},
     {"blue_water", {{0.1f, 0.1f, 0.2f}, {0.1f, 0.6f, 0.8f}, {1, 1, 1}, 70, 0.01f, 0.2f, 0.8f, 1.3f, 1}},
     {"grey_matter", {{0, 0, 0}, {0.45f, 0.45f, 0.45f}, {0.5f, 0.5f, 0.5f}, 0.5f, 1, 0, 0, 1, 1}},
     {"steel", {{0.05f, 0.05f, 0.05f}, {0.3f, 0.3f, 0.31f}, {0.7f, 0.7f, 0.71f}, 10, 0.8f, 0.2f, 0, 1, 1}},
     {"ruby", {{0.15f, 0, 0}, {0.7f, 0, 0.05f}, {1, 0.9f, 0.9f}, 76.8f, 0.25f, 0.25f, 0.5f, 1.5f, 1}},
     {"grey_metallic", {{0.05f, 0.05f, 0.05f}, {0.75f, 0.75f, 0.8f}, {1, 1, 1}, 30, 0.9f, 0.1f, 0, 1, 1}}}};

}  // namespace

std::vector<std::string_view> names_of_presets()
{
    std::vector<std::string_view> names;
    for (const Preset& p : presets) names.push_back(p.name);
    return names;
}

std::optional<MaterialDescription> find_preset(std::string_view name)
{
    const auto is_it = [=](const Preset& p) { return p.name == name; };
    const auto* preset = std::find_if(presets.begin(), presets.end(), is_it);
    if (preset == presets.end()) return {};
    MaterialDescription m;
    m.name = name;
    m.type = MaterialType::interface;
    m.base_color = preset->phong.diffuse;
    m.phong = preset->phong;
    return m;
}

std::vector<std::string_view> names_of_materials(const SceneDescription& scene)
{
    std::vector<std::string_view> names;
    for (const MaterialDescription& m : scene.materials) names.push_back(m.name);
    const auto own = static_cast<std::ptrdiff_t>(names.size());
    for (const Preset& p : presets)
        if (std::find(names.begin(), names.begin() + own, p.name) == names.begin() + own) names.push_back(p.name);
    return names;
}

}  // namespace lancer
