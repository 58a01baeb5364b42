// SPDX-License-Identifier: BSD-3-Clause
/// `fbsi`, face-based soft intersection, theory.md (G.28): a cell's share is the product over its faces of the part of
/// the particle behind each. Faces of the boundary do not count, so that nothing is lost through walls.
#pragma once

#include "exec/Selection.hpp"
#include "mapping/FacePlanes.hpp"
#include "mapping/methods/ReachingMethod.hpp"

namespace gimdem
{

/// Shares of one particle, eight faces at a time.
struct SoftIntersection
{
    FacePlanesView planes;

    void operator()(Quad const& particle, std::int32_t const* cells, int count, double* w) const
    {
        for (int first = 0; first < count; first += some)
            take(particle, cells + first, count - first < some ? count - first : some, w + first);
    }

private:
    using Octet = exec::Octet;
    static constexpr int some = 64;

    // Most candidates have a face that the particle is beyond: those are sorted out before any share is computed, and
    // without a branch, which nobody could predict.
    void take(Quad const& particle, std::int32_t const* cells, int count, double* w) const
    {
        std::int32_t kept[some];
        int kept_count = 0;
        for (int k = 0; k < count; ++k)
        {
            w[k] = 0;
            kept[kept_count] = k;
            kept_count += !is_beyond_a_first_face(particle, cells[k]);
        }
        for (int i = 0; i < kept_count; ++i)
            w[kept[i]] = share(particle, cells[kept[i]]);
    }

    bool is_beyond_a_first_face(Quad const& particle, std::int32_t cell) const
    {
        return exec::greater_lanes(Octet::Constant(-particle.w), planes.inside(planes.offsets[cell], cell, particle)) !=
               0;
    }

    double share(Quad const& particle, std::int32_t cell) const
    {
        double const per_radius = 1 / particle.w;
        Octet product = Octet::Constant(1);
        for (std::int32_t i = planes.offsets[cell]; i < planes.offsets[cell + 1]; ++i)
            product = product * part_behind(Octet(planes.inside(i, cell, particle) * per_radius));
        return product_of_lanes(product);
    }

    /// Part of a ball behind a plane that its centre is `inside` of, in units of the radius: the spherical cap.
    static Octet part_behind(Octet const& inside)
    {
        Octet const one = Octet::Constant(1);
        Octet const least = choose(greater(inside, one), one, inside);
        Octet const t = 0.5 + 0.5 * choose(greater(least, -one), least, -one);
        return t * t * (3 - 2 * t);
    }

    static double product_of_lanes(Octet const& x)
    {
        double const a = x[0] * x[4], b = x[1] * x[5], c = x[2] * x[6], d = x[3] * x[7];
        return a * c * (b * d);
    }
};

class FaceSoftIntersection : public ReachingMethod
{
public:
    // All cells whose faces' planes a ball may reach: the corners of a box around it.
    FaceSoftIntersection(exec::Execution const& execution, PolyMesh const& mesh)
        : ReachingMethod(execution, mesh, 1.7320508075688772), planes_(mesh)
    {
    }

    void compute_weights(WeightTask const& task) override { fill_rows(task, SoftIntersection{planes_.view()}); }

private:
    FacePlanes planes_;
};

}  // namespace gimdem
