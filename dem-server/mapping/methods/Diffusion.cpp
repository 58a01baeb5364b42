// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/methods/Diffusion.hpp"

#include <cmath>

#include "exec/Reduce.hpp"

namespace gimdem
{

namespace
{

/// step * (flow out of cell c), in units of the density times volume.
struct Outflow
{
    MeshKernelView mesh;
    double const* conductance;
    double step;

    double operator()(double const* density, std::int32_t c) const
    {
        double sum = 0;
        for (std::int32_t k = mesh.cell_offsets[c]; k < mesh.cell_offsets[c + 1]; ++k)
        {
            std::int32_t const face = mesh.cell_faces[k];
            if (face >= mesh.internal_face_count) continue;
            sum += conductance[face] * (density[c] - density[mesh.across(face, c)]);
        }
        return step * sum;
    }
};

double dot(exec::Execution const& execution, exec::Buffer<double> const& a, exec::Buffer<double> const& b)
{
    double const* const x = a.view().data;
    double const* const y = b.view().data;
    return exec::sum(execution, a.size(), [=](std::int64_t i) { return x[i] * y[i]; });
}

/// y <- f y + g x.
void combine(exec::Execution const& execution, double f, exec::Buffer<double>& to, double g,
             exec::Buffer<double> const& from)
{
    double* const y = to.view().data;
    double const* const x = from.view().data;
    exec::for_each(execution, to.size(), [=](std::int64_t i) { y[i] = f * y[i] + g * x[i]; });
}

}  // namespace

Diffusion::Diffusion(exec::Execution const& execution, PolyMesh const& mesh, double bandwidth)
    : ParticleCentre(mesh), execution_(execution), mesh_(mesh), bandwidth_(bandwidth)
{
    conductance_.resize(mesh.internal_face_count());
    MeshKernelView const view = mesh.view();
    for (std::int32_t f = 0; f < mesh.internal_face_count(); ++f)
    {
        Vec3 const way = mesh.centroid(view.neighbour[f]) - mesh.centroid(view.owner[f]);
        conductance_[f] = mesh.face_area(f) * std::abs(way.dot(mesh.face_normal(f))) / way.squaredNorm();
    }
    for (auto* const buffer : {&per_diagonal_, &residual_, &way_, &image_, &scaled_, &values_, &density_})
        buffer->resize(mesh.cell_count());
}

bool Diffusion::prepare(ParticleState const& particles)
{
    Quad const* const position = particles.position.view().data;
    double const diameter =
        2 * exec::maximum(execution_, particles.count(), 0.0, [=](std::int64_t p) { return position[p].w; });
    if (diameter <= largest_diameter_) return false;
    largest_diameter_ = diameter;
    double const b = bandwidth_ * diameter;
    step_ = b * b / 4 / step_count;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
    {
        double diagonal = mesh_.volume(c);
        for (std::int32_t const f : mesh_.faces_of_cell(c))
            if (f < mesh_.internal_face_count()) diagonal += step_ * conductance_[f];
        per_diagonal_[c] = 1 / diagonal;
    }
    return false;
}

void Diffusion::apply(exec::Buffer<double> const& density, exec::Buffer<double>& result) const
{
    Outflow const outflow{mesh_.view(), conductance_.view().data, step_};
    double const* const x = density.view().data;
    double* const y = result.view().data;
    exec::for_each(execution_, result.size(),
                   [=](std::int64_t c)
                   { y[c] = outflow.mesh.cell[c].w * x[c] + outflow(x, static_cast<std::int32_t>(c)); });
}

// Conjugate gradients, scaled by the diagonal, from the density of before.
void Diffusion::solve(exec::Buffer<double> const& values, exec::Buffer<double>& density)
{
    auto const scale = [&]
    {
        double const *const r = residual_.view().data, *const d = per_diagonal_.view().data;
        double* const z = scaled_.view().data;
        exec::for_each(execution_, scaled_.size(), [=](std::int64_t i) { z[i] = d[i] * r[i]; });
        return dot(execution_, residual_, scaled_);
    };
    apply(density, residual_);
    combine(execution_, -1, residual_, 1, values);
    double now = scale();
    double const enough = 1e-24 * now;
    way_ = scaled_;
    for (int i = 0; i < most_iterations && now > enough && now > 0; ++i)
    {
        apply(way_, image_);
        double const along = now / dot(execution_, way_, image_);
        combine(execution_, 1, density, along, way_);
        combine(execution_, 1, residual_, -along, image_);
        double const before = now;
        now = scale();
        combine(execution_, now / before, way_, 1, scaled_);
    }
}

// What has flowed through each face leaves one cell and enters the other: the sum is kept whatever the solver's error.
void Diffusion::spread(exec::Buffer<double>& values)
{
    Outflow const outflow{mesh_.view(), conductance_.view().data, step_};
    double const* const density = density_.view().data;
    double* const v = values.view().data;
    for (int k = 0; k < step_count; ++k)
    {
        for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
            density_[c] = values[c] / mesh_.volume(c);
        solve(values, density_);
        exec::for_each(execution_, values.size(),
                       [=](std::int64_t c) { v[c] -= outflow(density, static_cast<std::int32_t>(c)); });
    }
}

void Diffusion::spread(CellSums& sums)
{
    spread(sums.solid_volume);
    for (double Quad::*const component : {&Quad::x, &Quad::y, &Quad::z, &Quad::w})
    {
        for (std::int64_t c = 0; c < values_.size(); ++c)
            values_[c] = sums.drag[c].*component;
        spread(values_);
        for (std::int64_t c = 0; c < values_.size(); ++c)
            sums.drag[c].*component = values_[c];
    }
}

}  // namespace gimdem
