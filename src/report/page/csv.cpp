#include "report/page/csv.h"

#include <array>
#include <cmath>

namespace lancer {
namespace {

template <class T>
std::string text_of(T x)
{
    std::array<char, 40> buffer;  // a double takes 24 letters
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
    return {buffer.data(), end.ptr};
}

std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

}  // namespace

std::string csv_row(const CsvFields& fields)
{
    std::string row;
    for (size_t i = 0; i < fields.size(); ++i) row += (i ? "," : "") + quoted(fields[i]);
    return row + "\n";
}

std::string csv_number(double x) { return std::isnan(x) ? "" : text_of(x); }
std::string csv_number(uint64_t x) { return text_of(x); }

bool CsvReader::next(CsvFields& fields)
{
    line_ = next_line_;
    if (at_ >= text_.size()) return false;
    fields.assign(1, "");
    while (at_ < text_.size()) {
        const char c = text_[at_++];
        if (c == '"') {
            quoted_part(fields.back());
        } else if (c == ',') {
            fields.emplace_back();
        } else if (c == '\n') {
            ++next_line_;
            break;
        } else if (c != '\r') {
            fields.back() += c;
        }
    }
    return true;
}

void CsvReader::quoted_part(std::string& field)
{
    for (; at_ < text_.size(); ++at_) {
        if (text_[at_] == '"' && (at_ + 1 == text_.size() || text_[at_ + 1] != '"')) {
            ++at_;
            return;
        }
        if (text_[at_] == '"') ++at_;
        if (text_[at_] == '\n') ++next_line_;
        field += text_[at_];
    }
    throw wrong("a quote that is not closed");
}

template <class T>
T CsvReader::number(const std::string& column, const std::string& field) const
{
    T x{};
    const auto end = std::from_chars(field.data(), field.data() + field.size(), x);
    if (field.empty() || end.ec != std::errc{} || end.ptr != field.data() + field.size())
        throw wrong("'" + field + "' in column " + column + " is no such number");
    return x;
}

double CsvReader::real(const std::string& column, const std::string& field) const
{
    return field.empty() ? std::numeric_limits<double>::quiet_NaN() : number<double>(column, field);
}

uint64_t CsvReader::count(const std::string& column, const std::string& field) const
{
    return number<uint64_t>(column, field);
}

}  // namespace lancer
