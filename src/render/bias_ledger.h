// The bias ledger: whatever keeps the mean of a picture from the light that the scene describes, however many samples
// it has. Pictures carry it in their header, and docs/architecture.md lists its entries.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/description/render_settings.h"

namespace lancer {

// What happened while rendering, and matters to the ledger.
struct LedgerEvents {
    std::string stopped_by;  // "time", "error"; empty: neither
    uint64_t dropped = 0;    // samples that were not finite
    bool denoised = false;
    bool caught_shadows = false;  // alpha has those on surfaces that catch them
    bool no_scattering = false;   // media would scatter, but the integrator only lets them absorb
};

// The entries of a picture, separated by commas; "none" if there are none. settings: resolved.
std::string bias_ledger(const RenderSettings& settings, const LedgerEvents& events);

// An entry that a ledger may have.
struct LedgerEntry {
    std::string entry;
    std::string when, effect;  // for readers
};
std::vector<LedgerEntry> all_ledger_entries();

}  // namespace lancer
