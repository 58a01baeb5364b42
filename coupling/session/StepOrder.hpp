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
    void accept(Step const& step) { last_ = step, pass_ = 0; }

    /// The same of a repetition of the last step: it has the number of the last step and begins where that began, and
    /// `pass` follows the last one. Its length may be another.
    std::optional<std::string> find_fault_of_repeat(Step const& again, int pass) const;
    void accept_repeat(Step const& step, int pass) { last_ = step, pass_ = pass; }

private:
    Step last_;  ///< number 0 before the first, which may begin at any time
    int pass_ = 0;
};

}  // namespace gimdem::coupling::session
