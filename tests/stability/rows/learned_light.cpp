// Rows L13 to L15: the choice of lights that a pilot learned (integrators/path/light_choice.h), where the pilot saw
// little or nothing of a light.
//
// What a light sample brings has the second moment sum f^2 / (q p), with probability q of a sample and p of its light.
// By power q is 1 and p is p0. The pilot chooses with at least p0 / 2; what is learned keeps at least a tenth of that,
// and q is at least 1/8. So q p >= p0 / 160, whatever was learned: the second moment grows to 160 times at most.
// Where BSDF sampling finds the light as well, c = q p / p0 turns the second moments of both techniques together, by
// the power heuristic with densities a and b, from (a^3 + b^3) / (a^2 + b^2)^2 into that of c a and b. Their ratio is
// at most 2 / c. The product of both means adds at most half of the square of their sum.
#include <functional>

#include "stability/groups.h"
#include "stability/shots.h"
#include "support/rasters.h"
#include "support/scenes/lit_places.h"

namespace lancer::stability {
namespace {

constexpr double least_chance = 1.0 / 160;  // over that by power: a half, a tenth, an eighth
constexpr double most_by_light = 1 / least_chance, most_by_both = 2 / least_chance + 0.5;

// The floor from -1 to 1 in y = 0, seen from straight above: each pixel is a square of it. The pilot looks at pixels 4,
// 12, 20, ... of a row or column.
constexpr uint32_t usual_side = 128;  // pixels of the picture's
constexpr double albedo = 0.5;

SceneDescription floor_from_above()
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(
        make_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, make_lambert("floor", {albedo, albedo, albedo}))));
    d.camera = make_camera({0, 0.75, 0}, {0, 0, 0}, 2 * std::atan(1 / 0.75) * 180 / pi_d);
    d.camera->up = {0, 0, -1};
    return d;
}

// Pixels as places of the floor.
struct Lit {
    double x0, z0, x1, z1;

    static Lit pixels(const Tile& t, uint32_t side = usual_side)
    {
        const auto place = [&](uint32_t pixel) { return 2.0 * pixel / side - 1; };
        return {place(t.x0), place(t.y0), place(t.x1), place(t.y1)};
    }
    bool has(Vec3d p) const { return p.x > x0 && p.x < x1 && p.z > z0 && p.z < z1; }
};

// A point of light in a box that lets it out to `lit` alone; without `lit` the box is closed.
void add_hooded(SceneDescription& d, double intensity, Vec3d at, const std::optional<Lit>& lit)
{
    const auto power = static_cast<float>(intensity);
    d.lights.push_back(light_of(LightType::point, {power, power, power}, at));
    const Lit floor = lit.value_or(Lit{at.x - 0.2, at.z - 0.2, at.x + 0.2, at.z + 0.2});
    std::array<Vec3d, 4> rim{
        Vec3d{floor.x0, 0, floor.z0}, {floor.x1, 0, floor.z0}, {floor.x1, 0, floor.z1}, {floor.x0, 0, floor.z1}};
    for (Vec3d& p : rim) p = at + (p - at) * 0.2;
    const auto add = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d e) { d.meshes.push_back(make_mesh(make_quad(a, b, c, e))); };
    const Vec3d up{0, 0.3 * at.y, 0};
    for (size_t i = 0; i < 4; ++i) add(rim[i], rim[(i + 1) % 4], rim[(i + 1) % 4] + up, rim[i] + up);
    add(rim[0] + up, rim[1] + up, rim[2] + up, rim[3] + up);
    if (!lit) add(rim[0], rim[1], rim[2], rim[3]);
}
double from_point(Vec3d place, double intensity, Vec3d at)
{
    const double distance = length(at - place);
    return albedo / pi_d * intensity * at.y / (distance * distance * distance);
}

struct Case {
    std::string name;
    SceneDescription scene;
    std::function<double(Vec3d)> radiance;  // of a place on the floor
    uint32_t side = usual_side;
    Tile crop{0, 0, usual_side, usual_side};  // what is looked at
    uint32_t block = 8;                       // pixels of a side, whose mean is compared
    double most = most_by_light;              // of second moments
    RasterSource images = test_picture;
};

