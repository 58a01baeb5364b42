// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/methods/GaussianMethod.hpp"

#include <cmath>
#include <numbers>

#include "mapping/CurveKernel.hpp"

namespace gimdem
{

GaussianMethod::GaussianMethod(PolyMesh const& mesh, double fixed_coefficient)
    : mesh_(mesh),
      layers_(mesh),
      tables_(mesh, fixed_coefficient),
      curves_(mesh, fixed_coefficient),
      fixed_coefficient_(fixed_coefficient)
{
    cell_sizes_.resize(mesh.cell_count());
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        double const radius = std::cbrt(3 / (4 * std::numbers::pi) * mesh.volume(c));
        cell_sizes_[c] = {radius, std::log(radius), std::pow(radius, -3 * 0.132), 1 / radius};
    }
}

void GaussianMethod::compute_weights(WeightTask const& task)
{
    auto const compute = [&]<class Integrals>(typename Integrals::Source source)
    {
        exec::for_each_uneven(task.execution, task.occupied.size(),
                              WeightKernel<Integrals>{task.occupied.view().data, task.particles.position.view().data,
                                                      mesh_.view().cell, task.rows, source, task.weights});
    };
    if (tables_.provide(task.particles))
        compute.operator()<TabulatedIntegrals>({tables_.view(), tables_.curves().view().data});
    else if (curves_.provide(task))
        exec::for_each_uneven(task.execution, task.occupied.size(),
                              CurveKernel{task.occupied.view().data,
                                          task.particles.position.view().data,
                                          mesh_.view().cell,
                                          task.rows,
                                          curves_.view(),
                                          {cell_sizes_.view().data, fixed_coefficient_},
                                          task.weights});
    else
        compute.operator()<ClosedFormIntegrals>({cell_sizes_.view().data, fixed_coefficient_});
}

}  // namespace gimdem
