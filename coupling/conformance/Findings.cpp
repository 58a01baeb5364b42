// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/Findings.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gimdem::conformance
{
namespace
{

/// A line has four parts with tabulators between them; a fact's first part is "fact".
struct Line
{
    std::string kind, name, text;
};

std::vector<Line> read_lines(std::string const& file_name)
{
    std::ifstream file(file_name);
    std::vector<Line> lines;
    for (std::string text; std::getline(file, text) && !file.eof();)
    {
        std::istringstream parts(text);
        Line line;
        std::getline(parts, line.kind, '\t');
        std::getline(parts, line.name, '\t');
        std::getline(parts, line.text);
        lines.push_back(line);
    }
    return lines;
}

std::string in_one_line(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    return text;
}

}  // namespace

char const* word_of(Verdict verdict)
{
    switch (verdict)
    {
        case Verdict::passed:
            return "ok";
        case Verdict::failed:
            return "FAILED";
        case Verdict::skipped:
            return "--";
    }
    return "";
}

void FindingsFile::add(Finding const& finding)
{
    std::fprintf(file_, "%s\t%s\t%s\n", word_of(finding.verdict), finding.name.c_str(),
                 in_one_line(finding.text).c_str());
    std::fflush(file_);
}

void FindingsFile::tell(std::string const& name, std::string const& value)
{
    std::fprintf(file_, "fact\t%s\t%s\n", name.c_str(), value.c_str());
    std::fflush(file_);
}

std::vector<Finding> read_findings(std::string const& file_name)
{
    std::vector<Finding> findings;
    for (Line const& line : read_lines(file_name))
        for (Verdict const verdict : {Verdict::passed, Verdict::failed, Verdict::skipped})
            if (line.kind == word_of(verdict)) findings.push_back({line.name, verdict, line.text});
    return findings;
}

std::optional<std::string> read_fact(std::string const& file_name, std::string const& name)
{
    for (Line const& line : read_lines(file_name))
        if (line.kind == "fact" && line.name == name) return line.text;
    return std::nullopt;
}

}  // namespace gimdem::conformance
