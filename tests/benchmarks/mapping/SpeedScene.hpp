// SPDX-License-Identifier: BSD-3-Clause
/// Particles and cells that mapping methods are timed on, and the way they are timed.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "MappingOptions.hpp"
#include "MeshCopies.hpp"
#include "mapping/Mapper.hpp"

namespace gimdem::benchmark
{

struct SpeedOptions
{
    CommonOptions common;
    std::int64_t count = bed_count;
    std::string device = "cpu";  ///< or cuda
    int threads = 1, repeats = 3;
    double seconds = 0.3;
};

/// Particles at a solid fraction of 0.4 on cells that hold them all: a larger box of a mesh that is made here, copies
/// of any other.
struct SpeedScene
{
    explicit SpeedScene(SpeedOptions const& options)
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
    static double width_of(SpeedOptions const& options)
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
double least_seconds(SpeedOptions const& options, Work const& work)
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

/// One row of the table, and one of the same columns on a GPU, where weights are computed twice within the sums.
void measure(std::string const& method, SpeedScene const& scene, SpeedOptions const& options);
void measure_on_gpu(std::string const& method, SpeedScene const& scene, SpeedOptions const& options);

}  // namespace gimdem::benchmark
