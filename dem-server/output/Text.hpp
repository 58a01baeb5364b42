// SPDX-License-Identifier: BSD-3-Clause
/// Numbers and names as text in result files.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "gimdem/coupling/Json.hpp"

namespace gimdem::output
{

/// The shortest text that reads back to the same bits.
inline std::string to_text(double value)
{
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// With the characters that XML gives a meaning replaced.
std::string xml_escaped(std::string_view text);

using coupling::json_quoted;

/// "45 s", "3 min 20 s", "2 h 05 min", "?" for what is not finite.
std::string duration_text(double seconds);

}  // namespace gimdem::output
