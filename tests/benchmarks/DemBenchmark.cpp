// SPDX-License-Identifier: BSD-3-Clause
/// Time and memory of a DEM step of a bed of 1.545 mm beads in the box of cases/wachem-bed, no fluid.
///
///   benchmark_dem [--data FILE] [--write FILE] [--steps N] [--warm-up N] [--threads N] [--device cpu|cuda] [--dt S]
///                 [--precision double|mixed] [--skin K] [--count N] [--box X Y Z]
///
/// FILE: particles in the format of LAMMPS (id type diameter density x y z, then Velocities), so that other programs
/// can start from the same state; without it, a lattice that falls. Prints figures.
#include <fmt/format.h>
#include <malloc.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "engine/DemSystem.hpp"
#include "engine/device/DeviceDem.hpp"
#include "particles/Insertion.hpp"

namespace
{

/// Memory that the program holds at present, what it gave back excluded [B].
std::size_t memory_in_use()
{
    struct mallinfo2 const all = mallinfo2();
    return all.uordblks + all.hblkhd;  // small blocks, and those with pages of their own
}

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
    std::string data, write, device = "cpu", precision = "double";
    int steps = 1000, warm_up = 500, threads = 1;
    double dt = 2e-5, skin = 0.3;
    std::int64_t count = 17'563;
    std::vector<double> box{0.09, 0.008, 0.5};
};

/// The lattice of cases/wachem-bed: what falls becomes an irregular bed.
InsertionSettings lattice(std::vector<double> const& box, std::int64_t count)
{
    InsertionSettings lattice;
    lattice.material = "bead";
    lattice.diameter = 1.545e-3;
    lattice.count = count;
    lattice.box = {{{0, 0, 0}, {box[0], box[1], box[2]}}};
    lattice.spacing = 1.65e-3;
    lattice.jitter = 2e-5;
    return lattice;
}

/// Sections "Atoms" and "Velocities" of a data file; throws for anything that cannot be read.
std::vector<test::Sphere> read_data(std::string const& path)
{
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::vector<test::Sphere> spheres;
    std::string line, section;
    while (std::getline(file, line))
    {
        std::istringstream words(line);
        std::string first;
        if (!(words >> first)) continue;
        if (first == "Atoms" || first == "Velocities")
        {
            section = first;
            continue;
        }
        if (section.empty()) continue;
        auto const id = std::stoul(first);
        if (spheres.size() < id) spheres.resize(id);
        test::Sphere& s = spheres[id - 1];
        double type, diameter, density;
        if (section == "Atoms")
        {
            words >> type >> diameter >> density >> s.position[0] >> s.position[1] >> s.position[2];
            s.radius = diameter / 2;
        }
        else
            for (Vec3* v : {&s.velocity, &s.angular_velocity})
                words >> (*v)[0] >> (*v)[1] >> (*v)[2];
        if (!words) throw std::runtime_error(path + ": cannot read \"" + line + "\"");
    }
    return spheres;
}

/// By rising id, as read_data() reads it.
void write_data(std::string const& path, ParticleState const& p, std::vector<double> const& box)
{
    std::vector<std::int64_t> place(static_cast<std::size_t>(p.count()));
    for (std::int64_t i = 0; i < p.count(); ++i)
        place[static_cast<std::size_t>(p.id[i])] = i;
    std::ofstream file(path);
    file << fmt::format("settled bed\n\n{} atoms\n1 atom types\n\n", p.count());
    for (std::size_t axis = 0; axis < 3; ++axis)
        file << fmt::format("0 {:.17g} {}lo {}hi\n", box[axis], "xyz"[axis], "xyz"[axis]);
    file << "\nAtoms\n\n";
    for (std::size_t k = 0; k < place.size(); ++k)
    {
        Quad const x = p.position[place[k]];
        file << fmt::format("{} 1 {:.17g} 1150 {:.17g} {:.17g} {:.17g}\n", k + 1, 2 * x.w, x.x, x.y, x.z);
    }
    file << "\nVelocities\n\n";
    for (std::size_t k = 0; k < place.size(); ++k)
    {
        Quad const v = p.velocity[place[k]], w = p.angular_velocity[place[k]];
        file << fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", k + 1, v.x, v.y, v.z, w.x, w.y,
                            w.z);
    }
    file.flush();
    if (!file) throw std::runtime_error("cannot write " + path);
}

