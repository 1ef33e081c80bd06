// lancer render --aov lobes: each layer is the picture that its lobe alone would make.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "app/run_program.h"
#include "render/mattes.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

using Arguments = std::vector<std::string>;

constexpr const char* lobes[] = {"emission", "diffuse", "glossy", "transmission"};

class LobeLayers : public AppTest {
protected:
    // A triangle of a material, which no ray meets again, between lights.
    void write_sheet(const std::string& name, const std::string& material, const std::string& lights) const
    {
        write(name, "[camera]\nposition = [0, 1, 4]\ntarget = [0, 0, 0]\nfov = 30\n" + lights + "[material.m]\n" +
                        material +
                        "[[triangle]]\na = [-1.5, -1, 0]\nb = [1.5, -1, 0]\nc = [0, 1.5, 0.3]\nmaterial = \"m\"\n");
    }
    // Draws name.toml into name.exr.
    void draw(const std::string& name, const Arguments& how) const
    {
        Arguments all{"render", name + ".toml", "--size", "24x20", "-q", "-o", name + ".exr"};
        all.insert(all.end(), how.begin(), how.end());
        const Said said = run(all);
        ASSERT_EQ(said.code, 0) << said.err;
    }
    std::vector<float> channel(const std::string& name, const std::string& which) const
    {
        return read_exr_channel(file(name + ".exr"), which);
    }
};

// Where points and directions shine, each lobe can be had alone by the colours of the others.
TEST_F(LobeLayers, AreThePicturesOfEachLobeAlone)
{
    const std::string lights =
        "[[light]]\ntype = \"point\"\nposition = [-2, 3, 3]\nintensity = [14, 13, 12]\n"
        "[[light]]\ntype = \"directional\"\ndirection = [-1, -1, -1]\nirradiance = [0.6, 1, 1.5]\n"
        "[[light]]\ntype = \"point\"\nposition = [1, 1, -3]\nintensity = [9, 9, 12]\n";
    struct Case {
        std::string all;
        std::vector<std::pair<const char*, std::string>> alone;
    };
    const std::vector<Case> cases{
        {"type = \"plastic\"\nbase_color = [0.6, 0.3, 0.1]\nroughness = 0.5\nspecular = [0.9, 1, 0.8]\n",
         {{"diffuse", "type = \"plastic\"\nbase_color = [0.6, 0.3, 0.1]\nroughness = 0.5\nspecular = 0\n"},
          {"glossy", "type = \"plastic\"\nbase_color = 0\nroughness = 0.5\nspecular = [0.9, 1, 0.8]\n"}}},
        {"type = \"interface\"\nbase_color = [0.3, 0.2, 0.1]\nspecular = [0.2, 0.3, 0.4]\nshininess = 8\n",
         {{"diffuse", "type = \"interface\"\nbase_color = [0.3, 0.2, 0.1]\nspecular = 0\nshininess = 8\n"},
          {"glossy", "type = \"interface\"\nbase_color = 0\nspecular = [0.2, 0.3, 0.4]\nshininess = 8\n"}}},
        {"type = \"translucent\"\nbase_color = [0.3, 0.2, 0.1]\ntransmittance = [0.2, 0.3, 0.4]\n",
         {{"diffuse", "type = \"translucent\"\nbase_color = [0.3, 0.2, 0.1]\ntransmittance = 0\n"},
          {"transmission", "type = \"translucent\"\nbase_color = 0\ntransmittance = [0.2, 0.3, 0.4]\n"}}},
        {"base_color = [0.3, 0.2, 0.1]\n", {{"diffuse", "base_color = [0.3, 0.2, 0.1]\n"}}},
        {"type = \"metal\"\nroughness = 0.4\n", {{"glossy", "type = \"metal\"\nroughness = 0.4\n"}}},
    };
    // For whitted all other materials are Phong's.
    for (const std::string integrator : {"direct", "path", "whitted"})
        for (const Case& c : cases) {
            if (integrator == "whitted" && c.all.find("interface") == std::string::npos) continue;
            SCOPED_TRACE(integrator + " " + c.all);
            // The same random numbers for all materials.
            const Arguments way{"--integrator",      integrator, "-s",          "16",    "--set",
                                "learned_nee=false", "--set",    "split=false", "--set", "roulette=false"};
            Arguments with_layers = way;
            with_layers.insert(with_layers.end(), {"--aov", "lobes"});
            write_sheet("all.toml", c.all, lights);
            ASSERT_NO_FATAL_FAILURE(draw("all", with_layers));
            for (const auto& [lobe, material] : c.alone) {
                write_sheet("alone.toml", material, lights);
                ASSERT_NO_FATAL_FAILURE(draw("alone", way));
                for (const char* const rgb : {"R", "G", "B"}) {
                    const std::vector<float> layer = channel("all", std::string("lobe.") + lobe + "." + rgb),
                                             alone = channel("alone", rgb), whole = channel("all", rgb);
                    float most = 0;
                    for (size_t i = 0; i < layer.size(); ++i) {
                        ASSERT_NEAR(layer[i], alone[i], 2e-6f * whole[i]) << lobe << ' ' << i;
                        most = std::max(most, layer[i]);
                    }
                    EXPECT_GT(most, 0.001f) << lobe;
                }
            }
            for (const char* const lobe : lobes) {
                const bool is_there = std::any_of(c.alone.begin(), c.alone.end(),
                                                  [&](const auto& one) { return one.first == std::string(lobe); });
                if (is_there) continue;
                for (const float x : channel("all", std::string("lobe.") + lobe + ".G")) ASSERT_EQ(x, 0) << lobe;
            }
        }
}

