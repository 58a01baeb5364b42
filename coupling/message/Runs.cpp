// SPDX-License-Identifier: BSD-3-Clause
#include "message/Runs.hpp"

#include <algorithm>

#include "message/Fields.hpp"

namespace gimdem::coupling::message
{
namespace
{

std::string run_text(std::uint64_t first, std::uint64_t count)
{
    return "a run of " + std::to_string(count) + " cells from cell " + std::to_string(first);
}

}  // namespace

void pack_runs(CellRuns const& runs, WireRuns& body)
{
    body.Clear();
    body.Reserve(static_cast<int>(2 * runs.size()));
    for (CellRun const& run : runs)
    {
        body.Add(static_cast<std::uint32_t>(run.first));
        body.Add(static_cast<std::uint32_t>(run.count));
    }
}

CellRuns unpack_runs(WireRuns const& body, std::size_t cell_count, std::string const& whose)
{
    if (body.size() % 2 != 0) refuse(whose + ": a run without its number of cells");
    if (body.size() / 2 > max_runs)
        refuse(whose + ": " + std::to_string(body.size() / 2) + " runs of cells (at most " + std::to_string(max_runs) +
               ")");
    CellRuns runs;
    runs.reserve(static_cast<std::size_t>(body.size() / 2));
    std::uint64_t end = 0;  // of the run before
    for (int k = 0; k < body.size(); k += 2)
    {
        std::uint64_t const first = body[k], count = body[k + 1];  // two numbers of 32 bits: their sum cannot overflow
        if (count == 0) refuse(whose + ": " + run_text(first, count));
        if (k > 0 && first <= end)
            refuse(whose + ": " + run_text(first, count) + " after one that ends at " + std::to_string(end) +
                   " (runs must rise, with gaps between them)");
        end = first + count;
        if (end > std::min(cell_count, most_cells))
            refuse(whose + ": " + run_text(first, count) + " (the mesh has " + std::to_string(cell_count) + " cells)");
        runs.push_back({static_cast<std::int32_t>(first), static_cast<std::int32_t>(count)});
    }
    return runs;
}

CellRuns cells_of_array(v1::Envelope const& envelope, int array, std::size_t cell_count)
{
    v1::ArrayHeader const& header = envelope.arrays(array);
    int told = array;
    while (told >= 0 && envelope.arrays(told).runs().empty())
        --told;
    bool const none = header.count() == 0 && header.runs().empty();
    std::string const whose = "array \"" + header.name() + "\"";
    if (told < 0 && !none) refuse(whose + " is sparse and does not tell its cells");
    CellRuns runs = none ? CellRuns{} : unpack_runs(envelope.arrays(told).runs(), cell_count, whose);
    std::size_t const rows = gimdem::coupling::cell_count(runs);
    if (rows != header.count())
        refuse(whose + " has " + std::to_string(header.count()) + " rows, but its runs have " + std::to_string(rows) +
               " cells");
    return runs;
}

void pack_needed(std::vector<NeededCells> const& needed, v1::SolidState& body)
{
    for (NeededCells const& some : needed)
    {
        v1::NeededCells& entry = *body.add_needed();
        for (std::string const& field : some.fields)
            entry.add_fields(field);
        pack_runs(some.cells, *entry.mutable_runs());
    }
}

std::vector<NeededCells> unpack_needed(v1::SolidState const& body, std::size_t cell_count)
{
    if (static_cast<std::size_t>(body.needed_size()) > fluid_fields.size())
        refuse("SolidState: " + std::to_string(body.needed_size()) + " sets of needed cells (at most one a field)");
    std::vector<NeededCells> needed;
    std::vector<std::string> all;
    for (v1::NeededCells const& entry : body.needed())
    {
        all.insert(all.end(), entry.fields().begin(), entry.fields().end());
        if (all.size() > fluid_fields.size()) refuse("SolidState: more needed fields than there are");
        needed.push_back({{entry.fields().begin(), entry.fields().end()},
                          unpack_runs(entry.runs(), cell_count, "SolidState: cells that the server needs")});
    }
    if (!all.empty()) choose_fluid_fields(all, Fault::protocol);
    return needed;
}

CellRuns const* needed_cells(std::vector<NeededCells> const& needed, std::string const& field)
{
    for (NeededCells const& some : needed)
        if (std::find(some.fields.begin(), some.fields.end(), field) != some.fields.end()) return &some.cells;
    return nullptr;
}

}  // namespace gimdem::coupling::message
