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
    using Octets = exec::OctetOfQuads;

    /// Some particles of one cell and one radius.
    struct Some
    {
        static constexpr int most = 64;

        int count = 0;
        std::int32_t particle[most];
        double* to[most];  ///< their rows

        /// In the lanes of the last eight that have no particle the first one is repeated.
        int load(Quad const* position, Octets* at)
        {
            int const octets = (count + exec::octet - 1) / exec::octet;
            for (int k = count; k < exec::octet * octets; ++k)
                particle[k] = particle[0];
            for (int e = 0; e < octets; ++e)
                at[e] = exec::load(position, particle + exec::octet * e);
            return octets;
        }
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
            if (some.count < Some::most) continue;
            fill(c, row, some);
            some.count = 0;
        }
        if (some.count > 0) fill(c, row, some);
    }

    void fill(std::int32_t c, std::int32_t row, Some& some) const
    {
        std::int32_t const* const candidates = rows.layer_cells + rows.layer_offsets[c];
        int const length = rows.length(c);
        Octets at[Some::most / exec::octet];
        int const octets = some.load(position, at);
        for (int k = 0; k < length; k += exec::octet)
        {
            CellCurve const* of[exec::octet];
            int const lanes = lanes_left(length, k);
            bool all = true;
            for (int j = 0; j < lanes; ++j)
            {
                of[j] = curves.find(row, candidates[k + j]);
                all = all && of[j] != nullptr;
            }
            for (int e = 0; e < octets; ++e)
                fill(of, lanes, at[e], some, exec::octet * e, k);
            if (!all) fill_by_closed_form(of, candidates + k, lanes, some, k);
        }
    }

    /// Eight particles, from the given one on, with up to eight candidates, at place k of the rows.
    static void fill(CellCurve const* const* of, int lanes, Octets const& at, Some const& some, int particle, int k)
    {
        Octet values[exec::octet];
        for (int j = 0; j < exec::octet; ++j)
            values[j] = j < lanes && of[j] != nullptr ? (*of[j])(at) : Octet::Constant(0);
        exec::transpose(values);
        for (int lane = 0; lane < exec::octet && particle + lane < some.count; ++lane)
            exec::store_first(values[lane], lanes, some.to[particle + lane] + k);
    }

    /// Those of up to eight candidates that have no curve.
    void fill_by_closed_form(CellCurve const* const* of, std::int32_t const* candidates, int lanes, Some const& some,
                             int k) const
    {
        CandidateCentres const at(cell, candidates, lanes);
        ClosedFormIntegrals const integrals(sizes, at);
        double values[exec::octet];
        for (int m = 0; m < some.count; ++m)
        {
            integrals(position[some.particle[m]], values);
            for (int j = 0; j < lanes; ++j)
                if (of[j] == nullptr) some.to[m][k + j] = values[j];
        }
    }
};

}  // namespace gimdem
