// SPDX-License-Identifier: BSD-3-Clause
#include "contact/Restitution.hpp"

#include <cmath>
#include <numbers>

namespace gimdem
{

namespace
{

struct Motion
{
    double overlap, speed;
};

/// Force of (D.90): -x^p - c x^((p-1)/2) v, in units of the elastic contact.
double force(Motion const& at, double damping, Stiffening stiffening)
{
    double const x = at.overlap > 0 ? at.overlap : 0;
    double const root = std::sqrt(x);
    return stiffening == Stiffening::hertz ? -x * root - damping * std::sqrt(root) * at.speed : -x - damping * at.speed;
}

/// One step h of Runge and Kutta.
Motion advance(Motion const& at, double h, double damping, Stiffening stiffening)
{
    auto const rate = [&](Motion const& m) { return Motion{m.speed, force(m, damping, stiffening)}; };
    auto const on = [&](Motion const& k, double t) {
        return Motion{at.overlap + t * k.overlap, at.speed + t * k.speed};
    };
    Motion const a = rate(at), b = rate(on(a, h / 2)), c = rate(on(b, h / 2)), d = rate(on(c, h));
    return {at.overlap + h / 6 * (a.overlap + 2 * b.overlap + 2 * c.overlap + d.overlap),
            at.speed + h / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed)};
}

}  // namespace

double damping_ratio(double restitution)
{
    double const log_e = std::log(restitution);
    return std::abs(log_e) / std::sqrt(log_e * log_e + std::numbers::pi * std::numbers::pi);
}

double restitution_without_attraction(double damping_ratio, Stiffening stiffening)
{
    // Elastic contacts last pi and 3.2; steps grow from the start, where the dashpot of Hertz has no derivative.
    constexpr double first = 1e-9, last = 4e-3, longest = 800;
    double const damping = (stiffening == Stiffening::hertz ? std::sqrt(5.0) : 2.0) * damping_ratio;
    Motion at{0, 1};
    double before = force(at, damping, stiffening);
    double h = first;
    for (double t = 0; t < longest; t += h, h = std::fmin(1.1 * h, last))
    {
        Motion const next = advance(at, h, damping, stiffening);
        double const after = force(next, damping, stiffening);
        // The force ends within this step, and with it the change of speed, which is of second order here.
        if (next.speed < 0 && after >= 0) return -advance(at, h * before / (before - after), damping, stiffening).speed;
        at = next;
        before = after;
    }
    return 0;  // overdamped beyond any use
}

double damping_ratio_without_attraction(double restitution, Stiffening stiffening)
{
    if (restitution >= 1) return 0;
    // The rebound falls as the damping grows: bisection.
    double low = 0, high = 1;
    while (restitution_without_attraction(high, stiffening) > restitution)
        high *= 2;
    for (int k = 0; k < 40; ++k)
    {
        double const middle = (low + high) / 2;
        (restitution_without_attraction(middle, stiffening) > restitution ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace gimdem
