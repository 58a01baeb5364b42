// SPDX-License-Identifier: BSD-3-Clause
/// The curves of the cells that particles come near, made as they do, theory.md (G.11a).
#pragma once

#include <cstdint>

#include "exec/Buffer.hpp"
#include "mapping/CellCurve.hpp"
#include "mapping/Method.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// What kernels see of the curves.
struct CellCurvesView
{
    double const* radii;           ///< of the rows [m]
    std::int32_t const* curve_of;  ///< shape=(n_rows, n_cells); negative: none
    CellCurve const* curves;
    std::int32_t row_count;
    std::int32_t cell_count;

    /// Null where the pair has none.
    CellCurve const* find(std::int32_t row, std::int32_t cell) const
    {
        std::int32_t const place = curve_of[static_cast<std::int64_t>(row) * cell_count + cell];
        return place < 0 ? nullptr : curves + place;
    }
};

/// Makes the curve of one radius and one cell; returns the largest error of I / V_p against the closed form where
/// it is checked; it is taken if that is less than half of CellCurves::error_bound.
/// fixed_coefficient: phi; 0: that of Eq. 27.
double make_curve(CellCurve& curve, double radius, Quad const& cell, double fixed_coefficient);

class CellCurves
{
public:
    /// More radii than this are no few.
    static constexpr std::int64_t most_radii = 4;
    /// More pairs of a radius and a cell would take too much memory: 1 kB each.
    static constexpr std::int64_t most_pairs = 250'000;
    /// Largest error of I / V_p against the closed form that a curve may have.
    static constexpr double error_bound = 1e-11;

    /// fixed_coefficient: phi of all pairs; 0: that of Eq. 27.
    explicit CellCurves(PolyMesh const& mesh, double fixed_coefficient = 0)
        : mesh_(mesh), fixed_coefficient_(fixed_coefficient)
    {
    }

    /// Sees to curves for all radii and all candidates of the occupied cells. False where there are none: too many
    /// radii, or radii and cells.
    bool provide(WeightTask const& task);

    CellCurvesView view() const;

private:
    static constexpr std::int32_t not_made = -1, too_coarse = -2;

    bool add_radii(ParticleState const& particles);
    void list_missing(WeightTask const& task);

    PolyMesh const& mesh_;
    double fixed_coefficient_;
    bool usable_ = true;
    exec::Buffer<double> radii_;
    exec::Buffer<std::uint8_t> seen_;      ///< 1 for cells whose candidates have all curves
    exec::Buffer<std::int32_t> curve_of_;  ///< as the view's, or one of the two above
    exec::Buffer<CellCurve> curves_;
    exec::Buffer<std::int64_t> missing_;  ///< pairs, places in curve_of_
};

}  // namespace gimdem
