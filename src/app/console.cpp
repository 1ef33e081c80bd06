#include "app/console.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/error.h"
#include "core/names.h"

namespace lancer {
namespace {

thread_local int silent_consoles = 0;

bool is_coloured()
{
    const char* const no_color = std::getenv("NO_COLOR");
    return stderr_is_terminal() && !(no_color && *no_color);
}

std::string coloured(std::string line)
{
    constexpr std::array<std::array<const char*, 2>, 2> words{{{"error:", "\x1b[1;31m"}, {"warning:", "\x1b[1;35m"}}};
    for (const auto& [word, colour] : words) {
        const size_t at = line.find(word);
        if (at == std::string::npos || (at > 0 && line[at - 1] != ' ')) continue;
        line.insert(at + std::strlen(word), "\x1b[0m");
        line.insert(at, colour);
        break;
    }
    return line;
}

}  // namespace

std::string format_text(const char* format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int size = std::vsnprintf(nullptr, 0, format, arguments);
    va_end(arguments);
    std::string text(static_cast<size_t>(size > 0 ? size : 0), '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    return text;
}

std::string shortest(double x)
{
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

std::string shortest(float x)
{
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

std::string in_shell_quotes(const std::string& word)
{
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) || std::strchr("-_./=,:+@%", c);
    });
    if (plain) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

void print_result(const std::string& line) { std::fprintf(stdout, "%s\n", without_controls(line, true).c_str()); }

void print_path(const std::string& path)
{
    if (isatty(STDOUT_FILENO)) return print_result(path);
    std::fprintf(stdout, "%s\n", path.c_str());
}

void flush_results()
{
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error(ErrorKind::failed, {}, std::string("cannot write to the standard output: ") + std::strerror(errno));
}

void print_problem(const std::string& lines)
{
    const bool colour = is_coloured();
    std::string text;
    const std::string clean = without_controls(lines, true);
    std::string_view rest = clean;
    while (!rest.empty()) {
        const size_t end = rest.find('\n');
        std::string line(rest.substr(0, end));
        rest = end == std::string_view::npos ? "" : rest.substr(end + 1);
        if (line.starts_with("error: ") || line.starts_with("warning: ")) line.insert(0, "lancer: ");
        text += (colour ? coloured(line) : line) + '\n';
    }
    print_raw(text);
}

std::string message_of(const Error& failure)
{
    constexpr std::string_view error = "error: ";
    const std::string text = failure.what();
    const size_t at = text.find(error);
    return at == std::string::npos ? text : text.substr(at + error.size());
}

void print_as_warning(const Error& failure, const std::string& consequence)
{
    constexpr std::string_view error = "error: ";
    std::string text = failure.what();
    if (const size_t at = text.find(error); at != std::string::npos) text.replace(at, error.size(), "warning: ");
    print_problem(text + "; " + consequence);
}

void print_note(const std::string& line) { print_raw("lancer: " + without_controls(line, true) + "\n"); }

bool stderr_is_terminal()
{
    const char* const terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) && terminal && std::strcmp(terminal, "dumb") != 0;
}

void print_raw(const std::string& text)
{
    if (silent_consoles == 0) std::fputs(text.c_str(), stderr);
}

SilentConsole::SilentConsole() { ++silent_consoles; }
SilentConsole::~SilentConsole() { --silent_consoles; }

}  // namespace lancer
