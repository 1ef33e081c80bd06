// What MTL keys say together: illum alone is not believed.
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class MtlKinds : public ObjTest {
protected:
    static constexpr auto glass = MaterialType::glass, lambert = MaterialType::lambert, plastic = MaterialType::plastic;

    MaterialDescription material(const std::string& statements, const std::string& head = "")
    {
        write("a.png", "");
        const auto m = load_with(head + "newmtl m\n" + statements + "\n", "usemtl m\nf 1 2 3\n");
        EXPECT_TRUE(m) << errors();
        return m ? m->materials.at(0) : MaterialDescription{};
    }
};

struct KindCase {
    const char* statements;
    MaterialType type;
    const char* why;
};

TEST_F(MtlKinds, IllumIsAHint)
{
    const KindCase cases[] = {
        // As Maya writes opaque materials.
        {"illum 4\nKd .5 .4 .3\nKa 0 0 0\nTf 1 1 1\nNi 1.00", lambert, "illum 4 says glass, but Ni is 1"},
        {"illum 4\nTf 1 1 1\nmap_Kd a.png\nNi 1", lambert, "illum 4 says glass, but Ni is 1"},
        {"illum 4\nKd .5 .5 .5\nKs .1 .1 .1\nTf 1 1 1\nNi 1", plastic, "Ks; illum 4 says glass, but Ni is 1"},
        {"illum 9\nKd .5 .5 .5", lambert, "Ni is missing"},
        {"illum 7\nNi 1.009", lambert, "Ni is 1.01"},
        {"illum 6\nNi 1.5\nKd .051 0 0", lambert, "Kd is opaque"},
        {"illum 6\nNi 1.5\nKd .5 .5 .5\nd 1", lambert, "Kd is opaque"},
        {"illum 6\nNi 1.5\nKd .5 .5 .5\nTr 0", lambert, "Kd is opaque"},
        {"illum 7\nNi 1.5\nmap_Kd a.png", lambert, "map_Kd is opaque"},
        {"illum 7\nNi 1.5\nKd .5 .5 .5\nTf 0 0 0", lambert, "Kd is opaque"},
        // What else says glass.
        {"illum 7\nNi 1.5", glass, "illum 7 and Ni 1.5 without Kd"},
        {"illum 7\nNi 1.33\nKd 0 0 0", glass, "illum 7 and Ni 1.33 without Kd"},
        {"illum 7\nNi 1.8\nKd .01 .01 .01\nTf 1 1 1", glass, "illum 7"},
        {"illum 7\nNi 0.75\nKd 0 0 0", glass, "illum 7"},
        {"illum 4\nNi 1\nKd .5 .5 .5\nTf .3 .3 .3", glass, "illum 4 and a Tf that is neither black nor white"},
        {"illum 4\nKd .5 .5 .5\nd .2", glass, "illum 4 and d 0.2"},
        {"illum 4\nKd .5 .5 .5\nTr .8", glass, "illum 4 and Tr 0.8"},
        {"illum 9\nNi 1.45\nKd .1 .8 .1\nd .3", glass, "illum 9 and d 0.3"},
        {"Pr 0\nPm 0\nTf 1 1 1\nNi 1.45\nKd 1 1 1\nd .1\nillum 7", glass, "illum 7 and d 0.1"},
        {"d .5\nNi 1.33", glass, "d 0.5 and Ni 1.33"},
    };
    for (const KindCase& c : cases) {
        const MaterialDescription m = material(c.statements);
        EXPECT_EQ(m.type, c.type) << c.statements;
        EXPECT_THAT(m.why, HasSubstr(c.why)) << c.statements;
        EXPECT_EQ(m.is_doubtful, m.why.find("says glass, but") != std::string::npos) << c.statements;
        EXPECT_THAT(warnings(), IsEmpty()) << c.statements;
    }
}

TEST_F(MtlKinds, GlassHasTheColourOfTfOrElseOfKd)
{
    const auto through = [&](const char* statements) {
        const Color c = material(statements).base_color;
        return Color{c.r * c.r, c.g * c.g, c.b * c.b};
    };
    const auto expect_color = [](Color found, Color expected) {
        EXPECT_NEAR(found.r, expected.r, 1e-6f);
        EXPECT_NEAR(found.g, expected.g, 1e-6f);
        EXPECT_NEAR(found.b, expected.b, 1e-6f);
    };
    expect_color(through("illum 9\nNi 1.45\nKd .1 .8 .1\nd .3"), {.1f, .8f, .1f});
    expect_color(through("illum 9\nNi 1.45\nKd .1 .8 .1\nTf .5 .6 .7\nd .3"), {.5f, .6f, .7f});
    expect_color(through("illum 9\nNi 1.45\nKd .8 .8 .8\nd .3"), {1, 1, 1});
}

TEST_F(MtlKinds, GlassIsRoughByPrOrElseByALowNs)
{
    EXPECT_EQ(material("Pr .3\nNi 1.45\nd .1\nillum 7").roughness, .3f);
    EXPECT_EQ(material("Pr 0\nNs 10\nNi 1.45\nd .1\nillum 7").roughness, 0);
    EXPECT_TRUE(material("map_Pr a.png\nNi 1.45\nd .1\nillum 7").roughness_map);
}

TEST_F(MtlKinds, BlenderWritesMetalsWithKdAndTfForTransmissionAlone)
{
    const std::string head = "# Blender 3.4.1 MTL File: 'None'\n# www.blender.org\n\n";
    const char* gold = "Ns 640\nKa 1 1 1\nKd 1 .766 .336\nKs .5 .5 .5\nNi 1.45\nd 1\nillum 3";
    const auto metal = material(gold, head);
    EXPECT_EQ(metal.type, MaterialType::metal);
    EXPECT_EQ(metal.base_color, (Color{1, .766f, .336f}));
    EXPECT_NEAR(metal.roughness, .2f, 1e-6f);
    EXPECT_EQ(material(gold).type, MaterialType::plastic);  // of another program
    EXPECT_EQ(material("Ns 250\nKd .8 .8 .8\nKs .5 .5 .5\nNi 1.45\nillum 2", head).roughness, .5f);
    const auto clear = material("Ns 1000\nKd .8 .8 .8\nKs .5 .5 .5\nNi 1.45\nd 1\nillum 2\nTf 1 1 1", head);
    EXPECT_EQ(clear.type, MaterialType::glass);
    EXPECT_EQ(clear.base_color, (Color{1, 1, 1}));
}

TEST_F(MtlKinds, KeysMayBeWrittenInAnyCase)
{
    const auto m = material("KD .1 .2 .3\nMAP_KD a.png\nPR .25\nmap_BUMP a.png\nKA 1 1 1\nPCR .03\nILLUM 2");
    EXPECT_EQ(m.base_color, (Color{.1f, .2f, .3f}));
    EXPECT_TRUE(m.base_color_map);
    EXPECT_TRUE(m.bump_map);
    EXPECT_EQ(m.roughness, .25f);
    EXPECT_THAT(warnings(), IsEmpty());
}

}  // namespace
}  // namespace lancer
