// Three indices for each triangle of a mesh that has them; often only some triangles do.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/ranked_bitset.h"

namespace lancer {

class CornerTable {
public:
    using Corners = std::array<uint32_t, 3>;
    static constexpr uint32_t none = UINT32_MAX;

    CornerTable() = default;
    // has(triangle): whether the triangle's indices are kept.
    template <class Has>
    CornerTable(const std::vector<Corners>& all, const Has& has)
    {
        const auto count = static_cast<uint32_t>(all.size());
        RankedBitset marks(count, has);
        const size_t kept = marks.marked();
        if (kept == 0) return;
        if (kept * sizeof(Corners) + marks.bytes() >= all.size() * sizeof(Corners)) {
            corners_ = all;
            for (uint32_t t = 0; t < count; ++t)
                if (!marks.has(t)) corners_[t] = {none, none, none};
            return;
        }
        corners_.reserve(kept);
        for (uint32_t t = 0; t < count; ++t)
            if (marks.has(t)) corners_.push_back(all[t]);
        marks_ = std::move(marks);
    }

    bool empty() const { return corners_.empty(); }
    // Null where the triangle has none.
    const Corners* find(uint32_t triangle) const
    {
        if (marks_.empty()) return corners_.empty() || corners_[triangle][0] == none ? nullptr : &corners_[triangle];
        return marks_.has(triangle) ? &corners_[marks_.before(triangle)] : nullptr;
    }
    // The entry that find() returns, or the next one if the triangle has none: computed without a branch, for
    // prefetching. The table must not be empty.
    const Corners* guess(uint32_t triangle) const
    {
        if (marks_.empty()) return &corners_[triangle];
        return &corners_[marks_.has(triangle) * marks_.before(triangle)];
    }
    // All entries in the order of their triangles, for renumbering. `none` entries must stay.
    std::vector<Corners>& all() { return corners_; }
    uint64_t bytes() const { return corners_.size() * sizeof(Corners) + marks_.bytes(); }

private:
    std::vector<Corners> corners_;
    RankedBitset marks_;  // which triangles have an entry; empty if all of them or none have
};

}  // namespace lancer
