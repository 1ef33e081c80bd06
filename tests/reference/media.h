// Bodies within bodies: Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", JGT 7(2), 2002, with the
// rules of docs/scene-format.md, "Nested dielectrics".
#pragma once

#include <deque>

#include "reference/world.h"

namespace reference {

// The bodies that a ray is in, as materials, the one entered first in front. Four at most: a fifth makes it forget the
// first.
class Inside {
public:
    void enter(size_t material)
    {
        bodies_.push_back(material);
        if (bodies_.size() > 4) bodies_.pop_front();
    }
    // False if it had not been entered.
    bool leave(size_t material)
    {
        for (size_t i = bodies_.size(); i-- > 0;)
            if (bodies_[i] == material) {
                bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(i));
                return true;
            }
        return false;
    }
    void had_been_entered(size_t material)
    {
        if (bodies_.size() < 4) bodies_.push_front(material);
    }

    struct There {
        std::optional<size_t> material;
        double index = 1;
    };
    // Of those with a priority the highest, of equal ones that entered first; a body without one is there from where
    // it was entered to where something else is.
    There there(const World& world) const
    {
        There t;
        for (const size_t body : bodies_) {
            const Material& m = world.materials[body];
            if (!m.what.priority) {
                t = {body, t.index * m.medium_index()};
                continue;
            }
            const auto& held = t.material ? world.materials[*t.material].what.priority : std::optional<int32_t>();
            if (!held || *m.what.priority > *held) t = {body, m.medium_index()};
        }
        return t;
    }

private:
    std::deque<size_t> bodies_;
};

}  // namespace reference
