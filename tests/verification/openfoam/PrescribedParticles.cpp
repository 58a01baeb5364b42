// SPDX-License-Identifier: BSD-3-Clause
#include "PrescribedParticles.hpp"

#include <stdexcept>

#include "Endpoint.hpp"

namespace gimdem::test
{

using namespace coupling;

namespace
{

Vector point(Mesh const& mesh, std::int32_t p)
{
    auto const* x = &mesh.points[3 * static_cast<std::size_t>(p)];
    return {x[0], x[1], x[2]};
}

Vector cross(Vector const& a, Vector const& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector difference(Vector const& a, Vector const& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Centres and volumes: every face is cut into triangles round its first point, every triangle makes a tetrahedron
/// with the origin; signed volumes add up to the cell. Exact for planar faces.
void measure(Mesh const& mesh, Fluid& fluid)
{
    auto const n = static_cast<std::size_t>(mesh.cell_count);
    fluid.centre.assign(n, {0, 0, 0});
    fluid.volume.assign(n, 0);

    auto const add = [&](std::int32_t cell, double volume, Vector const& sum_of_corners)
    {
        auto const c = static_cast<std::size_t>(cell);
        fluid.volume[c] += volume;
        for (int d = 0; d < 3; ++d)
            fluid.centre[c][d] += volume * sum_of_corners[d] / 4;
    };
    for (std::size_t f = 0; f < mesh.owner.size(); ++f)
        for (auto i = static_cast<std::size_t>(mesh.face_offsets[f]) + 1;
             i + 1 < static_cast<std::size_t>(mesh.face_offsets[f + 1]); ++i)
        {
            Vector const a = point(mesh, mesh.face_points[static_cast<std::size_t>(mesh.face_offsets[f])]);
            Vector const b = point(mesh, mesh.face_points[i]);
            Vector const c = point(mesh, mesh.face_points[i + 1]);
            Vector const normal = cross(difference(b, a), difference(c, a));
            double const volume = (a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2]) / 6;
            Vector const corners = {a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]};
            add(mesh.owner[f], volume, corners);
            if (f < mesh.neighbour.size()) add(mesh.neighbour[f], -volume, corners);
        }
    for (std::size_t c = 0; c < n; ++c)
        for (int d = 0; d < 3; ++d)
            fluid.centre[c][d] /= fluid.volume[c];
}

/// The prescribed fields, sampled in the cells.
struct Sample
{
    Sample(Fluid const& fluid, Prescription const& prescribe, double time)
    {
        for (Vector const& centre : fluid.centre)
        {
            Solid const solid = prescribe(centre, time);
            void_fraction.push_back(solid.void_fraction);
            coefficient.push_back(solid.drag_coefficient);
            momentum.insert(momentum.end(), solid.drag_momentum.begin(), solid.drag_momentum.end());
        }
    }

    SolidFields fields() const
    {
        SolidFields solid;
        solid.void_fraction = void_fraction;
        solid.drag_coefficient = coefficient;
        solid.drag_momentum = momentum;
        return solid;
    }

    std::vector<double> void_fraction, coefficient, momentum;
};

template <std::size_t N>
std::vector<std::array<double, N>> rows(Span<double const> flat)
{
    std::vector<std::array<double, N>> result(flat.size() / N);
    for (std::size_t i = 0; i < flat.size(); ++i)
        result[i / N][i % N] = flat[i];
    return result;
}

void take(FluidState const& state, Fluid& fluid)
{
    fluid.time = state.step.time;
    fluid.step = state.step.dt;
    fluid.velocity = rows<3>(state.fields.velocity);
    fluid.velocity_gradient = rows<9>(state.fields.velocity_gradient);
    fluid.pressure_gradient = rows<3>(state.fields.pressure_gradient);
    fluid.void_fraction_gradient = rows<3>(state.fields.void_fraction_gradient);
    fluid.pressure.assign(state.fields.pressure.begin(), state.fields.pressure.end());
    for (Monitor const& monitor : state.monitors)
        fluid.monitors[monitor.name] = monitor.value;
}

ServerTerms terms_until(double end_time)
{
    ServerTerms terms;
    terms.title = "prescribed";
    terms.end_time = end_time;
    terms.needs = {field::velocity, field::velocity_gradient, field::pressure_gradient, field::void_fraction_gradient,
                   field::pressure};
    return terms;
}

Fluid serve(FluidProcess& process, ServerTerms const& terms, Prescription const& prescribe, Observer const& observe);

}  // namespace

Fluid run_with(FluidCase const& fluid, Prescription const& prescribe, Observer const& observe)
{
    FluidProcess process(fluid);
    ServerTerms terms = terms_until(fluid.end_time);
    terms.fluid_steps = fluid.fluid_steps;
    if (fluid.overlapped) terms.schedule = Schedule::overlapped;
    return serve(process, terms, prescribe, observe);
}

Fluid run_with(FluidProcess& process, double end_time, Prescription const& prescribe, Observer const& observe)
{
    return serve(process, terms_until(end_time), prescribe, observe);
}

namespace
{

Fluid serve(FluidProcess& process, ServerTerms const& terms, Prescription const& prescribe, Observer const& observe)
{
    ServerOptions options;
    options.endpoint = unused_ipc_endpoint();
    options.name = "prescribed particles";
    options.timeout = 10;
    options.connect_time = 20;
    Server server(options);
    process.start("-endpoint " + server.endpoint());

    Fluid fluid;
    try
    {
        server.wait_for_client(terms);
        fluid.mesh = server.receive_mesh();
        measure(fluid.mesh, fluid);
        Sample sample(fluid, prescribe, 0);
        server.accept_mesh(sample.fields());
        while (auto const state = server.receive_fluid())
        {
            fluid.void_fraction = sample.void_fraction;
            take(*state, fluid);
            if (observe) observe(fluid);
            sample = Sample(fluid, prescribe, state->step.time + state->step.dt);
            server.send_solid(sample.fields(), {});
        }
    }
    catch (CouplingError const& error)
    {
        throw std::runtime_error(std::string(error.what()) + "\nlog of gimdemFoam:\n" + process.log());
    }
    if (int const code = process.wait(); code != 0)
        throw std::runtime_error("gimdemFoam ended with " + std::to_string(code) + ":\n" + process.log());
    return fluid;
}

}  // namespace

}  // namespace gimdem::test
