// Table of what a thin film on a rough dielectric reflects, by cosine, roughness and thickness: with a film the share
// differs by channel, and from facet to facet otherwise than that of the bare dielectric. Computed by a fixed
// quadrature, so that the bits are always the same.
#pragma once

#include <cstdint>
#include <vector>

#include "core/color.h"

namespace lancer {

// Even steps between two numbers, for tables of films.
struct FilmSteps {
    float least, most;
    uint32_t count;

    static FilmSteps of_roughness(float least, float most) { return {least, most, least < most ? 9u : 1u}; }
    static FilmSteps of_thickness(float least, float most) { return {least, most, least < most ? 24u : 1u}; }
    float at(uint32_t i) const;
    // The step below x, and how far x is on the way to the next.
    uint32_t below(float x, float& part) const;
};

class FilmTable {
public:
    // film_ior, base_ior: over that outside.
    FilmTable(float film_ior, float base_ior) : film_ior_(film_ior), base_ior_(base_ior) {}
    // From now on albedo() answers for every roughness and thickness between these, all above 0: a few milliseconds for
    // one of each, up to a fifth of a second for ranges.
    void need(float least_roughness, float most_roughness, float least_thickness, float most_thickness);
    // Of one scattering. cos: in (0, 1].
    Color albedo(float cos, float roughness, float thickness) const;

private:
    void fill(Color* row, float roughness, float thickness) const;

    float film_ior_, base_ior_;
    FilmSteps roughness_{}, thickness_{};
    std::vector<Color> albedo_;  // by roughness, thickness and the root of the cosine
};

}  // namespace lancer
