// Rows C of the stability matrix: camera and command line. C5 to C8 stand in camera_cases.cpp.
#include <cmath>

#include "app/exit_code.h"
#include "stability/camera_cases.h"
#include "stability/counted_render.h"
#include "stability/measured_run.h"

namespace lancer::stability {
namespace {

const std::string front_camera = "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n";

void write(const TempFolder& folder, const std::string& name, const std::string& text)
{
    write_bytes(folder.file(name), text);
}

// The sky "gradient" along a direction, in long double: straight lines between white, blue and black by the elevation.
std::array<long double, 3> gradient_sky(long double sine)
{
    if (sine < 0.5L) return {1 - 2 * sine, 1 - 2 * sine, 1};
    return {0, 0, 2 - 2 * sine};
}

// What the picture, of a camera that looks up by `elevation` radians, is off at most.
double gradient_error(const Image& image, long double elevation, long double fov_deg)
{
    const int32_t w = image.display.width(), h = image.display.height();
    const long double pi = std::numbers::pi_v<long double>, pixel = 2 * std::tan(fov_deg * pi / 360) / h;
    double worst = 0;
    for (int32_t y = 0; y < h; ++y)
        for (int32_t x = 0; x < w; ++x) {
            const long double right = (x + 0.5L - w / 2.0L) * pixel, up = (h / 2.0L - y - 0.5L) * pixel;
            const long double sine = (std::sin(elevation) + std::cos(elevation) * up) / std::hypot(right, up, 1.0L);
            const auto expected = gradient_sky(sine);
            const Color c = image.at(x, y);
            const std::array<float, 3> got{c.r, c.g, c.b};
            for (size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(static_cast<double>(got[k] - expected[k])));
        }
    return worst;
}

Outcome extreme_sizes(const Setup& setup)
{
    const TempFolder folder;
    write(folder, "sky.toml",
          "[camera]\nposition = [0, 0, 0]\ntarget = [0, 3, -4]\nfov = 60\n[background]\nsky = \"gradient\"\n");
    const long double elevation = std::atan2(3.0L, 4.0L);
    const std::string side = std::to_string(setup.scaled(512, 4096, 16384));
    Outcome out;
    for (const std::string& size :
         {std::string("1x1"), std::string("1x65535"), std::string("65535x1"), side + "x" + side}) {
        const MeasuredRun run = measured_run(
            folder, {"render", "sky.toml", "-s", "1", "--filter", "centre", "--size", size, "-o", "a.exr"});
        out.measures.push_back(exactly(size + ": exit code", run.said.code, 0));
        if (run.said.code != 0) continue;
        const Image image = read_exr(folder.file("a.exr"));
        const auto pixels = static_cast<double>(image.pixels.size());
        out.samples += image.pixels.size();
        out.measures.push_back(
            at_most(size + ": largest error of the gradient", gradient_error(image, elevation, 60), 1e-6));
        out.measures.push_back(cost_at_most(size + ": memory, MiB", run.peak_mb, 64 + 40 * pixels / (1 << 20)));
    }
    return out;
}

Outcome impossible_sizes(const Setup&)
{
    const TempFolder folder;
    write(folder, "a.toml", front_camera);
    Outcome out;
    double wrong = 0, cpu = 0, memory = 0, files = 0, runs = 0;
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
        {"--size",
         {"0x5", "5x0", "-1x5", "5x-1", "2147483648x1", "1x2147483648", "65536x65536", "9999999999x9999999999"}},
        {"--spp", {"0", "-1", "1099511627776", "4294967296", "nan", "1e3"}},
        {"--threads", {"0", "-1", "1099511627776"}},
        {"--tile", {"0", "-1", "1099511627776"}},
        {"--batch", {"0", "-1", "1099511627776"}},
        {"--crop", {"0,0,0,0", "5,5,4,4", "-1,0,4,4", "0,0,4294967296,1"}}};
    for (const auto& [option, values] : cases)
        for (const std::string& value : values) {
            const MeasuredRun run = measured_run(folder, {"render", "a.toml", "-o", "a.exr", option + "=" + value});
            wrong += run.said.code != exit_usage;
            cpu = std::max(cpu, run.cpu_seconds), memory = std::max(memory, run.peak_mb), ++runs;
            files += std::filesystem::exists(folder.file("a.exr"));
        }
    out.measures = {exactly("exit codes that are not 2", wrong, 0), cost_at_most("CPU time, ms", 1000 * cpu, 50),
                    cost_at_most("memory, MiB", memory, 32), exactly("pictures written", files, 0), told("runs", runs)};
    return out;
}

// The angle between the upper and the lower edge of the picture, over what it should be, less 1.
double fov_error(double fov_deg, Vec3d towards)
{
    constexpr uint32_t size = 1000;
    const Camera camera(make_camera({0, 0, 0}, towards, fov_deg), Normalisation{}, size, size);
    const Vec3d a = normalize(to_double(camera.ray({size / 2, 0}, {}).dir));
    const Vec3d b = normalize(to_double(camera.ray({size / 2, size}, {}).dir));
    const double angle = std::atan2(length(cross(a, b)), dot(a, b));
    return std::abs(angle / (fov_deg * std::numbers::pi / 180) - 1);
}

Outcome fields_of_view(const Setup&)
{
    const TempFolder folder;
    write(folder, "a.toml", front_camera + "[[sphere]]\n");
    double wrong = 0;
    for (const char* fov : {"0", "-0.0", "180", "-5", "nan", "inf", "1e400", "180.0000001"})
        wrong += measured_run(folder, {"render", "a.toml", "-o", "a.exr", "-D", std::string("camera.fov=") + fov})
                     .said.code != exit_invalid;
    double rendered = 0;
    for (const char* fov : {"179.99", "1e-6", "1e-300"})
        rendered += measured_run(folder, {"render", "a.toml", "-o", "a.exr", "-s", "1", "--size", "8x8", "-D",
                                          std::string("camera.fov=") + fov})
                        .said.code == exit_done;
    const Vec3d ahead{0, 0, -1}, oblique{0.3, -0.5, -1};
    double worst = 0, worst_oblique = 0;
    for (const double fov : {1e-6, 1e-3, 1.0, 40.0, 179.0, 179.99}) worst = std::max(worst, fov_error(fov, ahead));
    for (const double fov : {1.0, 40.0, 179.0, 179.99})
        worst_oblique = std::max(worst_oblique, fov_error(fov, oblique));
    double least = 180;
    while (least > 1e-6 && fov_error(least / 2, oblique) <= 1e-5) least /= 2;
    Outcome out;
    out.measures = {exactly("angles out of range not refused with 65", wrong, 0),
                    exactly("angles in range rendered", rendered, 3),
                    at_most("relative error of the angle along an axis, 1e-6 to 179.99 degrees", worst, 1e-5),
                    at_most("relative error of the angle askew, 1 to 179.99 degrees", worst_oblique, 1e-5),
                    told("least angle askew with an error below 1e-5, degrees", least)};
    return out;
}

Outcome views_that_are_none(const Setup&)
{
    const TempFolder folder;
    const std::string sky = "[[light]]\ntype = \"environment\"\nradiance = 1\n[[sphere]]\nradius = 0.5\n";
    double wrong = 0, runs = 0;
    for (const char* camera :
         {"position = [1, 2, 3]\ntarget = [1, 2, 3]", "position = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 0, -1]",
          "position = [0, 0, 5]\nup = [0, 0, 0]", "position = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [1e-9, 0, 1]",
          "position = [0, 5, 0]\ntarget = [0, 0, 0]\nup = \"y\"",
          "position = [1.7e308, 0, 0]\ntarget = [-1.7e308, 0, 0]", "position = [nan, 0, 0]", "position = [0, 0, inf]",
          "up = [0, 1e400, 0]"}) {
        write(folder, "a.toml", std::string("[camera]\n") + camera + "\n" + sky);
        wrong += measured_run(folder, {"render", "a.toml", "-o", "a.exr", "--size", "8x8", "-s", "1"}).said.code !=
                 exit_invalid;
        ++runs;
    }
    // What is barely a view is one: as far from parallel as single precision can tell, tiny and huge up vectors.
    double not_finite = 0;
    Outcome out;
    for (const auto& [position, target, up] : {std::tuple{Vec3d{0, 0, 5}, Vec3d{}, Vec3d{1e-5, 0, -1}},
                                               {Vec3d{0, 0, 5}, Vec3d{}, Vec3d{0, 1e-300, 0}},
                                               {Vec3d{0, 0, 5}, Vec3d{}, Vec3d{0, 1e300, 0}},
                                               {Vec3d{0, 0, 5}, Vec3d{0, 0, std::nextafter(5, 0)}, Vec3d{0, 1, 0}},
                                               {Vec3d{1e6, 0, 0}, Vec3d{}, Vec3d{0, 1, 0}},
                                               {Vec3d{0, 0, 1e-12}, Vec3d{}, Vec3d{0, 1, 0}}}) {
        SceneDescription d;
        d.spheres.push_back(sphere_of({0, 0, 0}, 0.5));
        d.lights.push_back(sky_of({1, 1, 1}));
        d.camera = make_camera(position, target, 40);
        d.camera->up = up;
        for (const Pixel& p : counted_render(d, square(8, 4), out).pixels)
            not_finite += !std::isfinite(p.sum[0]) || p.n != 4;
    }
    out.measures = {exactly("views not refused with 65", wrong, 0), told("views refused", runs - wrong),
                    exactly("pixels that are not finite with views that are barely ones", not_finite, 0)};
    return out;
}

}  // namespace

std::vector<Row> camera_rows()
{
    return {
        {"C1", "1x1, 1x65535, 65535x1, a large square", "closed form", Tier::A, false, extreme_sizes},
        {"C2", "sizes, samples and crops that are none", "policy", Tier::A, false, impossible_sizes},
        {"C3", "fov 0, 180, 179.99, NaN, 1e-6", "policy, closed form", Tier::A, false, fields_of_view},
        {"C4", "no view: target = position, up along it, up = 0", "policy", Tier::A, false, views_that_are_none},
        {"C5", "scenes of nothing, of lights alone, closed boxes", "closed form", Tier::A, false, empty_scenes},
        {"C6", "camera on a surface, a vertex, in a light", "itself on one thread", Tier::A, false, camera_on_things,
         true},
        {"C7", "locales de_DE and tr_TR", "itself in C", Tier::A, false, locales},
        {"C8", "depth 1, 1e5 without roulette, 1e9, no limit", "closed form", Tier::A, false, depths},
    };
}

}  // namespace lancer::stability
