// SPDX-License-Identifier: BSD-3-Clause
/// Which cells of the whole mesh are whose: fields are cut for ranks, and put together again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "message/Fields.hpp"

namespace gimdem::coupling::session
{

class RankCells
{
public:
    /// Before the meshes are known: all parts are empty.
    RankCells() = default;
    /// first_cell: shape=(ranks + 1,). wants: the solid fields of every rank.
    RankCells(std::vector<std::int32_t> first_cell, message::FieldChoice<SolidFields> wants);

    /// Fault::user, before any rank gets its part.
    void check(SolidFields const& fields) const;
    /// Rank's part of the fields that are wanted; the others are empty.
    SolidFields cut(SolidFields const& whole, std::size_t rank) const;
    /// Rank's part of the cells that travel, by its own numbers.
    StepCells cut(StepCells const& whole, std::size_t rank) const;
    /// Whole fields of the ranks' parts, in memory of this object until the next call.
    FluidFields join(std::vector<FluidFields> const& parts);

private:
    std::size_t count(std::size_t rank) const;
    CellRuns cut(CellRuns const& whole, std::size_t rank) const;

    std::vector<std::int32_t> first_cell_;
    message::FieldChoice<SolidFields> wants_;
    std::map<std::string, std::vector<double>> fluid_;  ///< whole fields
};

}  // namespace gimdem::coupling::session
