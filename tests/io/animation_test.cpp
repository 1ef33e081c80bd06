// [animation] of scene files.
#include "io/scene_test_support.h"

#include <cmath>

namespace lancer {
namespace {

class AnimationFile : public SceneFileTest {
protected:
    SceneDescription at(const std::string& text, double frame)
    {
        options_.frame = frame;
        return scene(text);
    }
    static std::string film(const std::string& tracks)
    {
        return "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n"
               "[camera.side]\nposition = [5, 0, 0]\n"
               "[camera.above]\nposition = [0, 5, 0]\nup = [0, 0, -1]\nfov = 60\n"
               "[[light]]\ntype = \"point\"\nposition = [0, 4, 0]\nintensity = 1\n"
               "[[light]]\ntype = \"directional\"\ndirection = [0, -1, 0]\nirradiance = 1\n"
               "[[sphere]]\nmaterial = \"glass\"\n"
               "[material.glass]\ntype = \"glass\"\nroughness = 0.5\n"
               "[animation]\nframes = [1, 9]\nfps = 30\n" +
               tracks;
    }
    static std::string track(const std::string& key, const std::string& frames, const std::string& values,
                             const std::string& more = "")
    {
        return "[[animation.track]]\nkey = \"" + key + "\"\nframes = " + frames + "\nvalues = " + values + "\n" + more;
    }
    std::string mistakes(const std::string& tracks) { return problems(film(tracks)); }
};

TEST_F(AnimationFile, MeshesAreDividedForTheFirstCamera)
{
    write("a.obj", "");
    const std::string moving = film(track("camera.position", "[1, 9]", "[[0, 0, 5], [0, 0, 21]]"));
    const std::string divided = "[[mesh]]\nfile = \"a.obj\"\nsubdivision_edge = 2\n" + moving;
    for (const double frame : {1.0, 5.0, 9.0}) {
        const SceneDescription s = at(divided, frame);
        EXPECT_EQ(s.camera->position.z, 3 + 2 * frame);
        ASSERT_TRUE(s.first_camera);
        EXPECT_EQ(s.first_camera->position.z, 5) << "in all frames";
    }
    EXPECT_FALSE(at("[[mesh]]\nfile = \"a.obj\"\n" + moving, 5).first_camera) << "which nothing needs";
}

TEST_F(AnimationFile, TheShutterKnowsTheWayOfTheCamera)
{
    const std::string moving = track("camera.position", "[1, 9]", "[[0, 0, 5], [0, 0, 21]]");
    const auto with_shutter = [&](const std::string& shutter, const std::string& tracks) {
        return film("shutter = " + shutter + "\n" + tracks);
    };
    const SceneDescription s = at(with_shutter("0.5", moving), 5);
    ASSERT_GT(s.cameras_later.size(), 2u);
    EXPECT_EQ(s.cameras_later.front().own->position.z, 13);
    EXPECT_EQ(s.cameras_later.back().own->position.z, 14) << "half of a frame later";
    EXPECT_EQ(s.cameras_later.back().named.size(), 2u);
    EXPECT_TRUE(at(with_shutter("0", moving), 5).cameras_later.empty());
    EXPECT_TRUE(at(film(moving), 5).cameras_later.empty());
    const std::string cut =
        track("camera.position", "[1, 5.2]", "[[0, 0, 5], [0, 0, 21]]", "interpolation = \"step\"\n");
    for (const CamerasAtTime& then : at(with_shutter("1", cut), 5).cameras_later)
        EXPECT_EQ(then.own->position.z, 5) << "a cut is no motion";
    Diagnostics diagnostics;
    const std::string lamp = with_shutter("0.5", track("light.0.intensity", "[1, 9]", "[1, 5]"));
    EXPECT_TRUE(parse_scene(lamp, path("s.toml"), options_, diagnostics).cameras_later.empty());
    EXPECT_EQ(diagnostics.warnings().size(), 1u) << "that the lamp does not blur";
    EXPECT_NE(mistakes("shutter = 2\n" + moving).find("from 0 to 1"), std::string::npos);
}

TEST_F(AnimationFile, TheShutterKnowsTheWayOfThings)
{
    write("a.obj", "");
    const std::string mesh = "[[mesh]]\nfile = \"a.obj\"\n";
    const std::string things = mesh + "[[mesh]]\nname = \"gear\"\nfile = \"a.obj\"\n[[instance]]\nmesh = \"gear\"\n" +
                               film("shutter = 0.5\n" + track("sphere.0.center", "[1, 9]", "[[0, 0, 0], [0, 8, 0]]") +
                                    track("mesh.0.translate", "[1, 9]", "[[0, 0, 0], [16, 0, 0]]") +
                                    track("instance.0.rotate", "[1, 9]", "[[0, 0, 0], [0, 80, 0]]"));
    Diagnostics diagnostics;
    options_.frame = 3;
    const SceneDescription s = parse_scene(things, path("s.toml"), options_, diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    ASSERT_EQ(s.spheres[0].path.size(), 17u);
    EXPECT_EQ(s.spheres[0].path.front().center, s.spheres[0].center);
    EXPECT_EQ(s.spheres[0].path.back().center, (Vec3d{0, 2.5, 0}));
    ASSERT_EQ(s.meshes[0].path.size(), 17u);
    EXPECT_EQ(s.meshes[0].path.back().translate, (Vec3d{5, 0, 0}));
    EXPECT_TRUE(s.meshes[1].path.empty());
    ASSERT_EQ(s.instances.size(), 2u) << "a mesh that moves is drawn as an instance";
    EXPECT_EQ(s.instances[0].path.back().rotate_deg, (Vec3d{0, 25, 0}));
    EXPECT_EQ(s.instances[1].mesh, "a");
    EXPECT_EQ(s.meshes[0].name, "a");
    EXPECT_EQ(s.meshes[0].transform.translate, (Vec3d{4, 0, 0}));
    options_.still = true;
    const SceneDescription without = at(things, 3);
    EXPECT_TRUE(without.spheres[0].path.empty() && without.meshes[0].path.empty() && without.instances[0].path.empty());
    EXPECT_EQ(without.instances.size(), 1u);
    options_.still = false;
    // Frames that begin alike and end apart have other accelerators.
    const std::string later = film("shutter = 0.5\n" + track("sphere.0.center", "[3, 9]", "[[0, 0, 0], [0, 8, 0]]"));
    EXPECT_NE(at(later, 2).still_hash, at(later, 3).still_hash);
    EXPECT_EQ(at(later, 1).still_hash, at(later, 2).still_hash);
}

TEST_F(AnimationFile, EveryKeyMoves)
{
    write("a.obj", "");
    const std::string text =
        "[[mesh]]\nname = \"gear\"\nfile = \"a.obj\"\n[[instance]]\nmesh = \"gear\"\n" +
        film(track("light.0.position", "[1, 5]", "[[0, 4, 0], [8, 4, 0]]") +
             track("light.0.intensity", "[1, 9]", "[1, 5]") +
             track("sphere.0.center", "[1, 9]", "[[0, 0, 0], [0, 2, 0]]") +
             track("material.glass.roughness", "[1, 9]", "[0, 1]") + track("material.glass.ior", "[3, 5]", "[1, 2.0]") +
             track("mesh.gear.rotate", "[1, 9]", "[[0, 0, 0], [0, 360, 0]]") +
             track("instance.0.translate", "[1, 9]", "[[0, 0, 0], [4, 0, 0]]") +
             track("camera.fov", "[1, 9]", "[40, 20]") +
             track("sphere.0.material", "[1, 5]", "[\"glass\", \"other\"]", "interpolation = \"step\"\n") +
             "[material.other]\n");
    const SceneDescription s = at(text, 3);
    EXPECT_EQ(s.lights[0].position, (Vec3d{4, 4, 0}));
    EXPECT_EQ(s.lights[0].power, (Color{2, 2, 2}));
    EXPECT_EQ(s.spheres[0].center, (Vec3d{0, 0.5, 0}));
    EXPECT_EQ(s.materials[0].roughness, 0.25f);
    EXPECT_EQ(s.materials[0].ior, 1);
    EXPECT_EQ(s.meshes[0].transform.rotate_deg, (Vec3d{0, 90, 0}));
    EXPECT_EQ(s.instances[0].transform.translate, (Vec3d{1, 0, 0}));
    EXPECT_EQ(s.camera->fov_deg, 35);
    EXPECT_EQ(s.spheres[0].material, "glass");
    const SceneDescription later = at(text, 9);
    EXPECT_EQ(later.lights[0].position, (Vec3d{8, 4, 0}));  // the last value holds on
    EXPECT_EQ(later.materials[0].ior, 2);
    EXPECT_EQ(later.spheres[0].material, "other");
    ASSERT_TRUE(later.animation);
    EXPECT_EQ(later.animation->first, 1u);
    EXPECT_EQ(later.animation->last, 9u);
    EXPECT_EQ(later.animation->fps, 30);
    options_.frame.reset();
    EXPECT_EQ(scene(text).animation->frame, 1);
}

TEST_F(AnimationFile, CamerasMoveFromKeyToKey)
{
    const std::string text = film(track("camera", "[1, 5, 9]", "[\"side\", \"above\", \"side\"]"));
    for (const auto& [frame, position, up] :
         {std::tuple{1.0, Vec3d{5, 0, 0}, Vec3d{0, 1, 0}}, {5.0, Vec3d{0, 5, 0}, Vec3d{0, 0, -1}}}) {
        const CameraDescription c = *at(text, frame).camera;
        EXPECT_EQ(c.position, position);
        EXPECT_EQ(c.target, Vec3d{});
        EXPECT_EQ(c.up, up);
    }
    EXPECT_EQ(at(text, 5).camera->fov_deg, 60);
    EXPECT_NEAR(at(text, 3).camera->fov_deg, 50 + 2.5, 1e-12);  // the slope at frame 5 is 0, at frame 1 it is 5
    // Catmull-Rom's place, by Hermite's polynomials halfway: slopes (-5, 5)/4 and 0.
    EXPECT_LT(length(at(text, 3).camera->position - Vec3d{2.5 - 0.625, 2.5 + 0.625, 0}), 1e-12);
    // From (side: -x ahead, y up) to (above: -y ahead, -z up) a third of a whole turn: the angle grows evenly.
    const auto ahead = [&](double frame) {
        const CameraDescription c = *at(text, frame).camera;
        return normalize(c.target - c.position);
    };
    const auto up = [&](double frame) { return at(text, frame).camera->up; };
    const auto turned_by = [&](double frame) {
        // trace of the rotation = 1 + 2 cos angle
        const Vec3d f0 = ahead(1), u0 = up(1), f = ahead(frame), u = normalize(up(frame));
        const double trace = dot(f0, f) + dot(u0, u) + dot(cross(f0, u0), cross(f, u));
        return std::acos((trace - 1) / 2);
    };
    EXPECT_NEAR(turned_by(5), 2 * pi_d / 3, 1e-7);
    for (const double frame : {2.0, 3.0, 4.0}) EXPECT_NEAR(turned_by(frame), (frame - 1) / 4 * 2 * pi_d / 3, 1e-7);
    EXPECT_NEAR(length(at(text, 4).camera->target - at(text, 4).camera->position), 5, 1e-12);
}

TEST_F(AnimationFile, DirectionsTurnAtConstantSpeed)
{
    const std::string text = film(track("light.1.direction", "[1, 9]", "[[0, -1, 0], [1, 0, 0]]"));
    for (int frame = 2; frame < 9; ++frame) {
        const Vec3d d = at(text, frame).lights[1].direction;
        EXPECT_NEAR(std::atan2(d.x, -d.y), (frame - 1) * pi_d / 16, 1e-14);
        EXPECT_NEAR(length(d), 1, 1e-14);
    }
}

TEST_F(AnimationFile, SmoothTracksHaveNoCorners)
{
    const std::string keys = "[1, 5, 9]", values = "[0, 0.5, 0.5]";
    const std::string smooth = film(track("material.glass.roughness", keys, values, "interpolation = \"smooth\"\n"));
    const std::string linear = film(track("material.glass.roughness", keys, values));
    EXPECT_EQ(at(linear, 3).materials[0].roughness, 0.25f);
    // Slopes 1/8 and 1/16 at the ends: halfway 0.25 + 4 (1/8 - 1/16) / 8.
    EXPECT_NEAR(at(smooth, 3).materials[0].roughness, 0.28125f, 1e-7f);
}

TEST_F(AnimationFile, DefinitionsComeBeforeTheFilm)
{
    options_.definitions = {"light.0.intensity=7"};
    EXPECT_EQ(at(film(track("light.0.intensity", "[1, 9]", "[1, 5]")), 3).lights[0].power, (Color{7, 7, 7}));
    options_.definitions = {"animation.frames=[1,20]"};
    EXPECT_EQ(at(film(""), 20).animation->last, 20u);
}

TEST_F(AnimationFile, FramesDifferInTheirHashes)
{
    const std::string text =
        film(track("light.0.intensity", "[1, 5]", "[1, 5]") + track("camera.fov", "[1, 9]", "[30, 40]"));
    EXPECT_NE(at(text, 2).content_hash, at(text, 3).content_hash);
    EXPECT_NE(at(text, 2).still_hash, at(text, 3).still_hash);
    EXPECT_NE(at(text, 7).content_hash, at(text, 8).content_hash);
    EXPECT_EQ(at(text, 7).still_hash, at(text, 8).still_hash);  // only the camera moves
    EXPECT_FALSE(at(text, 2).animation->moves_views_only);
    EXPECT_TRUE(at(film(track("camera", "[1, 9]", "[\"side\", \"above\"]")), 2).animation->moves_views_only);
}

TEST_F(AnimationFile, MistakesHaveTheirPlace)
{
    EXPECT_EQ(
        mistakes(track("material.galss.roughness", "[1, 9]", "[0, 1]")),
        "s.toml:27:7: error: the track of 'material.galss.roughness' has no target: unknown 'galss'; did you mean "
        "'glass'? known: glass");
    EXPECT_EQ(mistakes(track("ligth.0.intensity", "[1, 9]", "[0, 1]")),
              "s.toml:27:7: error: the track of 'ligth.0.intensity' has no target: unknown 'ligth'; did you mean "
              "'light'? known: camera, light, sphere, material");
    EXPECT_EQ(mistakes(track("light.2.intensity", "[1, 9]", "[0, 1]")),
              "s.toml:27:7: error: the track of 'light.2.intensity' has no target: the list has no entry '2': they "
              "count from 0, and there are 2");
    EXPECT_EQ(mistakes(track("light.0.intensitty", "[1, 9]", "[0, 1]")),
              "s.toml:29:11: error: unknown key 'intensitty' in [[light]]; did you mean 'intensity'? known: type, "
              "position, intensity, direction, irradiance, inner_angle, outer_angle, center, radius, radiance, file, "
              "scale, rotate, group");
    EXPECT_EQ(mistakes(track("camera", "[1, 9]", "[\"side\", \"abvoe\"]")),
              "s.toml:29:19: error: unknown camera 'abvoe'; did you mean 'above'? known: side, above");
    EXPECT_EQ(mistakes(track("camera.fov", "[1, 9]", "[30]")),
              "s.toml:29:10: error: 'values' in [[track]] must be as many as 'frames': 2, not 1");
    EXPECT_EQ(mistakes(track("camera.fov", "[9, 1]", "[30, 40]")),
              "s.toml:28:10: error: 'frames' in [[track]] must be in ascending order, each once");
    EXPECT_EQ(mistakes(track("camera.fov", "[1, 9]", "[30, \"wide\"]")),
              "s.toml:29:15: error: 'values' in [[track]] must be numbers, or lists of as many numbers; others need "
              "interpolation = \"step\"");
    EXPECT_EQ(mistakes(track("camera.fov", "[1, 9]", "[30, 40]", "interpolation = \"smoth\"\n")),
              "s.toml:30:17: error: unknown interpolation 'smoth' in [[track]]; did you mean 'smooth'? known: linear, "
              "smooth, step");
    EXPECT_EQ(mistakes(track("camera.fov", "[1, 9]", "[30, 40]") + track("camera.fov", "[1, 9]", "[30, 40]")),
              "s.toml:31:7: error: 'key' in [[track]]: another track moves 'camera.fov' already");
    EXPECT_EQ(mistakes(track("version", "[1, 9]", "[1, 2]")),
              "s.toml:27:7: error: the track of 'version' has no target: 'version' does not move");
    EXPECT_EQ(
        problems("[animation]\nframes = [9, 1]\n"),
        "s.toml:2:10: error: 'frames' in [animation] must be the first and the last frame, from 0 to 1000000, such "
        "as [1, 48]");
    for (const std::string key : {"camera.fov=30", "camera..fov", "camera fov.", "."})
        EXPECT_EQ(mistakes(track(key, "[1, 9]", "[1, 2]")),
                  "s.toml:27:7: error: '" + key + "' is no key such as 'camera.fov' or 'light.0.intensity'");
    EXPECT_EQ(problems("[animation]\nfps = 24\n"), "s.toml:1:1: error: [animation] needs 'frames'");
}

// A value out of range is said where the key frame stands; of frames that are not asked for, where all are looked at.
TEST_F(AnimationFile, ValuesAreCheckedAsThoseOfTheFile)
{
    const std::string text = film(track("material.glass.roughness", "[1, 9]", "[0, 2]"));
    options_.frame = 7;
    EXPECT_EQ(problems(text), "s.toml:29:11: error: 'roughness' in [material.glass] must be from 0 to 1, not 1.5");
    options_.frame = 2;
    EXPECT_EQ(problems(text), "");
    options_.checks_frames = true;
    EXPECT_EQ(problems(text),
              "s.toml:29:11: error: 'roughness' in [material.glass] must be from 0 to 1, not 1.25, in frame 6");
}

TEST_F(AnimationFile, AFrameThatThereIsNotIsAMistakeOfUse)
{
    Diagnostics diagnostics;
    options_.frame = 10;
    for (const std::string& text : {film(""), std::string("[camera]\n")}) try {
            parse_scene(text, path("s.toml"), options_, diagnostics);
            FAIL() << text;
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::usage);
        }
}

}  // namespace
}  // namespace lancer
