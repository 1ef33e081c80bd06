#include "stability/obj_text.h"

namespace lancer::stability {

std::string moved_obj(const std::string& text, double scale, Vec3d shift, const char* format)
{
    std::istringstream in(text);
    std::string out, line;
    while (std::getline(in, line)) {
        double x = 0, y = 0, z = 0;
        if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3) {
            line = "v";
            for (const double c : {x * scale + shift.x, y * scale + shift.y, z * scale + shift.z}) {
                char number[64];
                std::snprintf(number, sizeof number, format, c);
                line += std::string(" ") + number;
            }
        }
        out += line + '\n';
    }
    return out;
}

std::string positions_text(const MeshData& mesh)
{
    std::string text;
    char line[128];
    for (const Vec3d& p : mesh.positions) {
        std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
        text += line;
    }
    return text;
}

std::shared_ptr<const MeshData> load_right(const std::string& path)
{
    Diagnostics diagnostics;
    auto mesh = load_obj(path, diagnostics);
    diagnostics.throw_if_errors();
    return mesh;
}

SceneDescription moved_cornell(double scale, Vec3d shift, const char* format)
{
    const TempFolder folder;
    const std::string source = LANCER_SOURCE_DIR "/scenes/cornell";
    write_bytes(folder.file("cornell.mtl"), read_bytes(source + ".mtl"));
    write_bytes(folder.file("moved.obj"), moved_obj(read_bytes(source + ".obj"), scale, shift, format));
    SceneDescription d;
    d.meshes.push_back(make_mesh(load_right(folder.file("moved.obj"))));
    const Vec3d from{2.78, 2.73, -8}, at{2.78, 2.73, 0};
    d.camera = make_camera(from * scale + shift, at * scale + shift, 39.3);
    return d;
}

}  // namespace lancer::stability
