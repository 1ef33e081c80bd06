// The view of a scene that says nothing, or not all, of its camera: read back from the log, as a scene file says it.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "app/run_program.h"
#include "core/bounds.h"

namespace lancer {
namespace {

struct FoundView {
    Vec3d position, target, up{0, 1, 0};
    double fov_deg = 40;
};

// Meshes as text, with the points that they have.
class MeshText {
public:
    void quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d)
    {
        for (const Vec3d p : {a, b, c, d}) {
            points.push_back(p);
            text << "v " << p.x << " " << p.y << " " << p.z << "\n";
        }
        text << "f -4 -3 -2 -1\n";
    }
    // Its faces outwards, or inwards; left_out: sides -x, +x, -y, +y, -z, +z that it does not have.
    void box(Vec3d l, Vec3d u, bool inwards = false, const std::vector<int>& left_out = {})
    {
        const auto face = [&](int side, Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
            for (const int out : left_out)
                if (out == side) return;
            if (inwards)
                quad(d, c, b, a);
            else
                quad(a, b, c, d);
        };
        face(0, {l.x, l.y, l.z}, {l.x, l.y, u.z}, {l.x, u.y, u.z}, {l.x, u.y, l.z});
        face(1, {u.x, l.y, u.z}, {u.x, l.y, l.z}, {u.x, u.y, l.z}, {u.x, u.y, u.z});
        face(2, {l.x, l.y, l.z}, {u.x, l.y, l.z}, {u.x, l.y, u.z}, {l.x, l.y, u.z});
        face(3, {l.x, u.y, u.z}, {u.x, u.y, u.z}, {u.x, u.y, l.z}, {l.x, u.y, l.z});
        face(4, {u.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, u.y, l.z}, {u.x, u.y, l.z});
        face(5, {l.x, l.y, u.z}, {u.x, l.y, u.z}, {u.x, u.y, u.z}, {l.x, u.y, u.z});
    }
    // By turning a profile (radius, height) about an axis: 1 for y, 2 for z.
    void turned(const std::vector<std::pair<double, double>>& profile, int axis)
    {
        constexpr int sides = 32;
        const auto at = [&](std::pair<double, double> p, int i) {
            const double a = 2 * pi_d * i / sides, x = p.first * std::cos(a), z = p.first * std::sin(a);
            return axis == 1 ? Vec3d{x, p.second, -z} : Vec3d{x, z, p.second};
        };
        for (size_t k = 0; k + 1 < profile.size(); ++k)
            for (int i = 0; i < sides; ++i)
                quad(at(profile[k], i), at(profile[k], i + 1), at(profile[k + 1], i + 1), at(profile[k + 1], i));
    }

