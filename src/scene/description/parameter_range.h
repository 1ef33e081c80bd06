// What the numbers of scene files may be.
#pragma once

namespace lancer {

// Of a number, or of each channel of a colour.
enum class ParameterRange {
    unit,          // from 0 to 1
    not_negative,  // 0 or more
    positive,      // more than 0
    quarter_turn,  // degrees, from 0 to 90
    below_one,     // from -0.999 to 0.999
    nonzero_vector,
    finite,
    million,  // an integer from -1000000 to 1000000
    choice,   // one of two words, false or true
    boolean,  // false or true
    name,     // that of a material, required
    group,    // that of a group of lights: see is_group_name()
    texture,  // one itself
};

}  // namespace lancer
