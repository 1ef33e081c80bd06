// What fills transparent bodies, and which of them a ray is in. Bodies may overlap: where they do, the one of the
// highest priority is there and the surfaces of the others are not. Schmidt and Budge, "Simple Nested Dielectrics in
// Ray Traced Images", Journal of Graphics Tools 7(2), 2002.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "core/color.h"

namespace lancer {

struct Medium {
    Color absorption{};                 // sigma_a per scene unit, >= 0
    float ior = 1;                      // without a priority: over that of whatever is around
    std::optional<int32_t> priority{};  // without: its surface is always there, as if nothing overlapped
};

inline constexpr uint16_t no_medium = UINT16_MAX;

// Beer and Lambert's law, over a distance in scene units; of what does not absorb, 1 over any.
inline Color transmittance(const Medium& medium, float distance)
{
    const auto part = [distance](float sigma) { return sigma > 0 ? std::exp(-sigma * distance) : 1; };
    return {part(medium.absorption.r), part(medium.absorption.g), part(medium.absorption.b)};
}

// The bodies that a ray has entered and not left, as ids of their media. It forgets the oldest of more than it holds;
// what is left without having been entered counts as entered before all others, so that forgotten ones come back.
class MediumStack {
public:
    static constexpr size_t capacity = 4;

    void enter(uint16_t id)
    {
        std::copy_backward(ids_.begin(), ids_.end() - 1, ids_.end());
        ids_[0] = id;
    }
    // Whether it had been entered.
    bool leave(uint16_t id)
    {
        const auto at = std::find(ids_.begin(), ids_.end(), id);
        if (at == ids_.end()) return false;
        std::copy(at + 1, ids_.end(), at);
        ids_.back() = no_medium;
        return true;
    }
    // As if it had been entered before all others.
    void enter_first(uint16_t id)
    {
        const auto end = std::find(ids_.begin(), ids_.end(), no_medium);
        if (end != ids_.end()) *end = id;
    }

    struct Current {
        uint16_t id = no_medium;
        float ior = 1;  // over that of empty space
    };
    // What is really there. Of equal priority, what was entered first; what has none is there from where it is entered
    // to where something else is.
    Current current(std::span<const Medium> media) const
    {
        Current c;
        for (size_t i = capacity; i-- > 0;) {
            if (ids_[i] == no_medium) continue;
            const Medium& m = media[ids_[i]];
            if (c.id != no_medium && m.priority && media[c.id].priority && *m.priority <= *media[c.id].priority)
                continue;
            c = {ids_[i], m.priority ? m.ior : c.ior * m.ior};
        }
        return c;
    }
    Color transmittance(std::span<const Medium> media, float distance) const
    {
        const uint16_t id = current(media).id;
        return id == no_medium ? Color{1, 1, 1} : lancer::transmittance(media[id], distance);
    }

    friend bool operator==(const MediumStack&, const MediumStack&) = default;

private:
    std::array<uint16_t, capacity> ids_{no_medium, no_medium, no_medium, no_medium};  // the latest first
};

// A surface that bounds a body, met from within `here`.
struct Boundary {
    MediumStack here, beyond;
    float eta = 0;        // index beyond over index here; 0: what the material says
    bool absent = false;  // the same medium is on both sides: there is no surface
};
// id: of the medium behind the surface, or none; front: the ray would enter it.
inline Boundary cross(std::span<const Medium> media, const MediumStack& in, uint16_t id, bool front)
{
    Boundary c{in, in};
    if (id == no_medium) return c;
    if (front)
        c.beyond.enter(id);
    else if (!c.beyond.leave(id))
        c.here.enter_first(id);
    if (!media[id].priority) return c;
    const MediumStack::Current before = c.here.current(media), after = c.beyond.current(media);
    c.eta = after.ior / before.ior;
    c.absent = before.id == after.id;
    return c;
}

}  // namespace lancer