    std::ostringstream text;
    std::vector<Vec3d> points;
};

class DefaultView : public AppTest {
protected:
    // What the log says of the camera of the bare mesh; nothing if it says none.
    std::optional<FoundView> view_of(const std::string& file, std::vector<std::string> more = {})
    {
        more.insert(more.begin(), {"render", file, "--size", "40x30", "-s", "1", "-o", "x.exr"});
        const Said said = run(more);
        EXPECT_EQ(said.code, 0) << said.err;
        log_ = said.err;
        const size_t at = said.err.find("[camera]\n");
        if (at == std::string::npos) return {};
        const std::string text = said.err.substr(at, said.err.find("\n[", at) - at);
        FoundView view;
        view.position = vector_at(text, "position").value();
        view.target = vector_at(text, "target").value();
        view.up = vector_at(text, "up").value_or(view.up);
        view.fov_deg = std::stod(text.substr(text.find("\nfov = ") + 7));
        return view;
    }
    std::optional<FoundView> view_of(const MeshText& mesh, const std::vector<std::string>& more = {})
    {
        write("mesh.obj", mesh.text.str());
        return view_of("mesh.obj", more);
    }
    static std::optional<Vec3d> vector_at(const std::string& text, const std::string& key)
    {
        const size_t at = text.find("\n" + key + " = [");
        if (at == std::string::npos) return {};
        std::istringstream in(text.substr(at + key.size() + 5));
        Vec3d v;
        char comma;
        in >> v.x >> comma >> v.y >> comma >> v.z;
        return v;
    }
    // The larger of the parts of the width and the height of a 4:3 picture that the points take; 2 if one is outside.
    static double share(const FoundView& v, const std::vector<Vec3d>& points)
    {
        const Vec3d ahead = normalize(v.target - v.position), right = normalize(cross(ahead, v.up));
        const double half = std::tan(v.fov_deg * pi_d / 360);
        double x0 = 1, x1 = -1, y0 = 1, y1 = -1;
        for (const Vec3d& p : points) {
            const Vec3d way = p - v.position;
            const double depth = dot(way, ahead);
            const double x = dot(way, right) / (depth * half * 4 / 3),
                         y = dot(way, cross(right, ahead)) / (depth * half);
            if (!(depth > 0 && std::abs(x) <= 1 && std::abs(y) <= 1)) return 2;
            x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
        return std::max(x1 - x0, y1 - y0) / 2;
    }
    static std::vector<Vec3d> corners(const std::vector<Vec3d>& points)
    {
        Bounds b;
        for (const Vec3d& p : points) b.grow(p);
        std::vector<Vec3d> all;
        for (int i = 0; i < 8; ++i)
            all.push_back(
                {i & 1 ? b.lower.x : b.upper.x, i & 2 ? b.lower.y : b.upper.y, i & 4 ? b.lower.z : b.upper.z});
        return all;
    }
    static Vec3d ahead(const FoundView& v) { return normalize(v.target - v.position); }
    static void expect_direction(Vec3d is, Vec3d wanted) { EXPECT_GT(dot(is, wanted), 1 - 1e-9); }

    std::string log_;
};

MeshText vase(int axis)
{
    MeshText mesh;
    mesh.turned({{0, 0}, {1, 0}, {1.6, 1.5}, {0.6, 3.5}, {0.8, 4}, {0.5, 3.5}, {1.4, 1.5}, {0, 0.2}}, axis);
    return mesh;
}

MeshText room(bool inwards, const std::vector<int>& left_out)
{
    MeshText mesh;
    mesh.box({-3, 0, -5}, {3, 3, 5}, inwards, left_out);
    for (double z = -4; z <= 4; z += 2)
        mesh.box({-2.5, 0, z}, {-1.5, 1, z + 0.5}), mesh.box({2, 0, z}, {2.5, 2, z + 1});
    return mesh;
}

TEST_F(DefaultView, ObjectsFillThePicture)
{
    MeshText rod, flat;
    rod.box({100, 0, 0}, {101, 9, 1});
    flat.box({0, 0, 0}, {7, 0.5, 6});
    for (const MeshText& mesh : {vase(1), std::move(rod), std::move(flat)}) {
        const std::optional<FoundView> view = view_of(mesh);
        ASSERT_TRUE(view);
        EXPECT_GE(share(*view, mesh.points), 0.6);
        EXPECT_LE(share(*view, corners(mesh.points)), 0.95);
        EXPECT_LT(ahead(*view).y, -0.2) << "from slightly above";
        EXPECT_EQ(view->up, (Vec3d{0, 1, 0}));
    }
}

// Given values are kept, and the rest is as if nothing were given: from the same side, and all in the picture.
TEST_F(DefaultView, MissingValuesComeFromTheFit)
{
    const MeshText mesh = vase(1);
    const FoundView usual = view_of(mesh).value();
    const FoundView narrow = view_of(mesh, {"-D", "camera.fov=20"}).value();
    EXPECT_EQ(narrow.fov_deg, 20);
    expect_direction(ahead(narrow), ahead(usual));
    EXPECT_GE(share(narrow, mesh.points), 0.6);
    EXPECT_LE(share(narrow, corners(mesh.points)), 0.95);
    EXPECT_GT(length(narrow.position - narrow.target), 1.5 * length(usual.position - usual.target));

    const FoundView turned = view_of(mesh, {"-D", "camera.up=z"}).value();
    EXPECT_EQ(turned.up, (Vec3d{0, 0, 1}));
    EXPECT_LE(share(turned, corners(mesh.points)), 0.95);

    const FoundView placed = view_of(mesh, {"-D", "camera.position=[9, 2, 0]"}).value();
    EXPECT_EQ(placed.position, (Vec3d{9, 2, 0}));
    expect_direction(ahead(placed), {-1, 0, 0});
    const FoundView aimed = view_of(mesh, {"-D", "camera.target=[0, 4, 0]"}).value();
    EXPECT_EQ(aimed.target, (Vec3d{0, 4, 0}));
    expect_direction(ahead(aimed), ahead(usual));
    EXPECT_LT(share(aimed, mesh.points), 1);
    // From the middle of the mesh, and from straight above: there is a view all the same.
    EXPECT_TRUE(view_of(mesh, {"-D", "camera.position=[0, 2, 0]"}));
    EXPECT_TRUE(view_of(mesh, {"-D", "camera.position=[0, 9, 0]"}));
}

TEST_F(DefaultView, SceneFilesAsWell)
{
    const MeshText mesh = vase(1);
    write("mesh.obj", mesh.text.str());
    const std::string scene = "[[mesh]]\nfile = \"mesh.obj\"\n[[light]]\ntype = \"environment\"\nradiance = 1\n";
    write("none.toml", scene);
    write("some.toml", scene + "[camera]\nfov = 20\n");
    write("all.toml", scene + "[camera]\nposition = [5, 3, 7]\ntarget = [0, 2, 0]\n");
    const FoundView none = view_of("none.toml").value(), some = view_of("some.toml").value();
    EXPECT_EQ(some.fov_deg, 20);
    expect_direction(ahead(some), ahead(none));
    EXPECT_LE(share(some, corners(mesh.points)), 0.95);
    EXPECT_FALSE(view_of("all.toml")) << "nothing was added";
    // The command line comes before the file.
    const FoundView right = view_of("all.toml", {"--view", "right"}).value();
    expect_direction(ahead(right), {-1, 0, 0});
    EXPECT_EQ(view_of("all.toml", {"--up", "z"}).value().up, (Vec3d{0, 0, 1}));
}

TEST_F(DefaultView, SidesByName)
{
    const MeshText mesh = vase(1);
    const std::vector<std::pair<std::string, Vec3d>> sides{{"front", {0, 0, -1}},
                                                           {"back", {0, 0, 1}},
                                                           {"left", {1, 0, 0}},
                                                           {"right", {-1, 0, 0}},
                                                           {"top", {0, -1, 0}},
                                                           {"90,0", {-1, 0, 0}},
                                                           {"-90,0", {1, 0, 0}},
                                                           {"0,90", {0, -1, 0}},
                                                           {"0,-90", {0, 1, 0}},
                                                           {"360,0", {0, 0, -1}},
                                                           {"0,30", {0, -0.5, -std::sqrt(0.75)}}};
    for (const auto& [name, wanted] : sides) {
        const FoundView view = view_of(mesh, {"--view", name}).value();
        SCOPED_TRACE(name);
        expect_direction(ahead(view), wanted);
        EXPECT_LE(share(view, corners(mesh.points)), 0.95);
    }
    // With z up, the front is seen from -y.
    expect_direction(ahead(view_of(mesh, {"--view", "front", "--up", "z"}).value()), {0, 1, 0});
    expect_direction(ahead(view_of(mesh, {"--view", "right", "--up", "z"}).value()), {-1, 0, 0});
    // Seen from above, the front is at the bottom of the picture.
    EXPECT_EQ(view_of(mesh, {"--view", "top"}).value().up, (Vec3d{0, 0, -1}));
    EXPECT_EQ(view_of(mesh, {"--view", "top", "--up", "z"}).value().up, (Vec3d{0, 1, 0}));
}

TEST_F(DefaultView, MistakesOfTheCommandLine)
{
    const auto said = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"render", "quad.obj", "-o", "x.exr"};
        all.insert(all.end(), more.begin(), more.end());
        const Said s = run(all);
        EXPECT_EQ(s.code, 2);
        return s.err;
    };
    expect_words(said({"--view", "fron"}), "--view: unknown name 'fron'; did you mean 'front'?");
    expect_words(said({"--view", "30,95"}), "--view: '95' is not a number of degrees from -90 to 90");
    expect_words(said({"--view", "30,x"}), "--view: 'x' is not a number of degrees");
    expect_words(said({"--up", "x"}), "--up: unknown name 'x'");
}

