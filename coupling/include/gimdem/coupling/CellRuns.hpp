// SPDX-License-Identifier: BSD-3-Clause
/// Parts of a mesh as runs of cells, and which of them the fields of a step are sent for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gimdem/coupling/Span.hpp"

namespace gimdem::coupling
{

/// The cells [first, first + count).
struct CellRun
{
    std::int32_t first = 0;
    std::int32_t count = 0;
};

/// In rising order, without overlap.
using CellRuns = std::vector<CellRun>;

/// The longest list of runs that is sent; what is longer is joined across gaps.
inline constexpr std::size_t most_runs_sent = 128;

std::size_t cell_count(CellRuns const& runs);

/// The cells whose flag is not 0: shape=(n_cells,). Runs with small gaps between them are joined, so that the list has
/// most_runs_sent at most; so cells may be in it whose flag is 0.
CellRuns runs_where(Span<std::uint8_t const> flags);

/// Is every cell of `part` in `whole`?
bool contains(CellRuns const& whole, CellRuns const& part);

/// The cells in which the server needs some fields of the next fluid.
struct NeededCells
{
    std::vector<std::string> fields;  ///< names of namespace field
    CellRuns cells;
};

/// Which cells the fields of a step are sent for. As it is made, all travel.
struct StepCells
{
    /// In all other cells the solid that is sent is that of a cell without particles, to the bit: void fraction 1, the
    /// rest +0. Absent: it may be anything anywhere.
    std::optional<CellRuns> solid;
    /// Of the next fluid. A field that is in none of them is needed in every cell.
    std::vector<NeededCells> needed;
};

/// Ways for fields to travel, docs/protocol.md. One is in force if the server wishes it and the client can do it.
struct Encodings
{
    bool sparse = false;   ///< only the cells of StepCells travel; the same to the bit
    bool float32 = false;  ///< rounded to float: half the bytes, errors of 6e-8 of each number
    bool lz4 = false;      ///< frames are compressed; arrays in shared memory are not
};

inline Encodings both(Encodings const& a, Encodings const& b)
{
    return {a.sparse && b.sparse, a.float32 && b.float32, a.lz4 && b.lz4};
}

}  // namespace gimdem::coupling
