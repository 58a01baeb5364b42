// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/CellPotentials.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace gimdem
{

namespace
{

/// A polynomial of degree two about some point, or what is dual to one.
struct Quadratic
{
    double value;
    Vec3 gradient;
    Eigen::Matrix3d hessian;  ///< symmetric

    static Quadratic zero() { return {0, Vec3::Zero(), Eigen::Matrix3d::Zero()}; }

    /// The same polynomial about a point that is `y` from this one's.
    Quadratic about(Vec3 const& y) const
    {
        Vec3 const turn = hessian * y;
        return {value + y.dot(gradient) + y.dot(turn) / 2, gradient + turn, hessian};
    }
    /// Transposed of about().
    Quadratic back_from(Vec3 const& y) const
    {
        Eigen::Matrix3d const outer = gradient * y.transpose();
        return {value, value * y + gradient, value / 2 * y * y.transpose() + (outer + outer.transpose()) / 2 + hessian};
    }
    double dot(Quadratic const& b) const
    {
        return value * b.value + gradient.dot(b.gradient) + hessian.cwiseProduct(b.hessian).sum();
    }
    void add(double f, Quadratic const& b)
    {
        value += f * b.value;
        gradient += f * b.gradient;
        hessian += f * b.hessian;
    }
};
using Quadratics = std::vector<Quadratic>;

/// What is wanted at a face of a polynomial about its centre that should vanish: its mean square over the face, taken
/// as a disc, and that of its slope across times a thickness (G.36).
struct FaceNorm
{
    Vec3 normal;
    double area, radius2, thickness2;

    /// Derivative of half the norm of e.
    Quadratic operator()(Quadratic const& e) const
    {
        Eigen::Matrix3d const along = Eigen::Matrix3d::Identity() - normal * normal.transpose();
        Eigen::Matrix3d const bend = along * e.hessian * along;
        double const mean = e.value + radius2 / 8 * bend.trace();
        double const across = e.gradient.dot(normal);
        Eigen::Matrix3d const tilt = along * e.hessian * normal * normal.transpose();
        return {area * mean, area * ((thickness2 - radius2 / 4) * across * normal + radius2 / 4 * e.gradient),
                area * (radius2 * (mean / 8 - radius2 / 192 * bend.trace()) * along + radius2 * radius2 / 48 * bend +
                        thickness2 * radius2 / 8 * (tilt + tilt.transpose()))};
    }
    /// The slope across alone, for a face of the boundary.
    Quadratic slope(Quadratic const& e) const
    {
        return {0, area * thickness2 * e.gradient.dot(normal) * normal, Eigen::Matrix3d::Zero()};
    }
};

/// Normal equations of the sum of the norms over all faces.
class PotentialFit
{
public:
    explicit PotentialFit(PolyMesh const& mesh) : mesh_(mesh), view_(mesh.view())
    {
        for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
            size_.push_back(std::cbrt(mesh.volume(c)));
    }

    /// Cubes: |y|^2 / (2 a), zero at the centres of their faces.
    Quadratics start() const
    {
        Quadratics potentials;
        for (double const a : size_)
            potentials.push_back({-a / 8, Vec3::Zero(), Eigen::Matrix3d::Identity() / a});
        return potentials;
    }

    /// Derivative of half of all norms by the potentials' coefficients; of those that are `wanted` times the distance
    /// from the face where the cells' are not.
    Quadratics derivative(Quadratics const& potentials, double wanted) const
    {
        Quadratics sums(potentials.size(), Quadratic::zero());
        for (std::int32_t f = 0; f < mesh_.face_count(); ++f)
        {
            std::int32_t const own = view_.owner[f];
            bool const internal = f < view_.internal_face_count;
            Vec3 const from_own = mesh_.face_centre(f) - mesh_.centroid(own);
            Quadratic e = potentials[at(own)].about(from_own);
            if (!internal)
            {
                e.gradient -= wanted / 2 * mesh_.face_normal(f);
                sums[at(own)].add(1, norm(f).slope(e).back_from(from_own));
                continue;
            }
            std::int32_t const other = view_.neighbour[f];
            Vec3 const from_other = mesh_.face_centre(f) - mesh_.centroid(other);
            e.add(-1, potentials[at(other)].about(from_other));
            e.gradient -= wanted * mesh_.face_normal(f);
            Quadratic const dual = norm(f)(e);
            sums[at(own)].add(1, dual.back_from(from_own));
            sums[at(other)].add(-1, dual.back_from(from_other));
        }
        return sums;
    }

    /// About the inverse of the equations' diagonal: one factor each for value, gradient and Hessian of a cell.
    std::vector<Vec3> scales() const
    {
        std::vector<Vec3> sums(size_.size(), Vec3::Zero());
        for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        {
            for (std::int32_t const f : mesh_.faces_of_cell(c))
            {
                FaceNorm const n = norm(f);
                double const y2 = (mesh_.face_centre(f) - mesh_.centroid(c)).squaredNorm();
                sums[at(c)] += n.area * Vec3(1, (y2 + n.thickness2 + n.radius2 / 2) / 3,
                                             (y2 * y2 / 4 + y2 * (n.thickness2 + n.radius2 / 2)) / 6);
            }
            sums[at(c)] = sums[at(c)].cwiseInverse();
        }
        return sums;
    }

private:
    static std::size_t at(std::int32_t cell) { return static_cast<std::size_t>(cell); }

    FaceNorm norm(std::int32_t f) const
    {
        double const own = size_[at(view_.owner[f])];
        double const thickness = (f < view_.internal_face_count ? (own + size_[at(view_.neighbour[f])]) / 2 : own) / 6;
        double const area = mesh_.face_area(f);
        return {mesh_.face_normal(f), area, area / std::numbers::pi, thickness * thickness};
    }

    PolyMesh const& mesh_;
    MeshKernelView view_;
    std::vector<double> size_;  ///< cube root of the volume [m]
};

double dot(Quadratics const& a, Quadratics const& b)
{
    double sum = 0;
    for (std::size_t c = 0; c < a.size(); ++c)
        sum += a[c].dot(b[c]);
    return sum;
}

Quadratics scaled(Quadratics r, std::vector<Vec3> const& by)
{
    for (std::size_t c = 0; c < r.size(); ++c)
        r[c] = {by[c][0] * r[c].value, by[c][1] * r[c].gradient, by[c][2] * r[c].hessian};
    return r;
}

/// Conjugate gradients, thirty steps: what they leave are coefficients that the faces hardly care about.
Quadratics solve(PotentialFit const& fit)
{
    constexpr int steps = 30;
    Quadratics potentials = fit.start();
    std::vector<Vec3> const scales = fit.scales();
    Quadratics residual = fit.derivative(potentials, 1);
    Quadratics way = scaled(residual, scales);
    double now = dot(residual, way);
    double const enough = 1e-24 * now;
    for (int i = 0; i < steps && now > enough; ++i)
    {
        Quadratics const image = fit.derivative(way, 0);
        double const along = now / dot(way, image);
        for (std::size_t c = 0; c < way.size(); ++c)
        {
            potentials[c].add(-along, way[c]);
            residual[c].add(-along, image[c]);
        }
        Quadratics next = scaled(residual, scales);
        double const before = now;
        now = dot(residual, next);
        for (std::size_t c = 0; c < way.size(); ++c)
            next[c].add(now / before, way[c]);
        way = std::move(next);
    }
    return potentials;
}

}  // namespace

exec::Buffer<CellPotential> fit_potentials(PolyMesh const& mesh)
{
    Quadratics const fitted = solve(PotentialFit(mesh));
    exec::Buffer<CellPotential> potentials(mesh.cell_count());
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        Quadratic const& q = fitted[static_cast<std::size_t>(c)];
        Vec3 const x = mesh.centroid(c);
        Vec3 const& g = q.gradient;
        Eigen::Matrix3d const& h = q.hessian;
        potentials[c] = {{x.x(), x.y(), x.z()},
                         q.value,
                         {g.x(), g.y(), g.z()},
                         h.squaredNorm() / 10,
                         {h(0, 0) / 2, h(1, 1) / 2, h(2, 2) / 2, h(1, 2), h(0, 2), h(0, 1)},
                         {0, 0}};
    }
    return potentials;
}

}  // namespace gimdem
