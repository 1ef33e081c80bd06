// SIMD types and functions. Each lane has the bits of the scalar function, as no operation is fused or reordered.
// Templates over T = float and T = Float8 use these functions for both.
#pragma once

#include "core/lanes/arithmetic.h"
#include "core/lanes/masks.h"
#include "core/lanes/memory.h"
#include "core/lanes/permute.h"
