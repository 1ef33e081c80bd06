#include "report/bench/comparable.h"

#include <algorithm>

#include "report/page/number_text.h"

namespace lancer {
namespace {

std::string shown(const std::string& s) { return "'" + s + "'"; }
std::string shown(int n) { return std::to_string(n); }
std::string shown(bool on) { return on ? "on" : "off"; }
bool told(const std::string& s) { return !s.empty(); }
template <class T>
bool told(const std::optional<T>& x)
{
    return x.has_value();
}
const std::string& value(const std::string& s) { return s; }
template <class T>
T value(const std::optional<T>& x)
{
    return *x;
}

template <class T>
void difference(const char* what, const T& a, const T& b, std::vector<std::string>& reasons)
{
    if (!told(a) || !told(b))
        reasons.push_back(std::string(what) + " not told by " +
                          (told(a)   ? "the second"
                           : told(b) ? "the first"
                                     : "either"));
    else if (value(a) != value(b))
        reasons.push_back(std::string(what) + " " + shown(value(a)) + " against " + shown(value(b)));
}

}  // namespace

std::vector<std::string> unfit(const MachineBlock& block)
{
    if (!block.load) return {"load not told"};
    // So that a load that is no number does not pass.
    if (*block.load <= highest_load) return {};
    return {"load " + significant(*block.load) + " is above " + significant(highest_load, 2)};
}

std::vector<std::string> not_comparable(const MachineBlock& a, const MachineBlock& b)
{
    std::vector<std::string> reasons;
    difference("CPU", a.cpu, b.cpu, reasons);
    difference("number of CPUs", a.num_cpus, b.num_cpus, reasons);
    difference("threads", a.threads, b.threads, reasons);
    difference("compiler", a.compiler, b.compiler, reasons);
    difference("flags", a.flags, b.flags, reasons);
    difference("Embree", a.embree, b.embree, reasons);
    difference("instruction set of Embree", a.embree_isa, b.embree_isa, reasons);
    difference("assertions in Embree", a.embree_asserts, b.embree_asserts, reasons);
    difference("TBB", a.tbb, b.tbb, reasons);
    for (const MachineBlock* block : {&a, &b})
        for (const std::string& reason : unfit(*block))
            reasons.push_back(std::string(block == &a ? "the first: " : "the second: ") + reason);
    return reasons;
}

void Findings::add(const std::string& subject, const std::vector<std::string>& reasons)
{
    for (const std::string& reason : reasons) {
        const auto same = std::find_if(found_.begin(), found_.end(), [&](const auto& f) { return f.first == reason; });
        if (same == found_.end())
            found_.emplace_back(reason, subject);
        else
            same->second += ", " + subject;
    }
}

std::vector<std::string> Findings::lines() const
{
    std::vector<std::string> lines;
    for (const auto& [reason, subjects] : found_) lines.emplace_back(subjects).append(": ").append(reason);
    return lines;
}

Ratio ratio(const Ratio& a, const Ratio& b) { return {a.value / b.value, a.low / b.high, a.high / b.low}; }

bool repeats(const Ratio& first, const Ratio& second)
{
    const bool close = first.value <= 1.05 * second.value && second.value <= 1.05 * first.value;
    return close || (first.low <= second.high && second.low <= first.high);
}

}  // namespace lancer
