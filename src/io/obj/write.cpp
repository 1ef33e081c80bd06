#include "io/obj/write.h"

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

}  // namespace

void write_obj(AtomicFile& file, const MeshData& mesh,
               const std::function<std::optional<uint32_t>(uint32_t)>& material_of)
{
    Text text(file);
    for (const Vec3d& p : mesh.positions) text.line("v", p);
    for (const Vec3& n : mesh.normals) text.line("vn", n);
    std::optional<uint32_t> current;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::optional<uint32_t> material = material_of(t);
        if (!material) continue;
        if (material != current) (text << "usemtl m").number(*(current = material)) << "\n";
        text << "f";
        for (size_t corner = 0; corner < 3; ++corner) {
            (text << " ").number(mesh.triangles[t][corner] + uint64_t{1});
            if (mesh.normals.empty()) continue;
            if (const uint32_t n = mesh.normal_triangles[t][corner]; n != MeshData::no_normal)
                (text << "//").number(n + uint64_t{1});
        }
        text << "\n";
    }
    text.flush();
}

}  // namespace lancer
