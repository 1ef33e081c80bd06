// Media inside transparent objects and the stack of media around a ray (nested dielectrics). Where objects overlap, the
// one with the highest priority is present, and the surfaces of the others are ignored. Schmidt and Budge, "Simple
// Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2), 2002.
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
    float ior = 1;                      // without a priority: relative to the surroundings
    std::optional<int32_t> priority{};  // none: its surface is never ignored
};

inline constexpr uint16_t no_medium = UINT16_MAX;

// Beer-Lambert transmittance over a distance in scene units; 1 without absorption.
inline Color transmittance(const Medium& medium, float distance)
{
    const auto part = [distance](float sigma) { return sigma > 0 ? std::exp(-sigma * distance) : 1; };
    return {part(medium.absorption.r), part(medium.absorption.g), part(medium.absorption.b)};
}

// The stack of objects that a ray has entered and not left, as medium ids. It drops the oldest entry on overflow.
// Leaving an object that is not on the stack is ignored as if it had been entered first, so that dropped entries
// reappear.
class MediumStack {
public:
    static constexpr size_t capacity = 4;

    void enter(uint16_t id)
    {
        std::copy_backward(ids_.begin(), ids_.end() - 1, ids_.end());
        ids_[0] = id;
    }
    // Removes a medium; returns whether it was on the stack.
    bool leave(uint16_t id)
    {
        const auto at = std::find(ids_.begin(), ids_.end(), id);
        if (at == ids_.end()) return false;
        std::copy(at + 1, ids_.end(), at);
        ids_.back() = no_medium;
        return true;
    }
    // Inserts a medium as the oldest entry.
    void enter_first(uint16_t id)
    {
        const auto end = std::find(ids_.begin(), ids_.end(), no_medium);
        if (end != ids_.end()) *end = id;
    }

    struct Current {
        uint16_t id = no_medium;
        float ior = 1;  // relative to vacuum
    };
    // The present medium. Of equal priority the one entered first; a medium without priority is present from its
    // surface until another surface.
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
    std::array<uint16_t, capacity> ids_{no_medium, no_medium, no_medium, no_medium};  // most recent first
};

// The crossing of a surface from within `here`.
struct Boundary {
    MediumStack here, beyond;
    float eta = 0;        // relative index; 0: that of the material
    bool absent = false;  // the same medium on both sides: the surface is ignored
};
// id: medium behind the surface, or none; front: the ray would enter it.
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
