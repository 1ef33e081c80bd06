// The switches of a render: --set NAME=true|false, or NAME in [render].
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lancer {

enum class Switch {
    nee,           // next-event estimation: a shadow ray to a sampled light at each vertex
    mis,           // weight it against BSDF sampling; off: nee alone where it can, else BSDF sampling alone
    direct,        // direct illumination
    indirect,      // indirect illumination
    emitters,      // emission seen by the camera, directly or by mirrors and glass
    fresnel,       // smooth boundaries reflect and refract by the Fresnel equations; off: glass only refracts
    soft_shadows,  // sphere lights cast soft shadows; off: sampled at their centres
    always_nee,    // also where sampling the BSDF finds the same light with the same density
    light_tree,    // many lights are sampled by their importance at the point; off: by power alone
    split,         // paths split at their first diffuse or rough vertex; see render/estimators/pilot.h
    roulette,      // adjoint-driven Russian roulette; off: by the throughput alone
    stop,          // end a pixel whose mean is known well enough
    multiscatter,  // energy compensation for multiple scattering of rough metal
    terminator,    // shadow terminator fix for smooth normals
    legacy,        // the methods of the two programs that lancer replaces, with their faults
};
inline constexpr std::array<std::string_view, 15> switch_names{
    "nee",        "mis",   "direct",   "indirect", "emitters",     "fresnel",    "soft_shadows", "always_nee",
    "light_tree", "split", "roulette", "stop",     "multiscatter", "terminator", "legacy"};

// Values of switches that a source gives explicitly.
using SaidSwitches = std::array<std::optional<bool>, switch_names.size()>;

class Switches {
public:
    static constexpr bool default_of(Switch s)
    {
        return s != Switch::always_nee && s != Switch::stop && s != Switch::multiscatter && s != Switch::terminator &&
               s != Switch::legacy;
    }
    Switches()
    {
        for (size_t i = 0; i < on_.size(); ++i) on_[i] = default_of(static_cast<Switch>(i));
    }
    bool operator[](Switch s) const { return on_[static_cast<size_t>(s)]; }
    void set(Switch s, bool on) { on_[static_cast<size_t>(s)] = on; }
    void take(const SaidSwitches& said)
    {
        for (size_t i = 0; i < on_.size(); ++i) on_[i] = said[i].value_or(on_[i]);
    }

private:
    std::array<bool, switch_names.size()> on_{};
};

}  // namespace lancer
