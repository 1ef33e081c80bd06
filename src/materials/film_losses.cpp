#include "materials/film_losses.h"

#include <cmath>

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/thin_film.h"
#include "materials/thin_sheet.h"

namespace lancer {
namespace {

constexpr Color all_light{1, 1, 1};

// Mean of f(normal) over visible normals of wo. Half of the azimuths suffice by symmetry.
template <class F>
Color mean_over_normals(const Ggx& ggx, Vec3d wo, int turns, int heights, const F& f)
{
    Color sum{};
    float weights = 0;
    for (int j = 0; j < heights; ++j) {
        const auto [v, weight] = height_node<float>(static_cast<size_t>(j), static_cast<size_t>(heights));
        for (int i = 0; i < turns; ++i) {
            const float turn = (static_cast<float>(i) + 0.5f) / static_cast<float>(2 * turns);
            sum += f(ggx.sample_visible(wo, {turn, v})) * weight, weights += weight;
        }
    }
    return sum / weights;
}

Vec3d direction_at(double cos) { return {std::sqrt((1 - cos) * (1 + cos)), 0, cos}; }

}  // namespace

// Reflectances of the smooth boundary with the film, from a table by the root of the cosine on the thinner side.
class FilmLosses::Smooth {
public:
    Smooth(float film_ior, float ior, float thickness) : dense_(double{std::max(ior, 1 / ior)})
    {
        const ThinFilm film{film_ior, thickness};
        for (uint32_t i = 0; i < count; ++i) {
            const auto root = static_cast<float>(i) / (count - 1);
            values_[i] = film.on_dielectric(root * root, static_cast<float>(dense_));
        }
    }
    double dense() const { return dense_; }
    // cos: on the thinner side.
    Color at(double cos) const
    {
        const double place = std::sqrt(std::clamp(cos, 0.0, 1.0)) * (count - 1);
        const uint32_t i = std::min(static_cast<uint32_t>(place), count - 2);
        return mix(values_[i], values_[i + 1], static_cast<float>(place - i));
    }
    // Of light at this cosine, on the side before the boundary. eta: index beyond over before.
    Color before(double cos, double eta) const
    {
        const auto [reflectance, cos_t] = fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta);
        return reflectance < 1 ? at(eta >= 1 ? cos : cos_t) : all_light;
    }

private:
    static constexpr uint32_t count = 65;
    std::array<Color, count> values_{};
    double dense_;
};

FilmLosses::FilmLosses(float film_ior, float ior, bool sheet)
    : film_ior_(film_ior),
      ior_(ior),
      edge_(FacetReflectance{sheet ? FacetKind::sheet : FacetKind::boundary, double{ior}}.edge()),
      sheet_(sheet)
{
}

void FilmLosses::need(float least_roughness, float most_roughness, float least_thickness, float most_thickness)
{
    roughness_ = FilmSteps::of_roughness(least_roughness, most_roughness);
    thickness_ = FilmSteps::of_thickness(least_thickness, most_thickness);
    nodes_.clear();
    for (uint32_t r = 0; r < roughness_.count; ++r)
        for (uint32_t t = 0; t < thickness_.count; ++t) nodes_.push_back(make(roughness_.at(r), thickness_.at(t)));
}

