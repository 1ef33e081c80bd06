// What rough facets of glass lose under a thin film, by channel: multiple scattering between facets sends it back (see
// glass_losses.h), so that no light is lost. A film changes what facets reflect and so what they lose, as more of what
// is reflected is lost than of what goes through. Computed by a fixed quadrature, so that the bits are always the same.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "materials/albedo_table.h"
#include "materials/film_table.h"

namespace lancer {

class FilmLosses {
    static constexpr uint32_t cosines = 25;

    // Of one roughness and thickness; of a body from its thinner and from its denser side, of a sheet the first.
    struct Node {
        std::array<std::vector<Color>, 2> loss{};  // as AnisotropicTable has them by the cosine
        std::array<Color, 2> mean{};               // weighted by the cosine
        Color through{};  // 1 - F of the smooth boundary from the thinner side, or what goes through the smooth sheet
    };

public:
    // ior: of the glass over that outside.
    FilmLosses(float film_ior, float ior, bool sheet);
    // As FilmTable::need(): some milliseconds for one of each, a third of a second for ranges.
    void need(float least_roughness, float most_roughness, float least_thickness, float most_thickness);

    // Of one roughness and thickness; the table must outlive it.
    class At {
    public:
        explicit operator bool() const { return nodes_[0] != nullptr; }
        // side: 1 is the denser one of a body. cos: in (0, 1].
        Color loss(uint32_t side, float cos) const;
        Color mean(uint32_t side) const;
        Color through() const;

    private:
        friend FilmLosses;
        template <class F>
        Color interpolate(const F& f) const;

        std::array<const Node*, 4> nodes_{};      // low and high roughness, each of low and high thickness
        float rough_ = 0, thick_ = 0, edge_ = 0;  // weights of the high ones; as in albedo_nodes.h
    };
    At at(float roughness, float thickness) const;

private:
    class Smooth;
    Node make(float roughness, float thickness) const;

    float film_ior_, ior_, edge_;
    bool sheet_;
    FilmSteps roughness_{}, thickness_{};
    std::vector<Node> nodes_;  // those of one roughness one behind the other
};

}  // namespace lancer
