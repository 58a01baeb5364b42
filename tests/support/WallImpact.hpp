// SPDX-License-Identifier: BSD-3-Clause
/// One sphere that hits the plane z = 0 and leaves it again.
#pragma once

#include <algorithm>
#include <string>

#include "HertzImpact.hpp"
#include "SphereBox.hpp"

namespace gimdem::test
{

/// What hits what. The sphere moves along x and towards the plane, and spins about y.
struct WallImpact
{
    MaterialSettings bead, wall;
    double restitution, friction;
    double radius;          ///< [m]
    double normal_speed;    ///< towards the plane [m/s]
    double tangential = 0;  ///< along the plane [m/s]
    double spin = 0;        ///< about y; radius * spin = tangential: rolling [rad/s]
    bool limit_damping = false, tangential_damping = true;
};

/// How it leaves, and what the contact was like.
struct Rebound
{
    double normal_speed;  ///< away from the plane [m/s]
    double tangential;    ///< of the centre [m/s]
    double spin;          ///< [rad/s]
    double surface;       ///< of the contact point, along the plane: tangential - radius * spin [m/s]
    double depth;         ///< largest overlap [m]
    double force;         ///< largest [N]
    double duration;      ///< of the contact, to one step [s]
};

/// Follows an impact with `steps` per duration of the elastic contact. It starts one part in 1e9 of the radius above
/// the plane and lasts 2.5 such durations: damped contacts take up to 1.8 times longer.
inline Rebound rebound_of(WallImpact const& impact, int steps = 2000)
{
    double const r = impact.radius;
    double const dt =
        HertzImpact::on_wall(impact.bead, impact.wall, r, impact.normal_speed).duration / static_cast<double>(steps);
    Case settings = impact_case(impact.bead, impact.wall, impact.restitution, impact.friction);
    for (ContactSettings& contact : settings.contacts)
    {
        contact.limit_damping = impact.limit_damping;
        contact.tangential_damping = impact.tangential_damping;
    }
    SphereBox scene(
        settings, {{40 * r, 40 * r, 40 * r}, {"bottom"}},
        {{{10 * r, 20 * r, r * (1 + 1e-9)}, r, {impact.tangential, 0, -impact.normal_speed}, {0, impact.spin, 0}}});
    Rebound out{};
    for (int s = 0; s < 5 * steps / 2; ++s)
    {
        scene.run(1, dt);
        double const overlap = r - scene.position(0).z();
        out.depth = std::max(out.depth, overlap);
        out.force = std::max(out.force, scene.force(0).norm());
        out.duration += overlap > 0 ? dt : 0;
    }
    out.normal_speed = scene.velocity(0).z();
    out.tangential = scene.velocity(0).x();
    out.spin = scene.spin(0).y();
    out.surface = out.tangential - r * out.spin;
    return out;
}

}  // namespace gimdem::test