struct Drawn {
    Film film;
    LightChoice choice;
    Discrete by_power;
};
Drawn draw(const Case& c, bool learned, uint32_t spp, const Setup& setup, Outcome& out)
{
    RendererConfig settings;
    Path path{.max_depth = 1, .split = false, .roulette_by_pixel = false};
    path.learned_nee = learned;
    settings.integrator = path;
    settings.kernel.sampler = SamplerKind::independent;
    settings.kernel.filter = Filter(FilterKind::box);
    settings.kernel.seed = salted(learned);
    const uint32_t side = c.side;
    Drawn drawn{Film(side, side, c.crop), {}, {}};
    with_threads(setup.tier == Tier::A ? 1 : available_threads(), [&] {
        const Renderer renderer(build_scene(c.scene, c.images), settings);
        const Camera camera = camera_of(c.scene, renderer.scene(), side, side);
        const PassResult pass = renderer.pass(camera, drawn.film, make_tiles(c.crop, 16), {0, spp});
        out.dropped += pass.counters.dropped;
        drawn.choice = renderer.plan(camera, side, side)->light_choice;
        drawn.by_power = renderer.scene().lights.pick;
    });
    for (const Pixel& p : drawn.film.pixels) out.samples += p.n;
    return drawn;
}

// The mean radiance of a pixel. Edges of light lie between pixels, or are soft.
double expected_of(const Case& c, uint32_t x, uint32_t y)
{
    const int n = static_cast<int>(1024 / c.side);
    const Lit area = Lit::pixels({x, y, x + 1, y + 1}, c.side);
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const double u = (i % n + 0.5) / n, v = (i / n + 0.5) / n;
        sum += c.radiance({area.x0 + u * (area.x1 - area.x0), 0, area.z0 + v * (area.z1 - area.z0)});
    }
    return sum / (n * n);
}

// A block of pixels: the mean of its samples, the error of that, the mean of their squares.
struct Block {
    double expected = 0, mean = 0, variance = 0, square = 0;

    double p() const
    {
        const double off = std::max(0.0, std::abs(mean - expected) - 1e-4 * expected);
        return off == 0 ? 1 : variance == 0 ? 0 : stats::normal_p(off / std::sqrt(variance));
    }
};
// expected: of all pixels.
std::vector<Block> blocks_of(const Case& c, const Film& film, const std::vector<double>& expected, uint32_t size)
{
    std::vector<Block> blocks;
    for (const Tile& t : make_tiles(c.crop, size)) {
        Block& b = blocks.emplace_back();
        const double count = static_cast<double>(t.width()) * t.height();
        for (uint32_t y = t.y0; y < t.y1; ++y)
            for (uint32_t x = t.x0; x < t.x1; ++x) {
                const stats::Tally pixel = tally(film.at(x, y));
                b.expected += expected[film.index(x, y)] / count;
                b.mean += pixel.mean / count;
                b.variance += pixel.variance() / pixel.n / (count * count);
                b.square += film.at(x, y).sum_sq / pixel.n / count;
            }
    }
    return blocks;
}

// The least probability that a light is sampled, over that by power.
double least_chance_of(const Drawn& learned)
{
    double least = std::numeric_limits<double>::infinity();
    for (uint32_t cell = 0; cell < learned.choice.exponents.size(); ++cell)
        for (uint32_t i = 0; i < learned.by_power.size(); ++i) {
            const double power = double{learned.by_power.probability(i)};
            const double chosen = learned.choice.chooses() ? double{learned.choice.probability(cell, i)} : power;
            if (power > 0) least = std::min(least, double{learned.choice.rate(cell)} * chosen / power);
        }
    return least;
}

