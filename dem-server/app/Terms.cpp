// SPDX-License-Identifier: BSD-3-Clause
#include "app/Terms.hpp"

#include <string>
#include <vector>

namespace gimdem::app
{

namespace
{

namespace field = coupling::field;

/// The fluid fields that this scene needs, and no other.
std::vector<std::string> needed_fields(Case const& settings)
{
    std::vector<std::string> needs;
    if (settings.fluid_forces.drag != "none")
        needs = {field::velocity, field::velocity_gradient, field::void_fraction_gradient};
    if (settings.fluid_forces.pressure_gradient) needs.emplace_back(field::pressure_gradient);
    OutputSettings const& output = settings.output;
    if (!output.planes.empty() || !output.inlet.empty() || output.particle_interval > 0)
        needs.emplace_back(field::pressure);
    return needs;
}

coupling::Schedule schedule_named(std::string const& name)
{
    if (name == "overlapped") return coupling::Schedule::overlapped;
    return name == "iterated" ? coupling::Schedule::iterated : coupling::Schedule::serial;
}

}  // namespace

coupling::ServerTerms terms_of(Case const& settings)
{
    CouplingSettings const& how = settings.coupling;
    return {.title = settings.title,
            .schedule = schedule_named(how.schedule),
            .end_time = settings.run.until,
            .needs = needed_fields(settings),
            .fluid_steps = static_cast<int>(how.fluid_steps),
            .iteration = {.tolerance = how.tolerance,
                          .max_passes = static_cast<int>(how.max_passes),
                          .relaxation = how.relaxation,
                          .must_converge = how.must_converge}};
}

coupling::Schedule schedule_of(Case const& settings, coupling::ClientInfo const& client)
{
    return client.schedule.value_or(schedule_named(settings.coupling.schedule));
}

}  // namespace gimdem::app
