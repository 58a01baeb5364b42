// SPDX-License-Identifier: BSD-3-Clause
/// Weights (G.8) of the particles of one cell by the curves of its candidates: eight particles at a time, so that the
/// lanes share a curve.
#pragma once

#include <cstdint>

#include "mapping/CellCurves.hpp"
#include "mapping/ClosedFormIntegrals.hpp"
#include "mapping/Method.hpp"

namespace gimdem
{

/// Weights of the particles of the i-th occupied cell. Candidates without a curve are computed by the closed form.
struct CurveKernel
{
    std::int32_t const* occupied;
    Quad const* position;
    Quad const* cell;
    WeightRows rows;
    CellCurvesView curves;
    CellSizes sizes;
    double* weights;

    void operator()(std::int64_t i) const
    {
        std::int32_t const c = occupied[i];
        for (std::int32_t row = 0; row < curves.row_count; ++row)
            fill(c, row);
        int const length = rows.length(c);
        double* w = weights + rows.first[c];
        for (std::int32_t m = rows.particle_offsets[c]; m < rows.particle_offsets[c + 1]; ++m, w += length)
            normalise(w, length);
    }

private:
    using Octet = exec::Octet;

    /// Some particles of one cell and one radius.
    struct Some
    {
        int count = 0;
        std::int32_t particle[exec::octet];
        double* to[exec::octet];  ///< their rows
    };

    /// Rows of a cell's particles of one radius.
    void fill(std::int32_t c, std::int32_t row) const
    {
        int const length = rows.length(c);
        double* w = weights + rows.first[c];
        Some some;
        for (std::int32_t m = rows.particle_offsets[c]; m < rows.particle_offsets[c + 1]; ++m, w += length)
        {
            std::int32_t const p = rows.members[m];
            if (position[p].w != curves.radii[row]) continue;
            some.particle[some.count] = p;
            some.to[some.count++] = w;
            if (some.count < exec::octet) continue;
            fill(c, row, some);
            some.count = 0;
        }
        if (some.count > 0) fill(c, row, some);
    }

    void fill(std::int32_t c, std::int32_t row, Some& some) const
    {
        std::int32_t const* const candidates = rows.layer_cells + rows.layer_offsets[c];
        int const length = rows.length(c);
        for (int lane = some.count; lane < exec::octet; ++lane)
            some.particle[lane] = some.particle[0];
        exec::OctetOfQuads const at = exec::load(position, some.particle);
        std::int32_t without[CandidateCentres::most];
        int without_count = 0;
        for (int k = 0; k < length; k += exec::octet)
        {
            int const lanes = lanes_left(length, k);
            Octet values[exec::octet];
            for (int j = 0; j < exec::octet; ++j)
            {
                values[j] = Octet::Constant(0);
                if (j >= lanes) continue;
                CellCurve const* const curve = curves.find(row, candidates[k + j]);
                if (curve == nullptr)
                    without[without_count++] = k + j;
                else
                    values[j] = (*curve)(at);
            }
            exec::transpose(values);
            for (int lane = 0; lane < some.count; ++lane)
                exec::store_first(values[lane], lanes, some.to[lane] + k);
            if (without_count + exec::octet <= CandidateCentres::most && k + exec::octet < length) continue;
            if (without_count > 0) fill_by_closed_form(candidates, without, without_count, some);
            without_count = 0;
        }
    }

    /// At these places of the rows.
    void fill_by_closed_form(std::int32_t const* candidates, std::int32_t const* places, int count,
                             Some const& some) const
    {
        std::int32_t cells[CandidateCentres::most];
        for (int k = 0; k < count; ++k)
            cells[k] = candidates[places[k]];
        CandidateCentres const at(cell, cells, count);
        ClosedFormIntegrals const integrals(sizes, at);
        double values[CandidateCentres::most];
        for (int lane = 0; lane < some.count; ++lane)
        {
            integrals(position[some.particle[lane]], values);
            for (int k = 0; k < count; ++k)
                some.to[lane][places[k]] = values[k];
        }
    }
};

}  // namespace gimdem
