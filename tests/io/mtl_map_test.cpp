// Statements of material files: textures with their options and files, and what cannot be used.
#include "io/asset_path.h"
#include "io/mtl/scan.h"
#include "io/scene/scene_file.h"
#include "obj_test_support.h"

namespace lancer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class MtlMapTest : public ObjTest {
protected:
    MtlMap map(const std::string& arguments)
    {
        diagnostics_ = {};
        const auto entries = scan_mtl("newmtl m\nmap_Kd " + arguments, "a.mtl", diagnostics_);
        const MtlMap* m = entries.at(0).map(MtlMapKind::kd);
        return m ? *m : MtlMap{};
    }
    std::string texture(const std::string& mtl, const MeshOptions& options = {})
    {
        write("a.mtl", mtl);
        diagnostics_ = {};
        const auto m =
            load_obj(write("a.obj", "mtllib a.mtl\n" + corners + "usemtl m\nf 1 2 3\n"), diagnostics_, options);
        EXPECT_TRUE(m) << errors();
        const TextureUse& use = m->materials.at(0).base_color_map;
        return use ? relative(use->file) : "";
    }
};

TEST_F(MtlMapTest, OptionsBeforeTheFile)
{
    const MtlMap plain = map("wood grain.png  # oak");
    EXPECT_EQ(plain.file, "wood grain.png");
    EXPECT_EQ(plain.scale, (Vec2{1, 1}));
    EXPECT_EQ(plain.gain, 1);
    const MtlMap m =
        map("-s 2 -3.5 1 -o .5 .25 0 -mm .1 .8 -bm 2.5 -clamp on -imfchan l -colorspace linear "
            "-blendu on -blendv off -texres 512 -boost 2 -cc off -type sphere \"tex\\a b.png\"");
    EXPECT_EQ(m.file, "tex/a b.png");
    EXPECT_EQ(m.scale, (Vec2{2, -3.5f}));
    EXPECT_EQ(m.offset, (Vec2{.5f, .25f}));
    EXPECT_EQ(m.base, .1f);
    EXPECT_EQ(m.gain, .8f);
    EXPECT_EQ(m.bump, 2.5f);
    EXPECT_EQ(m.wrap, Wrap::clamp);
    EXPECT_EQ(m.channel, Channel::luminance);
    EXPECT_EQ(m.encoding, Encoding::linear);
    EXPECT_EQ(map("-s 2 3d.png").scale, (Vec2{2, 1}));
    EXPECT_EQ(map("-s 2 3d.png").file, "3d.png");
    EXPECT_EQ(map("-stone.png").file, "-stone.png");
    EXPECT_EQ(map("-clamp off a").wrap, Wrap::repeat);
    const std::pair<const char*, Channel> channels[] = {
        {"r", Channel::red}, {"g", Channel::green}, {"b", Channel::blue}, {"m", Channel::alpha}};
    for (const auto& [letter, channel] : channels)
        EXPECT_EQ(map("-imfchan " + std::string(letter) + " a").channel, channel);
    EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(MtlMapTest, OptionsThatCannotBeUsedAreSaid)
{
    const auto warning = [&](const std::string& arguments) {
        EXPECT_EQ(map(arguments).file, "a.png") << arguments;
        EXPECT_EQ(warnings().size(), 1u) << arguments;
        return warnings().empty() ? "" : warnings()[0].substr(warnings()[0].find("map_Kd"));
    };
    EXPECT_EQ(warning("-t .1 0 0 a.png"), "map_Kd option -t (turbulence) is not supported");
    EXPECT_EQ(warning("-imfchan z a.png"), "map_Kd option -imfchan 'z' is not supported");
    EXPECT_EQ(warning("-colorspace aces a.png"), "map_Kd option -colorspace 'aces' is not supported");
    EXPECT_EQ(warning("-s 1e400 a.png"), "map_Kd option -s beyond 8388608 ignored");
    EXPECT_EQ(warning("-o nan a.png"), "map_Kd option -o beyond 8388608 ignored");
    EXPECT_EQ(warning("-bm a.png"), "map_Kd option -bm without a number");
    EXPECT_EQ(map("-t 0 0 0 a.png").file, "a.png");
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_EQ(map("-s 2 2 2").file, "");
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: map_Kd names no file"));
}

TEST_F(MtlMapTest, FilesAreFoundBesideTheMaterialFile)
{
    fs::create_directories(folder_ / "Tex" / "in ner");
    write("Tex/in ner/Wood.PNG", "");
    EXPECT_EQ(texture("newmtl m\nmap_Kd Tex/in ner/Wood.PNG"), "Tex/in ner/Wood.PNG");
    EXPECT_EQ(texture("newmtl m\nmap_Kd ./x/..\\Tex\\in ner\\Wood.PNG\r\n"), "Tex/in ner/Wood.PNG");
    EXPECT_THAT(warnings(), IsEmpty());
    EXPECT_EQ(texture("newmtl m\nmap_Kd tex\\IN NER\\wood.png"), "Tex/in ner/Wood.PNG");
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: texture file 'tex/IN NER/wood.png' not found; "
                                        "that name in other letters is used"));
    EXPECT_EQ(texture("newmtl m\nKd 1 0 0\nmap_Kd Tex\nmap_bump none.png\n"), "");
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:3: warning: texture file 'Tex' and 'none.png' not found; not used"));
    // Nothing looks up what is not there: the colour remains.
    const auto m = load("mtllib a.mtl\n" + corners + "vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    ASSERT_TRUE(m);
    EXPECT_EQ(m->materials[0].base_color, (Color{1, 0, 0}));
    EXPECT_THAT(m->uvs, IsEmpty());
    std::string many, uses = "mtllib a.mtl\n" + corners;
    for (int i = 0; i < 30; ++i) {
        const std::string n = std::to_string(i);
        many += "newmtl m" + n + "\nmap_Kd x" + n + ".png\n";
        uses += "usemtl m" + n + "\nf 1 2 3\n";
    }
    write("a.mtl", many);
    EXPECT_TRUE(load(uses));
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: texture file 'x0.png', 'x1.png', 'x2.png' and 27 others not "
                                        "found; not used"));
}

