// SPDX-License-Identifier: BSD-3-Clause
/// Time and memory of a DEM step: a bed in the box of cases/wachem-bed without its fluid, a gas of beads, and scenes
/// with one feature more or less. `./gimdem bench dem` calls it; --help tells the options. Prints figures.
#include <fmt/format.h>
#include <malloc.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <optional>

#include "DataFile.hpp"
#include "DemScene.hpp"
#include "Drag.hpp"
#include "MemoryInUse.hpp"
#include "engine/DemSystem.hpp"
#include "engine/device/DeviceDem.hpp"
#include "search/PairSprings.hpp"

namespace
{

using gimdem::benchmark::memory_in_use;

std::size_t peak = 0;  ///< of memory_in_use(), as far as arrays grew [B]

}  // namespace

/// In place of the C library's: whatever holds much memory is a Buffer, and gets it here.
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
    void* const memory = memalign(alignment, size);
#pragma omp critical
    peak = std::max(peak, memory_in_use());
    return memory;
}

namespace
{

using namespace gimdem;

struct Options
{
    benchmark::SceneOptions scene;
    std::string write, device = "cpu";
    int steps = 1000, warm_up = 500, rebuilds = 0, threads = 1;
    double dt = 2e-5;
};

double kinetic_energy(ParticleState const& p)
{
    double sum = 0;
    for (std::int64_t i = 0; i < p.count(); ++i)
        sum += p.mass(i) * p.velocity[i].xyz().squaredNorm() / 2;
    return sum;
}

double count_contacts(NeighborList const& list)
{
    double sum = 0;
    auto const touches = touches_of_pairs(list);
    for (std::uint8_t const touch : touches.host())
        sum += touch;
    return sum;
}

/// Waits for a device to finish its steps.
void finish(DemSystem& system)
{
    if (DeviceDem* const device = system.device()) device->finish();
}

/// Time of work() called `count` times [s].
template <class Work>
double seconds_of(int count, DemSystem& system, Work const& work)
{
    finish(system);
    auto const start = std::chrono::steady_clock::now();
    for (int k = 0; k < count; ++k)
        work();
    finish(system);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_state(DemSystem const& system, std::size_t bytes, std::size_t peak_bytes)
{
    auto const n = static_cast<double>(system.particles().count());
    fmt::print("figure: dem_pairs_per_particle = {:.4g} [1]\n", double(system.neighbors().pair_count()) / n);
    fmt::print("figure: dem_contacts_per_particle = {:.4g} [1]\n", count_contacts(system.neighbors()) / n);
    fmt::print("figure: bytes_per_particle = {:.4g} [B]\n", static_cast<double>(bytes) / n);
    fmt::print("figure: bytes_per_particle_peak = {:.4g} [B]\n", static_cast<double>(peak_bytes) / n);
    fmt::print("figure: dem_kinetic_energy = {:.6g} [J]\n", kinetic_energy(system.particles()));
}

void run(Options const& options)
{
    benchmark::Scene const scene(options.scene);
    std::string const backend = options.device == "cuda" ? "cuda" : options.threads == 1 ? "serial" : "openmp";
    exec::Execution const execution = exec::make_execution(backend, options.threads);
    Materials const materials(scene.settings);
    std::size_t const before = peak = memory_in_use();
    DemSystem system(scene.settings, execution, materials, scene.walls, scene.particles());
    system.prepare();
    std::optional<benchmark::Drag> drag;
    if (options.scene.drag) drag.emplace(scene.settings, execution, scene.mesh, system);
    system.begin_coupling_step(drag ? drag->fluid() : nullptr);
    auto const step = [&] { system.step(options.dt); };
    seconds_of(options.warm_up, system, step);

    std::int64_t const rebuilds = system.rebuilds();
    double const seconds = seconds_of(options.steps, system, step);
    std::int64_t const rebuilt = system.rebuilds() - rebuilds;
    std::size_t const bytes = memory_in_use() - before;
    if (!options.write.empty()) benchmark::write_data(options.write, std::as_const(system).particles(), scene.box);
    auto const n = static_cast<double>(scene.spheres.size());
    fmt::print("figure: dem_particles = {} [1]\n", n);
    fmt::print("figure: dem_threads = {} [1]\n", options.threads);
    fmt::print("figure: dem_ms_per_step = {:.4g} [ms]\n", 1e3 * seconds / options.steps);
    fmt::print("figure: dem_particle_steps_per_second = {:.4g} [1/s]\n", n * options.steps / seconds);
    fmt::print("figure: dem_list_rebuilds = {} [1]\n", rebuilt);
    print_state(system, bytes, peak - before);
    if (options.rebuilds == 0) return;
    double const of_lists = seconds_of(options.rebuilds, system, [&] { system.rebuild(); });
    fmt::print("figure: dem_ms_per_rebuild = {:.4g} [ms]\n", 1e3 * of_lists / options.rebuilds);
}

void add_options(CLI::App& app, Options& options)
{
    benchmark::SceneOptions& scene = options.scene;
    app.add_option("--data", scene.data, "initial state, a data file of LAMMPS");
    app.add_option("--write", options.write, "keep the last state");
    app.add_option("--steps", options.steps, "timed steps");
    app.add_option("--warm-up", options.warm_up, "steps before");
    app.add_option("--rebuilds", options.rebuilds, "timed buildings of the list, with forces, after the steps");
    app.add_option("--threads", options.threads, "threads");
    app.add_option("--device", options.device, "where the particles are")->check(CLI::IsMember({"cpu", "cuda"}));
    app.add_option("--precision", scene.precision, "of the contact laws")->check(CLI::IsMember({"double", "mixed"}));
    app.add_option("--dt", options.dt, "time step [s]");
    app.add_option("--start", scene.start, "without --data")->check(CLI::IsMember({"lattice", "random"}));
    app.add_option("--count", scene.count, "particles of the start");
    app.add_option("--box", scene.box, "sides of the box [m]")->expected(3);
    app.add_option("--tiles", scene.tiles, "copies of state and box along x and y")->expected(2);
    app.add_option("--spacing", scene.spacing, "of the lattice [m]");
    app.add_option("--jitter", scene.jitter, "of the lattice [m]");
    app.add_option("--speed", scene.speed, "deviation of random velocities to begin with [m/s]");
    app.add_option("--sides", scene.sides, "walls but for the top, all walls, x and y periodic, all periodic, none")
        ->check(CLI::IsMember({"walls", "closed", "floor", "periodic", "none"}));
    app.add_option("--gravity", scene.gravity, "[m/s^2]");
    app.add_option("--law", scene.law, "contact_law of a case file");
    app.add_option("--rolling", scene.rolling, "rolling_friction of a case file");
    app.add_option("--cohesion", scene.cohesion, "cohesion of a case file");
    app.add_option("--restitution", scene.restitution, "of all contacts");
    app.add_option("--friction", scene.friction, "of all contacts");
    app.add_option("--materials", scene.materials, "kinds of particles, all with the same constants");
    app.add_option("--size-step", scene.size_step, "every second particle is smaller by this share");
    app.add_option("--size-ratio", scene.size_ratio, "largest to smallest diameter of a random start");
    app.add_option("--skin", scene.skin, "of the neighbour list, in smallest radii");
    app.add_flag("--drag", scene.drag, "drag by air at rest");
}

}  // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Time of a DEM step");
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try
    {
        if (options.scene.drag && options.device == "cuda")
            throw std::runtime_error("--drag is for the processor alone");
        run(options);
    }
    catch (std::exception const& error)
    {
        fmt::print(stderr, "benchmark_dem: error: {}\n", error.what());
        return 1;
    }
}