TEST_F(DefaultView, UpIsZOnlyOnEvidence)
{
    EXPECT_EQ(view_of(vase(1)).value().up, (Vec3d{0, 1, 0}));
    EXPECT_EQ(view_of(vase(2)).value().up, (Vec3d{0, 0, 1}));
    expect_words(log_, "up is z, as ");
    EXPECT_EQ(view_of(vase(2), {"--up", "y"}).value().up, (Vec3d{0, 1, 0}));
    MeshText cube, ball;
    cube.box({-1, -1, 0}, {1, 1, 2});
    ball.turned({{0, -1}, {0.6, -0.8}, {1, 0}, {0.6, 0.8}, {0, 1}}, 2);
    EXPECT_EQ(view_of(cube).value().up, (Vec3d{0, 1, 0}));
    EXPECT_EQ(view_of(ball).value().up, (Vec3d{0, 1, 0}));
    // A scene file says what is up, unless it is asked to guess.
    write("mesh.obj", vase(2).text.str());
    write("s.toml", "[[mesh]]\nfile = \"mesh.obj\"\n");
    EXPECT_EQ(view_of("s.toml").value().up, (Vec3d{0, 1, 0}));
    EXPECT_EQ(view_of("s.toml", {"--up", "auto"}).value().up, (Vec3d{0, 0, 1}));
}

