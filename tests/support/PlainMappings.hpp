// SPDX-License-Identifier: BSD-3-Clause
/// Shares of one particle and one cell as they are first written down: no table, no vector, no candidate left out. What
/// tests compare with, and what benchmarks are measured against.
#pragma once

#include <cmath>
#include <cstdint>

#include "mapping/Method.hpp"
#include "mapping/overlap/CellOverlap.hpp"
#include "mesh/PolyMesh.hpp"
#include "particles/ParticleState.hpp"

namespace gimdem::test
{

/// Eqs. 17-19 and 27 of the paper, for V_c > V_p.
struct PlainGim
{
    MeshKernelView mesh;

    double operator()(Quad const& particle, std::int32_t cell) const
    {
        double const volume_p = sphere_volume(particle.w), volume_c = mesh.cell[cell].w;
        double const phi = 0.579 * std::pow(volume_p / volume_c, 0.132);
        double const sigma_p = phi * particle.w, sigma_c = phi * std::cbrt(0.75 / M_PI * volume_c);
        double const mu = (particle.xyz() - mesh.cell[cell].xyz()).norm();
        double const difference = sigma_c * sigma_c - sigma_p * sigma_p;
        double const discriminant = mu * mu - 2 * difference * std::log(volume_c * sigma_p / (volume_p * sigma_c));
        if (!(discriminant > 0)) return volume_p;
        double const root = sigma_p * sigma_c * std::sqrt(discriminant);
        double const x1 = (-mu * sigma_p * sigma_p - root) / difference;
        double const x2 = (-mu * sigma_p * sigma_p + root) / difference;
        auto const below = [](double x, double sigma) { return 0.5 * (1 + std::erf(x / (std::sqrt(2.0) * sigma))); };
        return volume_p * (1 - below(x2, sigma_p) + below(x1, sigma_p)) +
               volume_c * (below(x2 - mu, sigma_c) - below(x1 - mu, sigma_c));
    }
};

/// (G.28).
struct PlainFbsi
{
    MeshKernelView mesh;

    double operator()(Quad const& particle, std::int32_t cell) const
    {
        double product = 1;
        for (std::int32_t k = mesh.cell_offsets[cell]; k < mesh.cell_offsets[cell + 1]; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            if (face >= mesh.internal_face_count) continue;
            double const outside = mesh.distance_outside(face, cell, particle.xyz()) / particle.w;
            double const t = outside > 1 ? 0 : (outside < -1 ? 1 : (1 - outside) / 2);
            product *= t * t * (3 - 2 * t);
        }
        return product;
    }
};

/// (G.24), from all facets.
struct PlainExact
{
    overlap::CellFacetsView facets;

    double operator()(Quad const& particle, std::int32_t cell) const
    {
        double const volume = overlap::BallOverlap{facets, particle.xyz(), particle.w}.sum_of_cones(cell);
        return volume > 0 ? volume : 0;
    }
};

/// Weights of one particle on a row of cells, by any of these.
template <class Shares>
void plain_weights(Shares const& share, Quad const& particle, std::int32_t const* cells, int count, double* w)
{
    double total = 0;
    for (int k = 0; k < count; ++k)
        total += w[k] = share(particle, cells[k]);
    for (int k = 0; k < count; ++k)
        w[k] /= total;
}

}  // namespace gimdem::test
