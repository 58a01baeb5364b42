// SPDX-License-Identifier: BSD-3-Clause
/// From the restitution that is asked for to the dashpot that gives it, theory.md (D.8), (D.90).
#pragma once

namespace gimdem
{

/// How the elastic force of a contact grows with the overlap.
enum class Stiffening
{
    linear,  ///< delta
    hertz    ///< delta^(3/2)
};

/// |beta| of a contact that keeps its last, attractive instants, (D.8): the same for both. restitution in (0, 1].
double damping_ratio(double restitution);

/// |beta| of one whose dashpot never pulls, (D.90).
double damping_ratio_without_attraction(double restitution, Stiffening stiffening);

/// Speed after over before a head-on collision with a dashpot |beta| that never pulls, by integration of (D.90).
double restitution_without_attraction(double damping_ratio, Stiffening stiffening);

}  // namespace gimdem
