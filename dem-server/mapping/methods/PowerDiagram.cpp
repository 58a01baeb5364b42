// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/methods/PowerDiagram.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mapping/PotentialShare.hpp"

namespace gimdem
{

namespace
{

struct Law
{
    PotentialShare of;

    GIMDEM_HD void operator()(Quad const& particle, std::int32_t const* cells, int count, double* w) const
    {
        double least = 1e300;
        for (int k = 0; k < count; ++k)
        {
            w[k] = of.level(particle, cells[k]);
            least = w[k] < least ? w[k] : least;
        }
        for (int k = 0; k < count; ++k)
            w[k] = of.share(particle, cells[k], w[k], least);
    }
};

/// Whether a ball of the radius r with its centre in `cell` may give something to the cell of another potential. For
/// sure not where it says so: the difference of the two is no less than its linear part at the corners of the cell and
/// the least that its second derivatives can add.
class MayGive
{
public:
    MayGive(PolyMesh const& mesh, std::int32_t cell, double r) : centre_(mesh.centroid(cell)), radius_(r)
    {
        for (std::int32_t const f : mesh.faces_of_cell(cell))
            for (std::int32_t const p : mesh.points_of_face(f))
            {
                // A tenth more: a particle may be beyond its cell, in a wall.
                corners_.push_back(1.1 * (mesh.point(p) - centre_));
                extent2_ = std::max(extent2_, corners_.back().squaredNorm());
            }
    }

    bool operator()(CellPotential const& own, CellPotential const& other) const
    {
        Eigen::Matrix3d const bend = hessian(other) - hessian(own);
        double const lowest = std::min(0.0, bend.selfadjointView<Eigen::Lower>().eigenvalues()[0]);
        double const level = value(other) - value(own) + lowest / 2 * extent2_;
        Vec3 const slope = gradient(other) - gradient(own);
        return std::ranges::any_of(corners_, [&](Vec3 const& y) { return level + slope.dot(y) < 1; });
    }

private:
    double value(CellPotential const& q) const { return q(Quad::of(centre_, 0)) * per_reach(q, radius_); }
    Eigen::Matrix3d hessian(CellPotential const& q) const
    {
        double const* const h = q.half_hessian;
        Eigen::Matrix3d full;
        full << 2 * h[0], h[5], h[4], h[5], 2 * h[1], h[3], h[4], h[3], 2 * h[2];
        return full * per_reach(q, radius_);
    }
    Vec3 gradient(CellPotential const& q) const
    {
        Vec3 const y = centre_ - Vec3(q.centre[0], q.centre[1], q.centre[2]);
        return Vec3(q.gradient[0], q.gradient[1], q.gradient[2]) * per_reach(q, radius_) + hessian(q) * y;
    }

    Vec3 centre_;
    double radius_;
    double extent2_ = 0;
    std::vector<Vec3> corners_;
};

}  // namespace

PowerDiagram::PowerDiagram(exec::Execution const& execution, PolyMesh const& mesh)
    : ReachingMethod(execution, mesh, 2), mesh_(mesh), potentials_(fit_potentials(mesh))
{
}

// Of the cells within two radii those that may receive something, from either side.
CellRows PowerDiagram::find_candidates(double largest) const
{
    CellRows const nearby = within(2 * largest);
    std::int32_t const cells = mesh_.cell_count();
    std::vector<std::uint8_t> gives(static_cast<std::size_t>(nearby.cells.size()));
    std::uint8_t* const may = gives.data();
    exec::for_each_uneven(execution(), cells,
                          [&](std::int64_t c)
                          {
                              auto const cell = static_cast<std::int32_t>(c);
                              MayGive const may_give(mesh_, cell, largest);
                              for (std::int32_t k = nearby.offsets[c]; k < nearby.offsets[c + 1]; ++k)
                                  may[k] = may_give(potentials_[c], potentials_[nearby.cells[k]]);
                          });
    auto const gives_back = [&](std::int32_t from, std::int32_t to)
    {
        auto const row =
            nearby.cells.host().subspan(static_cast<std::size_t>(nearby.offsets[from]) + 1,
                                        static_cast<std::size_t>(nearby.offsets[from + 1] - nearby.offsets[from] - 1));
        return may[nearby.offsets[from] + 1 + (std::ranges::lower_bound(row, to) - row.begin())] != 0;
    };
    std::vector<std::int32_t> kept;
    CellRows candidates;
    candidates.offsets.resize(cells + 1);
    for (std::int32_t c = 0; c < cells; ++c)
    {
        candidates.offsets[c] = static_cast<std::int32_t>(kept.size());
        for (std::int32_t k = nearby.offsets[c]; k < nearby.offsets[c + 1]; ++k)
            if (std::int32_t const other = nearby.cells[k]; other == c || may[k] || gives_back(other, c))
                kept.push_back(other);
    }
    candidates.offsets[cells] = static_cast<std::int32_t>(kept.size());
    candidates.cells.resize(static_cast<std::int64_t>(kept.size()));
    std::ranges::copy(kept, candidates.cells.host().begin());
    return candidates;
}

void PowerDiagram::compute_weights(WeightTask const& task)
{
    fill_rows(task, Law{{potentials_.view().data}});
}

}  // namespace gimdem
