#include "render/aov.h"

#include "render/blocks.h"

namespace lancer {
namespace {

// f of a material that is no mix; of a mix the mean of both parts.
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
    return std::visit(
        [&](const auto& m) {
            // Whatever a material calls it.
            if constexpr (requires { m.albedo; }) {
                return point.base(m.albedo);
            } else if constexpr (requires { m.base; }) {
                return point.base(m.base);
            } else if constexpr (requires { m.color; }) {
                return point.base(m.color);
            } else {
                return point.base(m.tint);
            }
        },
        material);
}

void add(std::array<double, 3>& sum, double x, double y, double z) { sum[0] += x, sum[1] += y, sum[2] += z; }
void add(std::array<double, 3>& sum, Color c) { add(sum, double{c.r}, double{c.g}, double{c.b}); }
void add(std::array<double, 3>& sum, Vec3 v) { add(sum, double{v.x}, double{v.y}, double{v.z}); }

double mean(double sum, uint32_t n) { return n ? sum / n : 0; }

double variance_of_mean(const Pixel& p)
{
    if (p.n < 2) return 0;
    const double n = p.n, y = luminance(p.sum[0], p.sum[1], p.sum[2]) / n;
    return std::max(0.0, p.sum_sq / n - y * y) / (n - 1);
}

// Channel i of an AOV.
double value_of(Aov aov, size_t i, const Pixel& light, const AovPixel& p, const Normalisation& normalisation)
{
    switch (aov) {
        case Aov::albedo:
            return mean(p.albedo[i], p.samples);
        case Aov::flat:
            return mean(p.flat[i], p.samples);
        case Aov::normal:
            return mean(p.normal[i], p.samples);
        case Aov::depth:
            return mean(p.depth, p.hits) / normalisation.scale;
        case Aov::position: {
            if (p.hits == 0) return 0;
            const double n = p.hits;
            const Vec3d file = normalisation.to_file({p.position[0] / n, p.position[1] / n, p.position[2] / n});
            return i == 0 ? file.x : i == 1 ? file.y : file.z;
        }
        case Aov::uv:
            return mean(p.uv[i], p.hits);
        case Aov::material:
            return p.material;
        case Aov::variance:
            return variance_of_mean(light);
        case Aov::mask:
            return mean(p.hits, p.samples);
        case Aov::samples:
            return light.n;
    }
    return 0;
}

std::string_view channels_of(Aov aov)
{
    constexpr std::array<std::string_view, aov_names.size()> channels{"RGB", "XYZ", "Z", "XYZ", "UV",
                                                                      "I",   "V",   "A", "RGB", "N"};
    return channels[static_cast<size_t>(aov)];
}

}  // namespace

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

void AovListener::vertex(const State& s, const Surface& surface) const
{
    if (s.depth != 0) return;
    AovPixel& p = pixel_of(s);
    const ShadingPoint point = scene_.shading_point(surface);
    ++p.hits;
    add(p.albedo, albedo_at(scene_, surface.material, point));
    add(p.flat, base_color_at(scene_, surface.material, point));
    add(p.normal, surface.ns);
    add(p.position, surface.p);
    p.depth += double{surface.t};
    p.uv[0] += double{surface.uv.x};
    p.uv[1] += double{surface.uv.y};
    if (w_.slots[s.slot].sample == 0) p.material = surface.material + 1;
}

void AovListener::begin_block(uint32_t first) const
{
    Blocks blocks{film_.aovs, film_.open_aovs};
    w_.aov_block.resize(size_t{tile_.width()} * tile_.height());
    for_pixels(film_, tile_, [&](size_t i, size_t k) { w_.aov_block[k] = blocks.take(i, first); });
}

void AovListener::end_block(uint32_t end) const
{
    Blocks blocks{film_.aovs, film_.open_aovs};
    for_pixels(film_, tile_, [&](size_t i, size_t k) { blocks.put(i, w_.aov_block[k], end); });
}

std::vector<ImagePlane> aov_planes(const Film& film, const std::vector<Aov>& which, const Normalisation& normalisation)
{
    std::vector<ImagePlane> planes;
    for (const Aov aov : which) {
        const std::string_view channels = channels_of(aov);
        for (size_t i = 0; i < channels.size(); ++i) {
            const std::string suffix = aov == Aov::material ? "ID" : std::string(1, channels[i]);
            ImagePlane& plane = planes.emplace_back();
            plane.name = std::string(aov_names[static_cast<size_t>(aov)]) + "." + suffix;
            plane.values.reserve(film.pixels.size());
            for (size_t k = 0; k < film.pixels.size(); ++k)
                plane.values.push_back(
                    static_cast<float>(value_of(aov, i, film.whole(k), film.whole_aov(k), normalisation)));
        }
    }
    return planes;
}

}  // namespace lancer
