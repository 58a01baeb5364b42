// SPDX-License-Identifier: BSD-3-Clause
/// Time of the mapping's parts for 17,563 particles on Grid B of cases/wachem-bed, and of the weights of each method on
/// cubic cells at a/dp = 1.76, on one thread.
#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "BoxMesh.hpp"
#include "TestCase.hpp"
#include "core/MappingMethodNames.hpp"
#include "mapping/Mapper.hpp"

namespace
{

using namespace gimdem;

constexpr double radius = 0.7725e-3;

/// Particles in the lower part of the bed, in the order that the neighbour search would give them.
ParticleState bed(double smallest, double largest)
{
    auto spheres = test::random_spheres(17'563, {0, 0, 0}, {0.09, 0.008, 0.08}, smallest, largest);
    std::ranges::sort(spheres, {}, [](auto const& s) { return std::floor(s.position.z() / 2e-3) + s.position.x(); });
    return test::particles_of(spheres);
}

struct GridB
{
    explicit GridB(double largest) : particles(bed(radius, largest)), mapper(test::serial, mesh)
    {
        wall_faces.resize(mesh.face_count());
        wall_faces.fill(0);
        impulses.resize(particles.count());
        impulses.fill({{1e-9, 2e-9, 3e-9, 1e-9}});
        mapper.locate(particles, wall_faces);
        mapper.compute_weights(particles);
    }

    PolyMesh mesh{test::BoxMesh::make({26, 2, 140}, {0.09, 0.008, 0.5})};
    ParticleState particles;
    exec::Buffer<std::uint8_t> wall_faces;
    exec::Buffer<Impulse> impulses;
    Mapper mapper;
    CellSums sums;
};

template <class Work>
void time_per_particle(benchmark::State& state, double largest, Work work)
{
    GridB grid(largest);
    for (auto _ : state)
        work(grid);
    state.counters["us_per_particle"] =
        benchmark::Counter(1e-6 * double(grid.particles.count()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void locate(GridB& grid)
{
    grid.mapper.locate(grid.particles, grid.wall_faces);
}
void weights(GridB& grid)
{
    grid.mapper.compute_weights(grid.particles);
}
void sums(GridB& grid)
{
    grid.mapper.sum_into_cells(grid.particles, grid.impulses, grid.sums);
}

}  // namespace

BENCHMARK_CAPTURE(time_per_particle, locate, radius, locate)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(time_per_particle, weights_from_tables, radius, weights)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(time_per_particle, weights_closed_form, 1.01 * radius, weights)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(time_per_particle, sums, radius, sums)->Unit(benchmark::kMillisecond);

namespace
{

/// 10,000 particles among 20^3 cubic cells of the edge a.
struct CubicCells
{
    explicit CubicCells(std::string_view method)
        : particles(test::particles_of(test::random_spheres(10'000, {0, 0, 0}, {20, 20, 20}, 0.5 / 1.76, 0.5 / 1.76)))
    {
        MappingSettings settings;
        settings.method = method;
        mapper = std::make_unique<Mapper>(test::serial, mesh, settings);
        exec::Buffer<std::uint8_t> wall_faces(mesh.face_count());
        wall_faces.fill(1);
        mapper->locate(particles, wall_faces);
        mapper->compute_weights(particles);
    }

    PolyMesh mesh{test::BoxMesh::make({20, 20, 20}, {20, 20, 20})};
    ParticleState particles;
    std::unique_ptr<Mapper> mapper;
};

void time_method(benchmark::State& state, std::string const& method)
{
    CubicCells cells(method);
    for (auto _ : state)
        cells.mapper->compute_weights(cells.particles);
    std::string name = method + "_us_per_particle";
    std::ranges::replace(name, '-', '_');
    state.counters[name] =
        benchmark::Counter(1e-6 * double(cells.particles.count()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv)
{
    for (std::string_view const method : mapping_method_names)
        benchmark::RegisterBenchmark(fmt::format("method/{}", method).c_str(), time_method, std::string(method))
            ->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
