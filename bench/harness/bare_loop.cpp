#include "harness/bare_loop.h"

#include <algorithm>
#include <numeric>

#include "core/frame.h"
#include "core/parallel.h"
#include "core/warp.h"
#include "integrators/path/transport.h"
#include "scene/description/material.h"

namespace lancer::bench {
namespace {

// The material of a face, or null if it is more than matt and emissive.
const MaterialDescription* material_of(const SceneDescription& d, const MeshDescription& mesh, uint32_t triangle)
{
    const MaterialDescription* m = nullptr;
    if (mesh.material.empty()) {
        const std::vector<uint32_t>& of_face = mesh.data->face_material;
        m = &mesh.data->materials[of_face.empty() ? 0 : of_face[triangle]];
    } else {
        for (const MaterialDescription& said : d.materials)
            if (said.name == mesh.material) m = &said;
    }
    const bool plain =
        m && m->type == MaterialType::lambert && !reads_textures(*m) && m->opacity == 1 && !m->emission_both_sides;
    return plain ? m : nullptr;
}

// Of a point on a triangle from its corners.
Vec3 error_of(Vec3 a, Vec3 b, Vec3 c) { return (abs(a) + abs(b) + abs(c)) * gamma(7); }

}  // namespace

BareLoop::BareLoop(const Stage& stage, const BareEmbree& embree)
    : stage_(&stage),
      embree_(&embree),
      max_depth_(stage.settings.max_depth ? stage.settings.max_depth : UINT32_MAX),
      roulette_depth_(Path{}.roulette_depth)
{
}

std::optional<BareLoop> BareLoop::make(const SceneDescription& d, const Stage& stage, const BareEmbree& embree)
{
    BareLoop loop(stage, embree);
    const bool plain = d.spheres.empty() && d.planes.empty() && d.instances.empty() && d.overrides.empty() &&
                       !d.background && d.camera && d.camera->type == CameraType::pinhole;
    if (!plain || !loop.take_meshes(d) || !loop.take_light(d)) return {};
    return loop;
}

bool BareLoop::take_meshes(const SceneDescription& d)
{
    for (const MeshDescription& mesh : d.meshes) {
        if (!mesh.data->normals.empty() || !mesh.data->colors.empty() || mesh.bands) return false;
        std::vector<Face>& faces = faces_.emplace_back();
        for (uint32_t i = 0; i < mesh.data->triangles.size(); ++i) {
            const MaterialDescription* m = material_of(d, mesh, i);
            if (!m) return false;
            faces.push_back({m->base_color, m->emission});
        }
    }
    return true;
}

bool BareLoop::take_light(const SceneDescription& d)
{
    std::vector<double> weights;
    for (uint32_t m = 0; m < faces_.size(); ++m)
        for (uint32_t i = 0; i < faces_[m].size(); ++i) {
            Face& face = faces_[m][i];
            if (is_black(face.emission)) continue;
            face.light = static_cast<uint32_t>(lights_.size());
            lights_.push_back({m, i});
            const double area = 0.5 * static_cast<double>(length(corners(m, i).normal()));
            weights.push_back(area * static_cast<double>(luminance(face.emission)));
        }
    chosen_ = Discrete(weights);
    if (d.lights.empty()) return !lights_.empty();
    const LightDescription& light = d.lights[0];
    sky_ = light.power;
    return d.lights.size() == 1 && lights_.empty() && light.type == LightType::environment && light.file.empty();
}

BareLoop::Corners BareLoop::corners(uint32_t mesh, uint32_t triangle) const
{
    const Mesh& m = stage_->scene.geometry.meshes[mesh];
    const auto& t = m.triangles[triangle];
    return {m.positions[t[0]], m.positions[t[1]], m.positions[t[2]]};
}

Color BareLoop::direct(Vec3 p, Vec3 error, Vec3 n, const Sampler& sampler, uint32_t depth) const
{
    if (lights_.empty()) {
        // A constant sky: both techniques have the density of the cosine.
        const Vec3 wi = normalize(Frame(n).to_world(square_to_cosine_hemisphere(sampler.get2(depth, Dim::light))));
        if (embree_->any({.org = offset_origin(p, error, n, wi), .dir = wi})) return {};
        return sky_ * (0.5f * pi);
    }
    const uint32_t pick = lights_.size() > 1 ? chosen_.sample(sampler.get1(depth, Dim::light)) : 0;
    const auto [mesh, triangle] = lights_[pick];
    const Corners light = corners(mesh, triangle);
    const Vec2 at = square_to_triangle(sampler.get2(depth, Dim::light));
    const Vec3 twice_area = light.normal();
    const float area = 0.5f * length(twice_area);
    const Vec3 light_n = twice_area * (0.5f / area);
    const Vec3 q = light.a + (light.b - light.a) * at.x + (light.c - light.a) * at.y;
    const Vec3 to_light = normalize(q - p);
    const Vec3 org = offset_origin(p, error, n, to_light);
    const Vec3 d = offset_origin(q, error_of(light.a, light.b, light.c), light_n, -to_light) - org;
    const float distance = length(d);
    const Vec3 wi = d / distance;
    const float cos_here = dot(n, wi), cos_there = -dot(light_n, wi);
    if (cos_here <= 0 || cos_there <= 0) return {};
    const float pdf = chosen_.probability(pick) / area * distance * distance / cos_there;
    if (embree_->any({.org = org, .dir = wi, .t_max = distance * (1 - gamma(16))})) return {};
    return faces_[mesh][triangle].emission * (cos_here / pdf * power_heuristic(pdf, pdf_cosine_hemisphere(cos_here)));
}

Color BareLoop::sample(uint32_t x, uint32_t y, uint32_t index, uint64_t seed) const
{
    const KernelSettings& k = stage_->config.kernel;
    const Sampler sampler(k.sampler, seed, uint64_t{y} * stage_->settings.size.width + x, index, 0);
    const Vec2 offset = k.filter.sample(sampler.get2(0, Dim::pixel));
    Ray ray = stage_->camera.ray({static_cast<float>(x) + 0.5f + offset.x, static_cast<float>(y) + 0.5f + offset.y},
                                 sampler.get2(0, Dim::lens));
    Color radiance, throughput{1, 1, 1};
    float pdf = 0;
    for (uint32_t depth = 0;; ++depth) {
        const Hit hit = embree_->closest(ray);
        if (!hit) return radiance + throughput * sky_ * (depth == 0 ? 1 : 0.5f);
        const Face& face = faces_[hit.geometry][hit.primitive];
        const Corners c = corners(hit.geometry, hit.primitive);
        const Vec3 twice_area = c.normal();
        const Vec3 outside = normalize(twice_area);
        if (face.light != none && dot(outside, ray.dir) < 0) {
            const float cos = -dot(outside, ray.dir);
            const float pdf_light = chosen_.probability(face.light) * hit.t * hit.t / (cos * 0.5f * length(twice_area));
            radiance += throughput * face.emission * (depth == 0 ? 1 : power_heuristic(pdf, pdf_light));
        }
        if (depth == max_depth_ || is_black(face.albedo)) return radiance;
        const Vec3 n = dot(outside, ray.dir) < 0 ? outside : -outside;
        const Vec3 p = c.a + (c.b - c.a) * hit.uv.x + (c.c - c.a) * hit.uv.y, error = error_of(c.a, c.b, c.c);
        throughput *= face.albedo;
        radiance += throughput * direct(p, error, n, sampler, depth) * (1 / pi);
        const Vec3 local = square_to_cosine_hemisphere(sampler.get2(depth, Dim::bsdf));
        const Vec3 wi = normalize(Frame(n).to_world(local));
        pdf = pdf_cosine_hemisphere(local.z);
        ray = {.org = offset_origin(p, error, n, wi), .dir = wi};
        if (depth + 1 < roulette_depth_) continue;
        const float q = std::min(0.95f, max_component(throughput));
        if (!(sampler.get1(depth + 1, Dim::roulette) < q)) return radiance;
        throughput /= q;
    }
}

Film BareLoop::render(uint32_t spp, uint64_t seed) const
{
    Film film = stage_->film();
    const std::vector<Tile> tiles = stage_->tiles();
    parallel_for(tiles.size(), [&](size_t i) {
        for (uint32_t y = tiles[i].y0; y < tiles[i].y1; ++y)
            for (uint32_t x = tiles[i].x0; x < tiles[i].x1; ++x) {
                Pixel& pixel = film.pixels[film.index(x, y)];
                for (uint32_t s = 0; s < spp; ++s) {
                    const Color c = sample(x, y, s, seed);
                    pixel.sum[0] += static_cast<double>(c.r), pixel.sum[1] += static_cast<double>(c.g);
                    pixel.sum[2] += static_cast<double>(c.b);
                }
                pixel.n = spp;
            }
    });
    return film;
}

}  // namespace lancer::bench
