// SPDX-License-Identifier: BSD-3-Clause
#include "output/Summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "output/OutputFile.hpp"
#include "output/Text.hpp"

namespace gimdem::output
{

void Summary::add(std::string const& name, double value, std::string const& unit)
{
    auto const same = std::find_if(figures_.begin(), figures_.end(), [&](Figure const& f) { return f.name == name; });
    if (same != figures_.end())
        *same = {name, value, unit};
    else
        figures_.push_back({name, value, unit});
}

void Summary::print(std::ostream& out) const
{
    for (auto const& figure : figures_)
    {
        char value[32];
        std::snprintf(value, sizeof value, "%.6g", figure.value);
        out << "figure: " << figure.name << " = " << value << " [" << figure.unit << "]\n";
    }
}

void Summary::write(std::filesystem::path const& file) const
{
    std::string text = "{\"figures\": [";
    for (auto const& figure : figures_)
    {
        text += &figure == figures_.data() ? "\n" : ",\n";
        text += "  {\"name\": " + json_quoted(figure.name);
        text += ", \"value\": " + (std::isfinite(figure.value) ? to_text(figure.value) : "null");
        text += ", \"unit\": " + json_quoted(figure.unit) + '}';
    }
    text += "\n]}\n";

    if (file.has_parent_path()) make_folder(file.parent_path());
    OutputFile out(file);
    out.write(text);
    out.commit();
}

}  // namespace gimdem::output
