// Rows M of the stability matrix: materials and textures.
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/exit_code.h"
#include "io/obj/obj.h"
#include "materials/texture_samples.h"
#include "stability/counted_render.h"
#include "stability/measured_run.h"
#include "support/shoot.h"

namespace lancer::stability {
namespace {

uint64_t count_of(const Diagnostics& diagnostics)
{
    uint64_t count = 0;
    for (const Diagnostics::Warning& w : diagnostics.warnings()) count += w.count;
    return count;
}

std::string mesh_text(const std::string& material_file)
{
    return "mtllib " + material_file +
           "\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
}

// The mean of the closed box of that material under a sky of 1, less four sigma, over all colours.
double furnace(const MaterialDescription& material, uint32_t spp, Outcome& out)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_cube(material), {{0, 0, 0}, {20, 30, 0}, {1, 1, 1}}));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = make_camera({0, 0, 5}, {0, 0, 0}, 40);
    RenderRequest r = square(12, spp);
    r.settings.kernel.sampler = SamplerKind::independent;
    Pixel all;
    for (const Pixel& p : counted_render(d, r, out).pixels) all += p;
    const stats::Tally t = tally(all);
    const double most = std::max({all.sum[0], all.sum[1], all.sum[2]}) / all.n;
    return most - 4 * t.error();
}

Outcome values_out_of_range(const Setup& setup)
{
    const TempFolder folder;
    const char* const statements[] = {"Kd -1 0.5 0.5",
                                      "Kd 0.5 2 0.5",
                                      "Kd 1e30 1e30 1e30",
                                      "Kd nan 0.5 0.5",
                                      "Kd 0.5 -inf 0.5",
                                      "Kd 1e400 1 1",
                                      "Kd x y z",
                                      "Kd",
                                      "Ke -1 -2 -3",
                                      "Ke nan 1 1",
                                      "Ns -1\nKs .5 .5 .5",
                                      "Ns nan\nKs .5 .5 .5",
                                      "Ks 3 3 3",
                                      "Ks -1 0 0",
                                      "d 7",
                                      "d nan",
                                      "Tr -2",
                                      "Ni 0\nillum 7",
                                      "Ni 1e6\nillum 7",
                                      "Ni -3\nillum 7",
                                      "Ni nan\nillum 7",
                                      "Pr -1",
                                      "Pr 7",
                                      "Pr nan",
                                      "Pm 9",
                                      "Pm -0.5",
                                      "Tf 9 9 9\nillum 7",
                                      "Tf -1 1 1\nillum 7",
                                      "illum nan"};
    Outcome out;
    double not_as_said = 0, failed = 0, not_strict = 0, most = 0;
    const auto spp = static_cast<uint32_t>(setup.scaled(16, 1024, 8192));
    const auto check = [&](const std::string& statement, uint64_t warnings) {
        write_bytes(folder.file("a.mtl"), "newmtl m\n" + statement + "\n");
        write_bytes(folder.file("a.obj"), mesh_text("a.mtl"));
        Diagnostics diagnostics;
        const auto mesh = load_obj(folder.file("a.obj"), diagnostics);
        if (!mesh) return void(++failed);
        not_as_said += count_of(diagnostics) != warnings;
        most = std::max(most, furnace(mesh->materials[0], spp, out));
    };
    for (const char* const statement : statements) check(statement, 1);
    // Clamped, and then said to be invisible, or taken for opaque.
    for (const char* const statement : {"d -3", "Tr 1e9"}) check(statement, 2);
    for (const char* const fine : {"Ns 1e9\nKs .5 .5 .5", "Kd 0 0 0", "Kd 1 1 1", "Ns 0\nKs 1 1 1"}) check(fine, 0);
    // A few by the program: a warning as it is, an error if strict.
    for (const char* const statement : {"Kd 0.5 2 0.5", "Ke nan 1 1", "d 7"}) {
        write_bytes(folder.file("a.mtl"), std::string("newmtl m\n") + statement + "\n");
        const std::vector<std::string> arguments{"render", "a.obj", "-s", "1", "--size", "8x8", "-q", "-o", "a.exr"};
        std::vector<std::string> strict = arguments;
        strict.emplace_back("--strict");
        failed += measured_run(folder, arguments).said.code != exit_done;
        not_strict += measured_run(folder, strict).said.code != exit_invalid;
    }
    out.measures = {exactly("values without their warning, or warned about in vain", not_as_said, 0),
                    exactly("files refused", failed, 0), exactly("not refused with --strict", not_strict, 0),
                    at_most("furnace: most light of any, less 4 sigma", most, 1.001)};
    return out;
}

