// SPDX-License-Identifier: BSD-3-Clause
/// The figures of a run: what it ends with on the terminal and in summary.json.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace gimdem::output
{

/// A named number.
struct Figure
{
    std::string name;  ///< lower_case_with_underscores
    double value = 0;
    std::string unit;  ///< SI, "1" for a pure number
};

/// Figures in the order in which they were added.
class Summary
{
public:
    /// Add a figure, or replace the one of this name in place.
    void add(std::string const& name, double value, std::string const& unit);

    std::vector<Figure> const& figures() const { return figures_; }

    /// Print a line `figure: name = value [unit]` each.
    void print(std::ostream& out) const;

    /// Write {"figures": [{"name": ..., "value": ..., "unit": ...}]} atomically; a value that is not finite is null.
    /// Throws UserError with the path and the system's reason.
    void write(std::filesystem::path const& file) const;

private:
    std::vector<Figure> figures_;
};

}  // namespace gimdem::output
