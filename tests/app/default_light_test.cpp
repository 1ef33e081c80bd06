// What a bare mesh gets besides a view: light, a ground, and an exposure with which objects of any colour are neither
// dark nor burnt out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "app/run_program.h"
#include "core/names.h"
#include "core/vec.h"
#include "io/image/png.h"

namespace lancer {
namespace {

// Statements of an OBJ file, whose faces are given by corners counted from the end.
std::string square(Vec3d a, Vec3d b, Vec3d c, Vec3d d)
{
    std::string text;
    for (const Vec3d p : {a, b, c, d})
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    return text + "f -4 -3 -2 -1\n";
}

enum class Side { left, right, bottom, top, back, front };

// A block, whose faces show outwards; or without a side a room, whose walls show inwards.
std::string box(Vec3d a, Vec3d b, std::optional<Side> without = {})
{
    const auto corner = [&](int i) { return Vec3d{i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z}; };
    constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::string text;
    for (int i = 0; i < 6; ++i) {
        const auto& s = sides[i];
        if (!without)
            text += square(corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3]));
        else if (i != static_cast<int>(*without))
            text += square(corner(s[3]), corner(s[2]), corner(s[1]), corner(s[0]));
    }
    return text;
}

std::string ball()
{
    constexpr int rows = 12, columns = 24;
    const auto at = [](int row, int column) {
        const double polar = pi_d * row / rows, turn = 2 * pi_d * column / columns;
        return Vec3d{std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn)};
    };
    std::string text;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) text += square(at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1));
    return text;
}

std::string shape_of(const std::string& file)
{
    std::string text, line;
    std::istringstream lines(read_bytes(file));
    while (std::getline(lines, line))
        if (line.starts_with('v') || line.starts_with('f')) text += line + "\n";
    return text;
}

class DefaultLight : public AppTest {
protected:
    // Writes mesh.obj, with materials "own" of this albedo and "lamp".
    void write_mesh(const std::string& statements, double albedo = 0.5, double lamp = 10) const
    {
        const std::string kd = std::to_string(albedo), ke = std::to_string(lamp);
        write("mesh.mtl", "newmtl own\nKd " + kd + " " + kd + " " + kd + "\nnewmtl lamp\nKd 0 0 0\nKe " + ke + " " +
                              ke + " " + ke + "\n");
        write("mesh.obj", "mtllib mesh.mtl\nusemtl own\n" + statements);
    }
    Said render_mesh(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {"render", "mesh.obj", "--size", "60x40", "-s", "16"});
        return run(more);
    }
    // The median code value, 0 to 1, of the pixels of mesh.obj that show nothing but the mesh.
    double median_brightness() const
    {
        const Said seen = render_mesh({"-q", "-o", "mask.exr", "--aov", "mask", "--no-ground"});
        const Said drawn = render_mesh({"-q", "-o", "a.png"});
        EXPECT_EQ(seen.code, 0) << seen.err;
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        const std::vector<float> mask = read_exr_channel(file("mask.exr"), "mask.A");
        const Image picture = read_png(file("a.png"), Encoding::linear);
        std::vector<float> values;
        for (size_t i = 0; i < mask.size(); ++i)
            if (mask[i] == 1) values.push_back(luminance(picture.pixels[i]));
        EXPECT_GT(values.size(), 20u);
        std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
        return static_cast<double>(values[values.size() / 2]);
    }
    std::string light_of(const std::string& name) const { return metadata(name, "light"); }
};

