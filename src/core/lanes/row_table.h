// A table of rows of four floats, gathered for eight indices at once.
#pragma once

#include <vector>

#include "core/lanes/vec.h"

namespace lancer {

struct alignas(16) Row {
    float x = 0, y = 0, z = 0, w = 0;
};

// A table of records of `rows` rows each.
template <size_t rows>
class RowTable {
public:
    using Record = std::array<Row, rows>;

    RowTable() = default;
    explicit RowTable(std::vector<Record> records) : records_(std::move(records))
    {
        if (!are_few()) return;
        for (size_t i = 0; i < records_.size(); ++i)
            for (size_t k = 0; k < rows; ++k) {
                const Row& row = records_[i][k];
                columns_[k].xyz.x[i] = row.x, columns_[k].xyz.y[i] = row.y, columns_[k].xyz.z[i] = row.z;
                columns_[k].w[i] = row.w;
            }
    }
    bool empty() const { return records_.empty(); }
    // The given row of eight records.
    RowLanes at(UInt8 numbers, size_t row = 0) const
    {
        if (!are_few()) return transpose([&](size_t i) { return load4(&records_[numbers[i]][row].x); });
        return {permute(columns_[row].xyz, numbers), permute(columns_[row].w, numbers)};
    }

private:
    // At most eight records: a register holds one number of each, and a gather is a permutation.
    bool are_few() const { return records_.size() <= float_lanes; }

    std::vector<Record> records_;
    std::array<RowLanes, rows> columns_{};
};

}  // namespace lancer
