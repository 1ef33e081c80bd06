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
        struct Place {
            uint32_t first;
            float part, side;
        };
        static Place place(float edge, float cos, float x, float y);
        float at(const Place& p) const;
        float at(float cos, float x, float y) const { return at(place(edge, cos, x, y)); }

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
        // 1 - the hemispherical albedo.
        float mean_missing() const;

    private:
        friend AnisotropicTable;
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

}  // namespace lancer