TEST_F(DefaultLight, ObjectsOfAnyAlbedoAreOfAMiddleBrightness)
{
    const std::map<std::string, std::string> meshes{
        {"ball", ball()},
        {"box", box({-1, 0, -2}, {1, 1, 2})},
        {"knot", shape_of(LANCER_SOURCE_DIR "/scenes/meshes/knot.obj")},
        {"tiny", box({1e-4, 0, 0}, {2e-4, 1e-4, 1e-4})},
        {"room", box({-3, 0, -3}, {3, 3, 3}, Side::front) + box({-1, 0, -1}, {0, 1, 0})},
    };
    for (const auto& [name, statements] : meshes) {
        double darker = 0;
        for (const double albedo : {0.2, 0.5, 0.8}) {
            write_mesh(statements, albedo);
            const double brightness = median_brightness();
            EXPECT_GE(brightness, 0.15) << name << " of albedo " << albedo;
            EXPECT_LE(brightness, 0.6) << name << " of albedo " << albedo;
            EXPECT_GT(brightness, darker) << name << ": a light object must look lighter than a dark one";
            darker = brightness;
        }
    }
}

TEST_F(DefaultLight, StatsSayHowLongChoicesTake)
{
    const auto times_named = [&](const std::string& scene, const std::string& name) {
        EXPECT_EQ(run({"render", scene, "--size", "8x8", "-s", "1", "-q", "--stats", "s.json", "-o", "a.exr"}).code, 0);
        const std::string text = read_bytes(file("s.json"));
        const size_t analyses = text.find("\"analyses\""), end = text.find(']', analyses);
        return text.substr(analyses, end - analyses).find("\"" + name + "\"") != std::string::npos;
    };
    write_mesh(ball());
    EXPECT_TRUE(times_named("mesh.obj", "view"));
    EXPECT_TRUE(times_named("mesh.obj", "light"));
    EXPECT_FALSE(times_named("scene.toml", "view"));  // it says both
    EXPECT_FALSE(times_named("scene.toml", "light"));
}

// The exposure is that of the whole picture, and the same for any number of threads, samples and whatever is written.
TEST_F(DefaultLight, ExposureIsSaidAndDoesNotDependOnHowThePictureIsMade)
{
    write_mesh(ball());
    const Said said = render_mesh({"-o", "a.png", "-o", "a.exr"});
    ASSERT_EQ(said.code, 0) << said.err;
    const auto exposure = [&](const std::string& name) {
        for (const auto& [key, value] : read_png_info(file(name)).metadata)
            if (key == "exposure") return to_string(value);
        return std::string("none");
    };
    const std::string chosen = exposure("a.png");
    EXPECT_NE(chosen, "0");
    expect_words(said.err, "--exposure " + chosen);
    EXPECT_EQ(metadata("a.exr", "exposure"), "none of this name");

    EXPECT_EQ(render_mesh({"-q", "-o", "b.png", "-t", "3", "--crop", "20,10,40,30"}).code, 0);
    EXPECT_EQ(exposure("b.png"), chosen);
    EXPECT_EQ(render_mesh({"-q", "-o", "c.png", "-s", "1"}).code, 0);
    EXPECT_EQ(exposure("c.png"), chosen);
    const Image whole = read_png(file("a.png")), part = read_png(file("b.png"));
    for (int32_t y = 0; y < 20; ++y)
        for (int32_t x = 0; x < 20; ++x)
            ASSERT_EQ(part.pixels[static_cast<size_t>(20 * y + x)],
                      whole.pixels[static_cast<size_t>(60 * (y + 10) + x + 20)]);

    EXPECT_EQ(render_mesh({"-q", "-o", "d.png", "-o", "d.exr", "--exposure", "0"}).code, 0);
    EXPECT_EQ(exposure("d.png"), "0");
    EXPECT_TRUE(same_pixels(image("a.exr"), image("d.exr")));
    EXPECT_EQ(run({"render", "scene.toml", "--size", "24x16", "-s", "4", "-q", "-o", "e.png"}).code, 0);
    EXPECT_EQ(exposure("e.png"), "0") << "a scene file says its light itself";
    EXPECT_EQ(
        run({"render", "scene.toml", "--size", "24x16", "-s", "4", "-q", "-o", "e.png", "--exposure", "auto"}).code, 0);
    EXPECT_NE(exposure("e.png"), "0");
    EXPECT_EQ(render_mesh({"-q", "-o", "x.png", "--exposure", "automatic"}).code, 2);
}

