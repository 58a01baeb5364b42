// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "core/Error.hpp"
#include "core/MappingMethodNames.hpp"
#include "mapping/Method.hpp"
#include "mapping/methods/Diffusion.hpp"
#include "mapping/methods/DividedVolume.hpp"
#include "mapping/methods/ExactOverlap.hpp"
#include "mapping/methods/FaceSoftIntersection.hpp"
#include "mapping/methods/GaussianKernel.hpp"
#include "mapping/methods/GaussianMethod.hpp"
#include "mapping/methods/ParticleCentre.hpp"
#include "mapping/methods/PowerDiagram.hpp"

namespace gimdem
{

std::unique_ptr<Method> make_method(MappingSettings const& settings, exec::Execution const& execution,
                                    PolyMesh const& mesh)
{
    std::string const& name = settings.method;
    if (name == "gim") return std::make_unique<GaussianMethod>(mesh);
    if (name == "gim-fixed") return std::make_unique<GaussianMethod>(mesh, settings.coefficient);
    if (name == "pcm") return std::make_unique<ParticleCentre>(mesh);
    if (name == "divided") return std::make_unique<DividedVolume>(execution, mesh, settings.points);
    if (name == "fbsi") return std::make_unique<FaceSoftIntersection>(execution, mesh);
    if (name == "kernel") return std::make_unique<GaussianKernel>(execution, mesh, settings.bandwidth);
    if (name == "diffusion") return std::make_unique<Diffusion>(execution, mesh, settings.bandwidth);
    if (name == "exact") return std::make_unique<ExactOverlap>(execution, mesh);
    if (name == "power-diagram") return std::make_unique<PowerDiagram>(execution, mesh);
    throw UserError(
        fmt::format("mapping method \"{}\" does not exist (it is the name of a file of mapping/methods); "
                    "take one of {}",
                    name, fmt::join(mapping_method_names, ", ")));
}

}  // namespace gimdem
