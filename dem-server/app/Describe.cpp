// SPDX-License-Identifier: BSD-3-Clause
#include "app/Describe.hpp"

#include <fmt/format.h>

namespace gimdem::app
{

namespace
{

std::string quoted(std::string const& text)
{
    std::string out = "\"";
    for (char const c : text)
    {
        if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            out += c;
    }
    return out + '"';
}

}  // namespace

std::string describe(Case const& settings)
{
    std::string grids;
    for (std::string const& grid : settings.run.grids)
        grids += (grids.empty() ? "" : ", ") + quoted(grid);
    return fmt::format(
        R"({{"title": {}, "client": {}, "grid": {}, "grids": [{}], "until": {}, "schedule": {}, "endpoint": {}, "timeout": {}, "connect_time": {}, "grace_time": {}, "keys": {}, "threads": {}}})",
        quoted(settings.title), quoted(settings.run.client), quoted(settings.run.grid), grids, settings.run.until,
        quoted(settings.coupling.schedule), quoted(settings.coupling.endpoint), settings.coupling.timeout,
        settings.coupling.connect_time, settings.coupling.grace_time, quoted(settings.coupling.keys),
        settings.dem.threads);
}

}  // namespace gimdem::app
