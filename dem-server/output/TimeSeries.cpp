// SPDX-License-Identifier: BSD-3-Clause
#include "output/TimeSeries.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "output/Text.hpp"

namespace gimdem::output
{

namespace
{

/// A heading as CSV: quoted where a comma or quote in it would be taken for the end of the column.
std::string heading(Column const& column)
{
    std::string text = column.name + " [" + column.unit + ']';
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char const c : text)
        quoted.append(c == '"' ? 2 : 1, c);
    return quoted += '"';
}

void add_cell(std::string& line, std::string const& cell)
{
    if (!line.empty()) line += ',';
    line += cell;
}

}  // namespace

TimeSeries::TimeSeries(std::filesystem::path file, std::vector<Column> const& columns)
    : file_(std::move(file)), column_count_(columns.size())
{
    if (file_.has_parent_path()) make_folder(file_.parent_path());
    std::string line;
    for (auto const& column : columns)
        add_cell(line, heading(column));
    descriptor_ = open_to_write(file_, O_TRUNC | O_APPEND, file_);
    write_line(line);
}

void TimeSeries::append(std::span<double const> values)
{
    if (values.size() != column_count_)
        throw std::invalid_argument("TimeSeries::append: " + std::to_string(values.size()) + " values for " +
                                    std::to_string(column_count_) + " columns of " + file_.string());
    std::string line;
    for (double const value : values)
        add_cell(line, to_text(value));
    write_line(line);
}

// A row at the very time is written again; its time may differ in the last bits.
std::int64_t TimeSeries::keep_before(double time, int column)
{
    auto const time_of = [=](std::string const& row)
    {
        std::size_t at = 0;
        for (int k = 0; k < column; ++k)
            at = row.find(',', at) + 1;
        return std::strtod(row.c_str() + at, nullptr);
    };
    std::ifstream in(file_);
    std::string line;
    std::getline(in, line);
    std::size_t bytes = line.size() + 1;
    std::int64_t rows = 0;
    for (; std::getline(in, line) && time_of(line) < time - 1e-9 * std::abs(time); ++rows)
        bytes += line.size() + 1;
    if (::ftruncate(descriptor_.get(), static_cast<::off_t>(bytes)) != 0) fail_with_errno("write", file_);
    return rows;
}

void TimeSeries::write_line(std::string const& line)
{
    std::string const text = line + '\n';
    write_all(descriptor_.get(), std::as_bytes(std::span(text)), file_);
}

}  // namespace gimdem::output
