// SPDX-License-Identifier: BSD-3-Clause
/// Shared integrals of the Gaussian Integral Method by the closed form, eight cells at a time: for scenes of more radii
/// and cell sizes than tables would do for.
#pragma once

#include <cmath>

#include "exec/ScaledErfc.hpp"
#include "exec/Selection.hpp"
#include "mapping/CandidateCentres.hpp"

namespace gimdem
{

/// What the closed form needs of a cell's volume, computed once.
struct CellSize
{
    double radius;      ///< of the sphere of its volume [m]
    double log_radius;  ///< its logarithm
    double tuning;      ///< radius^(-3 * 0.132): the cell's factor of Eq. 27
    double per_radius;  ///< [1/m]
};

/// Of all cells, and the coefficient.
struct CellSizes
{
    CellSize const* of_cell;
    double fixed_coefficient;  ///< phi of all pairs; 0: that of Eq. 27
};

/// (G.6) as (G.12) has it, with one exponential for each crossing. What is below 1e-18 of the particle for sure, (G.13)
/// and (G.14), is nothing.
class ClosedFormIntegrals
{
public:
    using Source = CellSizes;

    ClosedFormIntegrals(Source const& source, CandidateCentres const& at) : at_(at)
    {
        for (int j = 0; j < at.octets(); ++j)
        {
            auto const [radius, log_radius, tuning, per_radius] =
                exec::load_fours(&source.of_cell->radius, at.cells + exec::octet * j);
            sizes_[j] = {radius, log_radius, per_radius,
                         source.fixed_coefficient > 0 ? Octet::Constant(1 / source.fixed_coefficient)
                                                      : Octet(1 / 0.579 / tuning)};
        }
        tuned_ = !(source.fixed_coefficient > 0);
    }

    void operator()(Quad const& particle, double* shared) const
    {
        double const log_radius = std::log(particle.w);
        ParticleSize const size{particle.w, 1 / particle.w, log_radius, tuned_ ? std::exp(-3 * 0.132 * log_radius) : 1};
        for (int j = 0; j < at_.octets(); ++j)
            at_.store(j, integrals(size, sizes_[j], at_.distance2(j, particle)), shared);
    }

private:
    using Octet = exec::Octet;

    static constexpr double nothing = 41.45;  ///< -ln 1e-18

    struct ParticleSize
    {
        double radius, per_radius, log_radius;
        double per_coefficient;  ///< its factor of 1 / phi
    };
    struct CellOctet
    {
        Octet radius, log_radius, per_radius;
        Octet per_coefficient;  ///< their factors of 1 / phi
    };

    /// A particle and eight cells as (G.6) has them.
    struct PairOctet
    {
        exec::OctetMask cell_is_narrow;
        Octet s, per_s, log_s;
        Octet m2;  ///< m^2

        PairOctet(ParticleSize const& particle, CellOctet const& cell, Octet const& mu2)
            : cell_is_narrow(greater(Octet::Constant(particle.log_radius), cell.log_radius)),
              log_s(exec::magnitude(Octet(cell.log_radius - particle.log_radius)))
        {
            Octet const radius = Octet::Constant(particle.radius), per_radius = Octet::Constant(particle.per_radius);
            Octet const per_narrow = choose(cell_is_narrow, cell.per_radius, per_radius);
            s = choose(cell_is_narrow, radius, cell.radius) * per_narrow;
            per_s = choose(cell_is_narrow, per_radius, cell.per_radius) * choose(cell_is_narrow, cell.radius, radius);
            Octet const per_deviation = per_narrow * (cell.per_coefficient * particle.per_coefficient);
            m2 = mu2 * (per_deviation * per_deviation);
        }
    };

    /// I / V_p.
    static Octet integrals(ParticleSize const& particle, CellOctet const& cell, Octet const& mu2)
    {
        PairOctet const pair(particle, cell, mu2);
        Octet const c = pair.m2 - 4 * (pair.s * pair.s) * pair.log_s;
        Octet const limit2 = 2 * (nothing + pair.log_s);
        Octet const c2 = c * exec::magnitude(c), bound = limit2 * ((1 + pair.s) * (1 + pair.s)) * pair.m2;
        Octet const zero = Octet::Constant(0);
        if (exec::greater_lanes(c2, bound) == exec::all_lanes) return zero;

        Octet const of_narrow = in_narrow(pair, c, limit2);
        Octet const per_cube = pair.per_s * pair.per_s * pair.per_s;
        return choose(greater(c2, bound), zero, choose(pair.cell_is_narrow, Octet(per_cube * of_narrow), of_narrow));
    }

    /// I / V_<, (G.12). The names are those of (G.6); limit2: 2 lambda.
    static Octet in_narrow(PairOctet const& pair, Octet const& c, Octet const& limit2)
    {
        using namespace exec;
        Octet const one = Octet::Constant(1), zero = Octet::Constant(0);
        double const h = 0.70710678118654752440;
        Octet const m = root(pair.m2);
        Octet const a = at_least(0.0, Octet(pair.s * pair.s - one));
        Octet const discriminant = plus_product(pair.m2, a, c);
        auto const crosses = greater(discriminant, zero);
        Octet const sum = m + root(choose(crosses, discriminant, one));

        Octet const right = c / sum;
        Octet const z0 = h * right, z2 = h * (m - right) * pair.per_s;
        Octet const tail = scaled_erfc(magnitude(z0)), core = pair.s * scaled_erfc(z2);
        auto const is_left = greater(zero, z0);
        Octet twice = choose(is_left, Octet(zero + 2), zero) +
                      exponential(Octet(-z0 * z0)) * (core + choose(is_left, -tail, tail));

        Octet const sum2 = sum * sum, bound = limit2 * (a * a);
        if (greater_lanes(bound, sum2) != 0)
        {
            Octet const left = sum / a;  // of the narrow one's centre
            Octet const z1 = h * left, z3 = h * (m + left) * pair.per_s;
            Octet const tails = exponential(Octet(-z1 * z1)) * (scaled_erfc(z1) - pair.s * scaled_erfc(z3));
            twice = choose(greater(bound, sum2), Octet(twice + tails), twice);
        }
        return choose(crosses, Octet(0.5 * twice), one);
    }

    CandidateCentres const& at_;
    CellOctet sizes_[CandidateCentres::most_octets];
    bool tuned_;
};

}  // namespace gimdem
