// SPDX-License-Identifier: BSD-3-Clause
/// DeviceDem on one kind of device: the step, in the words of DemSystem.
#pragma once

#include <cstdint>
#include <utility>

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
          contacts_(device_, Domain::of(scene.settings.domain), scene.settings.dem.precision == "mixed"),
          walls_(device_, scene.walls, scene.host_walls, laws_.has_rolling_spring()),
          fluid_(device_)
    {
    }

    void upload(HostState const& state) override
    {
        owed_ = 0;  // a state that comes back was finished when it went
        particles_.upload(device_, state.particles, state.impulses);
        neighbors_.upload(state.particles, state.neighbors);
        walls_.upload(state.walls, state.particles.count());
        fluid_.take_sizes(state.particles);
        device_.wait();
    }
    void download(HostState const& state) override
    {
        finish_step();
        particles_.download(device_, state.particles, state.impulses);
        neighbors_.download(state.neighbors);
        walls_.download(state.walls);
        device_.wait();
    }

    bool prepare() override
    {
        finish_step();
        if (neighbors_.is_built())
            device_.for_each(particles_.count(), StaleKernel{particles_.position.data(), neighbors_.stale_test()});
        return sum_contact_forces(0);
    }

    bool step(double dt) override
    {
        move(dt);
        if (!sum_contact_forces(dt)) return false;
        if (with_fluid_) fluid_.apply(particles_);
        owed_ = dt / 2;
        return true;
    }

    void begin_coupling_step(bool fluid) override
    {
        finish_step();
        with_fluid_ = fluid;
        particles_.impulses.resize(device_, fluid ? particles_.count() : 0);
        particles_.impulses.zero(device_);
        walls_.clear_impulse(particles_.count());
        if (fluid) fluid_.apply(particles_);
    }
    Vec3 steady_fluid_force() override { return fluid_.steady_force(); }
    void take_impulses_of_one_second() override
    {
        finish_step();
        device_.for_each(particles_.count(),
                         DragOfOneSecond{fluid_.loads(), particles_.velocity.data(), particles_.impulses.data()});
    }
    Vec3 wall_impulse() override { return finish_step(), walls_.impulse(); }
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
    void sum_into_cells(CellSums& sums) override { finish_step(), fluid_.sum_into_cells(particles_, sums); }
    ImpulseSums impulse_sums() override { return finish_step(), fluid_.impulse_sums(particles_); }
    void occupied_cells(exec::Buffer<std::uint8_t>& flags) override { fluid_.occupied_cells(particles_, flags); }
    void download_cells(exec::Buffer<std::int32_t>& cell_of) override
    {
        particles_.cell_of.download(device_, cell_of);
        device_.wait();
    }

    void upload_cells(exec::Buffer<std::int32_t> const& cell_of) override
    {
        particles_.cell_of.upload(device_, cell_of);
        fluid_.group_by_cell(particles_);
        device_.wait();
    }

    void finish() override { finish_step(), device_.wait(); }

    std::int64_t allocations() const override
    {
        if constexpr (requires { device_.allocations(); })
            return static_cast<std::int64_t>(device_.allocations());
        else
            return 0;
    }

private:
    /// The second half kick of the step before, if it is still owed, the first of this one, and the drift.
    void move(double dt)
    {
        device_.fork();
        walls_.add_impulse(owed_, dt / 2);
        if (with_fluid_)
            device_.for_each(particles_.count(),
                             MotionKernel<true>{particles_.view(), fluid_.loads(), particles_.impulses.data(), gravity_,
                                                owed_, dt / 2, neighbors_.stale_test()});
        else
            device_.for_each(particles_.count(), MotionKernel<false>{particles_.view(), nullptr, nullptr, gravity_,
                                                                     owed_, dt / 2, neighbors_.stale_test()});
        device_.join();
        owed_ = 0;
    }

    /// The second half kick of a step waits for the first of the next one, unless somebody looks at the state before.
    void finish_step()
    {
        double const h = std::exchange(owed_, 0.0);
        if (h == 0) return;
        device_.fork();
        walls_.add_impulse(0, h);
        device_.join();
        if (with_fluid_)
            device_.for_each(particles_.count(), HalfKick<true>{particles_.view(), fluid_.loads(),
                                                                particles_.impulses.data(), gravity_, h});
        else
            device_.for_each(particles_.count(), HalfKick<false>{particles_.view(), nullptr, nullptr, gravity_, h});
    }

    /// Asks for the forces before it knows whether the list is stale, so that the device need not wait for the host to
    /// ask; where it was, they do nothing, and are asked for again with a new list.
    bool sum_contact_forces(double dt)
    {
        bool stale = !neighbors_.is_built() || walls_.is_stale(neighbors_.skin());
        if (!stale)
        {
            neighbors_.ask_whether_stale();
            launch_contact_forces(dt);
            stale = neighbors_.is_stale();
        }
        if (!stale) return true;
        if (!build_neighbors()) return false;
        launch_contact_forces(dt);
        return true;
    }

    void launch_contact_forces(double dt)
    {
        device_.fork();
        walls_.find_forces(laws_, particles_, neighbors_.stale(), dt);
        contacts_.find_forces(laws_, particles_, neighbors_, dt);
        device_.join();
        contacts_.sum_forces(particles_, neighbors_, walls_.forces());
    }

    bool build_neighbors()
    {
        if (!neighbors_.build(particles_)) return false;
        walls_.build(particles_, neighbors_.skin(), neighbors_.order());
        auto const [low, high] = neighbors_.reached();
        host_walls_.remember_build(low, high);
        ++rebuilds_;
        return true;
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
    double owed_ = 0;  ///< half step whose kick is still to come [s]
    std::int64_t rebuilds_ = 0;
};

}  // namespace gimdem
