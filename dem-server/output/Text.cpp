// SPDX-License-Identifier: BSD-3-Clause
#include "output/Text.hpp"

#include <cstdio>

namespace gimdem::output
{

std::string xml_escaped(std::string_view text)
{
    std::string escaped;
    for (char const c : text)
        switch (c)
        {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    return escaped;
}

std::string json_quoted(std::string_view text)
{
    std::string quoted = "\"";
    for (char const c : text)
        if (c == '"' || c == '\\')
            (quoted += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
        {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
            quoted += code;
        }
        else
            quoted += c;
    return quoted += '"';
}

}  // namespace gimdem::output
