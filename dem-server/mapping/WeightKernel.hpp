// SPDX-License-Identifier: BSD-3-Clause
/// Weights (G.8) of the particles of one cell: the candidates' data is read once, then used by every particle.
#pragma once

#include <cstdint>

#include "mapping/CandidateCentres.hpp"
#include "mapping/ClosedFormIntegrals.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mapping/GaussianTable.hpp"
#include "mapping/Method.hpp"

namespace gimdem
{

/// Tables, and the curve of each.
struct TablesAndCurves
{
    GaussianTableView tables;
    SharedCurve const* curves;
};

/// Shared integrals from the tables, or from the curve of eight cells that share one.
class TabulatedIntegrals
{
public:
    using Source = TablesAndCurves;

    TabulatedIntegrals(Source const& source, CandidateCentres const& at) : source_(source), at_(at) {}

    /// The tables' operator() for all candidates.
    void operator()(Quad const& particle, double* shared)
    {
        if (particle.w != radius_) take_pairs(particle.w);
        for (int j = 0; j < at_.octets(); ++j)
            at_.store(j, integrals(j, at_.distance2(j, particle)), shared);
    }

private:
    using Octet = exec::Octet;

    Octet integrals(int j, Octet const& mu2) const
    {
        using Table = GaussianTableView;
        Octet const x2 = mu2 * scale_[j] - offset_[j];
        if (shared_[j] != nullptr) return shared_[j]->curve.at(x2 * shared_[j]->per_table);
        Octet const last = Octet::Constant(Table::intervals);
        Octet const x = exec::root(exec::at_least(0.0, x2));
        Octet const argument = choose(greater(x, last), last, x);
        std::int32_t place[exec::octet];
        Octet const interval = exec::whole_part(argument, place);
        Octet const u = argument - (interval + 0.5);
        for (int lane = 0; lane < exec::octet; ++lane)
            place[lane] += table_[exec::octet * j + lane];
        Octet sum = exec::gather(source_.tables.coefficients + Table::degree * Table::stride, place);
#pragma GCC unroll 8
        for (int k = Table::degree - 1; k >= 0; --k)
            sum = exec::plus_product(exec::gather(source_.tables.coefficients + k * Table::stride, place), sum, u);
        return exec::at_least(0.0, sum);
    }

    void take_pairs(double radius)
    {
        TabulatedPair const* const row = source_.tables.row(radius);
        for (int k = 0; k < exec::octet * at_.octets(); ++k)
        {
            TabulatedPair const& pair = row[at_.cells[k]];
            scale_[k / exec::octet][k % exec::octet] = pair.scale;
            offset_[k / exec::octet][k % exec::octet] = pair.offset;
            table_[k] = static_cast<std::int32_t>(pair.table);
        }
        for (int j = 0; j < at_.octets(); ++j)
            shared_[j] = shared_by(table_ + exec::octet * j);
        radius_ = radius;
    }

    /// The curve of eight tables; null unless they are one and it has a curve.
    SharedCurve const* shared_by(std::int32_t const* tables) const
    {
        for (int lane = 1; lane < exec::octet; ++lane)
            if (tables[lane] != tables[0]) return nullptr;
        SharedCurve const* const shared = source_.curves + tables[0] / GaussianTableView::length;
        return shared->per_table > 0 ? shared : nullptr;
    }

    Source source_;
    CandidateCentres const& at_;
    Octet scale_[CandidateCentres::most_octets], offset_[CandidateCentres::most_octets];
    std::int32_t table_[CandidateCentres::most];
    SharedCurve const* shared_[CandidateCentres::most_octets];
    double radius_ = 0;
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
