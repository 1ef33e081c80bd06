#include "materials/anisotropic_table.h"

#include "core/elementary.h"

namespace lancer {
namespace {

constexpr uint32_t all_roughnesses = 12, all_anisotropies = 9;

// x: in [0, 1].
NodeCell cell_in_range(float x, uint32_t nodes)
{
    if (nodes == 1) return {0, 0};
    return even_cell(x, nodes);
}

// Albedo over that of the smooth surface, subtracted from 1. Four normals at a time.
double loss_of_stretched(const AlphaPair& alpha, Vec3d wo, const FacetReflectance& reflectance)
{
    constexpr size_t most_turns = 48;
    const size_t turns = reflectance.edge() > 0 ? most_turns : 24, heights = turns;
    const double smooth = reflectance.whole(wo.z);
    if (!(smooth > 0)) return 0;
    std::array<SinCosT<Double4>, most_turns / double_lanes> phi;
    for (size_t i = 0; i < turns; ++i) {
        const SinCos at = sin_cos_2pi((static_cast<float>(i) + 0.5f) / static_cast<float>(turns));
        phi[i / 4].sin[i % 4] = at.sin, phi[i / 4].cos[i % 4] = at.cos;
    }
    const StretchedGgxT<Double4> ggx{broadcast(double{alpha.along}), broadcast(double{alpha.across})};
    const Vec3T<Double4> from = in_four_lanes(wo);
    double sum = 0, weights = 0;
    for (size_t j = 0; j < heights; ++j) {
        const auto [v, weight] = height_node<double>(j, heights);
        for (size_t i = 0; i < turns / double_lanes; ++i) {
            const Vec3T<Double4> h = ggx.sample_visible(from, broadcast(double{static_cast<float>(v)}), phi[i]);
            const Vec3T<Double4> wi = mirrored(from, h);
            const FacetReflectionT<Double4> f = eval_stretched(ggx, from, wi);
            const Double4 part =
                select(wi.z > 0.0, (f.f_cos / f.pdf) * (reflectance(dot(from, h)) / smooth), Double4{});
            for (size_t lane = 0; lane < double_lanes; ++lane) sum += weight * part[lane], weights += weight;
        }
    }
    return 1 - sum / weights;
}

// turn: of a quarter.
Vec3d direction(double cos, double turn)
{
    const double r = std::sqrt((1 - cos) * (1 + cos)), phi = 0.5 * pi_d * turn;
    return Vec3d{r * std::cos(phi), r * std::sin(phi), cos};
}

}  // namespace

template <class T>
AnisotropicTable::Slice::PlaceT<T> AnisotropicTable::Slice::place(T from, T x, T y)
{
    const NodeCellT<T> c = root_cell(from, cosines);
    const NodeCellT<T> a = even_cell(part_of_quarter(abs(x), abs(y)), azimuths);
    return {c.index * azimuths + a.index, c.part, a.part};
}

AnisotropicTable::Slice::Place AnisotropicTable::Slice::place(float edge, float cos, float x, float y)
{
    const EdgedCosine at = edged_cosine(edge, std::clamp(cos, 0.0f, 1.0f));
    Place p = place(at.from, x, y);
    p.first += at.piece * cosines * azimuths;
    return p;
}

std::vector<AnisotropicTable::Slice::Place> AnisotropicTable::even_light(float edge)
{
    std::vector<Slice::Place> places;
    places.reserve(steps * steps);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const Vec3 w = to_float(direction(std::sqrt((i + 0.5) / steps), (j + 0.5) / steps));
            places.push_back(Slice::place(edge, w.z, w.x, w.y));
        }
    return places;
}

