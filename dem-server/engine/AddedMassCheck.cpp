// SPDX-License-Identifier: BSD-3-Clause
#include "engine/AddedMassCheck.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gimdem
{

std::string note_on_added_mass(double fluid_density, double lightest_particle_density,
                               std::span<double const> void_fraction)
{
    if (void_fraction.empty()) return "";
    double const densest = *std::min_element(void_fraction.begin(), void_fraction.end());
    double const added = fluid_density * (1 - densest) / densest;
    if (added <= lightest_particle_density) return "";
    return fmt::format(
        "the particles are light for this fluid: where the void fraction is {:.3g}, a fluid of {:.4g} kg/m^3 answers "
        "their "
        "acceleration like {:.4g} kg/m^3, and they have {:.4g} kg/m^3; schedules that solve one after the other may "
        "diverge, whatever the time step (docs/theory.md, C.19); [coupling] schedule = \"iterated\" does not",
        densest, fluid_density, added, lightest_particle_density);
}

}  // namespace gimdem