FilmLosses::Node FilmLosses::make(float roughness, float thickness) const
{
    const double alpha = double{std::max(least_alpha, alpha_of_roughness(roughness))}, index = double{ior_};
    const Smooth smooth(film_ior_, ior_, thickness);
    // What a smooth sheet does with light at this cosine.
    const auto part_of = [&](double cos, bool through) {
        return part_of_sheets(smooth.before(std::min(1.0, cos), index), through);
    };
    const auto loss_of_sheet = [&](Vec3d wo) {
        Color lost{};
        for (const bool through : {false, true}) {
            const Ggx ggx{alpha_of_sheet(alpha, index, through)};
            const Color all = part_of(wo.z, through);
            const double hidden_o = ggx.lambda(wo);
            const int finer = edge_ > 0 ? 2 : 1;
            lost += mean_over_normals(ggx, wo, 10 * finer, 24 * finer, [&](const Vec3d& h) {
                const Vec3d wi = mirrored(wo, h);
                if (!(wi.z > 0)) return all;
                return all - least_of(all, part_of(wi.z, through)) * static_cast<float>(1 - ggx.stopped(hidden_o, wi));
            });
        }
        return lost;
    };
    const auto loss_of_boundary = [&](Vec3d wo, double eta) {
        const Ggx ggx{alpha};
        const double hidden_o = ggx.lambda(wo);
        const int finer = eta < 1 ? 2 : 1;  // total reflection begins at an edge
        return mean_over_normals(ggx, wo, 10 * finer, 24 * finer, [&](const Vec3d& h) {
            const double cos = std::min(1.0, dot(wo, h));
            const auto [bare, cos_t] = fresnel_dielectric_double(cos, (1 - cos) * (1 + cos), eta);
            const Vec3d back = mirrored(wo, h), through = refracted(wo, h, cos, cos_t, eta);
            const double of_back = back.z > 0 ? ggx.stopped(hidden_o, back) : 1;
            const double of_through = bare < 1 && through.z < 0 ? ggx.stopped(hidden_o, through) : 1;
            const Color reflected = smooth.before(cos, eta);
            return reflected * static_cast<float>(of_back) + (all_light - reflected) * static_cast<float>(of_through);
        });
    };
    // Twice the integral of c L(c). L is linear in the root x of the piece, and c is a + b x^2 there.
    const auto mean_of_piece = [&](const Color* loss, uint32_t count, uint32_t piece) {
        const double a = edge_ > 0 ? double{cosine_of(edge_, {piece, 0})} : 0;
        const double b = edge_ > 0 ? double{cosine_of(edge_, {piece, 1})} - a : 1, scale = 4 * std::abs(b);
        Color sum{};
        for (uint32_t c = 0; c + 1 < count; ++c) {
            const double x0 = static_cast<double>(c) / (count - 1), x1 = static_cast<double>(c + 1) / (count - 1);
            const auto even = [&](double x) { return x * x * (a / 2 + b * x * x / 4); };
            const auto rising = [&](double x) { return x * x * x * (a / 3 + b * x * x / 5); };
            const double all = even(x1) - even(x0), high = (rising(x1) - rising(x0) - x0 * all) / (x1 - x0);
            sum += loss[c] * static_cast<float>(scale * (all - high)) + loss[c + 1] * static_cast<float>(scale * high);
        }
        return sum;
    };
    Node node;
    const uint32_t pieces = pieces_of(edge_);
    for (uint32_t side = 0; side < (sheet_ ? 1u : 2u); ++side) {
        std::vector<Color>& loss = node.loss[side];
        loss.resize(size_t{pieces} * cosines);
        for (uint32_t c = 0; c < pieces * cosines; ++c) {
            const double root = root_node(c % cosines, cosines);
            double cos = root * root;
            if (pieces > 1) cos = double{cosine_of(edge_, {c / cosines, static_cast<float>(cos)})};
            const Vec3d wo = direction_at(cos);
            loss[c] =
                sheet_ ? loss_of_sheet(wo) : loss_of_boundary(wo, side == 0 ? smooth.dense() : 1 / smooth.dense());
        }
        for (uint32_t piece = 0; piece < pieces; ++piece)
            node.mean[side] += mean_of_piece(&loss[size_t{piece} * cosines], cosines, piece);
    }
    constexpr uint32_t steps = 256;
    for (uint32_t i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps, cos = root * root;
        const Color through = sheet_ ? part_of(cos, true) : all_light - smooth.at(cos);
        node.through += through * static_cast<float>(4 * root * cos / steps);
    }
    return node;
}

FilmLosses::At FilmLosses::at(float roughness, float thickness) const
{
    At at;
    at.edge_ = edge_;
    const uint32_t r = roughness_.below(roughness, at.rough_), t = thickness_.below(thickness, at.thick_);
    const uint32_t next_r = std::min(r + 1, roughness_.count - 1), next_t = std::min(t + 1, thickness_.count - 1);
    const auto node = [&](uint32_t i, uint32_t j) { return &nodes_[size_t{i} * thickness_.count + j]; };
    at.nodes_ = {node(r, t), node(r, next_t), node(next_r, t), node(next_r, next_t)};
    return at;
}

template <class F>
Color FilmLosses::At::interpolate(const F& f) const
{
    if (rough_ == 0 && thick_ == 0) return f(*nodes_[0]);
    return lancer::mix(lancer::mix(f(*nodes_[0]), f(*nodes_[1]), thick_),
                       lancer::mix(f(*nodes_[2]), f(*nodes_[3]), thick_), rough_);
}

Color FilmLosses::At::loss(uint32_t side, float cos) const
{
    const EdgedCosine at = edged_cosine(edge_, std::clamp(cos, 0.0f, 1.0f));
    const NodeCell root = root_cell(at.from, cosines);
    const uint32_t c = at.piece * cosines + root.index;
    return interpolate([&](const Node& n) { return lancer::mix(n.loss[side][c], n.loss[side][c + 1], root.part); });
}
Color FilmLosses::At::mean(uint32_t side) const
{
    return interpolate([&](const Node& n) { return n.mean[side]; });
}
Color FilmLosses::At::through() const
{
    return interpolate([](const Node& n) { return n.through; });
}

}  // namespace lancer
