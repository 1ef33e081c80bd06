// What can be switched on or off in a render: --set NAME=true|false, or NAME in [render].
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lancer {

enum class Switch {
    nee,           // next-event estimation: a shadow ray to a sampled light at each vertex
    mis,           // weight it against BSDF sampling; off: nee alone where it can, else BSDF sampling alone
    direct,        // light that reaches a surface straight from a light
    indirect,      // light that comes by way of other surfaces
    emitters,      // what emits is seen by the camera, also in mirrors and through glass
    fresnel,       // smooth boundaries reflect and refract by the Fresnel equations; off: glass only refracts
    soft_shadows,  // spheres of light cast shadows as large as they are; off: as from their centres
    always_nee,    // also where sampling the BSDF finds the same light with the same density
    light_tree,    // of many lights one is chosen by what it may send to the place; off: by power alone
    split,         // paths split into several where that pays; see render/estimators/pilot.h
    roulette,      // by what the pixel shows; off: by the throughput alone
    stop,          // end a pixel whose mean is known well enough
    multiscatter,  // rough metal loses no light between its facets
    terminator,    // softer edges of shadow on smoothed meshes
    legacy,        // the ways of the two programs that this one grew from, their faults included
};
inline constexpr std::array<std::string_view, 15> switch_names{
    "nee",        "mis",   "direct",   "indirect", "emitters",     "fresnel",    "soft_shadows", "always_nee",
    "light_tree", "split", "roulette", "stop",     "multiscatter", "terminator", "legacy"};

// What somebody said of them.
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
