// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/Case.hpp"
#include "core/CaseChecks.hpp"
#include "core/CaseSettings.hpp"
#include "core/Error.hpp"

namespace gimdem
{

namespace
{

toml::table parse_toml(std::string const& text, std::string const& file)
{
    try
    {
        return toml::parse(text, file);
    }
    catch (toml::parse_error const& error)
    {
        auto const where = error.source().begin;
        throw UserError(file + ':' + std::to_string(where.line) + ':' + std::to_string(where.column) + ": not TOML (" +
                        std::string(error.description()) + "); mend this line, https://toml.io tells how");
    }
}

/// Paths in a case file are relative to the file; absolute ones do not depend on where they are used.
void resolve_paths(Case& input)
{
    if (!input.coupling.keys.empty() && input.coupling.keys.is_relative())
        input.coupling.keys = std::filesystem::absolute(input.file.parent_path() / input.coupling.keys);
    for (auto& insertion : input.insertion)
        if (!insertion.file.empty() && insertion.file.is_relative())
            insertion.file = std::filesystem::absolute(input.file.parent_path() / insertion.file);
    for (auto& wall : input.wall)
        if (!wall.file.empty() && wall.file.is_relative())
            wall.file = std::filesystem::absolute(input.file.parent_path() / wall.file);
}

/// What decides how the particles move: all but names, the other process, the machine, and what is written.
std::string identity_of(toml::table root)
{
    for (auto const* const section : {"title", "run", "coupling", "output"})
        root.erase(section);
    if (auto* const dem = root["dem"].as_table())
        for (auto const* const key : {"threads", "backend"})
            dem->erase(key);
    std::ostringstream text;
    text << root;
    return text.str();
}

}  // namespace

Case parse_case(std::string const& text, std::filesystem::path const& file)
{
    std::string const name = file.string();
    toml::table const root = parse_toml(text, name);
    Case input;
    input.file = file;
    input.identity = identity_of(root);

    case_file::Setting const top;
    case_file::read({root, top, "", false, name}, input);
    resolve_paths(input);
    case_file::check_case(input, {name, root});
    return input;
}

Case read_case(std::filesystem::path const& file)
{
    if (std::filesystem::is_directory(file))
        throw UserError(file.string() + " is a folder (a case file is needed); give " + (file / "case.toml").string());
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !(text << stream.rdbuf()))
        throw UserError(file.string() + " cannot be read (" + std::strerror(errno) + "); give the path of a case.toml");
    return parse_case(text.str(), file);
}

}  // namespace gimdem