// Under a sky directions are sampled by either lobe and by the light: on the average each layer has its lobe's light.
TEST_F(LobeLayers, HaveTheMeansOfEachLobeAlone)
{
    const std::string sky = "[[light]]\ntype = \"environment\"\nradiance = [0.4, 0.7, 1]\n";
    const std::string plastic = "type = \"plastic\"\nbase_color = [0.2, 0.15, 0.1]\nroughness = 0.6\n";
    write_sheet("all.toml", plastic, sky);
    write_sheet("alone.toml", plastic + "specular = 0\n", sky);
    stats::Family family;
    for (const std::string nee : {"true", "false"}) {
        stats::Tally layer, alone;
        for (int seed = 1; seed <= 16; ++seed) {
            const Arguments way{"-s",        "8",           "--seed", std::to_string(seed), "--set", "nee=" + nee,
                                "--sampler", "independent", "--crop", "8,6,16,14"};
            Arguments with_layers = way;
            with_layers.insert(with_layers.end(), {"--aov", "lobes"});
            ASSERT_NO_FATAL_FAILURE(draw("all", with_layers));
            ASSERT_NO_FATAL_FAILURE(draw("alone", way));
            const auto mean = [](const std::vector<float>& of) {
                double sum = 0;
                for (const float x : of) sum += static_cast<double>(x);
                return sum / static_cast<double>(of.size());
            };
            layer.add(mean(channel("all", "lobe.diffuse.G"))), alone.add(mean(channel("alone", "G")));
        }
        EXPECT_LT(layer.error(), 0.02 * layer.mean);
        family.add(stats::welch_p(layer, alone), "nee=" + nee);
    }
}

// Pixels that show one material have the lobes of it, however the light went on. Of a mix, whose parts are chosen at
// random, those of both.
TEST_F(LobeLayers, AreThoseOfTheFirstSurface)
{
    write("room.toml",
          "[camera]\nposition = [0, 1, 6]\ntarget = [0, 0.8, 0]\nfov = 40\n"
          "[[light]]\ntype = \"sphere\"\ncenter = [0, 4, 2]\nradius = 0.5\nradiance = 9\n"
          "[[light]]\ntype = \"environment\"\nradiance = 0.3\n"
          "[material.floor]\nbase_color = 0.6\n[material.mirror]\ntype = \"mirror\"\n"
          "[material.lamp]\nbase_color = 0\nemission = 2\n[material.glass]\ntype = \"glass\"\n"
          "[material.frosted]\ntype = \"glass\"\nroughness = 0.4\n"
          "[material.pane]\ntype = \"glass\"\nthin = true\n"
          "[material.half]\ntype = \"mix\"\nfirst = \"floor\"\nsecond = \"mirror\"\n"
          "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n"
          "[[sphere]]\ncenter = [-2, 0.7, 0]\nradius = 0.6\nmaterial = \"mirror\"\n"
          "[[sphere]]\ncenter = [-0.6, 0.7, 0]\nradius = 0.6\nmaterial = \"glass\"\n"
          "[[sphere]]\ncenter = [0.8, 0.7, 0]\nradius = 0.6\nmaterial = \"frosted\"\n"
          "[[sphere]]\ncenter = [2.2, 0.7, 0]\nradius = 0.6\nmaterial = \"half\"\n"
          "[[sphere]]\ncenter = [-0.7, 2.2, 0]\nradius = 0.6\nmaterial = \"lamp\"\n"
          "[[sphere]]\ncenter = [0.8, 2.2, 0]\nradius = 0.6\nmaterial = \"pane\"\n");
    const std::vector<std::pair<const char*, std::string>> of_materials{{"floor", "diffuse"},
                                                                        {"mirror", "glossy"},
                                                                        {"glass", "glossy transmission"},
                                                                        {"frosted", "glossy transmission"},
                                                                        {"half", "diffuse glossy"},
                                                                        {"lamp", "emission"},
                                                                        {"pane", "glossy transmission"}};
    for (const std::string integrator : {"path", "direct"}) {
        ASSERT_NO_FATAL_FAILURE(
            draw("room", {"--size", "48x36", "-s", "16", "--integrator", integrator, "--aov", "lobes,cryptomatte"}));
        const std::vector<float> id = channel("room", "CryptoMaterial00.R"),
                                 part = channel("room", "CryptoMaterial00.G"), whole = channel("room", "G");
        for (const auto& [material, expected] : of_materials) {
            // The way through a body of rough glass has a second surface that spreads light.
            if (integrator == "direct" && material == std::string("frosted")) continue;
            SCOPED_TRACE(integrator + " " + material);
            size_t shown = 0;
            for (const char* const lobe : lobes) {
                const std::vector<float> layer = channel("room", std::string("lobe.") + lobe + ".G");
                double sum = 0;
                for (size_t i = 0; i < layer.size(); ++i)
                    if (std::bit_cast<uint32_t>(id[i]) == matte_id(material) && part[i] == 1)
                        sum += static_cast<double>(layer[i]), ++shown;
                EXPECT_EQ(sum > 0, expected.find(lobe) != std::string::npos) << lobe;
            }
            EXPECT_GT(shown, 4 * 8u);
        }
        const std::vector<float> emission = channel("room", "lobe.emission.G");
        for (size_t i = 0; i < id.size(); ++i)
            if (part[i] == 0) {
                ASSERT_EQ(emission[i], whole[i]) << "the sky at " << i;
            }
    }
}

}  // namespace
}  // namespace lancer
