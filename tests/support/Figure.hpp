// SPDX-License-Identifier: BSD-3-Clause
/// Measured numbers in the output of a test: one line each, `figure: <name> = <value> [unit]`.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace gimdem::test
{

inline void figure(std::string_view name, double value, std::string_view unit = "1")
{
    fmt::print("figure: {} = {:.8g} [{}]\n", name, value, unit);
}

}  // namespace gimdem::test