TEST_F(MtlMapTest, NothingOutsideOfTheAssetsIsRead)
{
    fs::create_directories(folder_ / "scene");
    write("out.png", "");
    write("out.mtl", "newmtl m\nKd 1 0 0\n");
    write("scene/in.png", "");
    fs::create_symlink("../out.png", folder_ / "scene" / "link.png");
    const AssetFolder narrow((folder_ / "scene" / "s.toml").string(), ""),
        wide((folder_ / "scene" / "s.toml").string(), folder_.string());
    const auto warning_of = [&](const std::string& name, const AssetFolder& assets) {
        write("scene/a.mtl", "newmtl m\nmap_Kd " + name + "\n");
        diagnostics_ = {};
        const std::string obj = write("scene/a.obj", "mtllib a.mtl\n" + corners + "usemtl m\nf 1 2 3\n");
        const auto m = load_obj(obj, diagnostics_, {.assets = &assets});
        EXPECT_TRUE(m);
        EXPECT_EQ(m->materials[0].base_color_map.has_value(), warnings().empty()) << name;
        return warnings().empty() ? "" : warnings()[0];
    };
    for (const std::string& name : {std::string("../out.png"), std::string("link.png"), std::string("../none.png"),
                                    (folder_ / "out.png").string()})
        EXPECT_EQ(warning_of(name, narrow),
                  "scene/a.mtl:2: warning: texture file '" + relative(name) +
                      "' lies outside of the folder of the scene; --asset-root FOLDER allows another folder; not used");
    for (const std::string& name : {std::string("in.png"), (folder_ / "scene" / "in.png").string()})
        EXPECT_EQ(warning_of(name, narrow), "");
    for (const std::string& name : {std::string("../out.png"), std::string("link.png"), (folder_ / "out.png").string()})
        EXPECT_EQ(warning_of(name, wide), "");

    const std::string obj = write("scene/a.obj", "mtllib ../out.mtl\n" + corners + "usemtl m\nf 1 2 3\n");
    for (const AssetFolder* assets : {&narrow, &wide}) {
        diagnostics_ = {};
        const auto m = load_obj(obj, diagnostics_, {.assets = assets});
        ASSERT_TRUE(m);
        EXPECT_EQ(m->materials[0].base_color == (Color{1, 0, 0}), assets == &wide);
        EXPECT_EQ(m->material_files.size(), assets == &wide ? 1u : 0u);
    }
}

