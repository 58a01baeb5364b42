// SPDX-License-Identifier: BSD-3-Clause
/// Hertz's elastic normal impact in closed form: the oracle of impact tests, and the time scale of their steps.
#pragma once

#include <cmath>
#include <limits>

#include "TestCase.hpp"

namespace gimdem::test
{

/// A wall that no sphere dents: its compliance is 1e-20 of theirs.
inline MaterialSettings rigid()
{
    return {"wall", 1, 1e30, 0.3};
}

/// A sphere of `bead` that meets another of its kind, or a plane of `wall`; no gravity.
inline Case impact_case(MaterialSettings bead, MaterialSettings wall, double restitution, double friction)
{
    Case settings = bead_case(restitution, friction);
    bead.name = "bead";
    wall.name = "wall";
    settings.materials = {bead, wall};
    settings.contacts = {{{"bead", "bead"}, restitution, friction}, {{"bead", "wall"}, restitution, friction}};
    settings.walls.material = "wall";
    return settings;
}

/// F = k depth^(3/2), k = 4/3 E* sqrt(R*); from 1/2 m* v^2 = 2/5 k depth^(5/2).
struct HertzImpact
{
    double stiffness;  ///< k [N/m^(3/2)]
    double depth;      ///< largest overlap [m]
    double force;      ///< largest force [N]
    double duration;   ///< of the contact [s]: 2.943275 depth/v

    HertzImpact(double young_eff, double radius_eff, double mass_eff, double speed)
        : stiffness(4.0 / 3.0 * young_eff * std::sqrt(radius_eff)),
          depth(std::pow(5 * mass_eff * speed * speed / (4 * stiffness), 0.4)),
          force(stiffness * std::pow(depth, 1.5)),
          duration(2.943275 * depth / speed)
    {
    }

    /// Sphere of `bead` against a plane of `wall`.
    static HertzImpact on_wall(MaterialSettings const& bead, MaterialSettings const& wall, double radius, double speed)
    {
        return {1 / (compliance(bead) + compliance(wall)), radius, bead.density * sphere_volume(radius), speed};
    }

    /// Two equal spheres; speed: relative.
    static HertzImpact of_twins(MaterialSettings const& bead, double radius, double speed)
    {
        return {1 / (2 * compliance(bead)), radius / 2, bead.density * sphere_volume(radius) / 2, speed};
    }

private:
    static double compliance(MaterialSettings const& m)
    {
        return (1 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus;
    }
};

}  // namespace gimdem::test
