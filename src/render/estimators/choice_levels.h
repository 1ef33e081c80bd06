// The cells of a LightChoice while it is learned: a grid, and coarser ones above it for places of few vertices.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "render/estimators/arrivals.h"

namespace lancer {

// The grid that holds all but the outermost places, without cells; per_unit is 0 if all lie at one place.
LightChoice make_grid(std::span<const Arrival> arrivals);

// Sums over the vertices of cells 2^level times as long as those of the grid, with the same normals.
class Level {
public:
    Level(std::array<uint32_t, 3> size, size_t lights)
        : size_(size), width_(lights + 1), row_(LightChoice::indices_in(size), none)
    {
    }
    bool is_coarsest() const { return size_[0] == 1 && size_[1] == 1 && size_[2] == 1; }
    // The cell of the next level to which a cell belongs.
    size_t above(size_t index) const
    {
        const auto place = static_cast<uint32_t>(index / 6), side = static_cast<uint32_t>(index % 6);
        const uint32_t x = place % size_[0], y = place / size_[0] % size_[1], z = place / size_[0] / size_[1];
        return LightChoice::index_in(size_above(), x / 2, y / 2, z / 2, side);
    }
    // Of a cell, which then has a row: for each light the squares of what shadow rays brought; behind these the number
    // of vertices.
    std::span<double> sums(size_t index)
    {
        if (row_[index] == none) {
            row_[index] = static_cast<uint32_t>(indices_.size());
            indices_.push_back(index);
            sums_.resize(sums_.size() + width_);
        }
        return std::span(sums_).subspan(row_[index] * width_, width_);
    }
    bool has(size_t index) const { return row_[index] != none; }
    // Those that have a row, in order.
    std::vector<size_t> indices() const
    {
        std::vector<size_t> sorted = indices_;
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    }
    // Cells twice as long.
    Level coarser()
    {
        Level to(size_above(), width_ - 1);
        for (const size_t index : indices()) {
            const std::span<double> from = sums(index), sum = to.sums(above(index));
            for (size_t i = 0; i < width_; ++i) sum[i] += from[i];
        }
        return to;
    }
    // Cells of LightChoice, by row.
    std::vector<uint32_t> cells;
    uint32_t& cell(size_t index) { return cells[row_[index]]; }
    uint32_t cell(size_t index) const { return cells[row_[index]]; }

private:
    static constexpr uint32_t none = UINT32_MAX;

    std::array<uint32_t, 3> size_above() const { return {(size_[0] + 1) / 2, (size_[1] + 1) / 2, (size_[2] + 1) / 2}; }

    std::array<uint32_t, 3> size_;
    size_t width_;
    std::vector<uint32_t> row_;
    std::vector<size_t> indices_;  // of the rows
    std::vector<double> sums_;
};

// A choice that is learned but for LightChoice::cell_at, which only the final one needs.
struct Learned {
    LightChoice choice{};
    std::vector<Level> levels{};

    // The cell of the smallest surroundings with vertices; the first cell if there are none.
    uint32_t cell_of(size_t index) const
    {
        for (const Level& level : levels) {
            if (level.has(index)) return level.cell(index);
            index = level.above(index);
        }
        return 0;
    }
    LightChoice finished() &&
    {
        choice.cell_at.resize(LightChoice::indices_in(choice.size));
        for (size_t i = 0; i < choice.cell_at.size(); ++i) choice.cell_at[i] = cell_of(i);
        return std::move(choice);
    }
};

}  // namespace lancer
