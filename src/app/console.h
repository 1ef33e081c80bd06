// What the program says. Results go to stdout, everything else to stderr.
#pragma once

#include <string>

namespace lancer {

// As printf would, into a string.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* format, ...);

// The fewest digits that give the number back.
std::string shortest(double x);
std::string shortest(float x);

// A word as a shell reads it back.
std::string in_shell_quotes(const std::string& word);

// One line for a script or a reader on stdout.
void print_result(const std::string& line);
// Throws Error (failed) if what was printed on stdout could not be written.
void flush_results();

// Lines "place: error: message" or "place: warning: message"; those without a place get the program's name. The words
// error and warning are coloured on a terminal, unless NO_COLOR is set.
void print_problem(const std::string& lines);
void print_note(const std::string& line);

// Whether stderr is a terminal that can redraw a line.
bool stderr_is_terminal();
// Raw text on stderr, at once.
void print_raw(const std::string& text);

}  // namespace lancer
