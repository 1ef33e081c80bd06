#include "scene/build/divide.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/hash.h"

namespace lancer {
namespace {

using Corners = std::array<uint32_t, 3>;

// The middles of pairs of values, each made once: open addressing in a table twice as large as what it holds.
class Middles {
public:
    explicit Middles(size_t most) : slots_(std::bit_ceil(2 * most + 1)) {}

    // make(): appends the middle and returns its index.
    template <class Make>
    uint32_t of(uint32_t a, uint32_t b, const Make& make)
    {
        if (a == b) return a;
        const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        size_t at = mix_bits(key) & (slots_.size() - 1);
        while (slots_[at].key != 0 && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
        if (slots_[at].key == 0) slots_[at] = {key, make()};
        return slots_[at].middle;
    }

private:
    struct Slot {
        uint64_t key = 0;  // of two different numbers it is never 0
        uint32_t middle = 0;
    };
    std::vector<Slot> slots_;
};

// Sums of two are the same in both orders, so that middles of edges in the same place are, too.
template <class T>
T middle(T a, T b)
{
    return (a + b) * (decltype(a.x)(0.5));
}

Vec3 middle_normal(Vec3 a, Vec3 b)
{
    const Vec3d sum = to_double(a) + to_double(b);
    const double l = length(sum);
    return l > 0 ? to_float(sum / l) : a;
}

class Divider {
public:
    explicit Divider(const MeshData& mesh) : m_(made_.data)
    {
        m_ = mesh;
        m_.tangents = {};
        give_normals();
        if (m_.uvs.empty()) m_.uv_triangles.assign(m_.triangles.size(), {none, none, none});
    }

    template <class IsLong, class Check>
    DividedMesh run(uint32_t most_rounds, const IsLong& is_long, const Check& check)
    {
        for (uint32_t round = 0; round < most_rounds; ++round) {
            std::vector<uint8_t> marks(m_.triangles.size());
            uint64_t count = 0;
            for (size_t t = 0; t < marks.size(); ++t) {
                for (size_t k = 0; k < 3; ++k)
                    if (is_long(place(t, k), place(t, (k + 1) % 3), round))
                        marks[t] = static_cast<uint8_t>(marks[t] | 1u << k);
                count += 1u + (marks[t] & 1u) + (marks[t] >> 1 & 1u) + (marks[t] >> 2 & 1u);
            }
            if (count == marks.size()) break;
            check(count);
            split(marks, count);
            ++made_.levels;
        }
        if (m_.uvs.empty()) m_.uv_triangles = {};
        return std::move(made_);
    }

private:
    static constexpr uint32_t none = MeshData::no_uv;

    Vec3d place(size_t t, size_t k) const { return m_.positions[m_.triangles[t][k]]; }

    void give_normals()
    {
        m_.normal_triangles.resize(m_.triangles.size(), {none, none, none});
        for (size_t t = 0; t < m_.triangles.size(); ++t) {
            if (m_.normal_triangles[t][0] != MeshData::no_normal) continue;
            const Vec3d a = place(t, 0), n = cross(place(t, 1) - a, place(t, 2) - a);
            const double l = length(n);
            m_.normal_triangles[t].fill(static_cast<uint32_t>(m_.normals.size()));
            m_.normals.push_back(l > 0 ? to_float(n / l) : Vec3{0, 0, 1});
        }
    }

    // A corner, or the middle of an edge, by its indices.
    struct Corner {
        uint32_t position, normal, uv;
    };
    Corner corner(size_t t, size_t k) const
    {
        return {m_.triangles[t][k], m_.normal_triangles[t][k], m_.uv_triangles[t][k]};
    }
    Corner middle_of(const Corner& a, const Corner& b)
    {
        Corner c{none, none, none};
        c.position = positions_.of(a.position, b.position, [&] {
            m_.positions.push_back(middle(m_.positions[a.position], m_.positions[b.position]));
            if (!m_.colors.empty()) m_.colors.push_back((m_.colors[a.position] + m_.colors[b.position]) * 0.5f);
            if (!m_.alphas.empty()) m_.alphas.push_back((m_.alphas[a.position] + m_.alphas[b.position]) * 0.5f);
            return static_cast<uint32_t>(m_.positions.size() - 1);
        });
        c.normal = normals_.of(a.normal, b.normal, [&] {
            m_.normals.push_back(middle_normal(m_.normals[a.normal], m_.normals[b.normal]));
            return static_cast<uint32_t>(m_.normals.size() - 1);
        });
        if (a.uv == none) return c;
        c.uv = uvs_.of(a.uv, b.uv, [&] {
            m_.uvs.push_back(middle(m_.uvs[a.uv], m_.uvs[b.uv]));
            if (!m_.second_uvs.empty()) m_.second_uvs.push_back(middle(m_.second_uvs[a.uv], m_.second_uvs[b.uv]));
            return static_cast<uint32_t>(m_.uvs.size() - 1);
        });
        return c;
    }

    void split(const std::vector<uint8_t>& marks, uint64_t count)
    {
        // Each triangle that is added needs at most one middle more.
        positions_ = normals_ = uvs_ = Middles(count - marks.size());
        std::vector<Corners> triangles, normals, uvs;
        std::vector<uint32_t> materials;
        for (auto* list : {&triangles, &normals, &uvs}) list->reserve(count);
        if (!m_.face_material.empty()) materials.reserve(count);
        size_t t = 0;
        const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
            triangles.push_back({a.position, b.position, c.position});
            normals.push_back({a.normal, b.normal, c.normal});
            uvs.push_back({a.uv, b.uv, c.uv});
            if (!m_.face_material.empty()) materials.push_back(m_.face_material[t]);
        };
        for (; t < marks.size(); ++t) {
            const uint32_t mark = marks[t];
            // Turned so that, of one marked edge it is the first, and of two the last one is left alone.
            const size_t turn = mark == 2 || mark == 6 ? 1 : mark == 4 || mark == 5 ? 2 : 0;
            const Corner a = corner(t, turn), b = corner(t, (turn + 1) % 3), c = corner(t, (turn + 2) % 3);
            if (mark == 0) {
                add(a, b, c);
                continue;
            }
            const Corner ab = middle_of(a, b);
            if (mark == 1 || mark == 2 || mark == 4) {
                add(a, ab, c), add(ab, b, c);
                continue;
            }
            const Corner bc = middle_of(b, c);
            if (mark != 7) {
                add(ab, b, bc);
                const Vec3d first = m_.positions[a.position] - m_.positions[bc.position];
                const Vec3d second = m_.positions[ab.position] - m_.positions[c.position];
                if (dot(first, first) <= dot(second, second))
                    add(a, ab, bc), add(a, bc, c);
                else
                    add(a, ab, c), add(ab, bc, c);
                continue;
            }
            const Corner ca = middle_of(c, a);
            add(a, ab, ca), add(ab, b, bc), add(ca, bc, c), add(ab, bc, ca);
        }
        m_.triangles = std::move(triangles), m_.normal_triangles = std::move(normals);
        m_.uv_triangles = std::move(uvs), m_.face_material = std::move(materials);
        positions_ = normals_ = uvs_ = Middles(0);
    }

    DividedMesh made_;
    MeshData& m_;
    Middles positions_{0}, normals_{0}, uvs_{0};
};

}  // namespace

DividedMesh divide(const MeshData& mesh, uint32_t most_rounds,
                   const std::function<bool(Vec3d a, Vec3d b, uint32_t round)>& is_long,
                   const std::function<void(uint64_t triangles)>& check)
{
    return Divider(mesh).run(most_rounds, is_long, check);
}

}  // namespace lancer
