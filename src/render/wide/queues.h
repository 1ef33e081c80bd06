// The queues of the materials whose points the wide kernel shades together, see materials/lane_queue.h.
#pragma once

#include <array>
#include <memory>
#include <tuple>
#include <type_traits>

#include "materials/glass_queue.h"
#include "materials/material.h"
#include "materials/metal_queue.h"
#include "materials/plastic_queue.h"
#include "materials/principled_queue.h"

namespace lancer {

// They are kept from batch to batch: clearing their memory takes as long as a hundredth of a batch.
class MaterialQueues {
    using Queues = std::tuple<std::unique_ptr<PlasticQueue>, std::unique_ptr<PrincipledQueue>,
                              std::unique_ptr<GlassQueue>, std::unique_ptr<MetalQueue>>;
    static constexpr size_t count = std::tuple_size_v<Queues>;

public:
    // The points of a group of eight lanes in each queue.
    struct Eights : std::array<LaneQueue::Eight, count> {
        // Lanes that are in any.
        uint32_t lanes() const
        {
            uint32_t all = 0;
            for (const LaneQueue::Eight& of : *this) all |= of.lanes;
            return all;
        }
    };

    // Before points of that type are added, if `wanted`.
    template <class Queue>
    void need(bool wanted)
    {
        auto& queue = std::get<std::unique_ptr<Queue>>(queues_);
        if (wanted && !queue) queue = std::make_unique<Queue>();
    }
    void begin_eight(Eights& of) const
    {
        size_t k = 0;
        std::apply([&](const auto&... queue) { ((queue ? void(of[k++] = queue->begin_eight()) : void(k++)), ...); },
                   queues_);
    }
    // Adds a point of a BSDF that is_queued().
    template <class B>
    [[gnu::always_inline]] void add(Eights& of, uint32_t lane, const B& bsdf)
    {
        if constexpr (std::is_same_v<B, PlasticBsdf>) add_to<PlasticQueue>(of, lane, bsdf);
        if constexpr (std::is_same_v<B, PrincipledBsdf>) add_to<PrincipledQueue>(of, lane, bsdf);
        if constexpr (std::is_same_v<B, GlassBsdf>) add_to<GlassQueue>(of, lane, bsdf);
        if constexpr (std::is_same_v<B, MetalBsdf>) add_to<MetalQueue>(of, lane, bsdf);
    }
    void add(Eights& of, uint32_t lane, const AnyBsdf& bsdf)
    {
        if (const auto* plastic = std::get_if<PlasticBsdf>(&bsdf))
            add(of, lane, *plastic);
        else if (const auto* glass = std::get_if<GlassBsdf>(&bsdf))
            add(of, lane, *glass);
        else if (const auto* metal = std::get_if<MetalBsdf>(&bsdf))
            add(of, lane, *metal);
        else
            add(of, lane, *std::get_if<PrincipledBsdf>(&bsdf));
    }
    // Adds a principled point with another turn than its own.
    void add_turned(Eights& of, uint32_t lane, const PrincipledBsdf& bsdf, Vec2 turn)
    {
        add_to<PrincipledQueue>(of, lane, bsdf, turn);
    }

    // Calls f(queue) for each queue.
    template <class F>
    void for_all(const F& f)
    {
        std::apply([&](const auto&... queue) { ((queue ? f(*queue) : void()), ...); }, queues_);
    }
    // Calls f(queue, points) for each queue with some of the lanes.
    template <class F>
    [[gnu::always_inline]] void for_some(const Eights& of, uint32_t lanes, const F& f) const
    {
        for_one<0>(of, lanes, f), for_one<1>(of, lanes, f), for_one<2>(of, lanes, f), for_one<3>(of, lanes, f);
        static_assert(count == 4);
    }

private:
    template <class Queue, class B, class... More>
    [[gnu::always_inline]] void add_to(Eights& of, uint32_t lane, const B& bsdf, More... more)
    {
        auto& queue = std::get<std::unique_ptr<Queue>>(queues_);
        queue->add(of[index<Queue>(std::make_index_sequence<count>{})], lane, bsdf, more...);
    }
    template <class Queue, size_t... k>
    static constexpr size_t index(std::index_sequence<k...>)
    {
        return ((std::is_same_v<std::tuple_element_t<k, Queues>, std::unique_ptr<Queue>> ? k : 0) + ...);
    }
    template <size_t k, class F>
    [[gnu::always_inline]] void for_one(const Eights& of, uint32_t lanes, const F& f) const
    {
        if ((lanes & of[k].lanes) != 0) f(*std::get<k>(queues_), of[k]);
    }

    Queues queues_;
};

}  // namespace lancer
