// SPDX-License-Identifier: BSD-3-Clause
/// Fields of all cells, kept from message to message, for those that do not travel as they are used.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "gimdem/coupling/CellRuns.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

/// One copy on the way in: each row to its cell; all other cells hold what a cell without particles holds. Copies share
/// the memory.
class FieldStore
{
public:
    FieldStore();

    /// The numbers of array k of the message as a field of all cells. Fault::protocol if its bytes, its runs or its
    /// sizes cannot be, or for a NaN or infinity. Lives until the field is received again.
    Span<double const> receive(Message const& message, int k, std::size_t cell_count) const;

private:
    struct Fields;
    std::shared_ptr<Fields> fields_;
};

/// What a field is where there are no particles.
double empty_value(std::string const& field);

/// Fraction of the cells above which a field travels whole: gathering and scattering cost more than copying.
inline constexpr double most_sparse = 0.75;

}  // namespace gimdem::coupling::message
