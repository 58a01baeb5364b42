// SPDX-License-Identifier: BSD-3-Clause
/// Errors of mapping methods on one mesh against the exact overlap, as rows of CSV. `./gimdem bench mapping` calls it;
/// --help tells the options.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <optional>

#include "ErrorMeasures.hpp"
#include "MappingOptions.hpp"
#include "core/Error.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::benchmark;

struct Options
{
    CommonOptions common;
    int places = 4000, lines = 100, sweeps = 50;
};

/// One particle at a time in the middle of a mesh wide enough for all methods, and a packing that has walls.
struct Scenes
{
    explicit Scenes(Options const& options)
        : alone({options.common.mesh, options.common.ratio, 15, 7}),
          packed({options.common.mesh, options.common.ratio, 28.4, 5}),
          probes(alone, options.places, options.lines),
          few_probes(alone, options.places / 16, options.lines / 4),
          bed(packed.bed(packed.is_from_files ? bed_count : 0)),
          spheres(packed.packing(packed.is_from_files ? bed_count : 0, options.sweeps)),
          exact_alone(alone.mesh, "exact"),
          exact_fractions(MethodOnMesh(packed.mesh, "exact").solid_fractions(spheres))
    {
    }

    MappingScene alone, packed;
    Probes probes, few_probes;
    Region bed;
    std::vector<test::Sphere> spheres;
    MethodOnMesh exact_alone;
    std::vector<double> exact_fractions;
};

void measure(std::string const& name, Scenes& scenes)
{
    MethodOnMesh alone(scenes.alone.mesh, name);
    // What spreads solves for all cells for each particle.
    Probes const& probes = alone.spreads() ? scenes.few_probes : scenes.probes;
    double const wrong = wrong_cells(alone, scenes.exact_alone, probes);
    Jump const jump = void_fraction_jump(alone, scenes.alone.mesh, probes);
    auto const fractions = MethodOnMesh(scenes.packed.mesh, name).solid_fractions(scenes.spheres);
    PackingErrors const packing = packing_errors(scenes.packed, scenes.bed, fractions, scenes.exact_fractions);
    fmt::print("{},{},{:.4g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", name, scenes.packed.mesh.cell_count(),
               scenes.packed.ratio(), wrong, packing.rms, jump.largest, jump.mean, packing.largest, packing.wall);
    std::fflush(stdout);
}

void run(Options const& options)
{
    Scenes scenes(options);
    fmt::print("method,cells,ratio,wrong_cells,rms_error,jump_largest,jump_mean,largest_solid_fraction,wall_ratio\n");
    for_each_method(options.common, [&](std::string const& name) { measure(name, scenes); });
}

}  // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Errors of mapping methods on one mesh, as CSV");
    add_common_options(app, options.common);
    app.add_option("--places", options.places, "random places of one particle");
    app.add_option("--lines", options.lines, "random lines that one particle moves along");
    bool list = false;
    app.add_flag("--list", list, "print the names of the methods, no more");
    app.add_option("--sweeps", options.sweeps, "Monte Carlo moves of each particle of the packing");
    CLI11_PARSE(app, argc, argv);
    if (list)
    {
        fmt::print("{}\n", fmt::join(mapping_method_names, "\n"));
        return 0;
    }
    return guarded("mapping_errors", [&] { run(options); });
}