double kinetic_energy(ParticleState const& p)
{
    double sum = 0;
    for (std::int64_t i = 0; i < p.count(); ++i)
        sum += p.mass(i) * p.velocity[i].xyz().squaredNorm() / 2;
    return sum;
}

/// Waits for a device to finish its steps.
void finish(DemSystem& system)
{
    if (DeviceDem* const device = system.device()) device->finish();
}

void run(Options const& options)
{
    Case settings = test::bead_case(0.9, 0.3);
    settings.dem.gravity = {0, 0, -9.81};
    settings.dem.skin = options.skin;
    settings.dem.precision = options.precision;
    std::string const backend = options.device == "cuda" ? "cuda" : options.threads == 1 ? "serial" : "openmp";
    exec::Execution const execution = exec::make_execution(backend, options.threads);
    Materials const materials(settings);
    PolyMesh const mesh(test::BoxMesh::make({1, 1, 1}, {options.box[0], options.box[1], options.box[2]}));
    WallGeometry const walls(mesh, {"bottom"}, 0.9e-3);
    settings.insertion = {lattice(options.box, options.count)};
    std::size_t const before = peak = memory_in_use();
    DemSystem system(
        settings, execution, materials, walls,
        options.data.empty() ? insert_particles(settings, materials) : test::particles_of(read_data(options.data)));
    system.prepare();
    system.begin_coupling_step(nullptr);
    for (int s = 0; s < options.warm_up; ++s)
        system.step(options.dt);

    std::int64_t const rebuilds = system.rebuilds();
    finish(system);
    auto const start = std::chrono::steady_clock::now();
    for (int s = 0; s < options.steps; ++s)
        system.step(options.dt);
    finish(system);
    double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    auto const n = static_cast<double>(system.particles().count());
    auto const bytes = static_cast<double>(memory_in_use() - before);
    if (!options.write.empty()) write_data(options.write, system.particles(), options.box);
    fmt::print("figure: dem_particles = {} [1]\n", n);
    fmt::print("figure: dem_threads = {} [1]\n", options.threads);
    fmt::print("figure: dem_ms_per_step = {:.4g} [ms]\n", 1e3 * seconds / options.steps);
    fmt::print("figure: dem_particle_steps_per_second = {:.4g} [1/s]\n", n * options.steps / seconds);
    fmt::print("figure: dem_list_rebuilds = {} [1]\n", system.rebuilds() - rebuilds);
    fmt::print("figure: dem_pairs_per_particle = {:.4g} [1]\n", double(system.neighbors().pair_count()) / n);
    fmt::print("figure: bytes_per_particle = {:.4g} [B]\n", bytes / n);
    fmt::print("figure: bytes_per_particle_peak = {:.4g} [B]\n", static_cast<double>(peak - before) / n);
    fmt::print("figure: dem_kinetic_energy = {:.6g} [J]\n", kinetic_energy(system.particles()));
}

}  // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Time of a DEM step");
    app.add_option("--data", options.data, "initial state");
    app.add_option("--write", options.write, "keep the last state");
    app.add_option("--steps", options.steps, "timed steps");
    app.add_option("--warm-up", options.warm_up, "steps before");
    app.add_option("--threads", options.threads, "threads");
    app.add_option("--device", options.device, "where the particles are")->check(CLI::IsMember({"cpu", "cuda"}));
    app.add_option("--precision", options.precision, "of the contact laws")->check(CLI::IsMember({"double", "mixed"}));
    app.add_option("--dt", options.dt, "time step [s]");
    app.add_option("--skin", options.skin, "of the neighbour list, in radii");
    app.add_option("--count", options.count, "particles of the lattice");
    app.add_option("--box", options.box, "sides of the box [m]")->expected(3);
    CLI11_PARSE(app, argc, argv);
    try
    {
        run(options);
    }
    catch (std::exception const& error)
    {
        fmt::print(stderr, "benchmark_dem: error: {}\n", error.what());
        return 1;
    }
}
