// SPDX-License-Identifier: BSD-3-Clause
/// The state of all particles: structure of arrays of aligned quadruples, kept in the order of the search grid.
#pragma once

#include <cstdint>
#include <span>

#include "exec/Buffer.hpp"
#include "exec/ForEach.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// What kernels see of the particles.
struct ParticleView
{
    Quad* position;          ///< centre [m], w: radius [m]
    Quad* velocity;          ///< [m/s], w: 1/mass [1/kg]
    Quad* angular_velocity;  ///< [rad/s], w: 1/moment of inertia [1/(kg m^2)]
    Quad* force;             ///< contacts and pressure gradient; gravity and drag enter in the kick [N]
    Quad* torque;            ///< [N m]
    std::int32_t* material;  ///< number in the table of materials
    std::int64_t count;
};

/// What a particle received over a coupling step: kept for the momentum exchange.
struct Impulse
{
    Quad drag;  ///< time integral of the drag force [N s], w: of its coefficient k [kg]
};

/// Owns the arrays. Everything here, in this order, is what a restart needs of the particles.
struct ParticleState
{
    exec::Buffer<Quad> position;
    exec::Buffer<Quad> velocity;
    exec::Buffer<Quad> angular_velocity;
    exec::Buffer<Quad> force;
    exec::Buffer<Quad> torque;
    exec::Buffer<std::int32_t> material;
    exec::Buffer<std::int64_t> id;  ///< never changes, whatever the order in memory

    std::int64_t count() const { return position.size(); }
    ParticleView view();
    void resize(std::int64_t count);

    /// Put the particle that was at order[i] at i. Forces and torques are to be computed anew.
    void permute(exec::Execution const& execution, std::span<std::int32_t const> order);

    double volume(std::int64_t i) const;  ///< [m^3]
    double mass(std::int64_t i) const;    ///< [kg]
};

/// Volume of a sphere [m^3] of radius [m].
GIMDEM_HD inline double sphere_volume(double radius)
{
    return 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
}

/// dst[i] = src[order[i]] for all i, by way of a copy.
template <class T>
void permute(exec::Buffer<T>& values, std::span<std::int32_t const> order)
{
    exec::Buffer<T> const old = values;
    for (std::size_t i = 0; i < order.size(); ++i)
        values[static_cast<std::int64_t>(i)] = old[order[i]];
}

/// The same on all threads.
template <class T>
void permute(exec::Execution const& execution, exec::Buffer<T>& values, std::span<std::int32_t const> order)
{
    exec::Buffer<T> permuted(static_cast<std::int64_t>(order.size()));
    exec::for_each(execution, permuted.size(),
                   [to = permuted.view(), from = values.view(), from_place = order.data()](std::int64_t i)
                   { to[i] = from[from_place[i]]; });
    swap(values, permuted);
}

/// The same without memory of its own: the values wait in `room`, whose elements mean nothing afterwards.
template <class T>
void permute(exec::Execution const& execution, exec::Buffer<T>& values, std::span<std::int32_t const> order,
             exec::Buffer<Quad>& room)
{
    static_assert(sizeof(T) <= sizeof(Quad));
    auto const n = static_cast<std::int64_t>(order.size());
    room.resize(n);
    T* const waiting = reinterpret_cast<T*>(room.view().data);
    exec::for_each(execution, n,
                   [=, from = values.view(), place = order.data()](std::int64_t i) { waiting[i] = from[place[i]]; });
    values.resize(n);
    exec::for_each(execution, n, [=, to = values.view()](std::int64_t i) { to[i] = waiting[i]; });
}

/// Of quadruples: `room` and `values` change places.
inline void permute(exec::Execution const& execution, exec::Buffer<Quad>& values, std::span<std::int32_t const> order,
                    exec::Buffer<Quad>& room)
{
    room.resize(static_cast<std::int64_t>(order.size()));
    exec::for_each(execution, room.size(),
                   [to = room.view(), from = values.view(), place = order.data()](std::int64_t i)
                   { to[i] = from[place[i]]; });
    swap(values, room);
}

}  // namespace gimdem
