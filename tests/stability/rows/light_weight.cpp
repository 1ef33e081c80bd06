// Row L11: an emitter that is found by light sampling and by the BSDF counts once.
#include "integrators/path/transport.h"
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/random.h"
#include "support/stage.h"

namespace lancer::stability {
namespace {

// The largest distance from 1 of the two weights of a place on a light: of the sample that found it, and of a ray that
// the BSDF sent the same way. Lambert, from everywhere on the surfaces that a camera sees.
struct Weights {
    double worst = 0, looked_at = 0;
};
Weights weights_of(const SceneDescription& d, size_t count)
{
    const Stage stage(d);
    const Scene& scene = stage.scene;
    const Camera camera = camera_of(d, scene, 64, 64);
    const DirectLight how;
    Weights weights;
    Random random(110);
    for (size_t i = 0; i < count; ++i) {
        const Vec2 film = random.unit2() * 64.0f;
        const Ray eye = camera.ray(film, {});
        const Hit seen = stage.embree->closest(eye);
        if (!seen) continue;
        const Surface from = surface_at(scene, eye, seen);
        const float pick = random.unit();
        const auto s = sample_light(scene, from, pick, random.unit2());
        if (!s || s->delta) continue;
        const float pdf = pdf_cosine_hemisphere(dot(s->wi, from.ns));
        if (!(pdf > 0) || dot(s->wi, from.side) <= 0) continue;
        const Ray ray{.org = ray_origin(from, s->wi), .dir = s->wi};
        const Hit hit = stage.embree->closest(ray);
        float found = 0;
        if (s->infinite) {
            if (hit) continue;
            found = pdf_environment(scene, from.ns, s->wi);
        } else {
            if (!hit) continue;
            const Surface at = surface_at(scene, ray, hit);
            // Something else may stand in front.
            if (at.light == Scene::none || length(at.p - s->point) > 1e-4f * length(s->point - from.p)) continue;
            found = pdf_light(scene, ray.org, from.ns, s->wi, at);
        }
        PathState state;
        state.pdf = pdf;
        const double sum = double{power_heuristic(s->pdf, pdf)} + double{weight_of_found(state, how, found)};
        weights.worst = std::max(weights.worst, std::abs(sum - 1)), ++weights.looked_at;
    }
    return weights;
}

Outcome found_twice(const Setup& setup)
{
    Outcome out;
    const std::vector<NamedScene> scenes{
        {"lights", lights_scene()}, {"cornell", cornell_scene()}, {"spheres", spheres_scene()}};
    for (const NamedScene& scene : scenes) {
        const Weights w = weights_of(scene.description, setup.scaled(20000, 2000000, 20000000));
        out.measures.push_back(at_most(std::string(scene.name) + ", both weights - 1", w.worst, 1e-6));
        out.measures.push_back(at_least(std::string(scene.name) + ", places looked at", w.looked_at, 1000));
    }
    Claim same;
    for (const NamedScene& scene : scenes) {
        Shot shot{.width = 32,
                  .height = 32,
                  .spp = static_cast<uint32_t>(setup.scaled(64, 2048, 16384)),
                  .sampler = SamplerKind::independent};
        // Point lights are found by light sampling alone.
        SceneDescription d = scene.description;
        std::erase_if(d.lights, [](const LightDescription& l) { return l.type == LightType::point; });
        std::vector<Film> films;
        for (const DirectLight how : {DirectLight{true, true}, DirectLight{true, false}, DirectLight{false, false}}) {
            shot.integrator = Path{.max_depth = 3, .direct = how, .split = false};
            shot.seed = films.size() + 1;
            films.push_back(shoot(d, shot, setup, out));
        }
        for (size_t i = 0; i < 3; ++i) same.add_tiles(films[i], films[(i + 1) % 3]);
    }
    out.measures.push_back(same.measure("both ways, light sampling and the BSDF alone, by tile"));
    return out;
}

}  // namespace

std::vector<Row> light_weight_rows()
{
    return {{"L11", "light found by its samples and by the BSDF's", "closed form, each other", Tier::A, false,
             found_twice}};
}

}  // namespace lancer::stability
