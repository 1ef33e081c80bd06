#include "core/error.h"

namespace lancer {

std::string to_string(const Location& l)
{
    std::string s = l.file;
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

void Diagnostics::warning(const Location& where, const std::string& message, uint64_t count)
{
    const auto [it, fresh] = index_.try_emplace(where.file + '\n' + message, warnings_.size());
    if (fresh) warnings_.push_back({where, message, 0});
    warnings_[it->second].count += count;
}

void Diagnostics::throw_if_errors() const
{
    if (errors_ == 0) return;
    const uint64_t more = errors_ > max_errors ? errors_ - max_errors : 0;
    throw Error(kind_, more ? text_ + "\nerror: and " + std::to_string(more) + " more" : text_);
}

std::string to_string(const Diagnostics::Warning& w)
{
    return (w.where.file.empty() ? "" : to_string(w.where) + ": ") + "warning: " + w.message +
           (w.count > 1 ? " (" + std::to_string(w.count) + " times)" : "");
}

}  // namespace lancer
