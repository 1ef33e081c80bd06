// What --json prints has the form that docs/json says, and says what the text says.
#include <gtest/gtest.h>

#include "app/json_schema.h"
#include "app/run_program.h"
#include "report/json_object.h"

namespace lancer {
namespace {

using Json = nlohmann::json;

class JsonResult : public AppTest {
protected:
    // The result of a command with --json, which must have its form and come alone.
    Json result(Arguments arguments, int code = 0) const
    {
        const std::string command = arguments[0];
        const Said said = run(arguments + Arguments{"--json"});
        EXPECT_EQ(said.code, code) << said.err;
        const Json value = Json::parse(said.out, nullptr, false);
        EXPECT_FALSE(value.is_discarded()) << said.out;
        const Json schema = Json::parse(read_bytes(LANCER_SOURCE_DIR "/docs/json/" + command + ".schema.json"));
        for (const std::string& fault : schema_faults(schema, value)) ADD_FAILURE() << fault << "\nin " << said.out;
        EXPECT_EQ(value.value("schema", ""), "lancer." + command + "/1");
        return value;
    }
};

TEST_F(JsonResult, OfCheckNamesPlaces)
{
    write("bad.toml", "version = 1\n[camera]\nfovv = 3\n[[mesh]]\nfile = \"none.obj\"\n");
    const Json bad = result({"check", "bad.toml"}, 65);
    ASSERT_FALSE(bad["errors"].empty());
    EXPECT_EQ(bad["errors"][0]["file"], "bad.toml");
    EXPECT_EQ(bad["errors"][0]["line"], 3);
    EXPECT_EQ(bad["errors"][0]["column"], 1);
    EXPECT_NE(bad["errors"][0]["message"].get<std::string>().find("fovv"), std::string::npos);
    EXPECT_EQ(result({"check", "missing.toml"}, 66)["errors"].size(), 1u);
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 1\n");
    EXPECT_EQ(result({"check", "scene.toml"})["errors"].size(), 0u);
    const Json warned = result({"check", "flat.obj"});
    ASSERT_FALSE(warned["warnings"].empty());
    EXPECT_EQ(warned["warnings"][0]["file"], "flat.obj");
    result({"check", "flat.obj", "--strict"}, 65);
}

TEST_F(JsonResult, OfCompareHasTheFiguresOfTheText)
{
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png", "--aov", "variance,depth", "--seed", "1"}).code, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--aov", "variance,depth", "--seed", "2"}).code, 0);
    ASSERT_EQ(render({"-o", "c.exr", "--aov", "variance,depth", "--seed", "3"}).code, 0);
    const Said text = run({"compare", "a.exr", "b.exr"});
    const Json json = result({"compare", "a.exr", "b.exr"});
    double relmse = 0;
    ASSERT_EQ(std::sscanf(text.out.c_str() + text.out.find("relmse "), "relmse %lf", &relmse), 1);
    EXPECT_NEAR(json["metrics"]["relmse"].get<double>(), relmse, 1e-8 * relmse);
    expect_words(text.out, "verdict: " + json["verdict"].get<std::string>());
    EXPECT_TRUE(json.contains("noise"));
    EXPECT_EQ(json["metrics"]["pixels"], 24 * 16);
    EXPECT_FALSE(result({"compare", "a.exr", "b.exr", "--fail-above", "1e-9"}, 1)["limit"]["passed"].get<bool>());
    const Json map = result({"compare", "a.exr", "b.exr", "c.exr", "-o", "map.png", "--fail-above", "1e9"});
    EXPECT_TRUE(map["limit"]["passed"].get<bool>());
    EXPECT_EQ(map["limit"]["metric"], "relmse_unbiased");
    EXPECT_EQ(map["maps"][0], "map.png");
    EXPECT_TRUE(exists("map.png"));
    EXPECT_EQ(result({"compare", "a.png", "a.png", "--steps"})["verdict"], "same bits");
}

TEST_F(JsonResult, OfInfoTellsOfScenesAndPictures)
{
    const Json scene = result({"info", "scene.toml"});
    EXPECT_EQ(scene["kind"], "scene");
    EXPECT_EQ(scene["triangles"], 0);
    EXPECT_EQ(scene["shapes"]["sphere"], 1);
    EXPECT_GT(scene["bytes"]["geometry"].get<int>(), 0);
    result({"info", LANCER_SOURCE_DIR "/scenes/spheres.toml"});
    result({"info", LANCER_SOURCE_DIR "/scenes/seed-a/noon.toml"});
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png", "-o", "a.jpg", "--crop", "2,3,20,10", "--exr-tiles", "16"}).code,
              0);
    const Json exr = result({"info", "a.exr"});
    EXPECT_EQ(exr["kind"], "picture");
    EXPECT_EQ(exr["width"], 24);
    EXPECT_EQ(exr["pixels"]["x0"], 2);
    EXPECT_EQ(exr["metadata"]["spp"], 4);
    EXPECT_EQ(exr["tiles"][0], 16);
    EXPECT_EQ(result({"info", "a.png"})["channel_count"], 3);
    result({"info", "a.jpg"});
    EXPECT_EQ(run({"info", "scene.toml", "--plan", "--json"}).code, 2);
}

TEST_F(JsonResult, OfMergeSaysWhatIsMissing)
{
    for (const char* k : {"1", "3"}) ASSERT_EQ(render({"--shard", std::string(k) + "/3", "-o", "%k.lancer"}).code, 0);
    const Json some = result({"merge", "1.lancer", "3.lancer", "-o", "all.exr"}, 75);
    EXPECT_FALSE(some["complete"].get<bool>());
    EXPECT_EQ(some["missing_shards"], Json::array({2}));
    EXPECT_TRUE(some["written"].empty());
    ASSERT_EQ(render({"--shard", "2/3", "-o", "%k.lancer"}).code, 0);
    const Json all = result({"merge", "1.lancer", "2.lancer", "3.lancer", "-o", "all.exr", "-o", "all.lancer"});
    EXPECT_TRUE(all["complete"].get<bool>());
    EXPECT_EQ(all["missing_pixels"], 0);
    EXPECT_EQ(all["written"].size(), 2u);
    EXPECT_EQ(run({"merge", "1.lancer", "-o", "-", "--format", "png", "--json"}).code, 2);
}

TEST_F(JsonResult, OfVerifyTellsTheDifferences)
{
    ASSERT_EQ(render({"-o", "a.exr"}).code, 0);
    const Json same = result({"verify", "a.exr", "--pixels", "all"});
    EXPECT_TRUE(same["verified"].get<bool>());
    EXPECT_EQ(same["traced"], 24 * 16);
    write("other.toml",
          std::string(small_scene) + "[[light]]\ntype = \"point\"\nposition = [1, 2, 3]\nintensity = 9\n");
    const Json other = result({"verify", "a.exr", "other.toml", "--pixels", "all"}, 1);
    EXPECT_FALSE(other["same_scene"].get<bool>());
    EXPECT_GT(other["differing"].get<int>(), 0);
    EXPECT_LE(other["first_differences"].size(), 5u);
}

TEST(JsonObjectTest, ReplacesWhatJsonCannotSay)
{
    JsonObject object;
    object.number("a", std::nan(""));
    object.text("b", "quote \" line\n byte \xff");
    object.numbers("c", std::vector<double>{1, 1 / 0.0});
    const Json read = Json::parse(object.to_text());
    EXPECT_TRUE(read["a"].is_null());
    EXPECT_EQ(read["b"], "quote \" line\n byte \xEF\xBF\xBD");
    EXPECT_TRUE(read["c"][1].is_null());
}

}  // namespace
}  // namespace lancer
