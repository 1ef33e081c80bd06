#include "render/aov.h"

#include <optional>

#include "integrators/media.h"
#include "materials/material.h"
#include "render/blocks.h"
#include "render/denoise/features.h"

namespace lancer {
namespace {

// Calls f for a material; for a mix, the weighted mean of both parts.
template <class F>
Color mixed(const Scene& scene, uint32_t id, const ShadingPoint& point, const F& f)
{
    if (scene.mix_of.empty() || scene.mix_of[id] == Scene::none) return f(scene.materials[id]);
    const Mix& mix = scene.mixes[scene.mix_of[id]];
    const float w = std::clamp(point.eval(mix.weight), 0.0f, 1.0f);
    return mixed(scene, mix.first, point, f) * (1 - w) + mixed(scene, mix.second, point, f) * w;
}

Color base_color_of(const Material& material, const ShadingPoint& point)
{
    return std::visit([&](const auto& m) { return point.base(lancer::base_color_of(m)); }, material);
}

void add(double* sum, double x, double y, double z) { sum[0] += x, sum[1] += y, sum[2] += z; }
void add(double* sum, Color c) { add(sum, double{c.r}, double{c.g}, double{c.b}); }
void add(double* sum, Vec3 v) { add(sum, double{v.x}, double{v.y}, double{v.z}); }

// How the channels of an AOV are computed: a sum, divided by a count if there is one, or from the radiance sums.
struct Channels {
    std::string_view names;
    std::optional<AovSum> sum{}, count{};
};
constexpr std::array<Channels, enum_names<Aov>.size()> channels_of_aovs{{
    {"RGB", AovSum::albedo, AovSum::samples},
    {"XYZ", AovSum::normal, AovSum::samples},
    {"Z", AovSum::depth, AovSum::hits},
    {"XYZ", AovSum::position, AovSum::hits},
    {"UV", AovSum::uv, AovSum::hits},
    {"I", AovSum::material},
    {"V"},
    {"A", AovSum::hits, AovSum::samples},
    {"RGB", AovSum::flat, AovSum::samples},
    {"N"},
    {"Z", AovSum::z, AovSum::hits},
}};
static_assert(std::all_of(channels_of_aovs.begin(), channels_of_aovs.end(),
                          [](const Channels& c) { return !c.names.empty(); }),
              "each Aov has channels");
static_assert(static_cast<size_t>(Aov::z) + 1 == channels_of_aovs.size(), "each Aov has a name");
const Channels& channels_of(Aov aov) { return channels_of_aovs[static_cast<size_t>(aov)]; }

// Channel i of an AOV.
double value_of(Aov aov, size_t i, const Film& film, size_t pixel, const Normalisation& normalisation)
{
    const Channels& channels = channels_of(aov);
    const auto sum = [&](AovSum of, size_t k) { return film.whole_aov(pixel, film.aov_layout.offset(of) + k); };
    const double n = channels.count ? sum(*channels.count, 0) : 1;
    const auto mean = [&](size_t k) { return n == 0 ? 0 : sum(*channels.sum, k) / n; };
    switch (aov) {
        case Aov::variance:
            return variance_of_mean(film.whole(pixel));
        case Aov::samples:
            return film.whole(pixel).n;
        case Aov::depth:
        case Aov::z:
            return mean(0) / normalisation.scale;
        case Aov::position: {
            if (n == 0) return 0;
            const Vec3d file = normalisation.to_file({mean(0), mean(1), mean(2)});
            return i == 0 ? file.x : i == 1 ? file.y : file.z;
        }
        default:
            return mean(i);
    }
}

}  // namespace

size_t channel_count(Aov aov) { return channels_of(aov).names.size(); }

double variance_of_mean(const Pixel& p)
{
    if (p.n < 2) return 0;
    const double n = p.n, y = luminance(p.sum[0], p.sum[1], p.sum[2]) / n;
    return std::max(0.0, p.sum_sq / n - y * y) / (n - 1);
}

Color albedo_at(const Scene& scene, uint32_t material, const ShadingPoint& point)
{
    return mixed(scene, material, point, [&](const Material& some) {
        return std::visit([&](const auto& m) { return m.at(point).reflectance(); }, some);
    });
}

Color base_color_at(const Scene& scene, uint32_t material, const ShadingPoint& point)
{
    return mixed(scene, material, point, [&](const Material& some) { return base_color_of(some, point); });
}

std::vector<Aov> all_aovs()
{
    std::vector<Aov> all;
    for (size_t i = 0; i < enum_names<Aov>.size(); ++i) all.push_back(static_cast<Aov>(i));
    return all;
}

AovLayout layout_of(const std::vector<Aov>& which)
{
    AovLayout layout;
    for (const Aov aov : which)
        for (const auto& sum : {channels_of(aov).sum, channels_of(aov).count})
            if (sum) layout.add(*sum);
    return layout;
}

void AovListener::vertex(const PathState& s, const Surface& surface) const
{
    if (!is_from_camera(s)) return;
    if (!film_.sets.empty()) add_features(s, surface);
    const auto wants = [&](AovSum sum) { return film_.aov_layout.has(sum); };
    if (wants(AovSum::albedo) || wants(AovSum::flat)) {
        const ShadingPoint point = scene_.shading_point(surface);
        if (wants(AovSum::albedo)) add(sum_of(s, AovSum::albedo), albedo_at(scene_, surface.material, point));
        if (wants(AovSum::flat)) add(sum_of(s, AovSum::flat), base_color_at(scene_, surface.material, point));
    }
    if (wants(AovSum::normal)) add(sum_of(s, AovSum::normal), surface.ns);
    if (wants(AovSum::position)) add(sum_of(s, AovSum::position), surface.p);
    if (wants(AovSum::uv)) {
        double* const uv = sum_of(s, AovSum::uv);
        uv[0] += double{surface.uv.x}, uv[1] += double{surface.uv.y};
    }
    add_distance(s, s.passed_distance() + surface.t);
    if (wants(AovSum::material) && w_.slots[s.slot].sample == 0) *sum_of(s, AovSum::material) = surface.material + 1.0;
}

void AovListener::add_distance(const PathState& s, float distance) const
{
    const auto wants = [&](AovSum sum) { return film_.aov_layout.has(sum); };
    if (wants(AovSum::depth)) *sum_of(s, AovSum::depth) += double{distance};
    if (wants(AovSum::z)) *sum_of(s, AovSum::z) += double{distance * dot(s.ray.dir, axis_)};
    if (wants(AovSum::hits)) ++*sum_of(s, AovSum::hits);
}

void AovListener::scattered(const PathState& s, float t, const Medium& medium, const Surface* end) const
{
    if (!is_from_camera(s)) return;
    if (end && !is_skipped(scene_, s.media, *end)) return vertex(s, *end);
    const auto wants = [&](AovSum sum) { return film_.aov_layout.has(sum); };
    const Color albedo = medium.albedo();
    if (wants(AovSum::albedo)) add(sum_of(s, AovSum::albedo), albedo);
    if (wants(AovSum::flat)) add(sum_of(s, AovSum::flat), albedo);
    if (wants(AovSum::normal)) add(sum_of(s, AovSum::normal), -s.ray.dir);
    if (wants(AovSum::position)) add(sum_of(s, AovSum::position), s.ray.org + s.ray.dir * t);
    add_distance(s, s.passed_distance() + t);
}

void AovListener::add_features(const PathState& s, const Surface& surface) const
{
    const SampleSet::Features seen = features_seen(scene_, accel_, s, surface);
    SampleSet::Features& sum = features_of(s);
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += seen[i];
}

void AovListener::begin_late() const
{
    w_.late_aovs.assign(w_.slots.size() * film_.aov_layout.size(), 0);
    if (!film_.sets.empty()) w_.late_features.assign(w_.slots.size(), {});
}

void AovListener::add_late() const
{
    const size_t size = film_.aov_layout.size();
    for (size_t i = 0; i < w_.slots.size(); ++i) {
        double* const sums = size > 0 ? sums_of(w_.slots[i]) : nullptr;
        for (size_t c = 0; c < size; ++c) sums[c] += w_.late_aovs[i * size + c];
        if (film_.sets.empty()) continue;
        SampleSet::Features& sum = set_of(w_.slots[i]).features;
        for (size_t c = 0; c < sum.size(); ++c) sum[c] += w_.late_features[i][c];
    }
}

void AovListener::add_alpha() const
{
    for (size_t i = 0; i < w_.slots.size(); ++i) {
        const AlphaSample& sample = w_.alpha.of(i);
        if (sees_through_glass_) *sum_of(w_.slots[i], AovSum::through) += sample.through;
        if (catches_shadows_) add(sum_of(w_.slots[i], AovSum::caught), sample.caught, sample.light, sample.blocked);
    }
}

void AovListener::begin_block(uint32_t first) const
{
    Blocks blocks{film_.aovs, film_.open_aovs};
    const size_t size = film_.aov_layout.size();
    w_.aov_block.resize(size_t{tile_.width()} * tile_.height() * size);
    for_pixels(film_, tile_, [&](size_t i, size_t k) {
        for (size_t c = 0; c < size; ++c) w_.aov_block[k * size + c] = blocks.take(i * size + c, first);
    });
}

void AovListener::end_block(uint32_t end) const
{
    Blocks blocks{film_.aovs, film_.open_aovs};
    const size_t size = film_.aov_layout.size();
    for_pixels(film_, tile_, [&](size_t i, size_t k) {
        for (size_t c = 0; c < size; ++c) blocks.put(i * size + c, w_.aov_block[k * size + c], end);
    });
}

std::vector<ImagePlane> aov_planes(const Film& film, const std::vector<Aov>& which, const Normalisation& normalisation)
{
    std::vector<ImagePlane> planes;
    for (const Aov aov : which) {
        const std::string_view names = channels_of(aov).names;
        for (size_t i = 0; i < names.size(); ++i) {
            const std::string suffix = aov == Aov::material ? "ID" : std::string(1, names[i]);
            ImagePlane& plane = planes.emplace_back();
            plane.name = aov == Aov::z ? "Z" : std::string(name_of(aov)) + "." + suffix;
            plane.values.reserve(film.pixels.size());
            for (size_t k = 0; k < film.pixels.size(); ++k)
                plane.values.push_back(static_cast<float>(value_of(aov, i, film, k, normalisation)));
        }
    }
    return planes;
}

void add_alpha_sums(bool glass, bool catcher, AovLayout& layout)
{
    layout.add(AovSum::hits), layout.add(AovSum::samples);
    if (glass) layout.add(AovSum::through);
    if (catcher) layout.add(AovSum::caught);
}

double alpha_at(const Film& film, size_t pixel)
{
    const auto sum = [&](AovSum of, size_t k = 0) { return film.whole_aov(pixel, film.aov_layout.offset(of) + k); };
    const double samples = sum(AovSum::samples);
    if (samples == 0) return 0;
    double covered = sum(AovSum::hits);
    if (film.aov_layout.has(AovSum::through)) covered -= sum(AovSum::through);
    if (film.aov_layout.has(AovSum::caught)) {
        const double light = sum(AovSum::caught, 1), blocked = sum(AovSum::caught, 2);
        covered -= sum(AovSum::caught) * (light > 0 ? (light - blocked) / light : 1);
    }
    return covered / samples;
}

ImagePlane alpha_of(const Film& film)
{
    ImagePlane alpha{"A", {}};
    alpha.values.reserve(film.pixels.size());
    for (size_t i = 0; i < film.pixels.size(); ++i) alpha.values.push_back(static_cast<float>(alpha_at(film, i)));
    return alpha;
}

}  // namespace lancer
