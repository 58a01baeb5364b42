// SPDX-License-Identifier: BSD-3-Clause
/// Runs of cells in messages, checked before anybody uses them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gimdem/coupling/CellRuns.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

using WireRuns = google::protobuf::RepeatedField<std::uint32_t>;

/// The longest list that is accepted.
inline constexpr int max_runs = 4096;
/// Cells are numbered by int32_t.
inline constexpr std::size_t most_cells = std::size_t{1} << 31;

void pack_runs(CellRuns const& runs, WireRuns& body);

/// Fault::protocol unless runs have a cell each, rise with a gap between them, and end within the mesh.
CellRuns unpack_runs(WireRuns const& body, std::size_t cell_count, std::string const& whose);

/// The cells whose rows the array has: of a sparse array, perhaps told with an array before it. Fault::protocol as
/// above, and if they are not as many as the rows.
CellRuns cells_of_array(v1::Envelope const& envelope, int array, std::size_t cell_count);

/// What the server needs of the next fluid. Fault::protocol also for names that are unknown or come twice.
void pack_needed(std::vector<NeededCells> const& needed, v1::SolidState& body);
std::vector<NeededCells> unpack_needed(v1::SolidState const& body, std::size_t cell_count);

/// The cells in which that field is needed; null: in every cell.
CellRuns const* needed_cells(std::vector<NeededCells> const& needed, std::string const& field);

}  // namespace gimdem::coupling::message
