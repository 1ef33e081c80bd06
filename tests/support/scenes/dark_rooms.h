// Rooms that see little of their lights.
#pragma once

#include <string>
#include <vector>

#include "scene/description/description.h"

namespace lancer {

// The inside of a box from -1 to 3 along x, divided at x = 1 by a wall with a square hole of the given half width. The
// lamp hangs behind it, the camera looks at the room before it.
SceneDescription room_with_hole(double hole);
// The same with a translucent curtain before the hole.
SceneDescription room_behind_a_curtain();

// The camera's room without a hole to the lamp's, but with a lamp of its own in a niche that only the place opposite
// sees.
SceneDescription room_with_niche();

// The camera's room with a dim lamp of its own.
SceneDescription room_beside_a_brighter_one();

// The same under a sun that no ray from the room reaches; and with a glossy floor, under a pictured sky besides.
SceneDescription room_under_a_sun();
SceneDescription glossy_room_under_a_sky();

// The camera's room alone, whose hole shows a part of the sky: of a picture or of one colour, the latter also beside a
// sun; matt, or with a glossy floor.
struct NamedRoom {
    std::string name;
    SceneDescription description;
};
std::vector<NamedRoom> rooms_with_window();

}  // namespace lancer
