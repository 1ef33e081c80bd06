// Table of the light that anisotropic GGX facets lose by shadowing and masking: what AlbedoTable is for isotropic ones,
// by cosine and azimuth. Computed by a fixed quadrature, so that the bits are always the same.
#pragma once

#include <array>
#include <vector>

#include "materials/albedo_table.h"
#include "materials/anisotropic.h"

namespace lancer {

class AnisotropicTable {
    static constexpr uint32_t cosines = 25, azimuths = 9;

    // Of one roughness and anisotropy: losses row by row, at even steps of the root of the cosine and of the azimuth of
    // a quarter turn, and their mean. With an edge (albedo_nodes.h) of the root of EdgedCosine::from in each piece.
    struct Slice {
        // Between which losses a direction lies: the first of four, and the weights of the others.
        template <class T>
        struct PlaceT {
            decltype(to_whole(T{})) first;
            T part, side;
        };
        using Place = PlaceT<float>;
        // T: float or Float4. from: the cosine, or EdgedCosine::from.
        template <class T>
        static PlaceT<T> place(T from, T x, T y);
        static Place place(float edge, float cos, float x, float y);
        float at(const Place& p) const { return table_square(&loss[p.first], azimuths).at(p.side, p.part); }

        std::vector<float> loss{};
        float mean = 0, edge = 0;
    };

public:
    // kind: reflector or coat; eta as for AlbedoTable.
    AnisotropicTable(FacetKind kind, double eta) : kind_(kind), eta_(eta) {}
    // From now on at() answers for this pair, and only for it. Roughness above 0; a few milliseconds, or some ten
    // times as many of a coat of an index below 1.
    void need(float roughness, float anisotropy);
    // The same for every pair: some sixty times as long.
    void need_all();

    // The losses of one pair; the table must outlive it.
    class At {
    public:
        explicit operator bool() const { return slices_[0] != nullptr; }
        // As AlbedoTable::Row::loss(). w: unit, along the tangent frame, z > 0.
        float loss(Vec3 w) const;
        // Four pairs, each at its own direction.
        static Float4 losses(const std::array<At, 4>& four, const Vec3T<Float4>& w);
        // 1 - the hemispherical albedo.
        float mean_missing() const;

    private:
        friend AnisotropicTable;
        // Of slices that of(i) tells.
        template <class T, class F>
        static T interpolate(T rough, T stretched, const F& of);

        std::array<const Slice*, 4> slices_{};  // low and high roughness, each of low and high anisotropy
        float rough_ = 0, stretched_ = 0;       // weights of the high ones
    };
    At at(float roughness, float anisotropy) const;

private:
    // Directions of even light: those of one cosine one behind the other.
    static constexpr int steps = 96;
    static std::vector<Slice::Place> even_light(float edge);
    float edge() const { return FacetReflectance{kind_, eta_}.edge(); }
    Slice make(float roughness, float anisotropy, const std::vector<Slice::Place>& even) const;

    FacetKind kind_;
    double eta_;
    uint32_t roughnesses_ = 1, anisotropies_ = 1;
    std::vector<Slice> slices_;  // those of one roughness one behind the other
};

inline float loss_of(const AnisotropicTable::At& at, Vec3 w) { return at ? at.loss(w) : 0; }
inline Float4 loss_of(const std::array<AnisotropicTable::At, 4>& four, const Vec3T<Float4>& w)
{
    return AnisotropicTable::At::losses(four, w);
}

}  // namespace lancer
