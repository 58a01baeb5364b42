// SPDX-License-Identifier: BSD-3-Clause
#include "output/Text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::string duration_text(double seconds)
{
    if (!std::isfinite(seconds) || seconds > 1e8) return "?";
    auto const whole = static_cast<long>(std::max(0.0, std::ceil(seconds)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace gimdem::output
