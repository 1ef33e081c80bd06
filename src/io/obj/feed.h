// What the parser behind load_obj gets to read of a checked file.
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

#include "io/obj/scan.h"

namespace lancer {

// The statements v, vn, f and usemtl of a text that passed scan_obj, without comments and continuations, materials
// as numbers (index into ObjSummary::materials). With uvs also vt: two numbers, beyond float for one that is not
// usable. Smoothing groups, if they count, arrive as objects named by the number of the group.
class ObjFeed : public std::streambuf {
public:
    enum class Part { all, vertices };
    ObjFeed(std::string_view text, const ObjSummary& summary, Part part, bool uvs)
        : lines_(text), summary_(&summary), part_(part), uvs_(uvs)
    {
    }

protected:
    int_type underflow() override;

private:
    TextLines lines_;
    const ObjSummary* summary_;
    Part part_;
    bool uvs_;
    std::string buffer_;
};

}  // namespace lancer
