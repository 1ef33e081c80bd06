// Rows L6 and L7: lights by the million, of powers that differ by the million.
#include "scene/lights/tree.h"
#include "stability/groups.h"
#include "stability/shots.h"
#include "support/random.h"
#include "support/stage.h"

namespace lancer::stability {
namespace {

const std::array<Vec3d, 8> places{Vec3d{0, 0, 0},      Vec3d{0.9, 0, 0.9},  Vec3d{-0.5, 0, 0.3}, Vec3d{0.3, 0, -0.7},
                                  Vec3d{-0.9, 0, 0.1}, Vec3d{0.05, 0, 0.6}, Vec3d{0.6, 0, 0.2},  Vec3d{-0.2, 0, -0.95}};

// Over a floor that has nothing on it.
SceneDescription floor_under(std::vector<LightDescription> lights)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, make_lambert("floor", {0.5f, 0.5f, 0.5f}))));
    d.lights = std::move(lights);
    return d;
}
LightDescription point_over_floor(Random& random, double power)
{
    const auto p = static_cast<float>(power);
    return light_of(LightType::point, {p, p, p}, random.point(-1, 1) + Vec3d{0, 1.3, 0});
}

// The sum over all of intensity * cosine / distance^2, times albedo / pi.
double radiance_at(Vec3d place, const std::vector<LightDescription>& lights)
{
    double sum = 0;
    for (const LightDescription& l : lights) {
        const Vec3d to = l.position - place;
        const double d2 = dot(to, to);
        if (to.y > 0) sum += double{l.power.g} * to.y / (d2 * std::sqrt(d2));
    }
    return 0.5 / pi_d * sum;
}

// One pixel at each place, so narrow that it is a point.
struct Found {
    Claim claim;
    double worst = 0, noise = 0;  // distance in sigma; sigma, relative
    double least = 1;             // probability of a light
};
Found look_at_places(const SceneDescription& d, const std::vector<double>& expected, uint32_t spp, const Setup& setup,
                     Outcome& out)
{
    Found found;
    RendererConfig settings;
    settings.integrator = Path{.max_depth = 1};
    settings.kernel.sampler = SamplerKind::independent;
    settings.kernel.filter = Filter(FilterKind::box);
    with_threads(setup.tier == Tier::A ? 1 : available_threads(), [&] {
        const Renderer renderer(build_scene(d), settings);
        const Scene& scene = renderer.scene();
        for (size_t i = 0; i < places.size(); ++i) {
            const CameraDescription eye = make_camera(places[i] + Vec3d{0.01, 0.1, 0.02}, places[i], 1e-4);
            constexpr uint32_t side = 4;
            Film film(side, side, {0, 0, side, side});
            const PassResult result = renderer.pass(Camera(eye, scene.normalisation, side, side), film,
                                                    make_tiles(film.crop, 1), {0, spp / (side * side)});
            out.samples += spp, out.dropped += result.counters.dropped;
            const stats::Tally t = tally(film);
            found.claim.add(stats::mean_p(t, expected[i], 1e-5));
            found.worst = std::max(found.worst, std::abs(t.mean - expected[i]) / t.error());
            found.noise = std::max(found.noise, t.error() / t.mean);
        }
        const LightTable& table = scene.lights;
        for (uint32_t id = 0; id < table.lights.size(); ++id) {
            if (!table.tree) {
                found.least = std::min(found.least, double{table.pick.probability(id)});
                continue;
            }
            const Vec3 place = to_float(scene.normalisation.to_scene(places[id % places.size()]));
            found.least = std::min(found.least, double{table.tree->probability(id, place, {0, 1, 0})});
        }
    });
    return found;
}

Measure above_zero(const std::string& what, double value)
{
    return at_least(what, value, std::numeric_limits<double>::min());
}

void add_measures(Outcome& out, const std::string& name, const Found& found)
{
    out.measures.push_back(found.claim.measure(name + ", pixels against the sum of all"));
    out.measures.push_back(told(name + ", the farthest pixel in sigma", found.worst));
    out.measures.push_back(told(name + ", the largest sigma, relative", found.noise));
    out.measures.push_back(above_zero(name + ", the least probability of a light", found.least));
}