// Returns the variance over that without what was learned.
double judge(const Case& c, uint32_t spp, const Setup& setup, Outcome& out)
{
    const Drawn with = draw(c, true, spp, setup, out), without = draw(c, false, spp, setup, out);
    out.measures.push_back(exactly(c.name + ", plans without a choice of lights", with.choice.empty(), 0));
    std::vector<double> expected;
    for (uint32_t y = c.crop.y0; y < c.crop.y1; ++y)
        for (uint32_t x = c.crop.x0; x < c.crop.x1; ++x) expected.push_back(expected_of(c, x, y));
    Claim claim;
    double noise = 0, worst = 0, variance = 0, variance_before = 0;
    const std::vector<Block> blocks = blocks_of(c, with.film, expected, c.block),
                             before = blocks_of(c, without.film, expected, c.block);
    for (size_t i = 0; i < blocks.size(); ++i) {
        const Block &b = blocks[i], &was = before[i];
        claim.add(b.p());
        variance += b.square - b.mean * b.mean, variance_before += was.square - was.mean * was.mean;
        if (b.expected == 0) continue;
        noise = std::max(noise, std::sqrt(b.variance) / b.expected);
        // Where few samples by power brought anything, the square of the mean bounds their second moment from below.
        worst = std::max(worst, b.square / std::max(was.square, b.expected * b.expected));
    }
    claim.add(blocks_of(c, without.film, expected, c.side)[0].p());
    out.measures.push_back(claim.measure(c.name + ", blocks against the closed form"));
    out.measures.push_back(at_most(c.name + ", the largest sigma of a block, relative", noise, 0.1));
    out.measures.push_back(at_most(c.name + ", second moment over that by power, worst block", worst, c.most));
    out.measures.push_back(at_least(c.name + ", chance of a light over that by power, the least cell",
                                    least_chance_of(with), least_chance * (1 - 1e-5)));
    return variance / variance_before;
}

// A strong lamp that nothing sees, one over the left half of the floor, and one over 8 x 8 pixels of the right, around
// the corner of four cells: the pilot sees it from one of them, and chooses it there in few samples.
Outcome seen_from_one_cell(const Setup& setup)
{
    constexpr Vec3d left{-0.5, 1, 0}, right{0.4, 1, 0.4};
    const Lit half = Lit::pixels({0, 0, usual_side / 2, usual_side}), corner = Lit::pixels({84, 84, 92, 92});
    Case c{.name = "one cell",
           .scene = floor_from_above(),
           .radiance =
               [=](Vec3d p) {
                   return half.has(p) ? from_point(p, 5, left) : corner.has(p) ? from_point(p, 50, right) : 0;
               },
           .crop = {56, 80, 96, 96}};
    add_hooded(c.scene, 100, {0, 1, -0.7}, {});
    add_hooded(c.scene, 5, left, half);
    add_hooded(c.scene, 50, right, corner);
    Outcome out;
    judge(c, static_cast<uint32_t>(setup.scaled(4096, 65536, 1 << 20)), setup, out);
    return out;
}

// A closed room of that floor; its ceiling in y = 2 has a hole of a tenth of a side.
struct Keyhole {
    static constexpr double height = 2, over = 3;
    static constexpr Lit hole{0, -0.3, 0.2, -0.1}, lamp{0.1, -0.7, 0.6, -0.2};
    double sky = 0, glow = 0;  // radiance of what is seen through it; 0: is not there