TEST_F(MtlMapTest, SceneFilesLimitTheirMeshes)
{
    write("out.mtl", "newmtl m\nKd 1 0 0\n");
    fs::create_directories(folder_ / "scene");
    write("scene/a.obj", "mtllib ../out.mtl\n" + corners + "usemtl m\nf 1 2 3\n");
    const std::string file = write("scene/s.toml", "[[mesh]]\nfile = \"a.obj\"\n");
    for (const std::string& root : {std::string(), folder_.string()}) {
        diagnostics_ = {};
        const SceneDescription scene =
            load_scene_file(file, {.asset_root = root, .mesh_loader = load_obj}, diagnostics_);
        EXPECT_EQ(errors(), "");
        EXPECT_EQ(scene.meshes.at(0).data->material_files.size(), root.empty() ? 0u : 1u);
    }
}

TEST_F(MtlMapTest, StatementsEndWhereTheyShould)
{
    write("wood.png", "");
    EXPECT_EQ(texture("\xEF\xBB\xBFnewmtl m\r\n\tmap_Kd\twood.png\t# c\r\n"), "wood.png");
    EXPECT_EQ(texture("newmtl m\nmap_Kd \\\nwood.png\n"), "wood.png");
    EXPECT_THAT(warnings(), IsEmpty());
    // A folder whose file name was lost does not swallow the next statement.
    const auto m = load_with("newmtl m\nmap_Kd textures\\\nKd 1 0 \\\n0\n", "usemtl m\nf 1 2 3\n");
    ASSERT_TRUE(m);
    EXPECT_EQ(m->materials[0].base_color, (Color{1, 0, 0}));
    EXPECT_THAT(warnings(), ElementsAre("a.mtl:2: warning: texture file 'textures/' not found; not used"));
}

TEST_F(MtlMapTest, WhatIsNotUnderstoodIsCounted)
{
    const auto entries = scan_mtl(
        "newmtl m\nKdd 1 0 0\nKdd 1 0 0\nmap_Kdd a.png\nKa 1 1 1\nmap_Ka a.png\nsharpness 60\nmap_Ns a.png\ndecal "
        "a.png\n"
        "illum 11\nillum 2.5\nNs many\nNi 0\nNi 99\nNs -1\nd 2\nPr\nxyzzy\nillum 2\nKt 0 0 0\nKm .25\n",
        "a.mtl", diagnostics_);
    EXPECT_EQ(entries.at(0).illum.value, 2);
    EXPECT_EQ(entries.at(0).ns.value, 0);
    EXPECT_EQ(entries.at(0).ni.value, 10);
    EXPECT_FALSE(entries.at(0).pr);
    EXPECT_THAT(warnings(),
                ElementsAre("a.mtl:2: warning: unknown statement 'Kdd' ignored; did you mean 'Kd'? (2 times)",
                            "a.mtl:4: warning: unknown statement 'map_Kdd' ignored; did you mean 'map_Kd'?",
                            "a.mtl:8: warning: statement 'map_Ns', 'decal' and 'Km' is not supported; ignored",
                            "a.mtl:10: warning: illum is not a whole number from 0 to 10; ignored (2 times)",
                            "a.mtl:12: warning: Ns is not a finite number; ignored",
                            "a.mtl:13: warning: Ni is not above 0; ignored",
                            "a.mtl:14: warning: Ni outside [0.001, 10] clamped",
                            "a.mtl:15: warning: Ns below 0 or beyond float clamped",
                            "a.mtl:16: warning: d outside [0, 1] clamped",
                            "a.mtl:17: warning: Pr is not a finite number; ignored",
                            "a.mtl:18: warning: unknown statement 'xyzzy' ignored"));
    std::string many = "newmtl m\n";
    for (int i = 0; i < 100; ++i) many += "key" + std::to_string(i) + "\n";
    diagnostics_ = {};
    scan_mtl(many, "a.mtl", diagnostics_);
    EXPECT_THAT(warnings(),
                ElementsAre("a.mtl:2: warning: unknown statement 'key0', 'key1', 'key2' and 97 others ignored"));
}

}  // namespace
}  // namespace lancer
