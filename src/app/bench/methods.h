// What `lancer bench` compares: Embree called directly, robust and fast, and lancer's accelerators.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench/agreement.h"

namespace lancer {

inline constexpr std::string_view bench_baseline = "embree-robust";
// The baseline, "embree-fast", and the accelerators by name.
std::vector<std::string_view> bench_method_names();
inline constexpr auto usual_bench_methods =
    std::to_array<std::string_view>({"embree-robust", "embree-fast", "bvh8", "bvh2", "median"});
// Whether it asks every ray of every triangle, or of very many.
bool tries_all(std::string_view method);

class BenchMethod {
public:
    // geometry: triangles and instances, as they are. isa: of Embree. Both must outlive it.
    BenchMethod(std::string_view name, const Geometry& geometry, const std::string& isa)
        : name_(name), g_(geometry), isa_(isa)
    {
    }

    const std::string& name() const { return name_; }
    bool is_baseline() const { return name_ == bench_baseline; }
    // Makes its structure anew; everything else below needs one. Throws Error (failed).
    void build();
    uint64_t bytes() const;  // of the structure, without the geometry
    // How it answers rays singly and in batches, as long as the structure stays. Embree's batches are packets of eight.
    RayMethod single() const;
    RayMethod batch() const;

    // What a render with it traces by, for any geometry: an accelerator of its own, built now.
    std::unique_ptr<Accelerator> renders_with(const Geometry& geometry) const;
    // The structure itself, if that is what a render of the same geometry traces by; else null.
    const Accelerator* accelerator() const { return accel_.get(); }

private:
    bool is_direct() const { return name_ == bench_baseline || name_ == "embree-fast"; }
    bool is_robust() const { return name_ != "embree-fast"; }

    std::string name_;
    const Geometry& g_;
    const std::string& isa_;
    std::unique_ptr<BareEmbree> direct_;
    std::unique_ptr<Accelerator> accel_;
};

}  // namespace lancer
