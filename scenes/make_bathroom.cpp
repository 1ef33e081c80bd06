// Writes the bathroom of bathroom.toml, in tenths of a millimetre: x from the tub to the tall mirror, z from the basin
// to the eye. The glass of the mirrors stands in the scene file.
//   g++ -std=c++20 -O2 scenes/make_bathroom.cpp -o make_bathroom && ./make_bathroom scenes/meshes
#include "make_rooms.h"

namespace {

constexpr double left = -1.7, right = 1.7, far = -1.4, near = 1.75, height = 2.55;
constexpr double tub_edge = -0.93, tub_end = 0.36, tub_top = 0.56, tiled = 2.16;

void shell(Pieces& p)
{
    p.material("floor");
    p.pictured_quad({left, 0, near}, {right, 0, near}, {right, 0, far}, {left, 0, far});
    p.material("ceiling");
    p.quad({left, height, far}, {right, height, far}, {right, height, near}, {left, height, near});
    p.material("wall");
    p.wall({left, 0, far}, {right - left, 0, 0}, {0, height, 0}, 0, {});
    p.wall({left, 0, near}, {0, 0, far - near}, {0, height, 0}, 0, {});
    p.wall({right, 0, far}, {0, 0, near - far}, {0, height, 0}, 0, {});
    p.wall({right, 0, near}, {left - right, 0, 0}, {0, height, 0}, 0, {});
    p.material("paint");
    p.box({tub_edge, -0.01, far}, {right, 0.10, far + 0.014}, 0.004);
    p.box({right - 0.014, -0.01, far}, {right, 0.10, near}, 0.004);
    p.box({left, -0.01, tub_end}, {left + 0.014, 0.10, near}, 0.004);
    // The door, behind the eye: the mirrors show it.
    constexpr double d0 = -0.75, d1 = 0.10, top = 2.03;
    for (const double x : {d0 - 0.08, d1}) p.box({x, 0, near - 0.02}, {x + 0.08, top + 0.08, near}, 0.005);
    p.box({d0, top, near - 0.02}, {d1, top + 0.08, near}, 0.005);
    p.material("door");
    p.box({d0, 0.005, near - 0.012}, {d1, top, near}, 0.002);
    for (const auto& [y0, y1] : {std::array{0.15, 0.95}, {1.07, 1.88}})
        p.box({d0 + 0.13, y0, near - 0.022}, {d1 - 0.13, y1, near - 0.010}, 0.005);
    p.material("chrome");
    p.rod({{d0 + 0.06, 1.02, near - 0.01},
           {d0 + 0.06, 1.02, near - 0.06},
           {d0 + 0.07, 1.02, near - 0.065},
           {d0 + 0.18, 1.02, near - 0.065}},
          0.009, 12);
}

// A wall of glazed tiles by hand: none lies quite flat, and no two have the same glaze.
void tiles(Pieces& p, Point corner, Point across, double width, double bottom, double top, uint32_t seed)
{
    constexpr double side = 0.1, joint = 0.0025, thick = 0.007, edge = 0.003;
    Random random(seed);
    const Point up{0, 1, 0}, out = cross(across, up);
    p.material("grout");
    const Point a = corner + up * bottom + out * (0.6 * thick), b = a + across * width, lift = up * (top - bottom);
    p.quad(a, b, b + lift, a + lift);
    p.quad(a + lift, b + lift, b + lift - out * (0.6 * thick), a + lift - out * (0.6 * thick));
    for (double y = bottom; y + side <= top + 1e-9; y += side)
        for (double x = 0; x < width - 0.01; x += side) {
            p.material("tile_" + std::to_string(1 + static_cast<int>(random.in(0, 2.999))));
            const double w = std::fmin(side, width - x) - joint, h = side - joint;
            const double lean_x = random.spread(0.008), lean_y = random.spread(0.008);
            const auto at = [&](double s, double t, double depth) {
                const double tilt = depth > 0 ? lean_x * (s - w / 2) + lean_y * (t - h / 2) : 0;
                return corner + across * (x + s) + up * (y + t) + out * (depth + tilt);
            };
            const std::array<Point, 4> low{at(0, 0, 0), at(w, 0, 0), at(w, h, 0), at(0, h, 0)};
            const std::array<Point, 4> high{at(edge, edge, thick), at(w - edge, edge, thick),
                                            at(w - edge, h - edge, thick), at(edge, h - edge, thick)};
            p.facets({low.begin(), low.end()}, {high.begin(), high.end()});
        }
}

void tub(Pieces& p)
{
    p.place({(left + tub_edge) / 2, 0, (far + tub_end) / 2});
    const double x = (tub_edge - left) / 2 - 0.008, z = (tub_end - far) / 2 - 0.008;
    p.material("enamel");
    std::vector<Pieces::Ring> rings{{x - 0.03, z, 0.01, 0},
                                    {x - 0.03, z, 0.01, tub_top - 0.045},
                                    {x - 0.025, z, 0.012, tub_top - 0.04},
                                    {x - 0.004, z, 0.018, tub_top - 0.038}};
    for (int k = 0; k <= 4; ++k) {
        const double a = k * pi / 8;
        rings.push_back({x - 0.012 + 0.012 * std::cos(a), z - 0.012 + 0.012 * std::cos(a), 0.02,
                         tub_top - 0.012 + 0.012 * std::sin(a)});
    }
    for (int k = 0; k <= 4; ++k) {
        const double a = k * pi / 8;
        rings.push_back(
            {x - 0.055 - 0.02 * std::sin(a), z - 0.07 - 0.02 * std::sin(a), 0.14, tub_top - 0.02 + 0.02 * std::cos(a)});
    }
    for (const auto& [dx, dz, r, y] : {std::array{0.085, 0.115, 0.16, 0.40},
                                       {0.10, 0.145, 0.17, 0.28},
                                       {0.115, 0.17, 0.18, 0.22},
                                       {0.14, 0.20, 0.16, 0.175},
                                       {0.18, 0.26, 0.13, 0.155},
                                       {0.26, 0.40, 0.06, 0.15}})
        rings.push_back({x - dx, z - dz, r, y});
    p.rounded(rings, 10);
    p.material("chrome");
    p.turned({0, 0.150, -0.45}, {{0.034, 0}, {0.034, 0.003}, {0.028, 0.005}, {0, 0.005}}, 24);
    p.place({});

    // A bath mixer on the tiles, with a riser and a shower head.
    const double wall = left + 0.007, tap = -0.92;
    p.place({wall, 0.82, tap});
    for (const double side : {-0.075, 0.075})
        p.rod({{0, 0, side}, {0.055, 0, side}}, 0.016, 18), p.rod({{0, 0, side}, {0.008, 0, side}}, 0.034, 24);
    p.rod({{0.06, 0, -0.10}, {0.06, 0, 0.10}}, 0.024, 20);
    for (const double side : {-0.135, 0.10}) p.rod({{0.06, 0, side}, {0.06, 0, side + 0.035}}, 0.028, 20);
    std::vector<Point> spout;
    for (int k = 0; k <= 10; ++k)
        spout.push_back({0.07 + 0.11 * std::sin(k * pi / 20), -0.02 - 0.06 * (1 - std::cos(k * pi / 20)), 0});
    p.rod(spout, 0.015, 16);
    std::vector<Point> riser{{0.06, 0.02, 0}, {0.06, 0.20, 0}, {0.05, 1.16, 0}};
    for (int k = 1; k <= 10; ++k)
        riser.push_back({0.05 + 0.16 * (1 - std::cos(k * pi / 10)), 1.16 + 0.13 * std::sin(k * pi / 10), 0});
    p.rod(riser, 0.011, 14);
    p.rod({{0, 0.9, 0}, {0.053, 0.9, 0}}, 0.009, 12);
    p.turned({0.37, 1.10, 0},
             {{0, 0}, {0.10, 0}, {0.104, 0.004}, {0.10, 0.009}, {0.03, 0.022}, {0.016, 0.06}, {0, 0.065}}, 40);
    p.place({});

    // The screen of frosted glass stands on the edge of the tub, in a frame.
    constexpr double z0 = far + 0.02, z1 = -0.45, y0 = tub_top + 0.002, y1 = 2.02, at = tub_edge - 0.035;
    p.material("frosted");
    p.quad({at, y0 + 0.01, z1 - 0.01}, {at, y0 + 0.01, z0 + 0.01}, {at, y1 - 0.01, z0 + 0.01},
           {at, y1 - 0.01, z1 - 0.01});
    p.material("chrome");
    p.box({at - 0.010, y0, z0 - 0.012}, {at + 0.010, y1 + 0.012, z0 + 0.012}, 0.003);
    p.box({at - 0.010, y0, z1 - 0.012}, {at + 0.010, y1 + 0.012, z1 + 0.012}, 0.003);
    for (const double y : {y0, y1 - 0.012}) p.box({at - 0.008, y, z0}, {at + 0.008, y + 0.02, z1}, 0.003);
}

void basin(Pieces& p)
{
    constexpr double x0 = -0.28, x1 = 1.02, deep = 0.48, top = 0.80;
    p.material("oak");
    p.board({x0, 0.20, far + 0.001}, {x1, top - 0.03, far + deep - 0.02}, 0.003, 0.4);
    for (int k = 0; k < 2; ++k) {
        const double a = x0 + 0.004 + k * (x1 - x0) / 2, b = a + (x1 - x0) / 2 - 0.008;
        p.board({a, 0.205, far + deep - 0.02}, {b, 0.475, far + deep}, 0.003, 1.3 + k);
        p.board({a, 0.483, far + deep - 0.02}, {b, top - 0.05, far + deep}, 0.003, 3.7 + k);
    }
    p.material("chrome");
    for (int k = 0; k < 2; ++k)
        for (const double y : {0.42, 0.70}) {
            const double x = x0 + (x1 - x0) * (0.25 + 0.5 * k), z = far + deep;
            p.rod({{x - 0.08, y, z},
                   {x - 0.08, y, z + 0.025},
                   {x - 0.074, y, z + 0.03},
                   {x + 0.074, y, z + 0.03},
                   {x + 0.08, y, z + 0.025},
                   {x + 0.08, y, z}},
                  0.006, 10);
        }
    p.material("stone");
    p.box({x0 - 0.02, top - 0.03, far + 0.001}, {x1 + 0.02, top, far + deep + 0.02}, 0.004);
    // A bowl that stands on the top.
    p.material("enamel");
    p.place({0.37, top, far + 0.25});
    p.rounded({{0.20, 0.13, 0.06, 0},
               {0.205, 0.135, 0.06, 0.004},
               {0.25, 0.17, 0.08, 0.07},
               {0.27, 0.185, 0.09, 0.122},
               {0.271, 0.186, 0.09, 0.127},
               {0.268, 0.183, 0.09, 0.130},
               {0.263, 0.178, 0.088, 0.130},
               {0.259, 0.174, 0.087, 0.127},
               {0.25, 0.166, 0.085, 0.10},
               {0.225, 0.146, 0.08, 0.045},
               {0.195, 0.12, 0.075, 0.022},
               {0.10, 0.06, 0.04, 0.014}},
              10);
    p.material("chrome");
    p.turned({0, 0.014, 0}, {{0.024, 0}, {0.024, 0.002}, {0.018, 0.004}, {0, 0.004}}, 24);
    p.place({0.37, top, far + 0.055});
    p.turned({0, 0, 0}, {{0, 0}, {0.026, 0}, {0.026, 0.006}, {0.017, 0.010}, {0.017, 0.014}}, 24);
    std::vector<Point> neck{{0, 0.005, 0}, {0, 0.24, 0}};
    for (int k = 1; k <= 12; ++k)
        neck.push_back({0, 0.24 + 0.07 * std::sin(k * pi / 12), 0.07 * (1 - std::cos(k * pi / 12))});
    neck.push_back({0, 0.215, 0.14});
    p.rod(neck, 0.013, 18);
    p.rod({{0, 0.10, 0}, {0.045, 0.10, 0}}, 0.010, 14);
    p.rod({{0.045, 0.095, 0}, {0.055, 0.17, 0}}, 0.006, 12);
    p.place({});
    // Beside it: soap, a tumbler and a jar.
    p.material("bottle");
    p.turned(
        {-0.10, top, far + 0.14},
        {{0, 0}, {0.034, 0}, {0.036, 0.004}, {0.036, 0.12}, {0.030, 0.138}, {0.014, 0.145}, {0.014, 0.16}, {0, 0.16}},
        32);
    p.turned(
        {-0.17, top, far + 0.24},
        {{0, 0}, {0.026, 0}, {0.028, 0.004}, {0.028, 0.085}, {0.022, 0.10}, {0.012, 0.104}, {0.012, 0.115}, {0, 0.115}},
        32);
    p.material("chrome");
    p.turned({-0.10, top + 0.16, far + 0.14}, {{0.016, 0}, {0.016, 0.018}, {0.006, 0.02}, {0.006, 0.045}, {0, 0.045}},
             20);
    p.rod({{-0.10, top + 0.20, far + 0.135}, {-0.10, top + 0.20, far + 0.185}}, 0.005, 10);
    p.material("tumbler");
    p.turned({0.86, top + 0.0002, far + 0.16},
             {{0, 0},
              {0.032, 0},
              {0.034, 0.003},
              {0.038, 0.095},
              {0.037, 0.097},
              {0.036, 0.095},
              {0.0325, 0.012},
              {0.030, 0.010},
              {0, 0.010}},
             40);
    p.material("brush");
    p.rod({{0.845, top + 0.014, far + 0.155}, {0.893, top + 0.19, far + 0.15}}, 0.004, 8);
}

void frames(Pieces& p)
{
    p.material("brass");
    const auto frame = [&](double x0, double x1, double y0, double y1, double w, const auto& turn) {
        const auto piece = [&](double a0, double b0, double a1, double b1) {
            const Point a = turn(a0, b0, 0.0), b = turn(a1, b1, 0.022);
            p.box({std::fmin(a.x, b.x), a.y, std::fmin(a.z, b.z)}, {std::fmax(a.x, b.x), b.y, std::fmax(a.z, b.z)},
                  0.003);
        };
        piece(x0 - w, y0 - w, x0, y1 + w), piece(x1, y0 - w, x1 + w, y1 + w), piece(x0, y0 - w, x1, y0),
            piece(x0, y1, x1, y1 + w);
    };
    frame(-0.30, 1.04, 1.04, 1.98, 0.014, [](double x, double y, double out) { return Point{x, y, far + out}; });
    frame(-1.28, -0.42, 0.14, 2.02, 0.014, [](double z, double y, double out) { return Point{right - out, y, z}; });
    // The lamp hangs on its cord from a rose.
    p.place({0.22, 0, 0.30});
    p.turned({0, height - 0.025, 0}, {{0, 0}, {0.05, 0.008}, {0.055, 0.025}}, 32);
    p.rod({{0, 2.09, 0}, {0, height - 0.02, 0}}, 0.003, 8);
    p.turned({0, 2.07, 0}, {{0.030, 0}, {0.032, 0.012}, {0.018, 0.03}, {0.006, 0.045}, {0, 0.045}}, 24);
    p.place({});
}

void cloths(Pieces& p)
{
    // A towel over a hook rail between tub and basin.
    p.material("chrome");
    p.rod({{-0.80, 1.58, far}, {-0.80, 1.58, far + 0.06}, {-0.45, 1.58, far + 0.06}, {-0.45, 1.58, far}}, 0.008, 12);
    p.material("towel_dark");
    for (const double side : {-1.0, 1.0})
        p.sheet(36, 40, [&](double u, double v) {
            const double bend = v < 0.06 ? std::sin(v / 0.06 * pi / 2) : 1,
                         drop = (v < 0.06 ? 0.011 * (1 - std::cos(v / 0.06 * pi / 2))
                                          : 0.011 + (v - 0.06) * (side > 0 ? 0.66 : 0.55));
            const double fold = 0.007 * v * std::sin(4 * pi * u + side + 1.5 * v) + 0.004 * v * std::sin(9 * pi * u);
            return Point{-0.625 + side * (u - 0.5) * (0.29 - 0.02 * v), 1.592 - drop,
                         far + 0.06 + side * bend * 0.012 + std::fabs(fold) * side};
        });
    p.material("mat");
    p.cushion({-0.02, 0.0, -0.84}, {0.76, 0.022, -0.32}, 0.010, 0.0);
    // A stool with folded towels.
    p.place({-0.66, 0, 0.06}, 20);
    p.material("oak_turned");
    p.turned({0, 0.42, 0}, {{0, 0}, {0.155, 0}, {0.165, 0.008}, {0.165, 0.026}, {0.155, 0.034}, {0, 0.034}}, 48);
    for (int k = 0; k < 3; ++k) {
        const double a = 2 * pi * k / 3 + 0.4;
        p.rod({{0.17 * std::cos(a), 0, 0.17 * std::sin(a)}, {0.10 * std::cos(a), 0.425, 0.10 * std::sin(a)}}, 0.014,
              12);
    }
    for (int k = 0; k < 3; ++k) {
        p.material(k == 1 ? "towel" : "towel_dark");
        const double y = 0.455 + 0.052 * k;
        p.cushion({-0.13 + 0.006 * k, y, -0.095}, {0.13, y + 0.052, 0.095 - 0.004 * k}, 0.022, 0.003);
    }
    p.place({});
}

}  // namespace

int main(int argc, char** argv)
{
    Pieces p(only_argument(argc, argv, "make_bathroom OUTPUT_FOLDER") + "/bathroom.obj", "bathroom.mtl", 1e-4, 0);
    shell(p);
    tiles(p, {left, 0, tub_end}, {0, 0, -1}, tub_end - far, tub_top, tiled, 51);
    tiles(p, {left, 0, far}, {1, 0, 0}, tub_edge - left + 0.02, tub_top, tiled, 52);
    tub(p);
    basin(p);
    frames(p);
    cloths(p);
}
