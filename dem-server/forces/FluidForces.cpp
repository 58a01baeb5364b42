// SPDX-License-Identifier: BSD-3-Clause
#include "forces/FluidForces.hpp"

#include <algorithm>

#include "exec/Octet.hpp"
#include "exec/Reduce.hpp"
#include "forces/LoadLaw.hpp"

namespace gimdem
{

namespace
{

/// Load of the particles of one octet, theory.md (D.15)-(D.18).
struct LoadKernel
{
    ParticleView particles;
    std::int32_t const* cell_of;
    Quad const* cell;
    double const* void_fraction;
    FluidView fluid;
    double void_fraction_minimum;
    bool drag, pressure_gradient;
    FluidLoad* loads;
    std::uint8_t* was_clipped;

    static std::int64_t octets(std::int64_t particle_count) { return (particle_count + exec::octet - 1) / exec::octet; }

    void operator()(std::int64_t o) const
    {
        std::int64_t const first = o * exec::octet;
        std::int64_t const left = particles.count - first;
        int const count = left < exec::octet ? static_cast<int>(left) : exec::octet;
        exec::OctetArray e = exec::OctetArray::Ones(), slip = exec::OctetArray::Zero(),
                         diameter = exec::OctetArray::Ones();
        for (int k = 0; k < count; ++k)
        {
            std::int64_t const p = first + k;
            Quad const x = particles.position[p];
            loads[p] = {{0, 0, 0, 0}, {0, 0, 0, 0}};
            was_clipped[p] = 0;
            if (pressure_gradient)
                loads[p].steady = Quad::of(-sphere_volume(x.w) * fluid.pressure_gradient[cell_of[p]].xyz(), 0);
            if (!drag) continue;
            std::int32_t const c = cell_of[p];
            Vec3 const dx = x.xyz() - cell[c].xyz();
            bool clipped = false;
            e[k] = fluid.void_fraction_at(c, void_fraction[c], dx, void_fraction_minimum, clipped);
            was_clipped[p] = clipped;
            loads[p].fluid_velocity = Quad::of(fluid.velocity_at(c, dx), 0);
            slip[k] = (loads[p].fluid_velocity.xyz() - particles.velocity[p].xyz()).norm();
            diameter[k] = 2 * x.w;
        }
        if (!drag) return;
        exec::OctetArray const coefficients = fluid.drag_coefficient(e, slip, diameter);
        for (int k = 0; k < count; ++k)
            loads[first + k].fluid_velocity.w = coefficients[k];
    }
};

void load_vectors(coupling::Span<double const> from, std::int32_t count, exec::Buffer<Quad>& to)
{
    to.resize(count);
    if (from.empty())
    {
        to.fill({0, 0, 0, 0});
        return;
    }
    for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c)
        to[static_cast<std::int64_t>(c)] = {from[3 * c], from[3 * c + 1], from[3 * c + 2], 0};
}

}  // namespace

void FluidForces::load(coupling::FluidFields const& fields, std::int32_t cell_count)
{
    load_vectors(fields.velocity, cell_count, velocity_);
    load_vectors(fields.pressure_gradient, cell_count, pressure_gradient_);
    load_vectors(fields.void_fraction_gradient, cell_count, void_gradient_);
    velocity_gradient_.resize(9 * static_cast<std::int64_t>(cell_count));
    if (fields.velocity_gradient.empty())
        velocity_gradient_.fill(0);
    else
        std::copy(fields.velocity_gradient.begin(), fields.velocity_gradient.end(), velocity_gradient_.host().begin());
}

void FluidForces::apply(ParticleState& particles, PolyMesh const& mesh, exec::Buffer<std::int32_t> const& cell_of,
                        exec::Buffer<double> const& void_fraction, exec::Buffer<FluidLoad>& loads)
{
    std::int64_t const n = particles.count();
    loads.resize(n);
    was_clipped_.resize(n);
    FluidView const fluid{velocity_.view().data,
                          velocity_gradient_.view().data,
                          pressure_gradient_.view().data,
                          void_gradient_.view().data,
                          fluid_.density,
                          fluid_.viscosity};
    std::uint8_t* const was_clipped = was_clipped_.view().data;
    exec::for_each(execution_, LoadKernel::octets(n),
                   LoadKernel{particles.view(), cell_of.view().data, mesh.view().cell, void_fraction.view().data, fluid,
                              void_fraction_minimum_, settings_.drag != "none", settings_.pressure_gradient,
                              loads.view().data, was_clipped});
    clipped_ +=
        static_cast<std::int64_t>(exec::sum(execution_, n, [=](std::int64_t p) { return double(was_clipped[p]); }));
}

}  // namespace gimdem