// Albedos above 1 where nobody checks them: paths end all the same.
Outcome albedo_above_one(const Setup& setup)
{
    Outcome out;
    double refused = 0, not_finite = 0;
    for (const float albedo : {1.0f, 1.001f})
        for (const AnyIntegrator& integrator : all_integrators()) {
            SceneDescription d;
            MaterialDescription m = make_lambert("wall", {albedo, albedo, albedo});
            m.emission = {1, 1, 1};
            m.emission_both_sides = true;
            d.materials = {m};
            d.spheres.push_back(sphere_of({0, 0, 0}, 1.3, "wall"));
            d.camera = make_camera({0.3, 0.2, 0}, {0, 0, -1}, 70);
            RenderRequest r = square(static_cast<uint32_t>(setup.scaled(4, 16, 32)), 16);
            r.settings.integrator = integrator;
            for (const Pixel& p : counted_render(d, r, out).pixels) not_finite += !std::isfinite(p.sum[0]) || p.n != 16;
        }
    const TempFolder folder;
    write_bytes(folder.file("a.toml"), "[[sphere]]\nmaterial = \"m\"\n[material.m]\nbase_color = 1.001\n");
    const MeasuredRun run = measured_run(folder, {"render", "a.toml", "-o", "a.exr"});
    refused += run.said.code == exit_invalid && run.said.err.find("a.toml:4:14") != std::string::npos;
    out.measures = {exactly("pixels that are not finite or lack samples", not_finite, 0),
                    exactly("in a scene file: refused with its place", refused, 1)};
    return out;
}

Outcome broken_textures(const Setup& setup)
{
    const TempFolder folder;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        write_bytes(folder.file(name), bytes);
    };
    Image picture = make_image(8, 8);
    for (Color& c : picture.pixels) c = {0.25f, 0.5f, 0.75f};
    write_exr(folder.file("good.exr"), picture);
    const std::string exr = read_bytes(folder.file("good.exr"));
    write("empty.png", "");
    write("cut.exr", exr.substr(0, exr.size() / 2));
    write("head.exr", exr.substr(0, 40));
    write("wrong.png", exr);  // read by its first bytes, so this is no mistake
    write("text.jpg", "a picture of a text");
    write("size.ppm", "P6\n16384 16384\n255\n");
    write("sizes.ppm", "P6\n2000000000 2000000000\n255\n");
    write("cut.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n");
    std::filesystem::create_directory(folder.file("folder.png"));
    Image bad = picture;
    for (Color& c : bad.pixels)
        c = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.75f};
    write_exr(folder.file("nan.exr"), bad);
    write("scene.toml",
          "[camera]\nposition = [0, 0, 2]\n[[mesh]]\nfile = \"a.obj\"\n[[light]]\ntype = \"environment\"\nradiance = "
          "1\n");
    write("a.obj", mesh_text("a.mtl"));
    double memory = 0;
    const auto render = [&](const std::string& statements, const std::string& output, bool strict) {
        write("a.mtl", "newmtl m\nKd 0.5 0.5 0.5\n" + statements);
        std::vector<std::string> arguments{"render", "scene.toml", "-s", "4", "--size", "16x12", "-q", "-o", output};
        if (strict) arguments.emplace_back("--strict");
        const MeasuredRun run = measured_run(folder, arguments);
        memory = std::max(memory, run.peak_mb);
        return run.said;
    };
    Outcome out;
    double failed = 0, silent = 0, not_strict = 0, other = 0;
    failed += render("", "plain.exr", true).code != exit_done;
    const Image plain = read_exr(folder.file("plain.exr"));
    for (const std::string file :
         {"none.png", "empty.png", "cut.exr", "head.exr", "text.jpg", "size.ppm", "sizes.ppm", "cut.hdr", "folder.png",
          "/etc/passwd", "../../../../../../etc/passwd", "/dev/zero"}) {
        const Said said = render("map_Kd " + file + "\n", "a.exr", false);
        failed += said.code != exit_done;
        silent += said.err.find("warning") == std::string::npos;
        if (setup.tier != Tier::A || file == "none.png" || file == "cut.exr")
            not_strict += render("map_Kd " + file + "\n", "b.exr", true).code != exit_invalid;
        other += said.code == exit_done && !same_pixels(plain, read_exr(folder.file("a.exr")));
    }
    const Said nan = render("map_Kd nan.exr\n", "a.exr", false);
    double not_finite = nan.code != exit_done;
    for (const Color& c : read_exr(folder.file("a.exr")).pixels) not_finite += !is_finite(c) || c.b < 0;
    silent += nan.err.find("warning") == std::string::npos;
    failed += render("map_Kd wrong.png\n", "a.exr", true).code != exit_done;
    // The name of a picture in the scene file itself must be right.
    write("scene.toml", "[[sphere]]\nmaterial = \"m\"\n[material.m]\ntexture = \"none.png\"\n");
    failed += measured_run(folder, {"render", "scene.toml", "-o", "a.exr"}).said.code != exit_missing;
    out.measures = {exactly("runs that ended otherwise than they should", failed, 0),
                    exactly("problems without a warning", silent, 0),
                    exactly("problems not refused with 65 by --strict", not_strict, 0),
                    exactly("pictures that are not those of the number alone", other, 0),
                    exactly("pixels spoilt by a texture of NaN and infinity", not_finite, 0),
                    told("memory, MiB", memory)};
    if (setup.tier == Tier::A) return out;
    const auto side = static_cast<size_t>(setup.scaled(0, 4096, 16384));
    const std::string number = std::to_string(side);
    write("scene.toml",
          "[camera]\nposition = [0, 0, 2]\n[[mesh]]\nfile = \"a.obj\"\n[[light]]\ntype = \"environment\"\nradiance = "
          "1\n");
    write("large.pgm", "P5\n" + number + " " + number + "\n255\n" + std::string(side * side, '\x80'));
    out.measures.push_back(exactly("a picture of " + number + " x " + number,
                                   render("map_Kd large.pgm\n", "a.exr", true).code, exit_done));
    return out;
}

