// SPDX-License-Identifier: BSD-3-Clause
/// Time and memory of mapping methods on one mesh, as rows of CSV. `./gimdem bench mapping` calls it; --help tells the
/// options.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>

#include "MappingOptions.hpp"
#include "MemoryInUse.hpp"
#include "MeshCopies.hpp"
#include "mapping/Mapper.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::benchmark;

struct Options
{
    CommonOptions common;
    std::int64_t count = bed_count;
    int threads = 1, repeats = 3;
    double seconds = 0.3;
};

/// Particles at a solid fraction of 0.4 on cells that hold them all: a larger box of a mesh that is made here, copies
/// of any other.
struct SpeedScene
{
    explicit SpeedScene(Options const& options)
        : one({options.common.mesh, options.common.ratio, width_of(options), 1}), mesh(one.mesh.topology())
    {
        auto const in_one = one.packing(options.count, 4);
        auto const copies = static_cast<int>((options.count - 1) / std::ssize(in_one)) + 1;
        double const spacing = 1.5 * (one.box.high.x() - one.box.low.x());
        if (copies > 1) mesh = PolyMesh(copies_of(one.mesh.topology(), copies, spacing));
        std::vector<test::Sphere> spheres;
        for (int copy = 0; copy < copies; ++copy)
            for (test::Sphere sphere : in_one)
            {
                sphere.position.x() += copy * spacing;
                spheres.push_back(sphere);
            }
        spheres.resize(static_cast<std::size_t>(options.count));
        particles = test::particles_of(spheres);
        find_cells(in_one);
    }

    MappingScene one;
    PolyMesh mesh;
    ParticleState particles;
    exec::Buffer<std::int32_t> cells;  ///< of the particles: no walk leads from one copy to another

private:
    static double width_of(Options const& options)
    {
        return std::cbrt(static_cast<double>(options.count) * (M_PI / 6) / solid_fraction) * (1 + 1e-9);
    }

    /// Those of one copy, and as many cells further on for each further one.
    void find_cells(std::vector<test::Sphere> const& in_one)
    {
        MappingSettings settings;
        settings.method = "pcm";
        Mapper mapper(test::serial, one.mesh, settings);
        exec::Buffer<std::uint8_t> wall_faces(one.mesh.face_count());
        wall_faces.fill(1);
        mapper.locate(test::particles_of(in_one), wall_faces);
        cells.resize(particles.count());
        for (std::int64_t p = 0; p < particles.count(); ++p)
        {
            auto const copy = static_cast<std::int32_t>(p / std::ssize(in_one));
            cells[p] = mapper.cell_of()[p % std::ssize(in_one)] + copy * one.mesh.cell_count();
        }
    }
};

/// Least time of work() in `repeats` calls, and in as many as fit in `seconds`: what else the machine does only adds.
template <class Work>
double least_seconds(Options const& options, Work const& work)
{
    using Clock = std::chrono::steady_clock;
    double least = 1e300, total = 0;
    for (int k = 0; k < options.repeats || total < options.seconds; ++k)
    {
        auto const start = Clock::now();
        work();
        double const seconds = std::chrono::duration<double>(Clock::now() - start).count();
        least = std::min(least, seconds);
        total += seconds;
    }
    return least;
}

void measure(std::string const& name, SpeedScene const& scene, Options const& options)
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

void run(Options const& options)
{
    SpeedScene const scene(options);
    fmt::print(
        "method,cells,ratio,particles,threads,locate_ns,weights_ns,sums_ns,step_ms,weights_per_particle,"
        "bytes_per_particle\n");
    for_each_method(options.common, [&](std::string const& name) { measure(name, scene, options); });
}

}  // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Time and memory of mapping methods on one mesh, as CSV");
    add_common_options(app, options.common);
    app.add_option("--count", options.count, "particles")->check(CLI::Range(1, 100'000'000));
    app.add_option("--threads", options.threads, "threads")->check(CLI::Range(1, 1024));
    app.add_option("--repeats", options.repeats, "at least so many calls of each stage; the least time is told");
    app.add_option("--seconds", options.seconds, "calls are added up to this time [s]");
    CLI11_PARSE(app, argc, argv);
    return guarded("mapping_speed", [&] { run(options); });
}