    static std::array<Vec3d, 4> corners(const Lit& r, double y)
    {
        return {Vec3d{r.x0, y, r.z0}, {r.x1, y, r.z0}, {r.x1, y, r.z1}, {r.x0, y, r.z1}};
    }
    double radiance(Vec3d p) const
    {
        constexpr Vec3d up{0, 1, 0};
        // The part of the lamp's plane that is seen through the hole, and of the lamp.
        const auto beyond = [](double from, double to) { return from + (to - from) * over / height; };
        const Lit seen{std::max(beyond(p.x, hole.x0), lamp.x0), std::max(beyond(p.z, hole.z0), lamp.z0),
                       std::min(beyond(p.x, hole.x1), lamp.x1), std::min(beyond(p.z, hole.z1), lamp.z1)};
        const bool sees_lamp = glow > 0 && seen.x0 < seen.x1 && seen.z0 < seen.z1;
        const double of_lamp = sees_lamp ? lambert(p, up, corners(seen, over)) : 0;
        return albedo / pi_d * (sky * (lambert(p, up, corners(hole, height)) - of_lamp) + glow * of_lamp);
    }
    SceneDescription scene() const
    {
        SceneDescription d = floor_from_above();
        const auto add = [&](const std::array<Vec3d, 4>& p, const MaterialDescription& material = {}) {
            d.meshes.push_back(make_mesh(make_quad(p[0], p[1], p[2], p[3], material)));
        };
        for (const double s : {-1.0, 1.0}) {
            add({Vec3d{s, 0, -1}, {s, 0, 1}, {s, height, 1}, {s, height, -1}});
            add({Vec3d{-1, 0, s}, {1, 0, s}, {1, height, s}, {-1, height, s}});
        }
        add(corners({-1, -1, hole.x0, 1}, height)), add(corners({hole.x1, -1, 1, 1}, height));
        add(corners({hole.x0, -1, hole.x1, hole.z0}, height)), add(corners({hole.x0, hole.z1, hole.x1, 1}, height));
        if (sky > 0) {
            const auto power = static_cast<float>(sky);
            d.lights.push_back(sky_map_of({power, power, power}));
        }
        if (glow > 0) {
            const auto power = static_cast<float>(glow);
            add(corners(lamp, over), make_emitter("lamp", {power, power, power}));
        }
        return d;
    }
};

Outcome through_a_keyhole(const Setup& setup)
{
    // What the hole shows is alike, which has the closed form; most of the light comes from above the horizon.
    const RasterSource sky = picture_source(make_raster(32, 16, [](uint32_t, uint32_t y) {
        const float radiance = y < 6 ? 1.0f : y == 7 ? 20.0f : 0.0f;
        return Color{radiance, radiance, radiance};
    }));
    constexpr uint32_t side = 512;  // for more places at which the pilot looks
    Outcome out;
    for (const auto& [name, hole] : {std::pair<const char*, Keyhole>{"sky", {.sky = 2}},
                                     {"lamp", {.glow = 20}},
                                     {"sky and lamp", {.sky = 2, .glow = 20}}}) {
        const Keyhole keyhole = hole;
        const Case c{.name = name,
                     .scene = keyhole.scene(),
                     .radiance = [=](Vec3d p) { return keyhole.radiance(p); },
                     .side = side,
                     .crop = {0, 0, side, side},
                     .block = side / 4,
                     .most = most_by_both,
                     .images = sky};
        const double whole = judge(c, static_cast<uint32_t>(setup.scaled(8, 128, 1024)), setup, out);
        out.measures.push_back(at_most(c.name + ", variance over that by power", whole, 1));
    }
    return out;
}

// A lamp with nearly all the power that shines between the pixels at which the pilot looks, and a weak one over the
// left half of the floor.
Outcome never_seen(const Setup& setup)
{
    constexpr Vec3d left{-0.5, 1, 0}, right{0.4, 1, 0.4};
    const Lit half = Lit::pixels({0, 0, usual_side / 2, usual_side});
    const Tile unseen{85, 85, 92, 92};
    Case c{.name = "unseen",
           .scene = floor_from_above(),
           .radiance = [=](Vec3d p) { return half.has(p) ? from_point(p, 1, left) : from_point(p, 50, right); },
           .crop = unseen};
    add_hooded(c.scene, 50, right, Lit::pixels(unseen));
    add_hooded(c.scene, 1, left, half);
    Outcome out;
    judge(c, static_cast<uint32_t>(setup.scaled(16384, 1 << 18, 1 << 22)), setup, out);
    return out;
}

}  // namespace

std::vector<Row> learned_light_rows()
{
    return {{"L13", "learned choice of lights: a lamp seen from one cell", "closed form, choice by power", Tier::A,
             false, seen_from_one_cell},
            {"L14", "learned choice of lights: a room lit through a keyhole", "closed form, choice by power", Tier::A,
             false, through_a_keyhole},
            {"L15", "learned choice of lights: a lamp that the pilot never saw", "closed form, choice by power",
             Tier::A, false, never_seen}};
}

}  // namespace lancer::stability
