// Three indices for each of those triangles of a mesh that have them, where often only some have.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace lancer {

class CornerTable {
public:
    using Corners = std::array<uint32_t, 3>;
    static constexpr uint32_t none = UINT32_MAX;

    CornerTable() = default;
    // has(triangle): whether its corners are kept.
    template <class Has>
    CornerTable(const std::vector<Corners>& all, const Has& has)
    {
        uint32_t kept = 0;
        std::vector<Mark> marks(all.size() / 64 + 1);
        for (uint32_t t = 0; t < all.size(); ++t) {
            if (t % 64 == 0) marks[t / 64].before = kept;
            if (!has(t)) continue;
            marks[t / 64].which |= uint64_t{1} << t % 64;
            ++kept;
        }
        if (kept == 0) return;
        if (kept * sizeof(Corners) + marks.size() * sizeof(Mark) >= all.size() * sizeof(Corners)) {
            corners_ = all;
            for (uint32_t t = 0; t < all.size(); ++t)
                if (!marks[t / 64].has(t)) corners_[t] = {none, none, none};
            return;
        }
        marks_ = std::move(marks);
        corners_.reserve(kept);
        for (uint32_t t = 0; t < all.size(); ++t)
            if (marks_[t / 64].has(t)) corners_.push_back(all[t]);
    }

    bool empty() const { return corners_.empty(); }
    // Null where the triangle has none.
    const Corners* find(uint32_t triangle) const
    {
        if (marks_.empty()) return corners_.empty() || corners_[triangle][0] == none ? nullptr : &corners_[triangle];
        const Mark& m = marks_[triangle / 64];
        if (!m.has(triangle)) return nullptr;
        return &corners_[m.number(triangle)];
    }
    // What find() gives, or that of another triangle where there is none: found without a branch, to be asked for
    // early. Only of a table that is not empty.
    const Corners* guess(uint32_t triangle) const
    {
        if (marks_.empty()) return &corners_[triangle];
        const Mark& m = marks_[triangle / 64];
        return &corners_[m.has(triangle) * m.number(triangle)];
    }
    // In the order of their triangles, to be renumbered or turned round; `none` stays what it is.
    std::vector<Corners>& all() { return corners_; }
    uint64_t bytes() const { return corners_.size() * sizeof(Corners) + marks_.size() * sizeof(Mark); }

private:
    // Of 64 triangles: which have corners, and how many before them do.
    struct Mark {
        uint64_t which = 0;
        uint32_t before = 0;
        bool has(uint32_t triangle) const { return which >> triangle % 64 & 1; }
        uint32_t number(uint32_t triangle) const
        {
            const uint64_t below = which & ((uint64_t{1} << triangle % 64) - 1);
            return before + static_cast<uint32_t>(std::popcount(below));
        }
    };
    std::vector<Corners> corners_;
    std::vector<Mark> marks_;  // empty: nearly all triangles have corners, and there is an entry for each; or none has
};

}  // namespace lancer