AnisotropicTable::Slice AnisotropicTable::make(float roughness, float anisotropy,
                                               const std::vector<Slice::Place>& even) const
{
    const FacetReflectance reflectance{kind_, eta_};
    const AlphaPair alpha = alphas_of(roughness, anisotropy);
    Slice slice;
    slice.edge = reflectance.edge();
    const uint32_t pieces = pieces_of(slice.edge);
    slice.loss.resize(size_t{pieces} * cosines * azimuths);
    for (uint32_t c = 0; c < pieces * cosines; ++c)
        for (uint32_t a = 0; a < azimuths; ++a) {
            const double root = root_node(c % cosines, cosines);
            double cos = root * root;
            if (pieces > 1) cos = double{cosine_of(slice.edge, {c / cosines, static_cast<float>(cos)})};
            const Vec3d wo = direction(cos, static_cast<double>(a) / (azimuths - 1));
            slice.loss[c * azimuths + a] = static_cast<float>(loss_of_stretched(alpha, wo, reflectance));
        }
    // Of the interpolated losses.
    double sum = 0;
    const Slice::Place* place = even.data();
    for (int i = 0; i < steps; ++i) {
        const double r = reflectance.whole(std::sqrt((i + 0.5) / steps));
        for (int j = 0; j < steps; ++j) sum += (1 - r) + r * static_cast<double>(slice.at(*place++));
    }
    slice.mean = static_cast<float>(sum / (steps * steps));
    return slice;
}

void AnisotropicTable::need(float roughness, float anisotropy)
{
    if (slices_.empty()) slices_.push_back(make(roughness, anisotropy, even_light(edge())));
}

void AnisotropicTable::need_all()
{
    roughnesses_ = all_roughnesses, anisotropies_ = all_anisotropies;
    slices_.clear();
    const std::vector<Slice::Place> even = even_light(edge());
    for (uint32_t r = 0; r < roughnesses_; ++r)
        for (uint32_t a = 0; a < anisotropies_; ++a)
            slices_.push_back(make(std::max(0.02f, static_cast<float>(r) / (all_roughnesses - 1)),
                                   static_cast<float>(a) / (all_anisotropies - 1), even));
}

AnisotropicTable::At AnisotropicTable::at(float roughness, float anisotropy) const
{
    const auto [r, rough] = cell_in_range(roughness, roughnesses_);
    const auto [a, stretched] = cell_in_range(anisotropy, anisotropies_);
    const uint32_t next_r = std::min(r + 1, roughnesses_ - 1), next_a = std::min(a + 1, anisotropies_ - 1);
    At at;
    at.slices_ = {&slices_[r * anisotropies_ + a], &slices_[r * anisotropies_ + next_a],
                  &slices_[next_r * anisotropies_ + a], &slices_[next_r * anisotropies_ + next_a]};
    at.rough_ = rough, at.stretched_ = stretched;
    return at;
}

template <class T, class F>
T AnisotropicTable::At::interpolate(T rough, T stretched, const F& of)
{
    const auto mixed = [&](size_t i) {
        const T low = of(i);
        return low + (of(i + 1) - low) * stretched;
    };
    const T low = mixed(0);
    return low + (mixed(2) - low) * rough;
}

float AnisotropicTable::At::loss(Vec3 w) const
{
    const auto of = [&](size_t i) { return slices_[i]->at(Slice::place(slices_[i]->edge, w.z, w.x, w.y)); };
    return rough_ == 0 && stretched_ == 0 ? of(0) : interpolate(rough_, stretched_, of);
}

Float4 AnisotropicTable::At::losses(const std::array<At, 4>& four, const Vec3T<Float4>& w)
{
    Float4 rough{}, stretched{};
    bool has_edge = false;
    for (size_t i = 0; i < 4; ++i) {
        rough[i] = four[i].rough_, stretched[i] = four[i].stretched_;
        has_edge = has_edge || (four[i] && four[i].slices_[0]->edge > 0);
    }
    if (has_edge) {
        const auto one = [&](size_t i) { return loss_of(four[i], Vec3{w.x[i], w.y[i], w.z[i]}); };
        return Float4{one(0), one(1), one(2), one(3)};
    }
    static constexpr std::array<float, azimuths + 2> none{};
    const Slice::PlaceT<Float4> p = Slice::place(w.z, w.x, w.y);
    const auto of = [&](size_t slice) {
        const auto at = [&](size_t i) { return four[i] ? &four[i].slices_[slice]->loss[p.first[i]] : none.data(); };
        return table_square(std::array{at(0), at(1), at(2), at(3)}, azimuths).at(p.side, p.part);
    };
    return movemask((rough != 0.0f) | (stretched != 0.0f)) == 0 ? of(0) : interpolate(rough, stretched, of);
}

float AnisotropicTable::At::mean_missing() const
{
    return interpolate(rough_, stretched_, [&](size_t i) { return slices_[i]->mean; });
}

}  // namespace lancer
