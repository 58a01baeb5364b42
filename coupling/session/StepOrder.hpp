// SPDX-License-Identifier: BSD-3-Clause
/// The rule for the numbers and times of coupling steps.
#pragma once

#include <optional>
#include <string>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling::session
{

/// Steps are numbered 1, 2, 3, ...; dt is positive; each begins where the last one ended.
class StepOrder
{
public:
    /// What is wrong with this as the next step; empty if it is right.
    std::optional<std::string> find_fault(Step const& next) const;
    void accept(Step const& step) { last_ = step; }

private:
    Step last_;  ///< number 0 before the first, which may begin at any time
};

}  // namespace gimdem::coupling::session
