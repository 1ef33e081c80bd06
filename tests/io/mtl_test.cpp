#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Mtl = ObjTest;

TEST_F(Mtl, MaterialsAreAssignedInOrderOfUse)
{
    const auto m = load_with(
        "newmtl red # one\r\nKd 1 0 0 # Red\r\n\nnewmtl unused\nKd 0 0 0\nnewmtl two words\n"
        "\tKd 0.25\n Ke 17 12 4\nnewmtl lamp\nKe 1 2 3\nnewmtl dark\nKe 0 0 0\n",
        "f 1 2 3\nusemtl two words\nf 1 2 3\nusemtl red\nf 1 2 3\nf 1 2 3\nusemtl lamp\nf 1 1 1\n"
        "usemtl two words\nf 1 2 3\nusemtl dark\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 4u);
    EXPECT_THAT(m->face_material, ElementsAre(0, 1, 2, 2, 1, 3));
    EXPECT_EQ(m->materials[0].name, "default");
    EXPECT_EQ(m->materials[1].name, "two words");
    EXPECT_EQ(relative(to_string(m->materials[1].where)), "a.mtl:6");
    EXPECT_EQ(m->materials[1].base_color, (Color{0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(m->materials[1].emission, (Color{17, 12, 4}));
    EXPECT_EQ(m->materials[2].name, "red");
    EXPECT_EQ(m->materials[2].type, MaterialType::lambert);
    EXPECT_EQ(m->materials[2].base_color, (Color{1, 0, 0}));
    EXPECT_EQ(m->materials[3].base_color, (Color{0.8f, 0.8f, 0.8f}));
    EXPECT_THAT(warnings(), ElementsAre("a.obj:12: warning: zero-area face dropped"));

    const auto lamp = load("mtllib a.mtl\n" + corners + "usemtl lamp\nf 1 2 3\n");
    ASSERT_TRUE(lamp);
    EXPECT_THAT(lamp->face_material, IsEmpty());
    EXPECT_EQ(lamp->materials[0].base_color, Color{});
    EXPECT_EQ(lamp->materials[0].emission, (Color{1, 2, 3}));
}

TEST_F(Mtl, MaterialValuesAreChecked)
{
    const auto m = load_with(
        "Kd 1 1 1\nnewmtl a\nKd -1 0.5 2\nKe -1 2 1e39\nnewmtl b\nKd nan 0 0\nKe inf 1 1\n"
        "newmtl c\nKd 1 1\nKe spectral x.rfl 1\nnewmtl d\nKd 0 0 1e400\nnewmtl e\nKd 0 0 1.5\n",
        "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl d\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    EXPECT_EQ(m->materials[0].base_color, (Color{0, 0.5f, 1}));
    EXPECT_EQ(m->materials[0].emission, (Color{0, 2, std::numeric_limits<float>::max()}));
    for (size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(m->materials[i].base_color, (Color{0.8f, 0.8f, 0.8f}));
        EXPECT_EQ(m->materials[i].emission, Color{});
    }
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: Kd outside [0, 1] clamped (2 times)",
                                        "a.mtl:4: warning: Ke below 0 or beyond float clamped",
                                        "a.mtl:6: warning: Kd is not three finite numbers; ignored (3 times)",
                                        "a.mtl:7: warning: Ke is not three finite numbers; ignored (2 times)",
                                        "a.mtl:1: warning: statement before the first newmtl ignored"));
}

TEST_F(Mtl, UnknownAndRepeatedMaterialsAreCounted)
{
    const auto m = load_with("newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n",
                             "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 2u);
    EXPECT_EQ(m->materials[0].base_color, (Color{1, 0, 0}));
    EXPECT_EQ(m->materials[1].name, "default");
    EXPECT_THAT(m->face_material, ElementsAre(0, 1, 1, 1));
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: material 'a' exists already; the first is used",
                                        "a.obj:7: warning: unknown material 'b' and ''; the default grey is used (3 "
                                        "times)"));
    std::string many = corners;
    for (int i = 0; i < 30; ++i) many += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    EXPECT_TRUE(load(many));
    EXPECT_THAT(warnings(),
                ElementsAre("a.obj:4: warning: unknown material 'm0', 'm1', 'm2' and 27 others; the default "
                            "grey is used"));
    // One cause, one message.
    EXPECT_TRUE(load("mtllib none.mtl\n" + many));
    EXPECT_THAT(warnings(),
                ElementsAre("a.obj:1: warning: material file 'none.mtl' not found; the default grey is used "
                            "for what no other file defines"));
    EXPECT_TRUE(load("mtllib none.mtl\n" + corners + "f 1 2 3\n"));
    EXPECT_THAT(warnings(), ElementsAre("a.obj:1: warning: material file 'none.mtl' not found"));
}

TEST_F(Mtl, ManyMaterialsKeepTheirOwnValues)
{
    std::string mtl, uses;
    for (int i = 0; i < 2500; ++i) {
        mtl += "newmtl m" + std::to_string(i) + "\nKd " + std::to_string(i / 2500.0) + " 0 0\n";
        uses += "usemtl m" + std::to_string(2499 - i) + "\nf 1 2 3\n";
    }
    const auto m = load_with(mtl, uses);
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 2500u);
    for (const size_t i : {0u, 1499u, 1500u, 2499u}) {
        EXPECT_EQ(m->face_material[i], i);
        EXPECT_NEAR(m->materials[i].base_color.r, static_cast<double>(2499 - i) / 2500.0, 1e-6);
        EXPECT_EQ(m->materials[i].where.line, 2 * (2499 - i) + 1);
    }
}

TEST_F(Mtl, MaterialFilesAreFoundByManyNames)
{
    write("one.mtl", "newmtl one\nKd 1 0 0\n");
    write("my file.mtl", "newmtl spaced\nKd 0 1 0\n");
    write("Upper.MTL", "newmtl upper\nKd 0 0 1\n");
    fs::create_directories(folder_ / "sub");
    write("sub/deep.mtl", "\xEF\xBB\xBFnewmtl deep\nKd 1 1 0\n");
    const std::string uses = corners +
                             "usemtl one\nf 1 2 3\nusemtl spaced\nf 1 2 3\nusemtl upper\nf 1 2 3\n"
                             "usemtl deep\nf 1 2 3\n";
    const std::string other_case = ": warning: material file 'upper.mtl' not found; that name in other letters is used";
    for (const std::string& libraries :
         {std::string("mtllib my file.mtl\nmtllib upper.mtl\nmtllib sub\\deep.mtl\nmtllib one.mtl # c\n"),
          std::string("mtllib upper.mtl my file.mtl sub/deep.mtl one.mtl one.mtl\n")}) {
        const auto m = load(uses + libraries + libraries);  // after their use, and repeated: no matter
        ASSERT_TRUE(m) << errors();
        ASSERT_EQ(m->materials.size(), 4u);
        EXPECT_EQ(m->materials[1].base_color, (Color{0, 1, 0}));
        EXPECT_EQ(m->materials[2].base_color, (Color{0, 0, 1}));
        EXPECT_EQ(m->materials[3].base_color, (Color{1, 1, 0}));
        ASSERT_EQ(warnings().size(), 1u) << libraries;
        EXPECT_THAT(warnings()[0], HasSubstr(other_case));
    }
    EXPECT_TRUE(load(uses + "mtllib no such.mtl one.mtl sub\nmtllib\n"));
    EXPECT_THAT(warnings(), testing::IsSupersetOf(
                                {"a.obj:12: warning: material file 'no such.mtl' and 'sub' not found; the default "
                                 "grey is used for what no other file defines",
                                 "a.obj:13: warning: mtllib without a file name"}));
    write("binary.mtl", std::string("newmtl one\n\0\n", 13));
    EXPECT_TRUE(load(corners + "mtllib binary.mtl\nf 1 2 3"));
    EXPECT_THAT(warnings(),
                ElementsAre("binary.mtl: warning: material file 'binary.mtl' is ignored: it holds NUL bytes"));
}

TEST_F(Mtl, TheHashIsOfAllBytesRead)
{
    const auto hash = [&](const std::string& mtl, const std::string& obj) {
        const auto m = load_with(mtl, obj);
        EXPECT_TRUE(m);
        return m ? m->content_hash : 0;
    };
    const uint64_t first = hash("newmtl a\n", "f 1 2 3\n");
    EXPECT_NE(first, 0u);
    EXPECT_EQ(first, hash("newmtl a\n", "f 1 2 3\n"));
    EXPECT_NE(first, hash("newmtl b\n", "f 1 2 3\n"));
    EXPECT_NE(first, hash("newmtl a\n", "f 1 2 3\n\n"));
}

// KeyShot numbers its materials.
TEST_F(Mtl, AHashBelongsToANameThatHasIt)
{
    write("wood #1.png", "");
    write("a.png", "");
    const auto m = load_with(
        "newmtl Metal #1\nKd 1 0 0\nmap_Kd wood #1.png\nnewmtl Metal #2\nKd 0 0 1\nmap_Kd a.png # c\n"
        "newmtl plain # c\nKd 0 1 0\n",
        "usemtl Metal #1\nf 1 2 3\nusemtl Metal #2\nf 1 2 3\nusemtl plain\nf 1 2 3\nusemtl plain # d\nf 1 2 3\n");
    ASSERT_TRUE(m) << errors();
    ASSERT_EQ(m->materials.size(), 4u);
    EXPECT_EQ(m->materials[0].name, "Metal #1");
    EXPECT_EQ(m->materials[0].base_color, (Color{1, 0, 0}));
    EXPECT_EQ(relative(m->materials[0].base_color_map->file), "wood #1.png");
    EXPECT_EQ(m->materials[1].name, "Metal #2");
    EXPECT_EQ(m->materials[1].base_color, (Color{0, 0, 1}));
    EXPECT_EQ(relative(m->materials[1].base_color_map->file), "a.png");
    EXPECT_EQ(m->materials[2].name, "plain");
    EXPECT_EQ(m->materials[3].base_color, (Color{0, 1, 0}));
    EXPECT_THAT(warnings(), IsEmpty());
    write("b #2.mtl", "newmtl b\nKd 1 0 0\n");
    const auto library = load("mtllib b #2.mtl\n" + corners + "usemtl b\nf 1 2 3\n");
    ASSERT_TRUE(library) << errors();
    EXPECT_EQ(library->materials[0].base_color, (Color{1, 0, 0}));
    EXPECT_THAT(warnings(), IsEmpty());
}

// Paths of the machine where the file was written mean nothing here.
TEST_F(Mtl, TexturesElsewhereAreTakenByTheirBareNames)
{
    fs::create_directories(folder_ / "textures");
    write("wood grain.png", "");
    write("textures/b.png", "");
    for (const auto& [written, found] : {std::pair{"file:///C:/x/wood%20grain.png", "wood grain.png"},
                                         {"file:///C:/x/wood grain.png", "wood grain.png"},
                                         {"C:\\maps\\wood grain.png", "wood grain.png"},
                                         {"/home/me/maps/WOOD grain.png", "wood grain.png"},
                                         {"..\\maps\\b.png", "textures/b.png"},
                                         {"b.png", "textures/b.png"}}) {
        const auto m =
            load_with(std::string("newmtl a\nmap_Kd ") + written + "\nmap_Ke " + written + "\n", "usemtl a\nf 1 2 3\n");
        ASSERT_TRUE(m) << errors();
        ASSERT_TRUE(m->materials[0].base_color_map) << written;
        EXPECT_EQ(relative(m->materials[0].base_color_map->file), found) << written;
        EXPECT_THAT(warnings(), testing::Contains(testing::AllOf(
                                    testing::StartsWith("a.mtl:3: warning: texture file '"),
                                    testing::EndsWith(" is not where its path says; its bare name is (2 times)"))))
            << written;
    }
}

}  // namespace
}  // namespace lancer
