#include "io/obj/write.h"

#include <array>
#include <charconv>
#include <string>

namespace lancer {
namespace {

// Gathers the text, and writes it in pieces.
class Text {
public:
    explicit Text(AtomicFile& file) : file_(file) {}

    Text& operator<<(std::string_view words)
    {
        text_ += words;
        if (text_.size() >= piece) flush();
        return *this;
    }
    template <class Number>
    Text& number(Number x)
    {
        char digits[32];
        const char* const end = std::to_chars(digits, digits + sizeof digits, x).ptr;
        return *this << std::string_view(digits, static_cast<size_t>(end - digits));
    }
    template <class V>
    void line(std::string_view key, const V& v)
    {
        *this << key;
        for (const auto x : {v.x, v.y, v.z}) (*this << " ").number(x);
        *this << "\n";
    }
    void flush()
    {
        file_.write(text_.data(), text_.size());
        text_.clear();
    }

private:
    static constexpr size_t piece = size_t{1} << 20;
    AtomicFile& file_;
    std::string text_;
};

// Whether the normals of the corners point to the side from which the corners run clockwise.
bool is_turned(const MeshData& mesh, uint32_t triangle)
{
    if (mesh.normals.empty()) return false;
    Vec3d sum{};
    for (const uint32_t n : mesh.normal_triangles[triangle]) {
        if (n == MeshData::no_normal) return false;
        sum += to_double(mesh.normals[n]);
    }
    const auto& t = mesh.triangles[triangle];
    const Vec3d a = mesh.positions[t[0]];
    return dot(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a), sum) < 0;
}

// The corner's indices as in "7", "7/3", "7//2" and "7/3/2".
void write_corner(Text& text, uint32_t position, std::optional<uint32_t> uv, std::optional<uint32_t> normal)
{
    const auto index = [&](uint32_t i) { text.number(i + uint64_t{1}); };
    text << " ";
    index(position);
    if (uv || normal) text << "/";
    if (uv) index(*uv);
    if (normal) text << "/", index(*normal);
}

}  // namespace

void write_obj(AtomicFile& file, const MeshData& mesh, bool with_uvs,
               const std::function<std::optional<uint32_t>(uint32_t)>& material_of)
{
    Text text(file);
    const bool uvs = with_uvs && !mesh.uvs.empty();
    for (const Vec3d& p : mesh.positions) text.line("v", p);
    if (uvs)
        for (const Vec2& uv : mesh.uvs) ((text << "vt ").number(uv.x) << " ").number(uv.y) << "\n";
    for (const Vec3& n : mesh.normals) text.line("vn", n);
    std::optional<uint32_t> current;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::optional<uint32_t> material = material_of(t);
        if (!material) continue;
        if (material != current) (text << "usemtl m").number(*(current = material)) << "\n";
        const auto given = [t](const auto& table, size_t corner, uint32_t none) -> std::optional<uint32_t> {
            if (table.empty() || table[t][corner] == none) return {};
            return table[t][corner];
        };
        static constexpr std::array<size_t, 3> forward{0, 1, 2}, backward{0, 2, 1};
        text << "f";
        for (const size_t corner : is_turned(mesh, t) ? backward : forward)
            write_corner(text, mesh.triangles[t][corner],
                         uvs ? given(mesh.uv_triangles, corner, MeshData::no_uv) : std::nullopt,
                         given(mesh.normal_triangles, corner, MeshData::no_normal));
        text << "\n";
    }
    text.flush();
}

}  // namespace lancer
