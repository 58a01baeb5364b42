// SPDX-License-Identifier: BSD-3-Clause
/// DeviceDem on one kind of device: the step, in the words of DemSystem.
#pragma once

#include <cstdint>

#include "engine/device/DeviceFluid.hpp"
#include "engine/device/DeviceWalls.hpp"
#include "integrate/VelocityVerlet.hpp"

namespace gimdem
{

/// Sets impulses to what the present drag would give in one second.
struct DragOfOneSecond
{
    FluidLoad const* loads;
    Quad const* velocity;
    Impulse* impulses;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Quad const v = loads[i].fluid_velocity;
        impulses[i].drag = Quad::of(v.w * (v.xyz() - velocity[i].xyz()), v.w);
    }
};

template <class Device>
class DeviceDemOn : public DeviceDem
{
public:
    /// The arguments that follow the scene are the device's.
    template <class... Arguments>
    explicit DeviceDemOn(DemScene const& scene, Arguments... arguments)
        : device_(arguments...),
          gravity_{scene.settings.dem.gravity[0], scene.settings.dem.gravity[1], scene.settings.dem.gravity[2], 0},
          host_walls_(scene.host_walls),
          laws_(device_, scene.materials),
          neighbors_(device_, scene.skin, Domain::of(scene.settings.domain), laws_.has_rolling_spring()),
          contacts_(device_, Domain::of(scene.settings.domain)),
          walls_(device_, scene.walls, scene.host_walls, laws_.has_rolling_spring()),
          fluid_(device_)
    {
    }

    void upload(HostState const& state) override
    {
        particles_.upload(device_, state.particles, state.impulses);
        neighbors_.upload(state.particles, state.neighbors);
        walls_.upload(state.walls, state.particles.count());
        fluid_.take_sizes(state.particles);
        device_.wait();
    }
    void download(HostState const& state) override
    {
        particles_.download(device_, state.particles, state.impulses);
        neighbors_.download(state.neighbors);
        walls_.download(state.walls);
        device_.wait();
    }

    bool prepare() override
    {
        if (!update_neighbors()) return false;
        sum_contact_forces(0);
        return true;
    }

    bool step(double dt) override
    {
        half_kick(dt / 2);
        device_.for_each(particles_.count(), Drift{particles_.view(), dt});
        if (!update_neighbors()) return false;
        sum_contact_forces(dt);
        if (with_fluid_) fluid_.apply(particles_);
        half_kick(dt / 2);
        return true;
    }

    void begin_coupling_step(bool fluid) override
    {
        with_fluid_ = fluid;
        particles_.impulses.resize(device_, fluid ? particles_.count() : 0);
        particles_.impulses.zero(device_);
        walls_.clear_impulse(particles_.count());
        if (fluid) fluid_.apply(particles_);
    }
    Vec3 steady_fluid_force() override { return fluid_.steady_force(); }
    void take_impulses_of_one_second() override
    {
        device_.for_each(particles_.count(),
                         DragOfOneSecond{fluid_.loads(), particles_.velocity.data(), particles_.impulses.data()});
    }
    Vec3 wall_impulse() override { return walls_.impulse(); }
    std::int64_t rebuilds() const override { return rebuilds_; }

    void set_fluid(FluidScene const& scene, ParticleState const& particles) override
    {
        fluid_.set_scene(scene);
        fluid_.take_sizes(particles);
        device_.wait();
    }
    void load_fluid(coupling::FluidFields const& fields) override { fluid_.load(fields); }
    void set_void_fraction(exec::Buffer<double> const& values) override { fluid_.set_void_fraction(values); }
    std::int64_t clipped() override { return fluid_.clipped(); }
    bool locate() override { return fluid_.locate(particles_); }
    void sum_into_cells(CellSums& sums) override { fluid_.sum_into_cells(particles_, sums); }
    ImpulseSums impulse_sums() override { return fluid_.impulse_sums(particles_); }
    void download_cells(exec::Buffer<std::int32_t>& cell_of) override
    {
        particles_.cell_of.download(device_, cell_of);
        device_.wait();
    }

    void finish() override { device_.wait(); }

    std::int64_t allocations() const override
    {
        if constexpr (requires { device_.allocations(); })
            return static_cast<std::int64_t>(device_.allocations());
        else
            return 0;
    }

private:
    void half_kick(double h)
    {
        walls_.add_impulse(h);
        if (with_fluid_)
            device_.for_each(particles_.count(), HalfKick<true>{particles_.view(), fluid_.loads(),
                                                                particles_.impulses.data(), gravity_, h});
        else
            device_.for_each(particles_.count(), HalfKick<false>{particles_.view(), nullptr, nullptr, gravity_, h});
    }

    bool update_neighbors()
    {
        if (!neighbors_.is_stale(particles_) && !walls_.is_stale(neighbors_.skin())) return true;
        if (!neighbors_.build(particles_)) return false;
        walls_.build(particles_, neighbors_.skin(), neighbors_.order());
        auto const [low, high] = neighbors_.reached();
        host_walls_.remember_build(low, high);
        ++rebuilds_;
        return true;
    }

    void sum_contact_forces(double dt)
    {
        contacts_.sum_forces(laws_, particles_, neighbors_, dt);
        walls_.add_forces(laws_, particles_, dt);
    }

    Device device_;  // before all that lives in its memory
    Quad gravity_;
    WallContacts& host_walls_;
    DeviceParticles<Device> particles_;
    DeviceLaws<Device> laws_;
    DeviceNeighbors<Device> neighbors_;
    DeviceContacts<Device> contacts_;
    DeviceWalls<Device> walls_;
    DeviceFluid<Device> fluid_;
    bool with_fluid_ = false;
    std::int64_t rebuilds_ = 0;
};

}  // namespace gimdem
