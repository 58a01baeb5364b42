// SPDX-License-Identifier: BSD-3-Clause
/// Time of the mapping's parts for 17,563 particles on Grid B of cases/wachem-bed, and of the weights of each method on
/// cubic cells at a/dp = 1.76 beside the same computed plainly, on one thread.
#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "BoxMesh.hpp"
#include "PlainMappings.hpp"
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

/// All are looked for, as if all had moved far enough for that.
void locate(GridB& grid)
{
    grid.mapper.take_cells(exec::Buffer<std::int32_t>(grid.mapper.cell_of()));
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

/// What is timed, and what its counters are called.
struct TimedMethod
{
    std::string method, name;
    double spread = 0;          ///< by which radii differ, relatively
    double reuse_distance = 0;  ///< of the case file; 1e-12: everything is renewed
};

/// 10,000 particles among 20^3 cubic cells of the edge a.
struct CubicCells
{
    explicit CubicCells(TimedMethod const& timed)
        : particles(test::particles_of(test::random_spheres(10'000, {0, 0, 0}, {20, 20, 20},
                                                            radius * (1 - timed.spread), radius * (1 + timed.spread))))
    {
        MappingSettings settings;
        settings.method = timed.method;
        settings.reuse_distance = timed.reuse_distance;
        mapper = std::make_unique<Mapper>(test::serial, mesh, settings);
        exec::Buffer<std::uint8_t> wall_faces(mesh.face_count());
        wall_faces.fill(1);
        mapper->locate(particles, wall_faces);
        mapper->compute_weights(particles);
    }

    /// The same weights, one pair after the other.
    template <class Shares>
    void compute_plainly(Shares const& share) const
    {
        CellRows const& rows = mapper->layers();
        double weights[64];
        for (std::int64_t p = 0; p < particles.count(); ++p)
        {
            std::int32_t const c = mapper->cell_of()[p];
            test::plain_weights(share, particles.position[p], rows.cells.view().data + rows.offsets[c],
                                rows.offsets[c + 1] - rows.offsets[c], weights);
            benchmark::DoNotOptimize(weights[0]);
        }
    }

    /// By next to nothing.
    void move()
    {
        for (Quad& x : particles.position.host())
            x.x += 1e-10;
    }

    static constexpr double radius = 0.5 / 1.76;
    PolyMesh mesh{test::BoxMesh::make({20, 20, 20}, {20, 20, 20})};
    ParticleState particles;
    std::unique_ptr<Mapper> mapper;
    overlap::CellFacets facets{mesh};
};

double seconds(auto const& work)
{
    auto const start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compute_plainly(CubicCells const& cells, std::string const& method)
{
    if (method == "gim") cells.compute_plainly(test::PlainGim{cells.mesh.view()});
    if (method == "fbsi") cells.compute_plainly(test::PlainFbsi{cells.mesh.view()});
    if (method == "exact") cells.compute_plainly(test::PlainExact{cells.facets.view()});
}
bool has_plain_form(std::string const& method)
{
    return method == "gim" || method == "fbsi" || method == "exact";
}

/// Counters `name`_us_per_particle and, where the method has a plain form, `name`_speedup_over_scalar: the time of
/// tests/support/PlainMappings.hpp over its own, by turns.
void time_method(benchmark::State& state, TimedMethod const& timed)
{
    CubicCells cells(timed);
    bool const beside = timed.reuse_distance == 0;
    double quick = 0, plain = 0;
    for (auto _ : state)
    {
        cells.move();
        double const time = seconds([&] { cells.mapper->compute_weights(cells.particles); });
        state.SetIterationTime(time);
        quick += time;
        if (beside) plain += seconds([&] { compute_plainly(cells, timed.method); });
    }
    std::string name = timed.name;
    std::ranges::replace(name, '-', '_');
    auto const per_particle = 1e6 / double(state.iterations() * cells.particles.count());
    state.counters[name + "_us_per_particle"] = quick * per_particle;
    if (beside && has_plain_form(timed.method)) state.counters[name + "_speedup_over_scalar"] = plain / quick;
}

void add(TimedMethod const& timed)
{
    benchmark::RegisterBenchmark(fmt::format("method/{}", timed.name).c_str(), time_method, timed)
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
}

}  // namespace

int main(int argc, char** argv)
{
    for (std::string_view const method : mapping_method_names)
        add({std::string(method), std::string(method)});
    for (std::string const method : {"gim", "gim-fixed"})
        add({method, method + "-many-radii", 0.05});  // more than there are tables for
    for (std::string const method : {"gim", "fbsi", "exact"})
    {
        add({method, method + "-reused", 0, 0.02});
        add({method, method + "-renewed", 0, 1e-12});
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