double cpu_now()
{
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// a.obj with as many materials as triangles, and a.mtl, where they stand in another order.
void write_many_materials(const TempFolder& folder, int count)
{
    std::string mtl, obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < count; ++i) {
        mtl += "newmtl m" + std::to_string(i) + "\nKd 0.1 0.2 0.3\n";
        obj += "usemtl m" + std::to_string(int64_t{i} * 7919 % count) + "\nf 1 2 3\n";
    }
    write_bytes(folder.file("a.mtl"), mtl);
    write_bytes(folder.file("a.obj"), obj);
}

Outcome material_files(const Setup& setup)
{
    const TempFolder folder;
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const auto load = [&](const std::string& mtl, const std::string& obj, uint64_t warnings, Color expected) {
        write_bytes(folder.file("a.mtl"), mtl);
        write_bytes(folder.file("a.obj"), obj);
        Diagnostics diagnostics;
        const auto mesh = load_obj(folder.file("a.obj"), diagnostics);
        return mesh && count_of(diagnostics) == warnings && mesh->materials[0].base_color == expected;
    };
    constexpr Color grey{0.8f, 0.8f, 0.8f}, red{1, 0, 0};
    double wrong = 0;
    wrong += !load("", "mtllib none.mtl\n" + corners + "f 1 2 3\n", 1, grey);
    wrong += !load("", "mtllib none.mtl\n" + corners + "usemtl x\nf 1 2 3\nusemtl y\nf 1 2 3\n", 1, grey);
    wrong += !load("newmtl a\n", "mtllib a.mtl\n" + corners + "usemtl x\nf 1 2 3\nusemtl x\nf 1 2 3\n", 2, grey);
    wrong +=
        !load("newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n", "mtllib a.mtl\n" + corners + "usemtl a\nf 1 2 3\n", 1, red);
    wrong += !load("", corners + "f 1 2 3\n", 0, grey);
    // Four times as many take four times as long, and not sixteen times. Least of three, in turns: what else runs on
    // the machine takes its caches away.
    const auto many = static_cast<int>(setup.scaled(20000, 200000, 200000));
    std::array<double, 2> seconds{};
    seconds.fill(std::numeric_limits<double>::infinity());
    double not_read = 0;
    for (int k = 0; k < 3; ++k)
        for (const size_t all : {size_t{0}, size_t{1}}) {
            const int count = all ? many : many / 4;
            write_many_materials(folder, count);
            Diagnostics diagnostics;
            const double start = cpu_now();
            const auto mesh = load_obj(folder.file("a.obj"), diagnostics);
            seconds[all] = std::min(seconds[all], cpu_now() - start);
            not_read += count - (mesh ? static_cast<double>(mesh->materials.size()) : 0);
        }
    Outcome out;
    out.measures = {exactly("files that did not become grey, or were not warned about", wrong, 0),
                    exactly("materials that were not read", not_read, 0),
                    at_most("exponent by which the CPU time grows with their number",
                            std::log(seconds[1] / seconds[0]) / std::log(4), 1.5),
                    told("CPU seconds to load them", seconds[1])};
    return out;
}

