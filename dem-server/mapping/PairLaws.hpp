// SPDX-License-Identifier: BSD-3-Clause
/// What one cell takes of one particle by each mapping method, before the weights are normalised: for devices, where
/// each pair is computed by itself. A law is called with the particle, the cell that holds it, and the cell asked
/// about.
#pragma once

#include <cmath>
#include <cstdint>

#include "mapping/GaussianIntegral.hpp"
#include "mapping/GaussianTable.hpp"
#include "mapping/PotentialShare.hpp"
#include "mapping/WeightKernel.hpp"
#include "mapping/overlap/CellOverlap.hpp"
#include "mesh/PointLocator.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem
{

/// Shared integral I / V_p from the tables.
struct TabulatedIntegral1
{
    GaussianTableView tables;
    Quad const* cell;

    GIMDEM_HD double operator()(Quad const& particle, std::int32_t, std::int32_t c) const
    {
        double const dx = particle.x - cell[c].x, dy = particle.y - cell[c].y, dz = particle.z - cell[c].z;
        return tables(tables.row(particle.w)[c], dx * dx + dy * dy + dz * dz);
    }
};

/// The same by the closed form (G.6).
struct ClosedFormIntegral1
{
    CellSizes sizes;
    Quad const* cell;

    GIMDEM_HD double operator()(Quad const& particle, std::int32_t, std::int32_t c) const
    {
        double const log_radius = std::log(particle.w);
        CellSize const& size = sizes.of_cell[c];
        double const tuned = 0.579 * std::exp(3 * 0.132 * log_radius) * size.tuning;
        ParticleAndCell const pair{particle.w, size.radius / particle.w, size.log_radius - log_radius,
                                   sizes.fixed_coefficient > 0 ? sizes.fixed_coefficient : tuned};
        return pair((particle.xyz() - cell[c].xyz()).norm()).sum();
    }
};

/// `pcm` and `diffusion` (G.26): all for the own cell, the only candidate.
struct WholeOfOwnCell
{
    GIMDEM_HD double operator()(Quad const&, std::int32_t own, std::int32_t c) const { return own == c ? 1 : 0; }
};

/// `divided` (G.27): points in the cell.
struct PointCount1
{
    CellWalker walk;
    CellBox const* boxes;
    Quad const* points;  ///< in a ball of radius 1
    std::int32_t point_count;

    GIMDEM_HD double operator()(Quad const& particle, std::int32_t own, std::int32_t c) const
    {
        // A point beyond the boundary belongs to the last cell of its walk, which need not be within the radius.
        if (!(boxes[c].distance2(particle.xyz()) <= 2 * particle.w * particle.w)) return 0;
        int count = 0;
        std::int32_t at = own;
        for (std::int32_t i = 0; i < point_count; ++i)
        {
            at = walk(at, particle.xyz() + particle.w * points[i].xyz()).cell;
            count += at == c;
        }
        return count;
    }
};

/// `fbsi` (G.28): the product over the inner faces of the part of the ball behind each.
struct SoftIntersection1
{
    MeshKernelView mesh;

    GIMDEM_HD double operator()(Quad const& particle, std::int32_t, std::int32_t c) const
    {
        double product = 1;
        for (std::int32_t k = mesh.cell_offsets[c]; k < mesh.cell_offsets[c + 1] && product > 0; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            if (face >= mesh.internal_face_count) continue;
            double const outside = mesh.distance_outside(face, c, particle.xyz()) / particle.w;
            double const t = outside > 1 ? 0 : (outside < -1 ? 1 : (1 - outside) / 2);
            product *= t * t * (3 - 2 * t);
        }
        return product;
    }
};

/// `kernel` (G.29).
struct GaussianAtCentre1
{
    Quad const* cell;
    double radii;  ///< b in radii

    GIMDEM_HD double operator()(Quad const& particle, std::int32_t, std::int32_t c) const
    {
        double const x = (cell[c].xyz() - particle.xyz()).norm() / (radii * particle.w);
        return x < 3 ? cell[c].w * std::exp(-x * x) : 0;
    }
};

/// `power-diagram` (G.34)-(G.39).
struct PowerDiagram1
{
    PotentialShare of;

    GIMDEM_HD double level(Quad const& particle, std::int32_t c) const { return of.level(particle, c); }
    GIMDEM_HD double operator()(Quad const& particle, std::int32_t, std::int32_t c, double least) const
    {
        return of.share(particle, c, of.level(particle, c), least);
    }
};

/// `exact` (G.20)-(G.25).
struct Overlap1
{
    overlap::CellFacetsView facets;

    GIMDEM_HD double operator()(Quad const& particle, std::int32_t, std::int32_t c) const
    {
        return overlap::BallOverlap{facets, particle.xyz(), particle.w}(c);
    }
};

}  // namespace gimdem
