#include "scene/description/metals.h"

#include <algorithm>
#include <array>

namespace lancer {
namespace {

// Sources. Ag, Au, Cu: Johnson, Christy, "Optical Constants of the Noble Metals", Phys. Rev. B 6, 4370 (1972). Cr, Fe,
// Ni, Ti: the same, "Optical Constants of Transition Metals", Phys. Rev. B 9, 5056 (1974). Al: McPeak et al.,
// "Plasmonic Films Can Easily Be Better", ACS Photonics 2, 326 (2015). Pt: Rakic et al., "Optical Properties of
// Metallic Films for Vertical-Cavity Optoelectronic Devices", Appl. Opt. 37, 5271 (1998), Lorentz-Drude model. W:
// Weaver, Olson, Lynch, "Optical Properties of Crystalline Tungsten", Phys. Rev. B 12, 1293 (1975). Brass, 70 % Cu and
// 30 % Zn: Querry, "Optical Constants", report CRDC-CR-85034 (1985).
//
// From spectra to channels: the reflectance of the tabulated indices from the front, and its cosine-weighted mean over
// the hemisphere, were integrated from 380 to 750 nm under D65 with the CIE 1931 observer and taken to linear sRGB. The
// indices of a channel are those that have both of its reflectances. The red of gold lies outside of sRGB (1.037); its
// indices are the means of the spectral ones, with the same weights, and reflect 0.983.
constexpr std::array<MeasuredMetal, 11> metals{
    {{"Ag", "silver", {0.0574f, 0.0554f, 0.0432f}, {4.525f, 3.562f, 2.592f}},
     {"Al", "aluminium", {1.203f, 0.767f, 0.468f}, {6.812f, 5.786f, 4.689f}},
     {"Au", "gold", {0.0588f, 0.491f, 1.483f}, {3.613f, 2.240f, 1.781f}},
     {"Cr", "chromium", {3.243f, 3.119f, 2.286f}, {3.286f, 3.337f, 3.117f}},
     {"Cu", "copper", {0.267f, 1.047f, 1.299f}, {3.745f, 2.628f, 2.365f}},
     {"Fe", "iron", {2.922f, 2.921f, 2.547f}, {3.077f, 2.937f, 2.750f}},
     {"Ni", "nickel", {2.051f, 1.907f, 1.733f}, {4.216f, 3.573f, 2.899f}},
     {"Pt", "platinum", {2.368f, 2.078f, 1.836f}, {4.250f, 3.670f, 3.098f}},
     {"Ti", "titanium", {2.763f, 2.508f, 2.243f}, {3.850f, 3.398f, 3.016f}},
     {"W", "tungsten", {3.639f, 3.495f, 3.315f}, {2.924f, 2.748f, 2.506f}},
     {"brass", "brass", {0.555f, 0.525f, 1.132f}, {4.706f, 2.675f, 1.815f}}}};

}  // namespace

std::optional<MeasuredMetal> find_metal(std::string_view name)
{
    const auto* const found = std::find_if(metals.begin(), metals.end(),
                                           [&](const MeasuredMetal& m) { return m.symbol == name || m.name == name; });
    return found == metals.end() ? std::nullopt : std::optional(*found);
}

std::vector<std::string_view> names_of_metals()
{
    std::vector<std::string_view> names;
    for (const MeasuredMetal& m : metals) names.push_back(m.symbol);
    for (const MeasuredMetal& m : metals)
        if (m.name != m.symbol) names.push_back(m.name);
    return names;
}

}  // namespace lancer
