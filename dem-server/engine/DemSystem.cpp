// SPDX-License-Identifier: BSD-3-Clause
#include "engine/DemSystem.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/PrecisionCheck.hpp"
#include "engine/device/DeviceDem.hpp"
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
      search_(execution, settings.dem.skin * smallest_radius(settings, particles_), Domain::of(settings.domain)),
      particle_contacts_(execution, materials, have_one_size(particles_), Domain::of(settings.domain)),
      wall_contacts_(execution, materials, materials.number_of(settings.walls.material), walls)
{
    check_precision(settings, smallest_radius(settings, particles_));
    for (std::int64_t const id : particles_.id.host())
        next_id_ = std::max(next_id_, id + 1);
    neighbors_.carries_rolling = particle_contacts_.has_rolling_springs();
    device_ = make_device_dem(execution, {settings, materials, walls, wall_contacts_, search_.skin()});
}

DemSystem::~DemSystem() = default;

void DemSystem::prepare()
{
    if (DeviceDem* const there = device()) return refuse_if(!there->prepare());
    update_neighbors();
    sum_contact_forces(0);
}

void DemSystem::begin_coupling_step(FluidOnParticles const* fluid)
{
    if (DeviceDem* const there = device()) return there->begin_coupling_step(fluid != nullptr);
    fluid_ = fluid;
    impulses_.resize(fluid == nullptr ? 0 : particles_.count());
    impulses_.fill({});
    wall_impulse_.setZero();
    update_fluid_loads();
}

Vec3 DemSystem::steady_fluid_force() const
{
    if (device_ != nullptr) return device_->steady_fluid_force();
    Vec3 sum = Vec3::Zero();
    for (FluidLoad const& load : loads_.host())
        sum += load.steady.xyz();
    return sum;
}

void DemSystem::take_impulses_of_one_second()
{
    if (DeviceDem* const there = device()) return there->take_impulses_of_one_second();
    for (std::int64_t i = 0; i < particles_.count(); ++i)
    {
        double const k = loads_[i].fluid_velocity.w;
        impulses_[i].drag = Quad::of(k * (loads_[i].fluid_velocity.xyz() - particles_.velocity[i].xyz()), k);
    }
}

void DemSystem::step(double dt)
{
    if (walls_move_) wall_contacts_.move_to(wall_contacts_.time() + dt);
    if (DeviceDem* const there = device()) return refuse_if(!there->step(dt));
    half_kick(dt / 2);
    drift(dt);
    update_neighbors();
    sum_contact_forces(dt);
    update_fluid_loads();
    half_kick(dt / 2);
}

void DemSystem::half_kick(double h)
{
    Quad const gravity{gravity_.x, gravity_.y, gravity_.z, 0};
    wall_impulse_ += h * wall_contacts_.total_force();
    if (fluid_ == nullptr)
        exec::for_each(execution_, particles_.count(),
                       HalfKick<false>{particles_.view(), nullptr, nullptr, gravity, h});
    else
        exec::for_each(execution_, particles_.count(),
                       HalfKick<true>{particles_.view(), loads_.view().data, impulses_.view().data, gravity, h});
}

void DemSystem::drift(double dt)
{
    exec::for_each(execution_, particles_.count(), Drift{particles_.view(), dt});
}

void DemSystem::update_neighbors()
{
    if (!search_.is_stale(particles_, neighbors_) && !wall_contacts_.is_stale(search_.skin())) return;
    auto const order = build_lists();
    if (impulses_.size() > 0) permute(execution_, impulses_, order);
    if (on_permutation_) on_permutation_(order);
    ++rebuilds_;
}

/// Builds both lists; the particles change places, and their forces are lost. Returns the permutation.
std::span<std::int32_t const> DemSystem::build_lists()
{
    auto const order = search_.build(particles_, neighbors_);
    room_.clear();
    room_.lend(particles_.force);
    room_.lend(particles_.torque);
    wall_contacts_.build(particles_, search_.skin(), order, room_);
    return order;
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

Vec3 DemSystem::wall_impulse() const
{
    return device_ == nullptr ? wall_impulse_ : device_->wall_impulse();
}

std::int64_t DemSystem::rebuilds() const
{
    return device_ == nullptr ? rebuilds_ : device_->rebuilds();
}

DeviceDem* DemSystem::device()
{
    if (device_ == nullptr) return nullptr;
    if (device_is_old_) device_->upload({particles_, neighbors_, wall_contacts_.pairs(), impulses_});
    device_is_old_ = false;
    host_is_old_ = true;
    return device_.get();
}

// The host's copy is a cache: bringing it up to date changes nothing that can be seen.
void DemSystem::to_look() const
{
    if (!host_is_old_) return;
    auto& self = const_cast<DemSystem&>(*this);
    device_->download({self.particles_, self.neighbors_, self.wall_contacts_.pairs(), self.impulses_});
    host_is_old_ = false;
}

void DemSystem::to_change()
{
    if (device_ == nullptr) return;
    to_look();
    device_is_old_ = true;
}

/// Throws UserError, naming a particle, where one has no finite position.
void DemSystem::refuse_if(bool diverged)
{
    if (diverged) Extent::of(execution_, std::as_const(*this).particles());
}

bool have_one_size(ParticleState const& particles)
{
    for (std::int64_t i = 1; i < particles.count(); ++i)
        if (particles.position[i].w != particles.position[0].w || particles.velocity[i].w != particles.velocity[0].w)
            return false;
    return true;
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

double reach_of(Case const& settings, ParticleState const& particles)
{
    return largest_radius(settings, particles) + settings.dem.skin * smallest_radius(settings, particles);
}

}  // namespace gimdem
