// SPDX-License-Identifier: BSD-3-Clause
/// A particle server whose void fraction and drag are given functions of place and time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "FluidCase.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::test
{

/// What the particles do to the fluid at one place.
struct Solid
{
    double void_fraction = 1;
    double drag_coefficient = 0;       ///< K [kg/(m^3 s)]
    Vector drag_momentum = {0, 0, 0};  ///< K u_p [N/m^3]
};

using Prescription = std::function<Solid(Vector centre, double time)>;

/// The fluid at one time, with what the server knows of its cells.
struct Fluid
{
    double time = 0;                                       ///< [s]
    double step = 0;                                       ///< the coupling step that begins there [s]
    coupling::Mesh mesh;                                   ///< as the server has it
    std::vector<Vector> centre;                            ///< [m]
    std::vector<double> volume;                            ///< [m^3]
    std::vector<double> void_fraction;                     ///< at the same time
    std::vector<Vector> velocity;                          ///< [m/s]
    std::vector<double> pressure;                          ///< [Pa]
    std::vector<Vector> pressure_gradient;                 ///< [Pa/m]
    std::vector<std::array<double, 9>> velocity_gradient;  ///< [1/s]
    std::vector<Vector> void_fraction_gradient;            ///< [1/m]
    std::map<std::string, double> monitors;

    double superficial(std::size_t c) const { return void_fraction[c] * velocity[c][2]; }
};

/// Called with every fluid state.
using Observer = std::function<void(Fluid const&)>;

/// Runs `fluid` with the prescribed particles to its end; returns the last state that the solver sent, which is
/// that at the beginning of its last step. @post the solver ended well, or an exception with its log.
Fluid run_with(FluidCase const& fluid, Prescription const& prescribe, Observer const& observe = {});

/// The same for a process whose files have been changed after FluidProcess wrote them.
Fluid run_with(FluidProcess& process, double end_time, Prescription const& prescribe, Observer const& observe = {});

}  // namespace gimdem::test
