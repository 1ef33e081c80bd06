// The range of a parameter as a rule for numbers in scene files.
#pragma once

#include "io/toml_reader.h"
#include "scene/description/parameter_range.h"

namespace lancer {

// positive, finite: what these two ranges ask for; it differs between numbers kept as float and as double. Ranges that
// are none of a number ask for finite ones.
inline const NumberRule& rule_of(ParameterRange range, const NumberRule& positive, const NumberRule& finite)
{
    switch (range) {
        case ParameterRange::unit:
            return reflectance;
        case ParameterRange::not_negative:
            return brightness;
        case ParameterRange::positive:
            return positive;
        case ParameterRange::quarter_turn:
            return up_to_quarter_turn;
        case ParameterRange::below_one:
            return below_one;
        case ParameterRange::nonzero_vector:
        case ParameterRange::finite:
        case ParameterRange::million:
        case ParameterRange::choice:
        case ParameterRange::boolean:
        case ParameterRange::name:
        case ParameterRange::group:
        case ParameterRange::texture:
            break;
    }
    return finite;
}

}  // namespace lancer
