// SPDX-License-Identifier: BSD-3-Clause
/// Weights (G.8) of the particles of one cell: the candidates' data is read once, then used by every particle.
#pragma once

#include <cmath>
#include <cstdint>

#include "exec/Octet.hpp"
#include "exec/Vector.hpp"
#include "exec/VectorMath.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/GaussianTable.hpp"
#include "mapping/Method.hpp"

namespace gimdem
{

/// Centres of some candidate cells, side by side for vector instructions. Lanes past `count` repeat the first cell.
struct CandidateCentres
{
    static constexpr int most = exec::vector_width;

    int count;
    std::int32_t cells[most];
    alignas(64) double x[most], y[most], z[most];

    CandidateCentres(Quad const* cell, std::int32_t const* candidates, int count_) : count(count_)
    {
        for (int k = 0; k < most; ++k)
        {
            cells[k] = candidates[k < count ? k : 0];
            x[k] = cell[cells[k]].x;
            y[k] = cell[cells[k]].y;
            z[k] = cell[cells[k]].z;
        }
    }

    /// Number of lanes that cover the candidates, in whole vector registers.
    int lanes() const { return (count + 7) / 8 * 8; }

    double distance2(int k, Quad const& p) const
    {
        double const dx = p.x - x[k], dy = p.y - y[k], dz = p.z - z[k];
        return dx * dx + dy * dy + dz * dz;
    }
};

/// Shared integrals from the tables.
class TabulatedIntegrals
{
public:
    using Source = GaussianTableView;

    TabulatedIntegrals(Source const& source, CandidateCentres const& at) : source_(source), at_(at) {}

    /// The tables' operator() for all candidates.
    void operator()(Quad const& particle, double* shared)
    {
        if (particle.w != radius_) take_pairs(particle.w);
        alignas(64) double sum[CandidateCentres::most];
        for (int k = 0; k < at_.lanes(); k += exec::octet)
            evaluate(k, particle, sum + k);
        for (int k = 0; k < at_.count; ++k)
            shared[k] = sum[k];
    }

private:
    void evaluate(int k, Quad const& particle, double* shared) const
    {
        using Octet = exec::OctetArray;
        auto const at = [k](double const* values) { return Eigen::Map<Octet const, Eigen::Aligned64>(values + k); };
        Octet const dx = particle.x - at(at_.x), dy = particle.y - at(at_.y), dz = particle.z - at(at_.z);
        Octet const x2 = (dx * dx + dy * dy + dz * dz) * at(scale_) - at(offset_);
        Octet const x = x2.max(0).sqrt().min(GaussianTableView::intervals);
        Octet const i = x.floor();
        Octet const u = x - (i + 0.5);
        Eigen::Array<std::int32_t, exec::octet, 1> const place =
            i.cast<std::int32_t>() + Eigen::Map<Eigen::Array<std::int32_t, exec::octet, 1> const>(table_ + k);
        Octet sum = Octet::Zero();
        for (int j = GaussianTableView::degree; j >= 0; --j)
            sum = sum * u + exec::gather(source_.coefficients + j * GaussianTableView::stride, place);
        Eigen::Map<Octet, Eigen::Aligned64>{shared} = sum.max(0);
    }

    void take_pairs(double radius)
    {
        TabulatedPair const* const row = source_.row(radius);
        for (int k = 0; k < CandidateCentres::most; ++k)
        {
            TabulatedPair const& pair = row[at_.cells[k]];
            scale_[k] = pair.scale;
            offset_[k] = pair.offset;
            table_[k] = static_cast<std::int32_t>(pair.table);
        }
        radius_ = radius;
    }

    Source source_;
    CandidateCentres const& at_;
    alignas(64) double scale_[CandidateCentres::most], offset_[CandidateCentres::most];
    std::int32_t table_[CandidateCentres::most];
    double radius_ = 0;
};

/// What the closed form needs of a cell's volume, computed once.
struct CellSize
{
    double radius;      ///< of the sphere of its volume [m]
    double log_radius;  ///< its logarithm
    double tuning;      ///< radius^(-3 * 0.132): the cell's factor of Eq. 27
};

/// Of all cells, and the coefficient.
struct CellSizes
{
    CellSize const* of_cell;
    double fixed_coefficient;  ///< phi of all pairs; 0: that of Eq. 27
};

/// Shared integrals by the closed form (G.6), many candidates at a time.
class ClosedFormIntegrals
{
public:
    using Source = CellSizes;

