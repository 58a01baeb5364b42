// SPDX-License-Identifier: BSD-3-Clause
/// Text and numbers as JSON writes them.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

namespace gimdem::coupling
{

/// As a JSON string, with its quotes.
inline std::string json_quoted(std::string_view text)
{
    std::string quoted = "\"";
    for (char const c : text)
        if (c == '"' || c == '\\')
            (quoted += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
        {
            char code[8];
            std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned>(c));
            quoted += code;
        }
        else
            quoted += c;
    return quoted += '"';
}

/// With so many digits; null for what JSON has no number for.
inline std::string json_number(double value, int digits = 12)
{
    if (!std::isfinite(value)) return "null";
    char text[32];
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    return text;
}

}  // namespace gimdem::coupling
