// SPDX-License-Identifier: BSD-3-Clause
/// `divided`, the divided volume method: points spread over the particle stand for equal parts of its volume, and each
/// gives its part to the cell that it is in, theory.md (G.27).
#pragma once

#include <cmath>
#include <numbers>

#include "mapping/methods/ReachingMethod.hpp"
#include "mesh/PointLocator.hpp"

namespace gimdem
{

/// 29 points: the centre, and two shells of 14, along the axes and the diagonals. Each stands for 1/29 of the ball and
/// a shell is at the mean radius of its points' parts.
inline exec::Buffer<Quad> satellite_points()
{
    exec::Buffer<Quad> points(29);
    points[0] = {0, 0, 0, 0};
    std::int64_t n = 1;
    double inner3 = 1.0 / 29;
    for (int shell = 0; shell < 2; ++shell)
    {
        double const outer3 = inner3 + 14.0 / 29;
        double const radius = 0.75 * (std::pow(outer3, 4.0 / 3) - std::pow(inner3, 4.0 / 3)) / (outer3 - inner3);
        for (int k = 0; k < 27; ++k)
        {
            Vec3 const way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            bool const axis = way.squaredNorm() == 1, diagonal = way.squaredNorm() == 3;
            if (axis || diagonal) points[n++] = Quad::of(radius * way.normalized(), 0);
        }
        inner3 = outer3;
    }
    return points;
}

/// `count` points on a spiral around the z axis (golden angle) whose radii share the volume evenly.
inline exec::Buffer<Quad> spiral_points(std::int64_t count)
{
    exec::Buffer<Quad> points(count);
    double const golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::int64_t i = 0; i < count; ++i)
    {
        // Heights and radii are two sequences that do not follow each other: van der Corput's for the radii.
        double const z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(count);
        double share = 0, digit = 0.5;
        for (std::int64_t bits = i; bits > 0; bits /= 2, digit /= 2)
            share += static_cast<double>(bits % 2) * digit;
        double const radius = std::cbrt(share + 0.5 / static_cast<double>(count));
        double const across = radius * std::sqrt(1 - z * z), angle = golden_angle * static_cast<double>(i);
        points[i] = {across * std::cos(angle), across * std::sin(angle), radius * z, 0};
    }
    return points;
}

class DividedVolume : public ReachingMethod
{
public:
    DividedVolume(exec::Execution const& execution, PolyMesh const& mesh, std::int64_t count)
        : ReachingMethod(execution, mesh, 1),
          mesh_(mesh),
          points_(count == 29 ? satellite_points() : spiral_points(count))
    {
    }

    exec::Buffer<Quad> const& points() const { return points_; }  ///< in a ball of radius 1

    void compute_weights(WeightTask const& task) override
    {
        fill_rows(task, Law{{mesh_.view()}, points_.view().data, static_cast<int>(points_.size())});
    }

private:
    struct Law
    {
        CellWalker walk;
        Quad const* points;  ///< in a ball of radius 1
        int point_count;

        GIMDEM_HD void operator()(Quad const& particle, std::int32_t const* cells, int count, double* w) const
        {
            for (int k = 0; k < count; ++k)
                w[k] = 0;
            std::int32_t at = cells[0];
            for (int i = 0; i < point_count; ++i)
            {
                at = walk(at, particle.xyz() + particle.w * points[i].xyz()).cell;
                int k = 0;
                while (k < count && cells[k] != at)
                    ++k;
                w[k < count ? k : 0] += 1;
            }
        }
    };

    PolyMesh const& mesh_;
    exec::Buffer<Quad> points_;
};

}  // namespace gimdem
