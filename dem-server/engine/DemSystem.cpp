// SPDX-License-Identifier: BSD-3-Clause
#include "engine/DemSystem.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "exec/ForEach.hpp"
#include "integrate/VelocityVerlet.hpp"
#include "particles/SizeDistribution.hpp"

namespace gimdem
{

DemSystem::DemSystem(Case const& settings, exec::Execution execution, Materials const& materials,
                     WallGeometry const& walls, ParticleState particles)
    : execution_(execution),
      gravity_{settings.dem.gravity[0], settings.dem.gravity[1], settings.dem.gravity[2]},
      particles_(std::move(particles)),
      search_(execution, settings.dem.skin * smallest_radius(settings, particles_)),
      particle_contacts_(execution, materials),
      wall_contacts_(execution, materials, materials.number_of(settings.walls.material), walls)
{
    for (std::int64_t const id : particles_.id.host())
        next_id_ = std::max(next_id_, id + 1);
    impulses_.resize(particles_.count());
    impulses_.fill({});
}

void DemSystem::prepare()
{
    update_neighbors();
    sum_contact_forces(0);
}

void DemSystem::begin_coupling_step(FluidOnParticles const* fluid)
{
    fluid_ = fluid;
    impulses_.fill({});
    update_fluid_loads();
}

Vec3 DemSystem::steady_fluid_force() const
{
    Vec3 sum = Vec3::Zero();
    for (FluidLoad const& load : loads_.host())
        sum += load.steady.xyz();
    return sum;
}

void DemSystem::take_impulses_of_one_second()
{
    for (std::int64_t i = 0; i < particles_.count(); ++i)
    {
        double const k = loads_[i].fluid_velocity.w;
        impulses_[i].drag = Quad::of(k * (loads_[i].fluid_velocity.xyz() - particles_.velocity[i].xyz()), k);
    }
}

void DemSystem::step(double dt)
{
    half_kick(dt / 2);
    drift(dt);
    update_neighbors();
    sum_contact_forces(dt);
    update_fluid_loads();
    half_kick(dt / 2);
}

void DemSystem::half_kick(double h)
{
    exec::for_each(execution_, particles_.count(),
                   HalfKick{particles_.view(), wall_contacts_.force_on_particles().view().data,
                            fluid_ == nullptr ? nullptr : loads_.view().data, impulses_.view().data, gravity_, h});
}

void DemSystem::drift(double dt)
{
    exec::for_each(execution_, particles_.count(), Drift{particles_.view(), dt});
}

void DemSystem::update_neighbors()
{
    if (!search_.is_stale(particles_, neighbors_)) return;
    auto const order = search_.build(particles_, neighbors_);
    wall_contacts_.build(particles_, search_.skin(), order);
    permute(impulses_, order);
    if (on_permutation_) on_permutation_(order);
    ++rebuilds_;
}

void DemSystem::sum_contact_forces(double dt)
{
    particle_contacts_.sum_forces(particles_, neighbors_, dt);
    wall_contacts_.add_forces(particles_, dt);
}

void DemSystem::update_fluid_loads()
{
    if (fluid_ != nullptr)
        fluid_->forces.apply(particles_, fluid_->mesh, fluid_->cell_of, fluid_->void_fraction, loads_);
}

double smallest_radius(ParticleState const& particles)
{
    double radius = particles.count() > 0 ? std::numeric_limits<double>::infinity() : 0;
    for (Quad const& x : particles.position.host())
        radius = std::min(radius, x.w);
    return radius;
}

double largest_radius(ParticleState const& particles)
{
    double radius = 0;
    for (Quad const& x : particles.position.host())
        radius = std::max(radius, x.w);
    return radius;
}

double smallest_radius(Case const& settings, ParticleState const& particles)
{
    double radius = smallest_radius(particles);
    for (InletSettings const& inlet : settings.inlets)
    {
        double const least = SizeDistribution(inlet.diameter, inlet.sizes).smallest() / 2;
        radius = radius > 0 ? std::min(radius, least) : least;
    }
    return radius;
}

double largest_radius(Case const& settings, ParticleState const& particles)
{
    double radius = largest_radius(particles);
    for (InletSettings const& inlet : settings.inlets)
        radius = std::max(radius, SizeDistribution(inlet.diameter, inlet.sizes).largest() / 2);
    return radius;
}

}  // namespace gimdem
