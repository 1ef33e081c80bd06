// Points of one material, queued contiguously for the wide kernel: few of eight lanes are of that material, and doubles
// are processed by four. PlasticQueue, PrincipledQueue, GlassQueue and MetalQueue evaluate and sample
// them.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "core/lanes/vec.h"
#include "materials/bsdf.h"

namespace lancer {

using BsdfValueLanes = BsdfValueT<Vec3x8, Float8>;
// As in BsdfSample, for the lanes in `found`.
struct BsdfSampleLanes {
    Vec3x8 wi, weight;
    Float8 pdf, eta;
    uint32_t found, delta;
};

// Operations on a queue have three steps: inputs are written for one group of eight lanes after another, in the order
// in which they were added; everything is computed; results are read per group. Inputs and outputs are by lane; lanes
// of other materials are undefined. Directions are local and unit.
class LaneQueue {
public:
    static constexpr size_t most = 128;  // points

    // The contiguous points of a group of eight lanes.
    struct Eight {
        uint32_t first = 0, count = 0;
        uint32_t lanes = 0;  // that are in the queue
        UInt8 from{}, to{};  // lane of each point, point of each lane

        void add(uint32_t lane) { lanes |= 1u << lane, from[count] = lane, to[lane] = count++; }
    };
    // A number per point. put() writes eight; the next group overwrites those beyond its own.
    template <class Lanes>
    struct alignas(sizeof(Lanes)) Numbers : std::array<float, most + float_lanes> {
        Float4 four(size_t k) const { return load4_aligned(&(*this)[k]); }
        Lanes eight(size_t k) const { return reinterpret_cast<Lanes>(load8(&(*this)[k])); }
        void set_four(size_t k, Float4 x) { store4_aligned(&(*this)[k], x); }
        void set_eight(size_t k, Lanes x) { store8(&(*this)[k], reinterpret_cast<Float8>(x)); }
        void put(const Eight& of, Lanes x)
        {
            store8_anywhere(&(*this)[of.first], reinterpret_cast<Float8>(permute(x, of.from)));
        }
        Lanes of(const Eight& of) const
        {
            return permute(reinterpret_cast<Lanes>(load8_anywhere(&(*this)[of.first])), of.to);
        }
    };
    struct Vectors {
        Numbers<Float8> x, y, z;

        Vec3T<Float4> four(size_t k) const { return {x.four(k), y.four(k), z.four(k)}; }
        Vec3x8 eight(size_t k) const { return {x.eight(k), y.eight(k), z.eight(k)}; }
        void set_four(size_t k, const Vec3T<Float4>& v) { x.set_four(k, v.x), y.set_four(k, v.y), z.set_four(k, v.z); }
        void set_eight(size_t k, const Vec3x8& v) { x.set_eight(k, v.x), y.set_eight(k, v.y), z.set_eight(k, v.z); }
        void set(size_t k, Color c) { x[k] = c.r, y[k] = c.g, z[k] = c.b; }
        void put(const Eight& of, const Vec3x8& v) { x.put(of, v.x), y.put(of, v.y), z.put(of, v.z); }
        Vec3x8 of(const Eight& of) const { return {x.of(of), y.of(of), z.of(of)}; }
    };

    void clear() { count_ = 0; }
    Eight begin_eight() const { return {.first = count_}; }
    // wo: before all other operations.
    void put_wo(const Eight& of, const Vec3x8& wo) { wo_.put(of, wo); }
    void put_wi(const Eight& of, const Vec3x8& wi) { wi_.put(of, wi); }
    // u selects the lobe, v the direction; cosine: square_to_cosine_hemisphere() of v, for queues with matt lobes.
    void put_numbers(const Eight& of, const Float8& u, const Vec2x8& v, const Vec3x8& /*cosine*/)
    {
        u_.put(of, u), v_x_.put(of, v.x), v_y_.put(of, v.y);
    }
    // After eval().
    BsdfValueLanes value(const Eight& of) const { return {color_.of(of), pdf_.of(of)}; }
    // After sample(). eta: of glass.
    BsdfSampleLanes sampled(const Eight& of, Float8 eta = broadcast(1.0f)) const
    {
        const uint32_t found = movemask(found_.of(of)) & of.lanes;
        return {wi_.of(of), color_.of(of), pdf_.of(of), eta, found, found & movemask(delta_.of(of))};
    }

protected:
    // The number of a new point. of: the last group that was begun, as points are contiguous.
    uint32_t add_to(Eight& of, uint32_t lane)
    {
        assert(of.first + of.count == count_);
        of.add(lane);
        return count_++;
    }

    // The value of four points; 0 where light comes or goes on a side that they do not answer for.
    void set_value(size_t k, const BsdfValueT<Vec3T<Float4>, Float4>& f, Mask4f is_lit)
    {
        color_.set_four(k, select(is_lit, f.f_cos, {}));
        pdf_.set_four(k, select(is_lit, f.pdf, Float4{}));
    }

    uint32_t count_ = 0;
    Vectors wo_{}, wi_{};
    Numbers<Float8> u_{}, v_x_{}, v_y_{};
    Vectors color_{};  // f cos, or the weight
    Numbers<Float8> pdf_{};
    Numbers<Mask8> found_{}, delta_{};
};

}  // namespace lancer
