// Output of the program. Results go to stdout, everything else to stderr.
#pragma once

#include <string>

#include "core/error.h"

namespace lancer {

// Formats as printf, into a string.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* format, ...);

// The shortest text that reads back as the same number.
std::string shortest(double x);
std::string shortest(float x);

// Quotes a word for a shell.
std::string in_shell_quotes(const std::string& word);

// Output never steers a terminal: control characters become '?', but for line feeds and tabs. Prints a line on stdout.
void print_result(const std::string& line);
// The same of a written file. A script gets its very name.
void print_path(const std::string& path);
// Throws Error (failed) if what was printed on stdout could not be written.
void flush_results();

// Lines "place: error: message" or "place: warning: message"; those without a place get the program's name. The words
// error and warning are coloured on a terminal, unless NO_COLOR is set.
void print_problem(const std::string& lines);
// What a failure says, without its place and the word error.
std::string message_of(const Error& failure);
// A failure that costs nothing but what `consequence` says: its message as a warning.
void print_as_warning(const Error& failure, const std::string& consequence);
void print_note(const std::string& line);

// While one exists nothing of its thread is printed on stderr: a library is silent.
class SilentConsole {
public:
    SilentConsole();
    ~SilentConsole();
    SilentConsole(const SilentConsole&) = delete;
};

// Whether stderr is a terminal that can redraw a line.
bool stderr_is_terminal();
// Prints raw text on stderr immediately.
void print_raw(const std::string& text);

}  // namespace lancer
