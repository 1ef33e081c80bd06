// States of paths as structure of arrays, so that eight of them load into SIMD registers.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "core/lanes/pack.h"
#include "core/lanes/sampler.h"
#include "geometry/ray_lanes.h"
#include "integrators/path_actions.h"

namespace lancer {

// Rays with additional data per ray. Lanes: a struct that consists of 8-lane registers only.
template <class Lanes>
class PackedStates {
public:
    using Record = Lanes;  // of eight rays

    size_t size() const { return count_; }
    std::span<const Ray> rays() const { return std::span(rays_).first(count_); }
    std::span<Ray> last_rays(size_t n) { return std::span(rays_).subspan(count_ - n, n); }
    void clear() { count_ = 0; }
    // Reserves memory for `most` rays and padding behind them.
    void reserve(size_t most)
    {
        if (rays_.size() >= most + float_lanes) return;
        rays_.resize(most + float_lanes);
        // An odd number of cache lines as stride avoids conflicts in the first-level cache.
        stride_ = ((rays_.size() + line - 1) / line | 1) * line;
        numbers_.resize(registers * stride_);
    }
    // Loads eight entries from `first` on; lanes beyond the last entry are undefined.
    void load(size_t first, Lanes& lanes) const
    {
        // Copies register by register: the compiler would copy the whole struct in a loop.
        auto* to = reinterpret_cast<uint32_t*>(&lanes);
        for (size_t k = 0; k < registers; ++k)
            store8(to + k * float_lanes, load8_anywhere(&numbers_[k * stride_ + first]));
    }
    // Appends the selected lanes.
    void push(uint32_t wanted, const Vec3x8& org, const Vec3x8& dir, Float8 t_max, const Lanes& lanes)
    {
        store(wanted, lanes);
        count_ += store_rays(&rays_[count_], wanted, org, dir, t_max);
    }
    // Sets Ray::leaf_hint of the rays that were just appended.
    void set_leaf_hints(uint32_t wanted, UInt8 start)
    {
        store_leaf_hints(last_rays(static_cast<size_t>(std::popcount(wanted))).data(), wanted, start);
    }

private:
    static constexpr size_t registers = sizeof(Lanes) / sizeof(UInt8), line = 16;  // numbers in a cache line

    void store(uint32_t wanted, const Lanes& lanes)
    {
        const Packing packing(wanted);
        const auto* from = reinterpret_cast<const uint32_t*>(&lanes);
        for (size_t k = 0; k < registers; ++k)
            packing.store(&numbers_[k * stride_ + count_], load8(from + k * float_lanes));
    }

    size_t count_ = 0, stride_ = 0;
    std::vector<Ray> rays_;
    std::vector<uint32_t> numbers_;  // one array per register, each of stride_ numbers
};

// An additional number per ray: float or uint32_t.
template <class Number>
class PackedNumbers {
public:
    void clear() { count_ = 0; }
    // As in PackedStates.
    void reserve(size_t most)
    {
        if (numbers_.size() < most + float_lanes) numbers_.resize(most + float_lanes);
    }
    template <class Lanes>
    void push(uint32_t wanted, Lanes n)
    {
        Packing(wanted).store(&numbers_[count_], n);
        count_ += static_cast<size_t>(std::popcount(wanted));
    }
    Number operator[](size_t i) const { return numbers_[i]; }

private:
    size_t count_ = 0;
    std::vector<Number> numbers_;
};
// An additional vector per ray.
class PackedVectors {
public:
    void clear() { x_.clear(), y_.clear(), z_.clear(); }
    void reserve(size_t most) { x_.reserve(most), y_.reserve(most), z_.reserve(most); }
    void push(uint32_t wanted, const Vec3x8& v) { x_.push(wanted, v.x), y_.push(wanted, v.y), z_.push(wanted, v.z); }
    Vec3 operator[](size_t i) const { return {x_[i], y_[i], z_[i]}; }

private:
    PackedNumbers<float> x_, y_, z_;
};

struct PathLanes {
    Vec3x8 throughput, importance;  // as in PathState
    Float8 pdf;
    UInt8 slot, sample;  // as in PathState
    KeyLanes key;        // of the sampler
};
// With the ray cone, for textures.
struct ConePathLanes : PathLanes {
    Float8 width, spread;  // as in RayCone
};
// With flags of the path, for specular materials.
struct AnyPathLanes : ConePathLanes {
    Float8 eta_scale;  // as in PathState
    UInt8 path_flags;  // the flags below; above them PathState::segment
};
inline constexpr uint32_t was_specular = 1, has_sampled_light = 2, has_split = 4, segment_shift = 3;
inline UInt8 bits_of(PathSegment segment) { return UInt8{} + (static_cast<uint32_t>(segment) << segment_shift); }
inline Mask8 is_set(UInt8 path_flags, uint32_t bit) { return (path_flags & bit) != 0; }

struct ShadowLanes {
    Vec3x8 radiance;  // if nothing is in between
    UInt8 slot;       // the sample that it adds to
};

template <class Lanes>
struct PathsUnderWay {
    PackedStates<Lanes> now, next;
};
// Working memory of a thread for the wide kernel.
struct WideWorkspace {
    std::tuple<PathsUnderWay<PathLanes>, PathsUnderWay<ConePathLanes>, PathsUnderWay<AnyPathLanes>> paths;
    PackedStates<ShadowLanes> shadows;
    // Shading normal at each ray's origin, if MIS weights need it (environment or light tree).
    PackedVectors normals_now, normals_next;
    PackedNumbers<uint32_t> cells_now, cells_next;  // PathState::cell, if lights are chosen by place
    PackedNumbers<float> mirror_distances_now,
        mirror_distances_next;              // PathState::mirror_distance, if there are mirrors
    PackedNumbers<uint32_t> shadow_lights;  // ids, parallel to the shadow rays, if a pilot learns
};

}  // namespace lancer
