// The sets of samples that the denoiser asks of a film: how they are dealt, what they see, and that the picture does
// not notice.
#include "render/denoise/film_halves.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "support/random.h"
#include "support/render.h"

namespace lancer {
namespace {

std::vector<uint32_t> counts_of(const SetDeal& deal, uint32_t paths)
{
    std::vector<uint32_t> counts(deal.count());
    for (uint32_t i = 0; i < paths; ++i) ++counts[deal.set_of(i)];
    return counts;
}

// Whole intervals where the number has doubled, else one at most twice the other.
TEST(SampleSets, MakeHalvesOfAnyNumberOfSamples)
{
    Film film(1, 1, {0, 0, 1, 1});
    film.keep_sets({});
    for (uint32_t n = 1; n <= 5000; ++n) {
        if (SetDeal::is_begin(n - 1)) film.begin_interval(0);
        ++film.set_of(0, n - 1).n;
        const auto [a, b] = halves_of(film).samples;
        EXPECT_EQ(a + b, static_cast<float>(n));
        if (std::has_single_bit(n) && n > 1) {
            EXPECT_EQ(a, b) << n;
        }
        if (n > 1) {
            EXPECT_LE(std::max(a, b), 2 * std::min(a, b)) << n;
        }
    }
    EXPECT_EQ(counts_of({.replicates = 2}, 8), (std::vector<uint32_t>{4, 4}));
}

TEST(SampleSets, HoldOutAReplicateOfEachHalf)
{
    EXPECT_EQ(counts_of({.replicates = 8}, 16), (std::vector<uint32_t>{6, 6, 2, 2}));
    EXPECT_EQ(counts_of({.replicates = 4}, 16), (std::vector<uint32_t>{4, 4, 4, 4}));
    const SetDeal deal{.replicates = 8};
    for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(deal.set_of(i), deal.set_of(i + 8)) << "a replicate is of one set";
}

bool same(const SampleSet& a, const SampleSet& b)
{
    return a.sum == b.sum && a.features == b.features && a.n == b.n && a.seen == b.seen;
}

class SetsOf : public testing::TestWithParam<size_t> {
protected:
    SceneDescription scene_ = test_scenes()[GetParam()].make();
    Film draw(const RenderRequest& r) const { return render(scene_, r).film; }
};
INSTANTIATE_TEST_SUITE_P(Every, SetsOf, testing::Range(size_t{0}, test_scenes().size()));

TEST_P(SetsOf, LeaveThePictureAlone)
{
    RenderRequest r;
    r.settings.kernel.replicates = 4;
    const Film plain = draw(r);
    r.sets = SetDeal{.replicates = 4};
    const Film film = draw(r);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        ASSERT_EQ(film.pixels[i].sum, plain.pixels[i].sum) << "pixel " << i;
        SampleSet all;
        for (size_t k = 0; k < 4; ++k) all += film.sets[4 * i + k];
        ASSERT_EQ(all.n, film.pixels[i].n);
        ASSERT_EQ(all.seen, 16u);
        for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(all.sum[c], film.pixels[i].sum[c], 1e-12 * (1 + film.pixels[i].sum[c]));
    }
}

TEST_P(SetsOf, AreTheSameHoweverTheWorkIsCutUp)
{
    RenderRequest r;
    r.sets = SetDeal{};
    const Film film = draw(r);
    RenderRequest cut = r;
    cut.threads = 3, cut.tile = 7, cut.spp = {1, 2, 13}, cut.settings.kernel.batch = 5;
    RenderRequest all = r;
    all.settings.kernel.profile = Profile::all;
    for (const RenderRequest& other : {cut, all}) {
        const Film again = draw(other);
        for (size_t i = 0; i < film.sets.size(); ++i) ASSERT_TRUE(same(film.sets[i], again.sets[i]));
    }
}

// Also of pixels that end before others do, whose intervals no later sample shifts.
TEST_P(SetsOf, AreWholeIntervalsOfEveryPixel)
{
    RenderRequest r;
    r.sets = SetDeal{};
    r.spp = {16, 48};
    r.settings.kernel.stop = StopRule::confidence, r.settings.kernel.stop_error = 0.05f;
    const Film film = draw(r);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        uint32_t seen[3]{};
        for (uint32_t sample = 0; sample < std::min(film.wanted[i], 64u); ++sample) {
            if (SetDeal::is_begin(sample)) seen[0] += seen[1], seen[1] = seen[2], seen[2] = 0;
            ++seen[2];
        }
        for (size_t k = 0; k < 3; ++k) ASSERT_EQ(film.sets[3 * i + k].seen, seen[k]) << "pixel " << i << ", set " << k;
    }
}

// A pane, 2 units ahead of the camera, before a red wall; another wall of the same colour behind the camera.
SceneDescription behind_a_pane(MaterialDescription of_pane)
{
    MaterialDescription red;
    red.name = "red";
    red.base_color = {0.5f, 0.25f, 0.125f};
    SceneDescription d;
    const auto add_wall = [&](double z, double half, const MaterialDescription& material) {
        MeshDescription mesh;
        mesh.data = make_quad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}, material);
        d.meshes.push_back(mesh);
    };
    of_pane.name = "pane";
    add_wall(-2, 50, of_pane);
    add_wall(-5, 500, red);
    add_wall(6, 500, red);
    CameraDescription camera;
    camera.position = {0, 0, 0};
    camera.target = {0, 0, -1};
    camera.fov_deg = 10;
    d.camera = camera;
    LightDescription sky;
    sky.type = LightType::environment;
    sky.power = {1, 1, 1};
    d.lights.push_back(sky);
    return d;
}

