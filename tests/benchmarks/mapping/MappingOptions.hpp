// SPDX-License-Identifier: BSD-3-Clause
/// What the programs of `./gimdem bench mapping` have in common.
#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "MappingScene.hpp"
#include "core/Error.hpp"
#include "core/MappingMethodNames.hpp"

namespace gimdem::benchmark
{

struct CommonOptions
{
    std::string mesh = "hexahedra";
    double ratio = 1.76;
    std::vector<std::string> methods;  ///< empty: all
};

inline void add_common_options(CLI::App& app, CommonOptions& options)
{
    app.add_option("--mesh", options.mesh,
                   fmt::format("{}, or a folder with an OpenFOAM mesh of a box", fmt::join(built_in_meshes, ", ")));
    app.add_option("--ratio", options.ratio, "a / dp of a mesh that is made here: cube root of a cell's volume over dp")
        ->check(CLI::Range(0.5, 20.0));
    std::vector<std::string> const names(std::begin(mapping_method_names), std::end(mapping_method_names));
    app.add_option("--methods", options.methods, "some methods; all")->delimiter(',')->check(CLI::IsMember(names));
}

/// Calls work(name); a method that refuses the mesh is left out, and why is told.
template <class Work>
void for_each_method(CommonOptions const& options, Work const& work)
{
    for (std::string_view const view : mapping_method_names)
    {
        std::string const name(view);
        if (!options.methods.empty() && std::ranges::find(options.methods, name) == options.methods.end()) continue;
        try
        {
            work(name);
        }
        catch (UserError const& error)
        {
            fmt::print(stderr, "{} is left out on {}: {}\n", name, options.mesh, error.what());
        }
    }
}

/// The exit code of a program.
template <class Work>
int guarded(std::string_view program, Work const& work)
{
    try
    {
        work();
        return 0;
    }
    catch (std::exception const& error)
    {
        fmt::print(stderr, "{}: error: {}\n", program, error.what());
        return 1;
    }
}

}  // namespace gimdem::benchmark
