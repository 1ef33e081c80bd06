// The principled material, in double and written from docs/integrators.md and the papers that it names; without what
// is let through, and without a direction of the facets. Albedos are found by quadratures of its own.
#pragma once

#include <memory>
#include <vector>

#include "reference/multiple.h"
#include "reference/vector.h"
#include "scene/description/material.h"

namespace reference {

// A number by the cosine, linear between even steps of its root.
template <class T>
struct ByCosine {
    std::vector<T> nodes;

    template <class F>
    static ByCosine of(int steps, const F& f)
    {
        ByCosine table;
        for (int i = 0; i <= steps; ++i) table.nodes.push_back(f(std::max(1e-5, std::pow(double(i) / steps, 2))));
        return table;
    }
    T at(double cos) const
    {
        const double place = std::sqrt(std::clamp(cos, 0.0, 1.0)) * static_cast<double>(nodes.size() - 1);
        const size_t i = std::min(static_cast<size_t>(place), nodes.size() - 2);
        return nodes[i] + (nodes[i + 1] - nodes[i]) * (place - static_cast<double>(i));
    }
};

class PrincipledModel {
public:
    explicit PrincipledModel(const lancer::MaterialDescription& what);

    // f |cos(wi)| without what is sharp, and what the mirror direction gets; base: of this place.
    Rgb eval(Vec wo, Vec wi, Rgb base) const;
    Rgb mirror(Vec wo, Rgb base) const;

private:
    Rgb metal(double cos, Rgb base) const;
    Rgb dielectric(double cos) const;
    Rgb film_over(double cos, bool on_metal, Rgb metal) const;
    double fuzz_value(Vec wo, Vec wi) const;
    double under_fuzz(double cos) const;
    Rgb under_coat(double cos, Rgb base) const;
    Rgb body(Vec wo, Vec wi, Rgb base) const;

    lancer::MaterialDescription what_;
    double alpha_, coat_alpha_, index_, metallic_, fuzz_scale_ = 1;
    ByCosine<Rgb> reflected_;  // by the dielectric's facets
    ByCosine<double> coat_, fuzz_;
    double mean_through_ = 1, coat_mean_through_ = 1;
};

}  // namespace reference