// Texels between their centres, in long double: a linear picture of bytes with one channel.
double reference(const Raster& raster, Wrap wrap, Vec2 uv)
{
    struct Between {
        size_t first, second;
        long double part;  // of the second
    };
    const auto between = [&](long double x, uint32_t size) {
        if (wrap == Wrap::repeat) x -= std::floor(x);
        x = std::clamp(x, 0.0L, 1.0L) * size - 0.5L;
        const long double first = std::floor(x);
        const auto at = [&](long double i) {
            const auto n = static_cast<int64_t>(i), last = static_cast<int64_t>(size) - 1;
            return static_cast<size_t>(wrap == Wrap::repeat ? (n + last + 1) % (last + 1)
                                                            : std::clamp<int64_t>(n, 0, last));
        };
        return Between{at(first), at(first + 1), x - first};
    };
    const Between column = between(static_cast<long double>(uv.x), raster.width);
    const Between line =
        between(1 - (wrap == Wrap::repeat ? static_cast<long double>(uv.y) - std::floor(static_cast<long double>(uv.y))
                                          : static_cast<long double>(uv.y)),
                raster.height);
    const auto texel = [&](size_t x, size_t y) {
        return static_cast<long double>(raster.bytes[y * raster.width + x]) / 255;
    };
    const auto row = [&](size_t y) {
        return texel(column.first, y) * (1 - column.part) + texel(column.second, y) * column.part;
    };
    return static_cast<double>(row(line.first) * (1 - line.part) + row(line.second) * line.part);
}

Outcome lookups(const Setup& setup)
{
    Random random(5);
    double worst = 0, not_finite = 0, seams = 0, means = 0;
    const auto n = setup.scaled(20000, 1000000, 10000000);
    for (const Size size : odd_and_even_sizes) {
        const Raster raster = byte_raster(size, 1, [&](auto...) { return random.below(256); });
        double mean = 0;
        for (const uint8_t b : raster.bytes) mean += b / 255.0 / static_cast<double>(raster.bytes.size());
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp}) {
            const ImageTexture texture(raster, {.encoding = Encoding::linear, .wrap = wrap});
            const auto error = [&](Vec2 uv) {
                return std::abs(double{texture.eval(uv, {}).r} - reference(raster, wrap, uv));
            };
            for (size_t i = 0; i < n; ++i) {
                const auto u = static_cast<float>(random.log_uniform(-6, 3)),
                           v = static_cast<float>(random.uniform(-2, 2));
                worst = std::max(worst, error({u, v}));
            }
            for (const float u : {0.0f, -0.0f, 1.0f, -1.0f, 2.0f, -7.0f, 0.5f, 1e30f, -1e30f, 3.4e38f, 1e-38f, -1e-38f,
                                  std::nextafter(1.0f, 0.0f), std::nextafter(1.0f, 2.0f)})
                for (const float v : {0.0f, 1.0f, -1.0f, 0.25f, 1e30f}) worst = std::max(worst, error({u, v}));
            // Where a picture repeats, its ends are one place.
            if (wrap == Wrap::repeat) seams += texture.eval({0, 0}, {}) != texture.eval({1, 1}, {});
            constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
            for (const Vec2 uv : {Vec2{nan, 0}, Vec2{0, nan}, Vec2{nan, nan}, Vec2{inf, 0}, Vec2{-inf, inf}}) {
                const float c = texture.eval(uv, {}).r;
                not_finite += !(c >= 0 && c <= 1);
            }
            // So wide a footprint that nothing but the mean is left, to the 8 bits that coarse levels have.
            means = std::max(means, std::abs(double{texture.eval({0.3f, 0.7f}, {1e9f, {}}).r} - mean));
        }
    }
    Outcome out;
    out.measures = {at_most("largest error of a texel", worst, 1e-6), exactly("seams at 1.0", seams, 0),
                    exactly("uv of NaN or infinity that give no colour of the picture", not_finite, 0),
                    at_most("coarsest level off the mean", means, 0.5 / 255 + 1e-6)};
    return out;
}

}  // namespace

std::vector<Row> material_rows()
{
    return {
        {"M1", "MTL values that are none or out of range", "policy", Tier::A, false, values_out_of_range},
        {"M2", "albedo 1 and 1.001 in a closed box", "policy", Tier::A, false, albedo_above_one},
        {"M3", "textures missing, empty, cut, of NaN, huge", "policy", Tier::A, false, broken_textures},
        {"M4", "materials missing, twice, 2e5 of them", "policy", Tier::A, false, material_files},
        {"M5", "uv of NaN, 1e30, negative, exactly 1; pictures of 1x1", "long double", Tier::A, false, lookups},
    };
}

}  // namespace lancer::stability
