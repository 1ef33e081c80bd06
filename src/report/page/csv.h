// Tables as text (RFC 4180): rows of fields with commas between them, fields in quotes where they must be.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"

namespace lancer {

using CsvFields = std::vector<std::string>;

// With the end of the line.
std::string csv_row(const CsvFields& fields);

// A number as text that gives the same bits back; of NaN nothing.
std::string csv_number(double x);
std::string csv_number(uint64_t x);

// The rows of a text, one after the other, with the line on which each begins. name: of the file, for messages. Both
// must outlive the reader.
class CsvReader {
public:
    CsvReader(const std::string& name, const std::string& text) : name_(name), text_(text) {}

    // False at the end. Throws Error (invalid_input) for a quote that is not closed.
    bool next(CsvFields& fields);
    // An error at the row that was read last.
    Error wrong(const std::string& why) const { return {ErrorKind::invalid_input, {name_, line_, 0}, why}; }
    // What a field holds. Throws wrong() for what is no such number; of reals, an empty field is NaN.
    double real(const std::string& column, const std::string& field) const;
    uint64_t count(const std::string& column, const std::string& field) const;

private:
    void quoted_part(std::string& field);
    template <class T>
    T number(const std::string& column, const std::string& field) const;

    const std::string& name_;
    const std::string& text_;
    size_t at_ = 0;
    uint32_t line_ = 1, next_line_ = 1;
};

}  // namespace lancer