Outcome of_any_power(const Setup& setup)
{
    Outcome out;
    Random random(60);
    std::vector<LightDescription> lights;
    for (size_t i = 0; i < setup.scaled(10000, 1000000, 1000000); ++i)
        lights.push_back(point_over_floor(random, std::pow(10.0, random.uniform(-6, 6))));
    std::vector<double> expected;
    for (const Vec3d& place : places) expected.push_back(radiance_at(place, lights));
    if (setup.tier == Tier::A) {  // the table of as many as in the other tiers costs little
        std::vector<double> powers(1000000);
        for (double& p : powers) p = std::pow(10.0, random.uniform(-6, 6));
        const Discrete pick(powers);
        float least = 1;
        for (uint32_t i = 0; i < powers.size(); ++i) least = std::min(least, pick.probability(i));
        out.measures.push_back(above_zero("the least probability of a million, by power", least));
    }
    SceneDescription d = floor_under(std::move(lights));
    const auto spp = static_cast<uint32_t>(setup.scaled(4096, 1 << 18, 1 << 21));
    for (const bool tree : {true, false}) {
        d.render.light_tree = tree;
        add_measures(out, tree ? "by the tree" : "by power", look_at_places(d, expected, spp, setup, out));
    }
    return out;
}

// What the faint lights give a place, by all numbers that can choose one of them: these are few, as the strong one has
// all the others. strong_first: where it stands in the list.
double part_found(std::vector<LightDescription> faint, const LightDescription& strong, bool strong_first, int each,
                  double& sigma)
{
    double expected = radiance_at({}, faint) / (0.5 / pi_d);
    faint.insert(strong_first ? faint.begin() : faint.end(), strong);
    SceneDescription d = floor_under(std::move(faint));
    d.render.light_tree = false;
    const Scene scene = build_scene(d);
    const Surface from = receiver(to_float(scene.normalisation.to_scene({})), {0, 1, 0});
    constexpr double step = 0x1p-24;
    double sum = 0, variance = 0;
    Random random(61);
    for (int k = 0; k < 20; ++k) {
        const float pick = strong_first ? 1 - static_cast<float>(k + 1) * 0x1p-24f : static_cast<float>(k) * 0x1p-24f;
        stats::Tally t;
        for (int i = 0; i < each; ++i) {
            const auto s = sample_light(scene, from, pick, random.unit2());
            t.add(s ? double{s->radiance.g} * double{dot(s->wi, from.n)} / double{s->pdf} : 0);
        }
        sum += t.mean * step, variance += t.error() * t.error() * step * step;
    }
    sigma = std::sqrt(variance) / expected;
    return sum / expected;
}

Outcome beside_a_strong_one(const Setup& setup)
{
    Outcome out;
    Random random(62);
    std::vector<LightDescription> faint;
    double total = 0;
    for (size_t i = 1; i < setup.scaled(10000, 1000000, 1000000); ++i) {
        faint.push_back(point_over_floor(random, random.uniform(0.5, 1.5)));
        total += double{faint.back().power.g};
    }
    // Below the floor, which keeps its light off.
    const auto power = static_cast<float>(total * 999999);
    const LightDescription strong = light_of(LightType::point, {power, power, power}, {0, -100, 0});
    for (const bool first : {true, false}) {
        double sigma = 0;
        const double part =
            part_found(faint, strong, first, static_cast<int>(setup.scaled(2000, 50000, 200000)), sigma);
        const std::string name = std::string("by power, the strong one ") + (first ? "first" : "last");
        out.measures.push_back(
            at_most(name + ", faint ones, distance in sigma", std::abs(part - 1) / std::max(1e-5, sigma), 4));
        out.measures.push_back(at_most(name + ", sigma", sigma, 0.02));
    }
    std::vector<double> expected;
    for (const Vec3d& place : places) expected.push_back(radiance_at(place, faint));
    faint.push_back(strong);
    const auto spp = static_cast<uint32_t>(setup.scaled(16384, 1 << 20, 1 << 23));
    const Found found = look_at_places(floor_under(std::move(faint)), expected, spp, setup, out);
    add_measures(out, "by the tree", found);
    out.measures.push_back(at_most("by the tree, the largest sigma", found.noise, 0.2));
    return out;
}

}  // namespace

std::vector<Row> many_light_rows()
{
    return {
        {"L6", "points of light of powers from 1e-6 to 1e6", "sum in double", Tier::A, false, of_any_power},
        {"L7", "one light of many has 99.9999 % of the power", "sum in double", Tier::A, false, beside_a_strong_one}};
}

}  // namespace lancer::stability
