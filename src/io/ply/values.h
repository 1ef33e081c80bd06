// The numbers of a PLY file, one after the other or from a known place.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "io/ply/header.h"
#include "io/text_file.h"

namespace lancer {

template <class T>
double load_as(const char* at, bool swaps)
{
    char bytes[sizeof(T)];
    std::memcpy(bytes, at, sizeof(T));
    if (swaps) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

// A number of a binary file. swaps: see PlyHeader. A double holds all types.
inline double load_number(const char* at, PlyType type, bool swaps)
{
    switch (type) {
        case PlyType::int8:
            return load_as<int8_t>(at, swaps);
        case PlyType::uint8:
            return load_as<uint8_t>(at, swaps);
        case PlyType::int16:
            return load_as<int16_t>(at, swaps);
        case PlyType::uint16:
            return load_as<uint16_t>(at, swaps);
        case PlyType::int32:
            return load_as<int32_t>(at, swaps);
        case PlyType::uint32:
            return load_as<uint32_t>(at, swaps);
        case PlyType::float32:
            return load_as<float>(at, swaps);
        case PlyType::float64:
            return load_as<double>(at, swaps);
    }
    return 0;
}

// Reads from front to back, in any form. Text need not keep to lines.
class PlyCursor {
public:
    PlyCursor(std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes), position_(header.end), line_(header.end_line + 1), form_(header.form), swaps_(header.swaps())
    {
    }

    bool is_text() const { return form_ == PlyHeader::Form::text; }
    // Of the next number, in text; else 0.
    uint32_t line() const { return is_text() ? line_ : 0; }
    size_t left() const { return bytes_.size() - position_; }
    const char* here() const { return bytes_.data() + position_; }
    // count: at most left().
    void skip(size_t count) { position_ += count; }
    // How many numbers of a type there can still be, at most.
    size_t room_for(PlyType type) const { return is_text() ? (left() + 1) / 2 : left() / size_of(type); }

    // False where there are not so many.
    bool skip_numbers(PlyType type, double count)
    {
        for (; count > 0; --count)
            if (!next(type)) return false;
        return true;
    }
    // Nothing at the end of the file, or where text has no number.
    std::optional<double> next(PlyType type)
    {
        if (is_text()) return next_in_text();
        if (left() < size_of(type)) return {};
        const double value = load_number(here(), type, swaps_);
        skip(size_of(type));
        return value;
    }

private:
    std::optional<double> next_in_text()
    {
        const char* const end = bytes_.data() + bytes_.size();
        const char* at = here();
        for (; at != end && (*at == ' ' || (*at >= '\t' && *at <= '\r')); ++at) line_ += *at == '\n';
        if (at != end && *at == '+') ++at;
        double value = 0;
        const auto [after, problem] = std::from_chars(at, end, value);
        // Too large, or too small, which leaves zero.
        if (problem == std::errc::result_out_of_range &&
            classify_number({at, static_cast<size_t>(after - at)}) == NumberKind::not_finite)
            value = HUGE_VAL;
        const bool ends = after == end || *after == ' ' || (*after >= '\t' && *after <= '\r');
        position_ = static_cast<size_t>(after - bytes_.data());
        if (problem == std::errc::invalid_argument || !ends) return {};
        return value;
    }

    std::string_view bytes_;
    size_t position_;
    uint32_t line_;
    PlyHeader::Form form_;
    bool swaps_;
};

}  // namespace lancer
