// What MTL materials become: docs/scene-format.md, "Materials of an OBJ file", row by row.
#include <cmath>

#include "materials/anisotropic.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class MtlMaterial : public ObjTest {
protected:
    // The material that these statements make; the pictures a.png and b.png are there.
    MaterialDescription material(const std::string& statements)
    {
        write("a.png", "");
        write("b.png", "");
        const auto m = load_with("newmtl m\n" + statements + "\n", "usemtl m\nvt 0 0\nf 1/1 2/1 3/1\n");
        EXPECT_TRUE(m) << errors();
        return m ? m->materials.at(0) : MaterialDescription{};
    }
    static float roughness(double ns) { return static_cast<float>(std::sqrt(std::sqrt(2 / (ns + 2)))); }
};

struct KeysCase {
    const char* statements;
    MaterialType type;
};

TEST_F(MtlMaterial, GivenKeysDecideTheType)
{
    const KeysCase cases[] = {
        {"", MaterialType::lambert},
        {"Kd 1 0 0", MaterialType::lambert},
        {"Kd .5 .5 .5\nKs 0 0 0\nNs 10\nNi 1.5\nillum 2\nd 1\nTr 0\nTf 1 1 1", MaterialType::lambert},
        {"Kd 0 0 0\nKs 0 0 0\nillum 3\nNs 500", MaterialType::lambert},
        {"Kd .5 .5 .5\nKs .5 .5 .5\nNs 96", MaterialType::plastic},
        {"Kd 0 0 0\nKs .5 .5 .5\nNs 96\nillum 2", MaterialType::plastic},
        {"Kd .5 .5 .5\nKs .95 .95 .95\nNs 1000\nillum 5", MaterialType::plastic},
        {"map_Kd a.png\nKs .9 .9 .9\nillum 3", MaterialType::plastic},
        {"Kd .01 .01 .01\nKs .95 .95 .95\nNs 1000\nillum 5", MaterialType::mirror},
        {"Ks .95 .95 .95\nillum 3", MaterialType::mirror},
        {"Ks .95 .95 .95\nillum 8", MaterialType::mirror},
        {"Ks .95 .95 .95\nNs 999\nillum 3", MaterialType::metal},
        {"map_Ks a.png\nNs 20\nillum 5", MaterialType::metal},
        {"Ni 1.5\nillum 4", MaterialType::glass},
        {"Kd .01 .01 .01\nKs .3 .3 .3\nNi 1.5\nillum 6", MaterialType::glass},
        {"d .5\nNi 1.33", MaterialType::glass},
        {"Tr .5\nNi 1.33", MaterialType::glass},
        {"d .5\nNi 1", MaterialType::lambert},
        {"d .5", MaterialType::lambert},
        {"d .5\nNi 1.5\nmap_d a.png", MaterialType::lambert},
        {"Pr .3", MaterialType::plastic},
        {"Pm 0\nKs 1 1 1\nillum 3", MaterialType::plastic},
        {"Pm .49", MaterialType::plastic},
        {"Pm .5", MaterialType::metal},
        {"Pm 1\nPr .3\nillum 7", MaterialType::metal},
        {"map_Pr a.png", MaterialType::plastic},
        {"map_Pm a.png", MaterialType::plastic},
    };
    for (const KeysCase& c : cases) EXPECT_EQ(material(c.statements).type, c.type) << c.statements;
}

