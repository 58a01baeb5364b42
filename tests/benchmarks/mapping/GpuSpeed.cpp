// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <vector>

#include "SpeedScene.hpp"
#include "engine/CoupledEngine.hpp"

namespace gimdem::benchmark
{

namespace
{

/// Air that rises through the particles: every one of them has a drag to be shared out.
coupling::FluidFields rising_air(std::vector<double>& velocity, std::int32_t cells)
{
    velocity.assign(3 * static_cast<std::size_t>(cells), 0.5);
    coupling::FluidFields fluid;
    fluid.velocity = velocity;
    return fluid;
}

}  // namespace

void measure_on_gpu(std::string const& method, SpeedScene const& scene, SpeedOptions const& options)
{
    Case settings = test::bead_case(0.9, 0.3);
    settings.fluid_forces.drag = "beetstra";
    settings.mapping.method = method;
    exec::Execution const execution = exec::make_execution("cuda", 1);
    Materials const materials(settings);
    WallGeometry const walls(scene.mesh, {}, diameter);
    DemSystem system(settings, execution, materials, walls, ParticleState(scene.particles));
    system.prepare();
    CoupledEngine engine(settings, execution, scene.mesh, walls, {1.2, 1.8e-5}, system);
    engine.map_initial_state();
    DeviceDem& device = *system.device();
    std::vector<double> velocity;
    device.load_fluid(rising_air(velocity, scene.mesh.cell_count()));
    CellSums sums;
    bool all_are_inside = true;
    double const locate = least_seconds(options,
                                        [&]
                                        {
                                            all_are_inside = device.locate() && all_are_inside;
                                            device.finish();
                                        });
    double const summing = least_seconds(options,
                                         [&]
                                         {
                                             device.sum_into_cells(sums);
                                             device.finish();
                                         });
    if (!all_are_inside) throw UserError("a particle of the benchmark is outside the mesh (a fault of the benchmark)");
    auto const n = static_cast<double>(scene.particles.count());
    fmt::print("{},{},{:.4g},{},gpu,{:.5g},nan,{:.5g},{:.5g},nan,nan\n", method, scene.mesh.cell_count(),
               scene.one.ratio(), scene.particles.count(), 1e9 * locate / n, 1e9 * summing / n,
               1e3 * (locate + summing));
    std::fflush(stdout);
}

}  // namespace gimdem::benchmark
