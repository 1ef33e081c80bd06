// Multiple scattering between the rough facets of glass. What single scattering loses comes back in two even lobes, one
// on each side of the surface, by Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017
// courses. With L(mu) the part that is lost of light from one side, L'(mu) from the other and M, M' their means under
// even light, both weighted by the cosine, the lobes of energy are
//   (1 - T) L(mu_o) L(mu_i) / (pi M)  and  T L(mu_o) L'(mu_i) / (pi M'),
// which together are L(mu_o). T, what goes through, is (1 - F) M' / max(M, M') with the mean reflectance F of the
// smooth boundary: then light may travel both ways, since (1 - F) n^2 = (1 - F') n'^2.
#pragma once

#include <memory>
#include <vector>

#include "core/color.h"
#include "materials/albedo_table.h"

namespace lancer {

// The two lobes at one point. T: float, or Float4 for those of four points.
template <class T>
struct GlassLobesT {
    AlbedoTable::EvenLobeT<T> here, beyond;  // L on wo's side and on the other; none: nothing is made up for
    SpectrumOf<T> color{};                   // of both lobes
    T reflected{}, transmitted{};            // their factors before L L' cos / pi, of radiance
    T part_through{};                        // T

    explicit operator bool() const { return static_cast<bool>(here); }
    // Those of one of four points.
    GlassLobesT<float> of(size_t i) const
    {
        return {here.of(i),   beyond.of(i),   {color.x[i], color.y[i], color.z[i]},
                reflected[i], transmitted[i], part_through[i]};
    }
};
using GlassLobes = GlassLobesT<float>;

// Of all points of a glass.
class GlassLosses {
public:
    // ior: of the inside over that of the outside, finite, > 0; of a thin sheet that of its glass.
    GlassLosses(float ior, bool thin);

    // From now on lobes() answers for this alpha in (0, 1]: about 5 ms for a body; need_all(): for every alpha, 28
    // times as long.
    void need(float alpha);
    void need_all();
    // The glass also touches a medium of this index, its own being `ior`: nested dielectrics.
    void touch(float outer_ior);

    // eta: index beyond the surface over index on wo's side; the nearest one is taken of those that are known. front:
    // wo is on the outside. tint: of each crossing and reflection.
    GlassLobes lobes(double eta, bool front, float alpha, Color tint) const;

private:
    struct Boundary {
        AlbedoTable outer, inner;  // L of light that comes from the outside and from the inside
        double eta;                // inside over outside
        double through;            // 1 - F from the outside
    };
    GlassLobes lobes_of_body(double eta, bool front, float alpha, Color tint) const;
    GlassLobes lobes_of_sheet(float alpha, Color tint) const;
    void add(double eta);
    void fill(Boundary& boundary) const;

    float ior_;
    bool thin_, all_ = false;
    std::vector<float> alphas_;
    std::vector<Boundary> boundaries_;  // the first one: of ior
};

}  // namespace lancer