SampleSet middle_of(const SceneDescription& d)
{
    RenderRequest r;
    r.width = r.height = 5;
    r.sets = SetDeal{};
    const Film film = render(d, r).film;
    SampleSet half = film.sets[3 * 12 + 2];
    for (float& f : half.features) f /= static_cast<float>(half.seen);
    return half;
}

TEST(Features, AreSeenInAMirror)
{
    MaterialDescription mirror;
    mirror.type = MaterialType::mirror;
    mirror.base_color = {0.5f, 1, 1};
    const SceneDescription d = behind_a_pane(mirror);
    const double scale = length(build_scene(d).normalisation.to_scene(Vec3d{0, 0, 1}) -
                                build_scene(d).normalisation.to_scene(Vec3d{0, 0, 0}));
    const SampleSet seen = middle_of(d);
    EXPECT_NEAR(seen.features[0], 0.25f, 1e-5f);
    EXPECT_NEAR(seen.features[1], 0.25f, 1e-5f);
    EXPECT_NEAR(seen.features[5], -1, 1e-5f) << "the normal of the wall behind the camera";
    EXPECT_NEAR(seen.features[6] * scale, 1.0 / (2 + 8), 1e-3);
}

// Reflection and refraction count by their parts of the light, which add up to 1.
TEST(Features, AreSeenThroughAndInGlass)
{
    MaterialDescription glass;
    glass.type = MaterialType::glass;
    glass.base_color = {1, 1, 1};
    glass.thin = true;
    const SampleSet seen = middle_of(behind_a_pane(glass));
    EXPECT_NEAR(seen.features[0], 0.5f, 1e-4f);
    EXPECT_NEAR(seen.features[2], 0.125f, 1e-4f);
    EXPECT_GT(seen.features[5], 0.5f) << "mostly the wall behind the pane, which faces the camera";
    EXPECT_LT(seen.features[5], 0.95f) << "and some of what it mirrors";
}

TEST(DenoiseFilm, LessensTheErrorOfAPicture)
{
    const SceneDescription d = cornell_scene();
    RenderRequest r;
    r.width = 64, r.height = 64, r.spp = {8};
    r.sets = SetDeal{};
    const Film film = render(d, r).film;
    Denoised denoised;
    with_threads(2, [&] { denoised = denoise_film(film); });
    r.sets.reset();
    r.spp = {512};
    r.settings.kernel.seed = 5;
    const Film reference = render(d, r).film;
    double before = 0, after = 0;
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        const Color truth = reference.pixels[i].mean();
        const auto error = [&](Color x) {
            const Color e = x - truth, square = e * e, size = truth * truth;
            return double{square.r / (size.r + 0.01f) + square.g / (size.g + 0.01f) + square.b / (size.b + 0.01f)};
        };
        before += error(film.pixels[i].mean());
        after += error(denoised.pixels[i]);
        EXPECT_GE(denoised.error[i], 0);
    }
    EXPECT_LT(after, before / 2) << "the edge of the lamp included, which has most of the error";
}

// Whenever it is stopped: the picture with all of its layers, or nothing.
TEST(DenoiseFilm, IsWholeOrEmptyWhereItIsStopped)
{
    Film film(96, 96, {0, 0, 96, 96});
    film.keep_sets(SetDeal{});
    film.keep_layers({.groups = 6});
    Random random(3);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
        film.pixels[i] += {{0.5, 0.5, 0.5}, 0.25, 1};
        for (size_t k = 0; k < film.deal.count(); ++k) {
            film.sets[film.deal.count() * i + k].n = 1;
            for (double& s : film.sets[film.deal.count() * i + k].sum) s = random.uniform();
        }
    }
    for (const int after : {0, 1, 3, 10, 30, 60, 100, 150, 200, 300}) {
        std::stop_source stop;
        const std::jthread stopper([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(after));
            stop.request_stop();
        });
        const Denoised denoised = denoise_film(film, UsedSets::all, stop.get_token());
        const size_t pixels = denoised.pixels.size();
        EXPECT_TRUE(pixels == 0 || pixels == film.pixels.size());
        EXPECT_EQ(denoised.layers.size(), pixels == 0 ? 0 : film.layers.size()) << after;
        for (const auto& layer : denoised.layers) EXPECT_EQ(layer.size(), pixels) << after;
    }
}

// What a picture file holds of the halves denoises to the same bits.
TEST(DenoiseFilm, GivesTheSameFromSavedPlanes)
{
    RenderRequest r;
    r.spp = {13};  // halves of 8 and 5
    r.sets = SetDeal{};
    const Film film = render(cornell_scene(), r).film;
    const HalfPlanes halves = halves_of(film);
    const std::vector<ImagePlane> planes = planes_of(halves);
    ASSERT_EQ(planes.size(), names_of_halves().size());
    std::vector<std::vector<float>> values;
    for (const ImagePlane& p : planes) values.push_back(p.values);
    EXPECT_EQ(denoise_film(film).pixels, denoise_picture(halves_from(values, halves.samples).input(32, 24)).pixels);
}

}  // namespace
}  // namespace lancer
