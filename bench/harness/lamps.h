// Scenes of many lights.
#pragma once

#include <cstdint>

#include "scene/description/description.h"

namespace lancer::bench {

// A closed box of side 2, of 20,000 triangles, with so many triangles of light all over its ceiling, all of one power
// and so bright together as one would be. lamps > 0.
SceneDescription box_of_lamps(uint32_t lamps);

// A hall 4 high, every lamp under 4 units of its ceiling and all alike, with a block on every 9 units of its floor:
// each place has its light from the few lamps that are near. Seen along its diagonal. lamps: the square of a whole
// number.
SceneDescription hall_of_lamps(uint32_t lamps);

}  // namespace lancer::bench
