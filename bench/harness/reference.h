// Answers of the reference in double for a mesh and rays, kept in files named by a hash of both: computed once, as they
// take minutes for millions of rays.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>

#include "core/parallel.h"
#include "io/atomic_file.h"
#include "support/double_tree.h"
#include "support/ray_kinds.h"

namespace lancer::bench {

inline constexpr uint32_t no_triangle = UINT32_MAX;

// triangle: of the one mesh of the geometry, or no_triangle.
inline Hit hit_of(const Geometry& g, const Ray& ray, uint32_t triangle)
{
    if (triangle == no_triangle) return {};
    return refine(g, ray, {0, Hit::no_instance, 0, triangle, {}, Kind::triangle});
}

class Reference {
public:
    // The geometry holds one mesh and must outlive this.
    Reference(const Geometry& g, std::string folder) : g_(g), folder_(std::move(folder))
    {
        mesh_hash_ = hash_of(std::span(g.meshes[0].positions), hash_of(std::span(g.meshes[0].triangles), 0));
    }

    // The number of the triangle that each ray meets first.
    std::vector<uint32_t> answers(std::span<const Ray> rays)
    {
        char name[32];
        std::snprintf(name, sizeof name, "%016llx.reference",
                      static_cast<unsigned long long>(hash_of(rays, mesh_hash_)));
        const std::filesystem::path file = std::filesystem::path(folder_) / name;
        std::vector<uint32_t> triangles(rays.size());
        const size_t bytes = triangles.size() * sizeof triangles[0];
        std::error_code none;
        if (std::filesystem::file_size(file, none) == bytes) {
            std::ifstream in(file, std::ios::binary);
            if (in.read(reinterpret_cast<char*>(triangles.data()), static_cast<std::streamsize>(bytes)))
                return triangles;
        }
        if (!tree_) tree_.emplace(g_);
        constexpr size_t chunk = 1024;
        parallel_for((rays.size() + chunk - 1) / chunk, [&](size_t c) {
            for (size_t i = c * chunk; i < std::min(rays.size(), (c + 1) * chunk); ++i) {
                const Hit hit = tree_->closest(rays[i]);
                triangles[i] = hit ? hit.primitive : no_triangle;
            }
        });
        std::filesystem::create_directories(folder_);
        AtomicFile out(file.string());
        out.write(triangles.data(), bytes);
        out.commit();
        return triangles;
    }

private:
    template <class T>
    static uint64_t hash_of(std::span<const T> items, uint64_t so_far)
    {
        return hash_bytes({reinterpret_cast<const char*>(items.data()), items.size_bytes()}, so_far);
    }

    const Geometry& g_;
    std::string folder_;
    uint64_t mesh_hash_ = 0;
    std::optional<DoubleTree> tree_;  // once it is needed
};

}  // namespace lancer::bench
