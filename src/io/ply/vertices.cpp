#include "io/ply/vertices.h"

#include "core/parallel.h"
#include "io/mesh_values.h"

namespace lancer {
namespace {

enum Field : size_t { px, py, pz, nx, ny, nz, red, green, blue, alpha, tu, tv, fields };
using Values = std::array<double, fields>;
constexpr size_t block = 1 << 16;  // vertices that a thread reads at a time

std::optional<Field> field_of(std::string_view name)
{
    constexpr std::array<std::array<std::string_view, 4>, fields> names{{{"x"},
                                                                         {"y"},
                                                                         {"z"},
                                                                         {"nx"},
                                                                         {"ny"},
                                                                         {"nz"},
                                                                         {"red", "r", "diffuse_red"},
                                                                         {"green", "g", "diffuse_green"},
                                                                         {"blue", "b", "diffuse_blue"},
                                                                         {"alpha", "a", "diffuse_alpha"},
                                                                         {"u", "s", "texture_u", "texture_s"},
                                                                         {"v", "t", "texture_v", "texture_t"}}};
    for (size_t field = 0; field < fields; ++field)
        for (const std::string_view known : names[field])
            if (!known.empty() && name == known) return static_cast<Field>(field);
    return {};
}

class VertexReader {
public:
    VertexReader(const PlyElement& element, bool keeps_uvs, MeshData& mesh) : mesh_(mesh), element_(element)
    {
        for (const PlyProperty& p : element.properties) {
            const std::optional<Field> field = p.count ? std::nullopt : field_of(p.name);
            fields_.push_back(field);
            if (!field) continue;
            has_[*field] = true;
            if (*field >= red && *field <= alpha) full_[*field] = full_value(p.type);
        }
        const size_t count = static_cast<size_t>(element.count);
        mesh.positions.resize(count);
        if (has(nx, nz)) mesh.normals.resize(count);
        if (has(red, blue)) mesh.colors.resize(count);
        if (has(red, alpha)) mesh.alphas.resize(count);
        if (keeps_uvs && has(tu, tv)) mesh.uvs.resize(count);
    }
    bool has_position() const { return has(px, pz); }

    // All have the same size: they are read in parallel.
    void read_records(const char* first, bool swaps)
    {
        const size_t size = element_.least_size(), count = mesh_.positions.size();
        parallel_for((count + block - 1) / block, [&](size_t b) {
            Values values{};
            for (size_t i = b * block; i < std::min(count, (b + 1) * block); ++i) {
                const char* at = first + i * size;
                for (size_t p = 0; p < fields_.size(); ++p) {
                    const PlyType type = element_.properties[p].type;
                    if (fields_[p]) values[*fields_[p]] = load_number(at, type, swaps);
                    at += size_of(type);
                }
                store(i, values);
            }
        });
    }
    // How many there were before the file ended.
    size_t read_one_by_one(PlyCursor& cursor)
    {
        Values values{};
        for (size_t i = 0; i < mesh_.positions.size(); ++i) {
            for (size_t p = 0; p < fields_.size(); ++p) {
                const PlyProperty& property = element_.properties[p];
                std::optional<double> value = cursor.next(property.count.value_or(property.type));
                if (!value) return i;
                if (fields_[p]) values[*fields_[p]] = *value;
                if (!property.count) continue;
                if (!cursor.skip_numbers(property.type, *value)) return i;
            }
            store(i, values);
        }
        return mesh_.positions.size();
    }
    bool check(const std::string& file, Diagnostics& diagnostics)
    {
        for (size_t i = 0; i < mesh_.positions.size(); ++i)
            if (!is_finite(mesh_.positions[i])) {
                diagnostics.error({file, 0, 0},
                                  "a coordinate of vertex " + std::to_string(i) + " is not a finite number");
                return false;
            }
        const auto warn = [&](size_t count, const char* message) {
            if (count) diagnostics.warning({file, 0, 0}, message, count);
        };
        warn(static_cast<size_t>(std::count(mesh_.normals.begin(), mesh_.normals.end(), Vec3{})),
             "normal of zero length or not of three finite numbers; faces that use it are flat");
        size_t broken = 0, outside = 0;
        for (const Vec2 uv : mesh_.uvs) broken += is_broken(uv) ? 1 : 0;
        warn(broken, "texture coordinates are not finite numbers; faces that use them get none");
        for (Color& c : mesh_.colors) {
            const auto part = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0; };
            const Color kept{part(c.r), part(c.g), part(c.b)};
            outside += kept == c ? 0 : 1;
            c = kept;
        }
        warn(outside, "vertex colour outside of its range cut off");
        check_alphas(warn);
        return true;
    }

private:
    bool has(Field first, Field last) const
    {
        for (size_t f = first; f <= last; ++f)
            if (!has_[f]) return false;
        return true;
    }
    // Programs that know no alpha of vertices write one all the same, of 1 or of 0 everywhere.
    template <class Warn>
    void check_alphas(const Warn& warn)
    {
        size_t clear = 0, full = 0, outside = 0;
        for (float& a : mesh_.alphas) {
            const float kept = a > 0 ? std::min(a, 1.0f) : 0;
            outside += kept == a ? 0 : 1, clear += kept == 0 ? 1 : 0, full += kept == 1 ? 1 : 0;
            a = kept;
        }
        warn(outside, "alpha of a vertex outside of its range cut off");
        const bool hides_all = clear > 0 && clear == mesh_.alphas.size();
        if (hides_all) warn(1, "the alpha of all vertices is 0: it is not used");
        if (hides_all || full == mesh_.alphas.size()) mesh_.alphas = {};
    }
    void store(size_t i, const Values& v)
    {
        mesh_.positions[i] = {v[px], v[py], v[pz]};
        if (!mesh_.normals.empty()) {
            const Vec3d n{v[nx], v[ny], v[nz]};
            mesh_.normals[i] = is_finite(n) ? unit_normal(n) : Vec3{};
        }
        if (!mesh_.colors.empty()) {
            const auto part = [&](Field f) { return static_cast<float>(v[f] / full_[f]); };
            mesh_.colors[i] = {part(red), part(green), part(blue)};
        }
        if (!mesh_.alphas.empty()) mesh_.alphas[i] = static_cast<float>(v[alpha] / full_[alpha]);
        if (!mesh_.uvs.empty()) mesh_.uvs[i] = uv_of(v[tu], v[tv]);
    }

    MeshData& mesh_;
    const PlyElement& element_;
    std::vector<std::optional<Field>> fields_;  // of the properties
    std::array<bool, fields> has_{};
    Values full_{};
};

}  // namespace

bool read_ply_vertices(const PlyElement& element, bool swaps, bool keeps_uvs, PlyCursor& cursor, MeshData& mesh,
                       Diagnostics& diagnostics)
{
    const auto fail = [&](uint32_t line, const std::string& message) {
        diagnostics.error({mesh.file, line, 0}, message);
        return false;
    };
    if (element.count > UINT32_MAX - 1) return fail(0, "more vertices than 4294967294");
    VertexReader reader(element, keeps_uvs, mesh);
    if (!reader.has_position()) return fail(0, "vertices have no x, y and z");
    if (cursor.is_text() || element.has_list()) {
        const size_t read = reader.read_one_by_one(cursor);
        if (read < element.count)
            return fail(cursor.line(), "no number, or the end of the file, in vertex " + std::to_string(read) + " of " +
                                           std::to_string(element.count));
    } else {
        reader.read_records(cursor.here(), swaps);
        cursor.skip(static_cast<size_t>(element.count) * element.least_size());
    }
    return reader.check(mesh.file, diagnostics);
}

}  // namespace lancer
