// Writes forest.toml: plants what make_forest_meshes.cpp has grown.
//   g++ -std=c++20 -O2 scenes/make_forest.cpp -o make_forest && ./make_forest scenes/forest.toml
#include <algorithm>

#include "make_forest_ground.h"

namespace {

// Everything of the scene but its plants.
constexpr const char* head =
    R"(# A path into a forest: 1,316 instances of five meshes, 11.5 million triangles, leaves cut out by masks,
# under a sky picture. Written by make_forest.cpp.
version = 1

[render]
spp = 128
size = [960, 540]
max_depth = 8

[camera]
position = [0.2, 2.6, 4.4]
target = [0.6, 2.7, -10.0]
fov = 42

[[light]]
type = "environment"
file = "textures/sky.hdr"
scale = 1.5

[[mesh]]
file = "meshes/ground.obj"
scale = 0.01

[[mesh]]
name = "beech"
file = "meshes/beech.obj"
scale = 0.01

[[mesh]]
name = "spruce"
file = "meshes/spruce.obj"
scale = 0.01

[[mesh]]
name = "fern"
file = "meshes/fern.obj"
scale = 0.001

[[mesh]]
name = "grass"
file = "meshes/grass.obj"
scale = 0.001

[[mesh]]
name = "rock"
file = "meshes/rock.obj"
scale = 0.001

# The leaves of the trees are as forest.mtl says. The ground is fallen leaves with a path trodden into them; a mask that
# covers 50 m by 50 m about the path tells where. The uvs of the ground are metres.
[[material_override]]
match = "ground"
material = "ground"

[[material_override]]
match = "rock"
material = "rock"

[texture.litter]
file = "textures/litter.png"
scale = 0.8

[texture.litter_height]
file = "textures/litter_height.png"
encoding = "linear"
scale = 0.8

[texture.path]
file = "textures/path_mask.png"
encoding = "linear"
wrap = "clamp"
scale = 0.02
offset = [0.5, 0.1]

[texture.earth]
file = "textures/plaster.png"
scale = 0.7

[texture.grain]
file = "textures/plaster.png"
encoding = "linear"
scale = 2

[texture.moss]
file = "textures/patches.png"
encoding = "linear"

[material.ground]
type = "mix"
first = "litter"
second = "trodden"
weight = 1
weight_texture = "path"
bump_texture = "litter_height"
bump_scale = 1

[material.litter]
texture = "litter"

[material.trodden]
base_color = [0.62, 0.50, 0.38]
texture = "earth"

[material.rock]
type = "mix"
first = "stone"
second = "green"
weight = 0.85
weight_texture = "moss"
bump_texture = "grain"
bump_scale = 4

[material.stone]
base_color = [0.40, 0.39, 0.36]

[material.green]
base_color = [0.10, 0.16, 0.03]
)";

struct Plant {
    std::string mesh;
    double x, z, sink, size, stretch, turn, lean;
};

// Draws places until `count` are found; `fits` says whether one will do and `spacing` how far from its own kind.
template <class Fits>
void plant(std::vector<Plant>& plants, const std::string& mesh, int count, double spacing, double near, double far,
           double wide, double small, double large, double sink, double lean, uint32_t seed, const Fits& fits)
{
    Random random(seed);
    int found = 0;
    for (int tries = 0; found < count && tries < 400000; ++tries) {
        const double depth = near + (far - near) * random.next(), z = -depth;
        const double x = path_x(z) * 0.5 + random.spread(wide + 0.75 * std::fmax(depth, 0));
        const Plant p{
            mesh, x, z, sink, random.in(small, large), random.in(0.88, 1.14), random.in(0, 360), random.spread(lean)};
        if (std::fabs(x) > ground_reach - 4 || -z > ground_reach - 4 || !fits(p)) continue;
        const bool crowded = std::any_of(plants.begin(), plants.end(), [&](const Plant& q) {
            const bool trees = spacing > 1.2 && (q.mesh == "beech" || q.mesh == "spruce");
            if (q.mesh != mesh && !trees) return false;
            const double dx = q.x - x, dz = q.z - z;
            return dx * dx + dz * dz < spacing * spacing;
        });
        if (crowded) continue;
        plants.push_back(p);
        ++found;
    }
    std::printf("%s: %d planted\n", mesh.c_str(), found);
}

std::vector<Plant> plant_all()
{
    std::vector<Plant> plants;
    const auto off = [](const Plant& p) { return std::fabs(p.x - path_x(p.z)); };
    const auto shade = [](const Plant& p) { return fractal(p.x * 0.1 + 50, p.z * 0.1 + 50, 2, 64, 91); };
    // Beeches along the path and to the right, spruces behind and on the slopes.
    // No tree stands where it would keep the sun from the clearing.
    const auto shadows_clearing = [&](const Plant& p) {
        const double foot = ground(p.x, p.z), top = foot + p.size * p.stretch * (p.mesh == "beech" ? 14 : 17);
        for (double h = foot + 1; h < top; h += 1.5)
            if (outside_clearing(p.x + 1.0 * h, p.z - 0.77 * h) < 3.5) return true;
        return false;
    };
    const auto tree_fits = [&](const Plant& p) {
        return off(p) > 2.6 && outside_clearing(p.x, p.z) > 0.8 && p.z < 3 + std::fabs(p.x) && !shadows_clearing(p);
    };
    plant(plants, "beech", 360, 3.1, -10, 76, 12, 0.75, 1.25, 0.1, 3, 101,
          [&](const Plant& p) { return tree_fits(p) && shade(p) > 0.40; });
    plant(plants, "spruce", 460, 2.5, -10, 76, 12, 0.55, 1.3, 0.1, 2, 102,
          [&](const Plant& p) { return tree_fits(p) && shade(p) < 0.56 && off(p) > 3.2; });
    plant(plants, "fern", 330, 0.75, 1, 40, 3, 0.6, 1.25, 0.03, 8, 103,
          [&](const Plant& p) { return off(p) > 1.3 && outside_clearing(p.x, p.z) > -2.2 && shade(p) > 0.42; });
    plant(plants, "grass", 420, 0.42, 1, 24, 2, 0.7, 1.35, 0.02, 5, 104, [&](const Plant& p) {
        return off(p) > 0.75 && (outside_clearing(p.x, p.z) < 0.6 || off(p) < 2.0) && shade(p) > 0.28;
    });
    plant(plants, "rock", 46, 1.4, 2, 50, 3, 0.14, 0.75, 0.12, 25, 105, [&](const Plant& p) { return off(p) > 1.2; });
    return plants;
}

void write_scene(const std::string& path, const std::vector<Plant>& plants)
{
    std::FILE* out = std::fopen(path.c_str(), "w");
    if (!out) {
        std::fprintf(stderr, "cannot write %s\n", path.c_str());
        std::exit(1);
    }
    std::fputs(head, out);
    for (const Plant& p : plants) {
        std::fprintf(out, "\n[[instance]]\nmesh = \"%s\"\nscale = [%.3g, %.3g, %.3g]\nrotate = [%.1f, %.0f, 0]\n",
                     p.mesh.c_str(), p.size, p.size * p.stretch, p.size, p.lean, p.turn);
        std::fprintf(out, "translate = [%.2f, %.2f, %.2f]\n", p.x, ground(p.x, p.z) - p.sink * p.size, p.z);
    }
    if (std::fclose(out) != 0) std::exit(1);
}

}  // namespace

int main(int argc, char** argv) { write_scene(only_argument(argc, argv, "make_forest OUTPUT_FILE"), plant_all()); }
