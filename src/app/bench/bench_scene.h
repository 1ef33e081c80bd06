// The scene of `lancer bench`: rays are found by rendering it with Embree, and are then asked of its triangles alone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/bench/rays.h"
#include "app/options/options.h"
#include "app/prepare.h"

namespace lancer {

class BenchScene {
public:
    // Loads and builds; warnings are printed. Must be called inside with_threads. Throws Error, also for a scene
    // without triangles (invalid_input).
    explicit BenchScene(const PictureOptions& options);

    const Renderer& renderer() const { return *renderer_; }
    // Triangles and instances, without holes: what accelerators differ in.
    const Geometry& bare() const { return bare_ ? *bare_ : renderer_->scene().geometry; }
    bool is_bare() const { return !bare_; }
    uint64_t hash() const;  // of the bare geometry
    const RenderSettings& settings() const { return prepared_.settings; }
    unsigned threads() const { return prepared_.threads; }
    const std::string& isa() const { return isa_; }  // of Embree

    // The view at any size.
    Camera camera(PictureSize size) const;
    // The rays of a picture of the scene's size: the same whatever is measured.
    std::vector<RaySet> rays(size_t count, std::span<const std::string_view> kinds) const;

private:
    Prepared prepared_;
    std::string isa_;
    std::unique_ptr<Renderer> renderer_;
    std::unique_ptr<const Geometry> bare_;  // null: that of the scene is
};

}  // namespace lancer