    ClosedFormIntegrals(Source const& cell_sizes, CandidateCentres const& at)
        : at_(at), fixed_coefficient_(cell_sizes.fixed_coefficient)
    {
        for (int k = 0; k < batch; ++k)
        {
            CellSize const& size = cell_sizes.of_cell[at.cells[k]];
            radius_[k] = size.radius;
            log_cell_[k] = size.log_radius;
            factor_[k] = size.tuning;
        }
    }

    void operator()(Quad const& particle, double* shared) const
    {
        double const log_radius = std::log(particle.w);
        double const tuning = 0.579 * std::exp(3 * 0.132 * log_radius);
        exec::Lanes mu2;
        for (int k = 0; k < batch; ++k)
            mu2[k] = at_.distance2(k, particle);
        exec::Lanes const coefficient = fixed_coefficient_ > 0 ? exec::Lanes(exec::Lanes::Constant(fixed_coefficient_))
                                                               : exec::Lanes(tuning * factor_);
        ParticleAndCell<exec::Lanes> const pairs{particle.w, radius_ / particle.w, log_cell_ - log_radius, coefficient};
        TailArguments<exec::Lanes> const arguments = pairs(mu2.sqrt());
        exec::Lanes tails[4];
        take_tails(arguments, tails);
        exec::Lanes const sum = arguments.sum(tails[0], tails[1], tails[2], tails[3]);
        for (int k = 0; k < at_.count; ++k)
            shared[k] = sum[k];
    }

private:
    static constexpr int batch = CandidateCentres::most;

    /// erfc of all arguments, packed so that no lane is idle; a tail below 1e-18 of the particle is nothing.
    void take_tails(TailArguments<exec::Lanes> const& arguments, exec::Lanes* tails) const
    {
        double packed[4 * batch];
        std::int16_t place[4 * batch];
        int active = 0;
        for (int t = 0; t < 4; ++t)
        {
            tails[t].setZero();
            for (int k = 0; k < at_.count; ++k)
            {
                // erfc(x) < exp(-x^2); the last two tails count s^3 times.
                double const x = arguments.x[t][k];
                double const limit2 = 41 + (t < 2 ? 0.0 : arguments.log_cube[k]);
                packed[active] = x;
                place[active] = static_cast<std::int16_t>(t * batch + k);
                active += !(x > 0 && x * x > limit2);
            }
        }
        exec::erfc_many(packed, active);
        for (int i = 0; i < active; ++i)
            tails[place[i] / batch][place[i] % batch] = packed[i];
    }

    CandidateCentres const& at_;
    double fixed_coefficient_;
    exec::Lanes radius_, log_cell_, factor_;
};

/// Weights of the particles of the i-th occupied cell.
template <class Integrals>
struct WeightKernel
{
    std::int32_t const* occupied;
    Quad const* position;
    Quad const* cell;
    WeightRows rows;
    typename Integrals::Source source;
    double* weights;

    void operator()(std::int64_t i) const
    {
        std::int32_t const c = occupied[i];
        std::int32_t const* const candidates = rows.layer_cells + rows.layer_offsets[c];
        std::int32_t const* const particles = rows.members + rows.particle_offsets[c];
        int const particle_count = rows.particle_offsets[c + 1] - rows.particle_offsets[c];
        int const length = rows.length(c);
        double* const first = weights + rows.first[c];
        for (int k = 0; k < length; k += CandidateCentres::most)
        {
            int const left = length - k;
            CandidateCentres const at(cell, candidates + k,
                                      left < CandidateCentres::most ? left : CandidateCentres::most);
            Integrals integrals(source, at);
            for (int m = 0; m < particle_count; ++m)
                integrals(position[particles[m]], first + m * length + k);
        }
        for (int m = 0; m < particle_count; ++m)
            normalise(first + m * length, length);
    }
};

}  // namespace gimdem
