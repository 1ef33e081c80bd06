// A warning of many lines of an OBJ file: it is given once, with its first line and how often it is due.
#pragma once

#include <cstdint>
#include <string>

#include "core/error.h"

namespace lancer {

struct RepeatedWarning {
    const char* message;
    uint32_t line = 0;  // the first, from 1
    uint64_t count = 0;

    void add(uint32_t at)
    {
        if (count++ == 0) line = at;
    }
    // Nothing where it never was due.
    void give(const std::string& file, Diagnostics& diagnostics) const
    {
        if (count) diagnostics.warning({file, line, 0}, message, count);
    }
};

}  // namespace lancer
