// SPDX-License-Identifier: BSD-3-Clause
/// Time and memory of mapping methods on one mesh, as rows of CSV. `./gimdem bench mapping` calls it; --help tells the
/// options.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "MemoryInUse.hpp"
#include "SpeedScene.hpp"

namespace gimdem::benchmark
{

void measure(std::string const& name, SpeedScene const& scene, SpeedOptions const& options)
{
    MappingSettings settings;
    settings.method = name;
    exec::Execution const execution = exec::make_execution(options.threads == 1 ? "serial" : "openmp", options.threads);
    exec::Buffer<std::uint8_t> wall_faces(scene.mesh.face_count());
    wall_faces.fill(1);
    exec::Buffer<Impulse> impulses(scene.particles.count());
    impulses.fill({{1e-9, 2e-9, 3e-9, 1e-9}});
    std::size_t const before = memory_in_use();
    Mapper mapper(execution, scene.mesh, settings);
    CellSums sums;
    mapper.take_cells(scene.cells);
    mapper.locate(scene.particles, wall_faces);
    mapper.compute_weights(scene.particles);
    mapper.sum_into_cells(scene.particles, impulses, sums);
    auto const n = static_cast<double>(scene.particles.count());
    double const bytes = static_cast<double>(memory_in_use() - before) / n;
    double const row = static_cast<double>(mapper.weights().size()) / n;

    // All are looked for, as if all had moved far enough for that.
    auto const locate_all = [&]
    {
        mapper.take_cells(scene.cells);
        mapper.locate(scene.particles, wall_faces);
    };
    double const locate = least_seconds(options, locate_all);
    double const weights = least_seconds(options, [&] { mapper.compute_weights(scene.particles); });
    double const summing = least_seconds(options, [&] { mapper.sum_into_cells(scene.particles, impulses, sums); });
    fmt::print("{},{},{:.4g},{},{},{:.5g},{:.5g},{:.5g},{:.5g},{:.4g},{:.5g}\n", name, scene.mesh.cell_count(),
               scene.one.ratio(), scene.particles.count(), options.threads, 1e9 * locate / n, 1e9 * weights / n,
               1e9 * summing / n, 1e3 * (locate + weights + summing), row, bytes);
    std::fflush(stdout);
}

}  // namespace gimdem::benchmark

namespace
{

using namespace gimdem::benchmark;

void run(SpeedOptions const& options)
{
    SpeedScene const scene(options);
    fmt::print(
        "method,cells,ratio,particles,threads,locate_ns,weights_ns,sums_ns,step_ms,weights_per_particle,"
        "bytes_per_particle\n");
    for_each_method(
        options.common, [&](std::string const& name)
        { options.device == "cuda" ? measure_on_gpu(name, scene, options) : measure(name, scene, options); });
}

}  // namespace

int main(int argc, char** argv)
{
    SpeedOptions options;
    CLI::App app("Time and memory of mapping methods on one mesh, as CSV");
    add_common_options(app, options.common);
    app.add_option("--count", options.count, "particles")->check(CLI::Range(1, 100'000'000));
    app.add_option("--device", options.device, "where")->check(CLI::IsMember({"cpu", "cuda"}));
    app.add_option("--threads", options.threads, "threads")->check(CLI::Range(1, 1024));
    app.add_option("--repeats", options.repeats, "at least so many calls of each stage; the least time is told");
    app.add_option("--seconds", options.seconds, "calls are added up to this time [s]");
    CLI11_PARSE(app, argc, argv);
    return guarded("mapping_speed", [&] { run(options); });
}
