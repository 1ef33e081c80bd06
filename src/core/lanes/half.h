// Half floats (IEEE 754 binary16), as picture files store them: float_from_half(h) is exact; half_from_float(v) rounds
// to nearest and gives infinity beyond 65504.
#pragma once

#include "core/lanes/native.h"
