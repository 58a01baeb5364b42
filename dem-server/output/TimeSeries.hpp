// SPDX-License-Identifier: BSD-3-Clause
/// Numbers over time as CSV.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "output/OutputFile.hpp"

namespace gimdem::output
{

/// A column of a time series.
struct Column
{
    std::string name;
    std::string unit;  ///< SI, "1" for a pure number
};

/// A CSV file with a header such as `time [s],bed_height [m]` and one row per sample.
///
/// Numbers are the shortest that read back to the same bits. Each row reaches the file before append() returns.
class TimeSeries
{
public:
    /// Create or replace `file`, with its folders. Throws UserError where that cannot be done.
    TimeSeries(std::filesystem::path file, std::vector<Column> const& columns);

    /// Write one row, values in the order of the columns.
    /// @pre values.size() is the number of columns (else std::invalid_argument).
    void append(std::span<double const> values);

    /// Drops the rows from `time` [s] on, which this column has. Returns how many are left.
    std::int64_t keep_before(double time, int column = 0);

    std::filesystem::path const& file() const { return file_; }

private:
    void write_line(std::string const& line);

    std::filesystem::path file_;
    std::size_t column_count_;
    Descriptor descriptor_;
};

}  // namespace gimdem::output
