#include "core/error.h"

#include <algorithm>

#include "core/names.h"

namespace lancer {
namespace {

constexpr size_t most_named = 3;  // in one warning

}  // namespace

std::string to_string(const Location& l)
{
    std::string s = without_controls(l.file, false);
    if (l.line) s += ":" + std::to_string(l.line);
    if (l.line && l.column) s += ":" + std::to_string(l.column);
    return s;
}

Error::Error(ErrorKind kind, const Location& where, const std::string& message)
    : kind_(kind), text_((where.file.empty() ? "" : to_string(where) + ": ") + "error: " + message)
{
}

void Diagnostics::error(const Location& where, const std::string& message, ErrorKind kind)
{
    if (errors_ == 0) kind_ = kind;
    if (++errors_ > max_errors) return;
    if (!text_.empty()) text_ += '\n';
    text_ += (where.file.empty() ? "" : to_string(where) + ": ") + "error: " + message;
}

Diagnostics::Warning& Diagnostics::warning_like(const Location& where, const std::string& before,
                                                const std::string& after)
{
    const auto [it, is_new] = index_.try_emplace(before + '\n' + after, warnings_.size());
    if (is_new) warnings_.push_back({where, before, after, {}, {}, {}, 0});
    return warnings_[it->second];
}

void Diagnostics::warning(const Location& where, const std::string& message, uint64_t count)
{
    Warning& w = warning_like(where, message, "");
    if (!where.file.empty()) w.files.insert(where.file);
    w.count += count;
}

void Diagnostics::warning(const Location& where, const NamedProblem& problem, uint64_t count)
{
    Warning& w = warning_like(where, problem.before, problem.after);
    if (!where.file.empty()) w.files.insert(where.file);
    w.count += count;
    if (w.names.insert(problem.name).second && w.first_names.size() < most_named) w.first_names.push_back(problem.name);
}

void Diagnostics::append(const Diagnostics& other)
{
    for (const Warning& from : other.warnings_) {
        Warning& w = warning_like(from.where, from.before, from.after);
        w.files.insert(from.files.begin(), from.files.end());
        w.count += from.count;
        for (const std::string& name : from.first_names)
            if (!w.names.contains(name) && w.first_names.size() < most_named) w.first_names.push_back(name);
        w.names.insert(from.names.begin(), from.names.end());
    }
}

void Diagnostics::throw_if_errors() const
{
    if (errors_ == 0) return;
    const uint64_t more = errors_ > max_errors ? errors_ - max_errors : 0;
    throw Error(kind_, more ? text_ + "\nerror: and " + std::to_string(more) + " more" : text_);
}

std::string message_of(const Diagnostics::Warning& w)
{
    std::string text = w.before;
    for (size_t i = 0; i < w.first_names.size(); ++i) {
        const bool is_last = i > 0 && i + 1 == w.names.size();
        text += (i == 0 ? " " : is_last ? " and " : ", ") + in_quotes(w.first_names[i]);
    }
    if (const size_t others = w.names.size() - w.first_names.size(); others > 0)
        text += " and " + std::to_string(others) + (others > 1 ? " others" : " other");
    return text + w.after;
}

std::string to_string(const Diagnostics::Warning& w, std::string_view kind)
{
    std::string counts;
    if (w.count > std::max<size_t>(1, w.names.size())) counts += std::to_string(w.count) + " times";
    if (w.files.size() > 1) counts += (counts.empty() ? "in " : ", in ") + std::to_string(w.files.size()) + " files";
    return (w.where.file.empty() ? "" : to_string(w.where) + ": ") + std::string(kind) + ": " + message_of(w) +
           (counts.empty() ? "" : " (" + counts + ")");
}

}  // namespace lancer
