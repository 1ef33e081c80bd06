// Suggestions for misspelled names: the known name that was probably meant, and the end of the error message. Used for
// keys and names of scene files and for options of the command line.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/readable.h"

namespace lancer {

// How many letters to insert, delete, replace or swap with their neighbour (no letter twice) to get from a to b.
// Upper and lower case count as the same letter.
inline size_t edit_distance(std::string_view a, std::string_view b)
{
    const auto same = [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    };
    std::vector<size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) above[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = above[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        before.swap(above);
        above.swap(row);
    }
    return above[b.size()];
}

// The most similar known name, if at most a third of its letters differ; the first one of equals.
template <class Names>
std::optional<std::string> nearest(std::string_view wrong, const Names& known)
{
    constexpr size_t longest = 64;  // limits the time of the search
    std::optional<std::string> best;
    size_t best_distance = 0;
    for (const std::string_view name : known) {
        const size_t letters = std::max(wrong.size(), name.size());
        if (letters > longest) continue;
        const size_t distance = edit_distance(wrong, name);
        const bool is_typo = distance <= std::max<size_t>(1, letters / 3) && distance < wrong.size();
        if (is_typo && (!best || distance < best_distance)) {
            best = name;
            best_distance = distance;
        }
    }
    return best;
}

// UTF-8 with control characters, those of C1 too, as '?': they could steer a terminal. keeps_lines: but for line feeds
// and tabs.
inline std::string without_controls(std::string_view text, bool keeps_lines)
{
    std::string clean;
    clean.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const unsigned char next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        const bool is_c1 = c == 0xc2 && next >= 0x80 && next < 0xa0;
        const bool stays = !is_c1 && c != 0x7f && (c >= 0x20 || (keeps_lines && (c == '\n' || c == '\t')));
        clean += stays ? text[i] : '?';
        if (is_c1) ++i;
    }
    return clean;
}

// A name from a file for use in a message: one line of UTF-8, of limited length, without control characters.
inline std::string on_one_line(std::string_view name)
{
    constexpr size_t longest = 200;  // room for a path
    std::string text = without_controls(readable(name), false);
    if (text.size() <= longest) return text;
    size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not within a character
    return text.substr(0, end) + "...";
}

inline std::string in_quotes(std::string_view name) { return "'" + on_one_line(name) + "'"; }

// "; did you mean 'x'? known: a, b, c", or "; known: a, b, c" if nothing is near, or "" if nothing is known.
template <class Names>
std::string suggestion(std::string_view wrong, const Names& known)
{
    constexpr size_t most = 20;  // a scene can have thousands of materials
    std::string list;
    size_t count = 0;
    for (const std::string_view name : known) {
        if (count++ < most) list += (list.empty() ? "" : ", ") + on_one_line(name);
    }
    if (count == 0) return "";
    if (count > most) list += " and " + std::to_string(count - most) + " more";
    const std::optional<std::string> meant = nearest(wrong, known);
    return (meant ? "; did you mean " + in_quotes(*meant) + "? known: " : "; known: ") + list;
}

}  // namespace lancer