// A lamp does not switch the sky off; lamps that light a room do.
TEST_F(DefaultLight, LampsCountByTheLightThatTheyGive)
{
    const std::string lamp = "usemtl lamp\n";
    const auto light_of_mesh = [&](const std::string& statements, double radiance) {
        write_mesh(statements, 0.5, radiance);
        const Said said = render_mesh({"-o", "a.exr", "-s", "1"});
        EXPECT_EQ(said.code, 0) << said.err;
        const std::string told = light_of("a.exr");
        expect_words(said.err, told);
        return told;
    };
    const std::string diode = square({0.99, 0.5, 1.01}, {1, 0.5, 1.01}, {1, 0.51, 1.01}, {0.99, 0.51, 1.01});
    EXPECT_TRUE(light_of_mesh(box({-1, 0, -1}, {1, 1, 1}) + lamp + diode, 10).starts_with("added a sky"));
    // A room, open in front, with a lamp under its ceiling.
    const std::string room = box({-3, 0, -3}, {3, 3, 3}, Side::front);
    const std::string ceiling_lamp =
        lamp + square({-0.5, 2.9, -0.5}, {0.5, 2.9, -0.5}, {0.5, 2.9, 0.5}, {-0.5, 2.9, 0.5});
    EXPECT_TRUE(light_of_mesh(room + ceiling_lamp, 10).starts_with("no sky"));
    EXPECT_TRUE(light_of_mesh(room + ceiling_lamp, 0.01).starts_with("added a sky"));
    // The same lamp in the open: a black background would be all that is seen beside it.
    EXPECT_TRUE(light_of_mesh(box({-1, 0, -1}, {1, 1, 1}) + ceiling_lamp, 10).starts_with("added a sky"));
    EXPECT_TRUE(light_of_mesh(room, 0).ends_with("nothing in the mesh emits light"));
}

// In a yard the key light must come over the walls: under the sky alone nothing would be brighter than the sky, 0.2.
TEST_F(DefaultLight, InsideTheKeyLightComesThroughAnOpening)
{
    write_mesh(box({-2, 0, -6}, {2, 4, 6}, Side::top));
    ASSERT_EQ(
        render_mesh({"-q", "-o", "a.exr", "-D", "camera.position=[0, 1, 5.9]", "-D", "camera.target=[0, 1.5, 0]"}).code,
        0);
    std::vector<float> lights;
    for (const Color c : image("a.exr").pixels) lights.push_back(luminance(c));
    std::sort(lights.begin(), lights.end());
    EXPECT_GT(lights[lights.size() * 98 / 100], 0.22f);
}

TEST_F(DefaultLight, AGroundIsForObjects)
{
    const auto light_of_mesh = [&](const std::string& statements, std::vector<std::string> more = {}) {
        write_mesh(statements);
        more.insert(more.end(), {"-q", "-o", "a.exr", "-s", "1"});
        EXPECT_EQ(render_mesh(more).code, 0);
        return light_of("a.exr");
    };
    const auto has_ground = [&](const std::string& statements, const std::vector<std::string>& more = {}) {
        return light_of_mesh(statements, more).find("ground") != std::string::npos;
    };
    const std::string block = box({-1, 0, -1}, {1, 1, 1}),
                      floor = square({-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3});
    EXPECT_TRUE(has_ground(block));
    EXPECT_FALSE(has_ground(block, {"--no-ground"}));
    EXPECT_FALSE(has_ground(block + floor)) << "it has one of its own";
    EXPECT_FALSE(has_ground(floor));
    EXPECT_FALSE(has_ground(block, {"-D", "camera.position=[1, -3, 5]"})) << "seen from below";
    EXPECT_FALSE(has_ground(box({-3, 0, -3}, {3, 3, 3}), {"-D", "camera.position=[0, 1, 2]"})) << "seen from inside";
    EXPECT_EQ(run({"render", "scene.toml", "--no-ground", "-o", "x.exr"}).code, 2);
}

}  // namespace
}  // namespace lancer
