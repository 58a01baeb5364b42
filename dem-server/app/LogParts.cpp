// SPDX-License-Identifier: BSD-3-Clause
#include "app/LogParts.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace gimdem::app
{

namespace
{

/// xyz of quads as n * 3 doubles.
std::vector<double> triples(exec::Buffer<Quad> const& quads)
{
    std::vector<double> out;
    out.reserve(3 * static_cast<std::size_t>(quads.size()));
    for (Quad const& q : quads.host())
        out.insert(out.end(), {q.x, q.y, q.z});
    return out;
}

}  // namespace

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void with_particle_frame(ParticleState const& particles, double time,
                         std::function<void(output::ParticleFrame const&)> const& write)
{
    auto const position = triples(particles.position);
    auto const velocity = triples(particles.velocity);
    auto const angular_velocity = triples(particles.angular_velocity);
    std::vector<double> radius;
    for (Quad const& x : particles.position.host())
        radius.push_back(x.w);
    write({.time = time,
           .position = position,
           .radius = radius,
           .velocity = velocity,
           .angular_velocity = angular_velocity,
           .id = particles.id.host()});
}

Removed total_removed(DemSystem const& system)
{
    Removed all;
    for (auto const& [cause, removed] : system.removed())
    {
        all.count += removed.count;
        all.mass += removed.mass;
    }
    return all;
}

void add_removed(DemSystem const& system, output::Summary& summary)
{
    Removed const gone = total_removed(system);
    summary.add("particles_removed", static_cast<double>(gone.count), "1");
    summary.add("particles_lost", static_cast<double>(lost_particles(system)), "1");
    summary.add("mass_removed", gone.mass, "kg");
}

void add_removed_by_cause(DemSystem const& system, output::Summary& summary)
{
    for (auto const& [cause, removed] : system.removed())
    {
        std::string name = "removed " + cause;
        std::replace(name.begin(), name.end(), ' ', '_');
        summary.add(name, static_cast<double>(removed.count), "1");
    }
}

double monitor(coupling::FluidState const& fluid, std::string const& name)
{
    for (coupling::Monitor const& m : fluid.monitors)
        if (m.name == name) return m.value;
    return coupling::not_known;
}

}  // namespace gimdem::app
