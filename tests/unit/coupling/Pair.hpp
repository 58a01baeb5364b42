// SPDX-License-Identifier: BSD-3-Clause
/// A client and a server in two threads of one process.
#pragma once

#include <future>
#include <string>
#include <utility>
#include <vector>

#include "BoxMesh.hpp"
#include "Endpoint.hpp"
#include "gimdem/coupling/Client.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::test
{

/// Long enough for a busy machine, where a test waits for no time-out.
inline constexpr double patient = 20;  ///< [s]

inline coupling::ServerOptions server_options(std::string const& endpoint, double timeout = patient)
{
    coupling::ServerOptions options;
    options.endpoint = endpoint;
    options.name = "test server 1";
    options.timeout = timeout;
    options.connect_time = patient;
    options.step_time = patient;
    return options;
}

inline coupling::ClientOptions client_options(std::string const& endpoint, double timeout = patient)
{
    coupling::ClientOptions options;
    options.endpoint = endpoint;
    options.name = "test client 1";
    options.timeout = timeout;
    options.connect_time = patient;
    options.step_time = patient;
    return options;
}

inline coupling::ServerTerms server_terms(coupling::Schedule schedule = coupling::Schedule::serial)
{
    return {"a test", schedule, 1.5, {coupling::field::velocity, coupling::field::pressure_gradient}};
}

/// Fields of a fluid, every number different from every other.
struct FluidArrays
{
    FluidArrays(std::size_t cells, double start) : velocity(3 * cells), pressure_gradient(3 * cells)
    {
        for (std::size_t i = 0; i < 3 * cells; ++i)
        {
            velocity[i] = start + 0.1 * static_cast<double>(i);
            pressure_gradient[i] = -start - 0.3 * static_cast<double>(i);
        }
    }

    coupling::FluidFields view() const
    {
        coupling::FluidFields fields;
        fields.velocity = velocity;
        fields.pressure_gradient = pressure_gradient;
        return fields;
    }

    std::vector<double> velocity;
    std::vector<double> pressure_gradient;
};

/// Fields of a solid, every number different from every other.
struct SolidArrays
{
    SolidArrays(std::size_t cells, double start)
        : void_fraction(cells), drag_coefficient(cells), drag_momentum(3 * cells)
    {
        for (std::size_t i = 0; i < cells; ++i)
        {
            void_fraction[i] = 1 / (1 + start + static_cast<double>(i));
            drag_coefficient[i] = start + 7 * static_cast<double>(i);
        }
        for (std::size_t i = 0; i < 3 * cells; ++i)
            drag_momentum[i] = start - 1e-3 * static_cast<double>(i);
    }

    coupling::SolidFields view() const
    {
        coupling::SolidFields fields;
        fields.void_fraction = void_fraction;
        fields.drag_coefficient = drag_coefficient;
        fields.drag_momentum = drag_momentum;
        return fields;
    }

    std::vector<double> void_fraction;
    std::vector<double> drag_coefficient;
    std::vector<double> drag_momentum;
};

template <class T>
std::vector<T> to_vector(coupling::Span<T const> values)
{
    return {values.begin(), values.end()};
}

inline coupling::Mesh small_mesh()
{
    return BoxMesh::make({2, 3, 4}, {0.2, 0.3, 0.4});
}

/// Step number n of a run with dt = 1 ms.
inline coupling::Step step(int n)
{
    return {n, 1e-3 * (n - 1), 1e-3};
}

/// Runs one side in a thread; get() of the future gives its result or its exception.
template <class Side>
auto in_background(Side side)
{
    return std::async(std::launch::async, std::move(side));
}

}  // namespace gimdem::test