TEST_F(MtlMaterial, MirrorsAndMetalsReflectKs)
{
    const auto mirror = material("Kd .01 .01 .01\nKs .9 .8 .7\nNs 1000\nillum 5");
    EXPECT_EQ(mirror.base_color, (Color{.9f, .8f, .7f}));
    const auto metal = material("Kd 0 0 0\nKs .9 .8 .7\nNs 198\nillum 3\nmap_Ks a.png");
    EXPECT_EQ(metal.base_color, (Color{.9f, .8f, .7f}));
    EXPECT_FLOAT_EQ(metal.roughness, std::sqrt(0.1f));
    ASSERT_TRUE(metal.base_color_map);
    EXPECT_EQ(relative(metal.base_color_map->file), "a.png");
    EXPECT_EQ(metal.base_color_map->use.encoding, Encoding::of_file);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(MtlMaterial, GlassIsTintedBySurfaceAndRoughOnlyIfSaid)
{
    const auto clear = material("illum 7\nKd 0 0 0\nKs 1 1 1\nTf 1 1 1\nNs 10000\nNi 1.8\nd 0");
    EXPECT_EQ(clear.base_color, (Color{1, 1, 1}));
    EXPECT_EQ(clear.ior, 1.8f);
    EXPECT_EQ(clear.roughness, 0);
    EXPECT_EQ(clear.opacity, 1);
    // Two surfaces let through what Tf says.
    const auto tinted = material("illum 7\nKs .04 .04 .04\nTf .25 .5 1");
    EXPECT_FLOAT_EQ(tinted.base_color.r * tinted.base_color.r, .25f);
    EXPECT_FLOAT_EQ(tinted.base_color.g * tinted.base_color.g, .5f);
    EXPECT_EQ(tinted.base_color.b, 1);
    EXPECT_EQ(tinted.ior, 1.5f);
    EXPECT_EQ(material("illum 7\nNi 1.5\nTf 0 0 0").base_color, (Color{1, 1, 1}));
    EXPECT_EQ(material("illum 7\nNi 1.5\nNs 100").roughness, 0);
    EXPECT_FLOAT_EQ(material("illum 7\nNi 1.5\nNs 99").roughness, roughness(99));
    EXPECT_EQ(material("illum 7\nNi 1\nd .3").ior, 1);
    EXPECT_THAT(warnings(), IsEmpty());
    material("illum 7\nd .1\nmap_Kd a.png\nmap_Ks a.png");
    EXPECT_THAT(warnings(),
                ElementsAre("a.mtl:4: warning: map_Kd of glass ignored", "a.mtl:5: warning: map_Ks of glass ignored"));
}

// At normal incidence the coat reflects F0(ior) * specular: Ks itself while that is no more than the coat can do.
TEST_F(MtlMaterial, CoatReflectsKsWhereItIsAReflectance)
{
    for (const float ni : {1.2f, 1.5f, 2.0f})
        for (const float ks : {.001f, .008f, .03f, .04f, .3f, 1.0f}) {
            const std::string k = std::to_string(ks);
            const auto m = material("Kd .5 .5 .5\nKs " + k + " " + k + " " + k + "\nNs 30\nNi " + std::to_string(ni));
            const float f0 = std::pow((ni - 1) / (ni + 1), 2.0f);
            EXPECT_EQ(m.ior, ni);
            EXPECT_NEAR(m.specular.g * f0, std::min(ks, f0), 1e-6f) << ni << " " << ks;
            EXPECT_LE(max_component(m.specular), 1);
            EXPECT_EQ(m.base_color, (Color{.5f, .5f, .5f}));
            EXPECT_FLOAT_EQ(m.roughness, .5f);
        }
    const auto tinted = material("Kd .5 .5 .5\nKs .8 .4 .2");
    EXPECT_FLOAT_EQ(tinted.specular.r, 1);
    EXPECT_FLOAT_EQ(tinted.specular.g, .5f);
    EXPECT_FLOAT_EQ(tinted.specular.b, .25f);
    EXPECT_EQ(tinted.ior, 1.5f);
    EXPECT_EQ(tinted.roughness, .5f);
    EXPECT_EQ(material("Kd .5 .5 .5\nKs 1 1 1\nNi 1").ior, 1.5f);
    EXPECT_EQ(material("Kd .5 .5 .5\nKs 1 1 1\nNs 0").roughness, 1);
}

TEST_F(MtlMaterial, PhysicalKeysAreTakenAsTheyAre)
{
    const auto coat = material("Kd .5 .4 .3\nPr .3\nNi 1.4\nKs 1 1 1\nNs 500");
    EXPECT_EQ(coat.base_color, (Color{.5f, .4f, .3f}));
    EXPECT_EQ(coat.roughness, .3f);
    EXPECT_EQ(coat.ior, 1.4f);
    EXPECT_EQ(coat.specular, (Color{1, 1, 1}));
    EXPECT_FALSE(coat.metallic);
    const auto metal = material("Kd .9 .7 .3\nPm 1\nNs 198\nmap_Kd a.png");
    EXPECT_EQ(metal.base_color, (Color{.9f, .7f, .3f}));
    EXPECT_TRUE(metal.base_color_map);
    EXPECT_FLOAT_EQ(metal.roughness, std::sqrt(.1f));
    EXPECT_EQ(material("Pm 1").roughness, .5f);
    const auto mapped = material("map_Pr -imfchan g a.png\nmap_Pm b.png");
    EXPECT_EQ(mapped.roughness, 1);
    EXPECT_EQ(mapped.metallic, 1);
    ASSERT_TRUE(mapped.roughness_map && mapped.metallic_map);
    EXPECT_EQ(mapped.roughness_map->use.channel, Channel::green);
    EXPECT_EQ(mapped.metallic_map->use.channel, Channel::red);
    EXPECT_EQ(mapped.roughness_map->use.encoding, Encoding::linear);
    EXPECT_EQ(relative(mapped.metallic_map->file), "b.png");
    const auto scaled = material("Pr .5\nmap_Pr a.png\nPm .25\nmap_Pm b.png");
    EXPECT_EQ(scaled.roughness, .5f);
    EXPECT_EQ(scaled.metallic, .25f);
    EXPECT_THAT(warnings(), IsEmpty());
    material("Pr .5\nmap_Ks a.png");
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: map_Ks beside Pr or Pm ignored"));
}

TEST_F(MtlMaterial, LayersOfThePhysicalKeysArePrincipled)
{
    EXPECT_EQ(material("Pr .5\nPs 0\nPc 0\nPcr .03\naniso 0\nanisor 0\nmap_Pc a.png").type, MaterialType::plastic);
    const auto coated = material("Pr .5\nPc .25\nPcr .03\nmap_Ps b.png");
    EXPECT_EQ(coated.type, MaterialType::principled);
    EXPECT_EQ(coated.coat, .25f);
    EXPECT_EQ(coated.coat_roughness, .03f);
    EXPECT_EQ(coated.fuzz, 1);
    ASSERT_TRUE(coated.fuzz_map);
    EXPECT_EQ(relative(coated.fuzz_map->file), "b.png");
    EXPECT_EQ(coated.roughness, .5f);
    // Disney's alphas: the squared roughness times and over sqrt(1 - 0.9 aniso).
    const auto brushed = material("Pm 1\nPr .5\naniso .5\nanisor .25");
    EXPECT_EQ(brushed.metallic, 1.0f);
    EXPECT_EQ(brushed.anisotropy_rotation, .25f);
    const AlphaPair alpha = alphas_of(brushed.roughness, brushed.anisotropy);
    EXPECT_NEAR(alpha.along, .25f / std::sqrt(.55f), 1e-5f);
    EXPECT_NEAR(alpha.across, .25f * std::sqrt(.55f), 1e-5f);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(MtlMaterial, OpacityIsDOrWhatTrLeaves)
{
    EXPECT_EQ(material("d .25").opacity, .25f);
    EXPECT_EQ(material("Tr .25").opacity, .75f);
    EXPECT_EQ(material("d .25\nTr .75").opacity, .25f);
    EXPECT_EQ(material("Kd 1 1 1\nPr .5\nd .25").opacity, .25f);
    EXPECT_EQ(material("Ks 1 1 1\nd .25").opacity, .25f);
    EXPECT_EQ(material("d 1\nTr 0").opacity, 1);
    EXPECT_EQ(material("illum 7\nNi 1.5\nTr 1").opacity, 1);
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_EQ(material("d 1\nTr 1").opacity, 1);
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: d and Tr contradict each other; d is used"));
    EXPECT_EQ(material("Tr 1").opacity, 1);
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: Tr 1 without d would make the surface invisible; taken for "
                                        "opaque"));
    EXPECT_EQ(material("d 0").opacity, 0);
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: d 0 makes the surface invisible"));
    EXPECT_EQ(material("d -halo .5").opacity, .5f);
    EXPECT_THAT(warnings(),
                ElementsAre("a.mtl:2: warning: option -halo of d is not supported; d is the same from all sides"));
    // Programs write d 0 where they mean that the map decides.
    EXPECT_EQ(material("d 0\nmap_d a.png").opacity, 1);
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: d 0 would make map_d invisible; the map alone is used"));
    const auto leaf = material("d 1\nmap_d a.png\nNi 1.5");
    ASSERT_TRUE(leaf.opacity_map);
    EXPECT_EQ(leaf.opacity_map->use.channel, Channel::automatic);
    EXPECT_EQ(leaf.opacity_map->use.encoding, Encoding::linear);
    EXPECT_TRUE(material("map_opacity a.png").opacity_map);
}