TEST_F(DefaultView, SheetsAreSeenFromTheirFront)
{
    MeshText front, back, floor;
    front.quad({0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0});
    back.quad({0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {3, 0, 0});
    floor.quad({0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0});
    expect_direction(ahead(view_of(front).value()), {0, 0, -1});
    expect_direction(ahead(view_of(back).value()), {0, 0, 1});
    expect_direction(ahead(view_of(floor).value()), {0, -1, 0});
}

// The side of many triangles is seen, in a three-quarter view.
TEST_F(DefaultView, TheSideWithMostDetailIsSeen)
{
    for (const int side : {0, 1, 4, 5}) {
        MeshText mesh;
        mesh.box({-2, 0, -2}, {2, 4, 2});
        for (double s = -1.8; s < 1.8; s += 0.2)
            for (double y = 0.2; y < 3.6; y += 0.2) {
                const double out = side % 2 ? 2 : -2.1;
                const Vec3d low = side < 2 ? Vec3d{out, y, s} : Vec3d{s, y, out};
                mesh.box(low, low + Vec3d{0.1, 0.1, 0.1});
            }
        const Vec3d outwards = side < 2 ? Vec3d{side ? 1.0 : -1.0, 0, 0} : Vec3d{0, 0, side == 5 ? 1.0 : -1.0};
        const Vec3d seen = ahead(view_of(mesh).value());
        EXPECT_LT(dot(seen, outwards), -0.7) << side;
        EXPECT_GT(dot(seen, outwards), -0.95) << side;
    }
}

TEST_F(DefaultView, RoomsAreSeenFromInside)
{
    const MeshText closed = room(true, {});
    const FoundView view = view_of(closed).value();
    EXPECT_LT(std::abs(view.position.x), 3);
    EXPECT_LT(std::abs(view.position.z), 5);
    EXPECT_GT(view.position.y, 0.3);
    EXPECT_LT(view.position.y, 2.7);
    EXPECT_GT(std::abs(ahead(view).z), 0.9) << "along its length";
    EXPECT_GT(ahead(view).z * -view.position.z, 0) << "from one end to the other";
    expect_words(log_, "seen from inside");
    expect_direction(ahead(view_of(closed, {"--view", "front"}).value()), {0, 0, -1});

    // Walls with an outside, and a turned room.
    MeshText thick = room(true, {});
    thick.box({-3.2, -0.2, -5.2}, {3.2, 3.2, 5.2});
    EXPECT_LT(std::abs(view_of(thick).value().position.z), 5);
    // An open top, as of a yard: what is inside is hidden from most sides, but not from above.
    EXPECT_GT(length(view_of(room(false, {})).value().position), 5) << "a closed box has no inside that faces inwards";
    EXPECT_GT(length(view_of(vase(1)).value().position), 4) << "a vessel is no room";
}

TEST_F(DefaultView, OpenBoxesAreSeenThroughTheirOpenSide)
{
    const std::vector<std::pair<int, Vec3d>> sides{{0, {1, 0, 0}}, {1, {-1, 0, 0}}, {4, {0, 0, 1}}, {5, {0, 0, -1}}};
    for (const auto& [side, inwards] : sides) {
        MeshText mesh;
        mesh.box({-2, 0, -2}, {2, 4, 2}, true, {side});
        mesh.box({-1, 0, -1}, {0, 2, 0});
        const FoundView view = view_of(mesh).value();
        SCOPED_TRACE(side);
        expect_direction(ahead(view), inwards);
        const double in_frame = share(view, mesh.points);
        EXPECT_GE(in_frame, 0.6);
        EXPECT_LE(in_frame, 0.95);
        expect_words(log_, "seen through its open side");
    }
}

}  // namespace
}  // namespace lancer
