// SPDX-License-Identifier: BSD-3-Clause
/// The shared integral of the Gaussian Integral Method as tables of polynomials, for scenes of few radii and few cell
/// sizes, theory.md (G.11): one square root and eight multiplications instead of four erfc.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "exec/Buffer.hpp"
#include "exec/HostDevice.hpp"
#include "mapping/CellCurve.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// One pair of a radius and a cell: its table, and what turns mu^2 into the table's argument
/// x = sqrt(max(0, mu^2 scale - offset)): the distance of the centres from where the Gaussians begin to cross, counted
/// in intervals of the table.
struct TabulatedPair
{
    double scale;        ///< [1/m^2]
    double offset;       ///< [1]
    std::int64_t table;  ///< place of its first coefficient
};

/// What kernels see of the tables.
struct GaussianTableView
{
    static constexpr int intervals = 512;
    static constexpr int degree = 5;
    /// The coefficient of u^j, u = x - (i + 1/2), of interval i is at [j * stride + i]; the one past the last is zero.
    static constexpr int stride = intervals + 1;
    static constexpr int length = (degree + 1) * stride;

    double const* radii;         ///< of the rows [m]
    TabulatedPair const* pairs;  ///< shape=(n_rows, n_cells)
    double const* coefficients;
    std::int32_t row_count;
    std::int32_t cell_count;

    /// Pairs of a radius that provide() has seen with every cell: shape=(n_cells,).
    GIMDEM_HD TabulatedPair const* row(double radius) const
    {
        std::int32_t r = 0;
        while (radii[r] != radius)
            ++r;
        return pairs + static_cast<std::int64_t>(r) * cell_count;
    }

    /// Argument of a table, at most `intervals`.
    GIMDEM_HD double argument(double mu2, double scale, double offset) const
    {
        double const x2 = mu2 * scale - offset;
        double const x = std::sqrt(x2 > 0 ? x2 : 0);
        return x < intervals ? x : intervals;
    }

    /// I / V_p.
    GIMDEM_HD double operator()(TabulatedPair const& pair, double mu2) const
    {
        double const x = argument(mu2, pair.scale, pair.offset);
        int const i = static_cast<int>(x);
        double const u = x - (i + 0.5);
        double const* const c = coefficients + pair.table + i;
        double sum = 0;
        for (int j = degree; j >= 0; --j)
            sum = sum * u + c[j * stride];
        return sum > 0 ? sum : 0;
    }
};

/// A table's function once more as a curve, for eight cells that share a table.
struct SharedCurve
{
    CellCurve curve;   ///< its scale and offset are not used
    double per_table;  ///< x^4 of the curve over x^2 of the table; 0: the curve is too coarse
};

/// The tables of all pairs of the scene's radii and its classes of cells.
class GaussianTables
{
public:
    /// Cells are of one class if their volumes differ by less than this, relatively: as much as the last digits of mesh
    /// files. The integral differs by less than that.
    static constexpr double class_tolerance = 1e-7;
    /// More tables than this do not stay in the cache.
    static constexpr std::size_t most_tables = 128;
    /// Largest error of I / V_p against the closed form that a table may have.
    static constexpr double error_bound = 1e-11;

    /// fixed_coefficient: phi of all pairs; 0: that of Eq. 27.
    explicit GaussianTables(PolyMesh const& mesh, double fixed_coefficient = 0);

    /// Sees to tables for all radii. False where there are none: the scene has too many radii and cell sizes, or a
    /// particle so nearly as large as a cell that its table would miss `error_bound`.
    bool provide(ParticleState const& particles);

    GaussianTableView view() const;
    /// Of each table, in the order of the tables.
    exec::Buffer<SharedCurve> const& curves() const { return curves_; }

private:
    void add_row(double radius);
    double add_table(double radius, double volume);                 ///< returns the width of its intervals
    void add_curve(double radius, double volume, double interval);  ///< of the table, as a distance [m]

    std::vector<double> volumes_;         ///< per cell [m^3]
    std::vector<std::int32_t> class_of_;  ///< per cell
    std::vector<double> class_volumes_;   ///< [m^3]
    exec::Buffer<double> radii_;
    exec::Buffer<TabulatedPair> pairs_;
    exec::Buffer<double> coefficients_;
    exec::Buffer<SharedCurve> curves_;
    double fixed_coefficient_;
    bool usable_ = true;
};

}  // namespace gimdem