TEST_F(MtlMaterial, ColoursMultiplyTheirTextures)
{
    const auto both = material("Kd .5 .25 1\nmap_Kd a.png\nKe 2 3 4\nmap_Ke b.png");
    EXPECT_EQ(both.base_color, (Color{.5f, .25f, 1}));
    EXPECT_EQ(relative(both.base_color_map->file), "a.png");
    EXPECT_EQ(both.base_color_map->where.line, 3u);
    EXPECT_EQ(both.emission, (Color{2, 3, 4}));
    EXPECT_EQ(both.emission_map->use.encoding, Encoding::of_file);
    EXPECT_EQ(material("map_Kd a.png").base_color, (Color{1, 1, 1}));
    EXPECT_EQ(material("map_Ke a.png").emission, (Color{1, 1, 1}));
    EXPECT_EQ(material("map_Ke a.png").base_color, Color{});
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_EQ(material("Kd 0 0 0\nmap_Kd a.png").base_color, (Color{1, 1, 1}));
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: a black Kd would blacken map_Kd; white is used"));
    // Without its picture it is as any surface of which nothing is known.
    EXPECT_EQ(material("Kd 0 0 0\nmap_Kd missing.png").base_color, (Color{.8f, .8f, .8f}));
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: texture file 'missing.png' not found; not used",
                                        "a.mtl:2: warning: a black Kd would blacken map_Kd; white is used"));
    EXPECT_FALSE(material("Ke 0 0 0\nmap_Ke a.png").emission_map);
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: map_Ke beside a black Ke emits nothing"));
    material("Kd 1 1 1\nKs 1 1 1\nmap_Ks a.png");
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:4: warning: map_Ks is used for mirrors and metals only; ignored"));
}

TEST_F(MtlMaterial, ReliefIsLinearAndNamedOnce)
{
    const auto m = material("map_bump -bm .3 a.png\nbump -bm .3 a.png\nnorm b.png");
    ASSERT_TRUE(m.bump_map && m.normal_map);
    EXPECT_EQ(m.bump_scale, .3f);
    EXPECT_EQ(m.bump_map->use.encoding, Encoding::linear);
    EXPECT_EQ(m.bump_map->use.channel, Channel::red);
    EXPECT_EQ(m.normal_map->use.encoding, Encoding::linear);
    EXPECT_EQ(m.normal_map->use.channel, Channel::color);
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_EQ(relative(material("map_Bump a.png\nbump b.png").bump_map->file), "b.png");
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: bump after another one; the last is used"));
}

}  // namespace
}  // namespace lancer
