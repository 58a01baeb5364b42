// SPDX-License-Identifier: BSD-3-Clause
/// Hertz-Mindlin contact with viscous damping and Coulomb friction, theory.md (D.5)-(D.12).
#pragma once

#include <cmath>

#include "exec/Vector.hpp"
#include "particles/Materials.hpp"

namespace gimdem
{

/// Two bodies that overlap, seen at one instant. A wall has infinite mass and radius.
struct ContactGeometry
{
    Vec3 normal;        ///< unit vector towards body i, on which the force is asked
    double overlap;     ///< delta > 0 [m]
    Vec3 velocity;      ///< of i relative to j at the contact point [m/s]
    double radius_eff;  ///< R*, (D.1) [m]
    double mass_eff;    ///< m*, (D.2) [kg]
};

/// Force on body i; body j feels the opposite.
struct ContactForce
{
    Vec3 force;       ///< normal + tangential [N]
    Vec3 tangential;  ///< [N]
};

/// The law. `displacement` is the tangential spring's elongation [m]: read, advanced by one step and truncated.
struct HertzMindlin
{
    ContactConstants constants;
    double dt;  ///< DEM time step [s]

    GIMDEM_HD ContactForce operator()(ContactGeometry const& contact, Vec3& displacement) const
    {
        // Stiffnesses S_n = 2 E* a, S_t = 8 G* a with the contact radius a, (D.5); dashpots 2 sqrt(5/6) |beta| sqrt(S
        // m*).
        double const a = std::sqrt(contact.radius_eff * contact.overlap);
        double const normal_stiffness = 2 * constants.young_eff * a;
        double const tangential_stiffness = constants.stiffness_ratio * normal_stiffness;
        double const normal_dashpot = constants.damping * std::sqrt(normal_stiffness * contact.mass_eff);
        double const tangential_dashpot = constants.root_stiffness_ratio * normal_dashpot;

        // Normal: Hertz spring and dashpot, (D.6), (D.7).
        double const v_n = contact.velocity.dot(contact.normal);
        double const normal_force = 2.0 / 3.0 * normal_stiffness * contact.overlap - normal_dashpot * v_n;

        // Tangential: turn the spring with the contact plane, stretch it, (D.9), (D.10).
        Vec3 const v_t = contact.velocity - v_n * contact.normal;
        turn_into_plane(contact.normal, displacement);
        displacement += v_t * dt;

        // Coulomb: a sliding spring is as long as friction can hold, and has no dashpot, (D.11), (D.12).
        double const limit = constants.friction * std::abs(normal_force);
        double const spring2 = tangential_stiffness * tangential_stiffness * displacement.squaredNorm();
        bool const slides = spring2 > limit * limit;
        if (slides) displacement *= limit / std::sqrt(spring2);
        Vec3 tangential = -tangential_stiffness * displacement;
        if (!slides) tangential -= tangential_dashpot * v_t;
        return {normal_force * contact.normal + tangential, tangential};
    }

private:
    /// Remove the normal part, keep the length.
    GIMDEM_HD static void turn_into_plane(Vec3 const& normal, Vec3& displacement)
    {
        double const before = displacement.squaredNorm();
        displacement -= displacement.dot(normal) * normal;
        double const after = displacement.squaredNorm();
        if (after > 0) displacement *= std::sqrt(before / after);
    }
};

}  // namespace gimdem
