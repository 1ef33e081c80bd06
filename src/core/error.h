// Errors and warnings of loading and building. Problems are collected with their place in the input and thrown once,
// all together. Nothing is thrown while a tile is rendered.
#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lancer {

// A place in an input file. Line and column count from 1; 0 means unknown.
struct Location {
    std::string file;
    uint32_t line = 0, column = 0;
    friend bool operator==(const Location&, const Location&) = default;
};

// "file", "file:line" or "file:line:column", as far as known; "" for no file.
std::string to_string(const Location& l);

// Category of an error; it decides the exit code of the program.
enum class ErrorKind {
    failed,         // at run time: memory, cannot write (exit 1)
    usage,          // the command line (exit 2)
    invalid_input,  // a scene or an asset is wrong (exit 65)
    missing_input,  // a file named in the input does not exist (exit 66)
    no_memory,      // the pictures of a scene need more memory than --memory allows (exit 71)
};

// The one exception type. what() holds complete lines "place: error: message", without a newline at the end.
class Error : public std::exception {
public:
    Error(ErrorKind kind, std::string text) : kind_(kind), text_(std::move(text)) {}
    Error(ErrorKind kind, const Location& where, const std::string& message);
    const char* what() const noexcept override { return text_.c_str(); }
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
    std::string text_;
};

// A message about one of many names: "before 'name' after".
struct NamedProblem {
    std::string before, name, after;
};

// Collects errors and warnings. Warnings that say the same are one, at the first place where they occurred: a million
// bad faces, fifty missing pictures or a hundred files without normals give one line.
class Diagnostics {
public:
    struct Warning {
        Location where;  // of the first
        std::string before, after;
        std::set<std::string> files, names;
        std::vector<std::string> first_names;  // the first few, in the order of the input
        uint64_t count = 0;
    };

    void error(const Location& where, const std::string& message, ErrorKind kind = ErrorKind::invalid_input);
    // count > 1: the caller has counted the occurrences; `where` is the first one.
    void warning(const Location& where, const std::string& message, uint64_t count = 1);
    // Problems that differ in their names alone are one.
    void warning(const Location& where, const NamedProblem& problem, uint64_t count = 1);
    // Appends the warnings of another object.
    void append(const Diagnostics& other);
    bool has_errors() const { return errors_ > 0; }
    const std::vector<Warning>& warnings() const { return warnings_; }
    // The kind is that of the first error.
    void throw_if_errors() const;

private:
    Warning& warning_like(const Location& where, const std::string& before, const std::string& after);

    static constexpr uint64_t max_errors = 50;  // a broken file of a million lines still gives a readable report
    ErrorKind kind_ = ErrorKind::invalid_input;
    uint64_t errors_ = 0;
    std::string text_;
    std::vector<Warning> warnings_;
    std::map<std::string, size_t> index_;
};

// What it says, without place and counts; names: "'a', 'b', 'c' and 5 others".
std::string message_of(const Diagnostics::Warning& w);
// "place: warning: message (n times, in m files)"
std::string to_string(const Diagnostics::Warning& w, std::string_view kind = "warning");

}  // namespace lancer
