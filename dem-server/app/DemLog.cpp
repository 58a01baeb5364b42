// SPDX-License-Identifier: BSD-3-Clause
#include "app/DemLog.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "app/LogParts.hpp"
#include "engine/BedMonitors.hpp"

namespace gimdem::app
{

namespace
{

using Clock = std::chrono::steady_clock;

std::vector<output::Column> const columns{
    {"time", "s"},           {"particles", "1"},          {"bed_height", "m"},
    {"centre_of_mass", "m"}, {"speed_max", "m/s"},        {"kinetic_energy", "J"},
    {"wall_force", "N"},     {"particles_inserted", "1"}, {"particles_removed", "1"},
    {"mass_removed", "kg"}};

double kinetic_energy(ParticleState const& particles)
{
    double sum = 0;
    for (std::int64_t i = 0; i < particles.count(); ++i)
        sum += 0.5 * particles.velocity[i].xyz().squaredNorm() / particles.velocity[i].w +
               0.5 * particles.angular_velocity[i].xyz().squaredNorm() / particles.angular_velocity[i].w;
    return sum;
}

double inserted(std::vector<Inlet> const& inlets)
{
    double count = 0;
    for (Inlet const& inlet : inlets)
        count += static_cast<double>(inlet.state().inserted);
    return count;
}

}  // namespace

DemLog::DemLog(Case const& settings, std::filesystem::path const& folder, PolyMesh const& mesh, DemSystem const& system,
               std::vector<Inlet> const& inlets, RunPoint const& start)
    : settings_(settings),
      folder_(folder),
      mesh_(mesh),
      system_(system),
      inlets_(inlets),
      start_(start),
      last_row_(start),
      up_(upward(settings)),
      frames_(folder, mesh.topology()),
      series_(folder / "bed.csv", columns),
      begin_(Clock::now()),
      last_row_at_(begin_)
{
}

void DemLog::write_row(RunPoint const& point)
{
    ParticleState const& particles = system_.particles();
    bool const any = particles.count() > 0;
    Removed const gone = total_removed(system_);
    series_.append(std::vector<double>{
        point.time, static_cast<double>(particles.count()), any ? bed_height(particles, mesh_, up_) : 0,
        any ? centre_of_mass_height(particles, mesh_, up_) : 0, fastest(particles), kinetic_energy(particles),
        system_.walls().total_force().dot(up_), inserted(inlets_), static_cast<double>(gone.count), gone.mass});
    auto const steps = static_cast<double>(std::max<std::int64_t>(1, point.step - last_row_.step));
    double const none = std::numeric_limits<double>::quiet_NaN();
    progress_.show(output::ProgressSample{.time = point.time,
                                          .until = settings_.run.until,
                                          .dem_ms = 1e3 * seconds_since(last_row_at_) / steps,
                                          .cfd_ms = none,
                                          .void_fraction_min = none,
                                          .void_fraction_max = none,
                                          .courant = none,
                                          .speed_max = fastest(particles)});
    last_row_ = point;
    last_row_at_ = Clock::now();
}

void DemLog::write_frame(double time)
{
    with_particle_frame(system_.particles(), time,
                        [&](output::ParticleFrame const& frame) { frames_.write(time, frame, {}); });
}

void DemLog::finish(RunPoint const& point)
{
    progress_.finish();
    double const wall = seconds_since(begin_), simulated = point.time - start_.time;
    auto const steps = static_cast<double>(point.step - start_.step);
    auto const count = static_cast<double>(system_.particles().count());
    summary_.add("simulated_time", simulated, "s");
    summary_.add("dem_steps", steps, "1");
    summary_.add("particles", count, "1");
    summary_.add("particles_inserted", inserted(inlets_), "1");
    add_removed(system_, summary_);
    add_removed_by_cause(system_, summary_);
    for (std::size_t i = 0; i < inlets_.size(); ++i)
        summary_.add("inlet_" + std::to_string(i + 1) + "_mass_owed", inlets_[i].owed(point.time), "kg");
    summary_.add("mass", total_mass(system_.particles()), "kg");
    summary_.add("kinetic_energy", kinetic_energy(system_.particles()), "J");
    if (count > 0)
    {
        summary_.add("bed_height", bed_height(system_.particles(), mesh_, up_), "m");
        summary_.add("centre_of_mass", centre_of_mass_height(system_.particles(), mesh_, up_), "m");
    }
    summary_.add("wall_time", wall, "s");
    if (simulated > 0) summary_.add("wall_time_per_simulated_second", wall / simulated, "s");
    summary_.print(std::cout);
    std::cout.flush();
    summary_.write(folder_ / "summary.json");
}

}  // namespace gimdem::app
