// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/Mapper.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/Error.hpp"
#include "exec/ForEach.hpp"
#include "exec/VectorMath.hpp"
#include "mapping/GaussianIntegral.hpp"

namespace gimdem
{

namespace
{

/// Cell of a particle; status 1 where it left the mesh.
struct LocateKernel
{
    CellWalker walk;
    Quad const* position;
    std::uint8_t const* wall_faces;
    std::int32_t* cell_of;
    std::uint8_t* status;

    GIMDEM_HD void operator()(std::int64_t p) const
    {
        Quad const x = position[p];
        Location const at = walk(cell_of[p], x.xyz());
        cell_of[p] = at.cell;
        bool const inside_a_wall = at.face >= walk.mesh.internal_face_count && wall_faces[at.face] != 0;
        bool const between_cells = at.face >= 0 && at.face < walk.mesh.internal_face_count;
        status[p] = at.face >= 0 && !between_cells && !(inside_a_wall && at.outside < x.w);
    }
};

/// Weights (G.8) of one particle on the candidates of its cell, a few candidates at a time.
struct WeightKernel
{
    Quad const* position;
    std::int32_t const* cell_of;
    Quad const* cell;
    CellSize const* cell_sizes;
    std::int32_t const* layer_offsets;
    std::int32_t const* layer_cells;
    std::int32_t const* weight_offsets;
    double* weights;

    void operator()(std::int64_t p) const
    {
        std::int32_t const begin = layer_offsets[cell_of[p]];
        int const count = layer_offsets[cell_of[p] + 1] - begin;
        double* const w = weights + weight_offsets[p];
        for (int k = 0; k < count; k += batch)
            integrate(position[p], layer_cells + begin + k, count - k < batch ? count - k : batch, w + k);

        double total = 0;
        for (int k = 0; k < count; ++k)
            total += w[k];
        // Cells so far away that every integral underflows: the own cell takes all.
        if (!(total > 0)) w[0] = total = 1;
        for (int k = 0; k < count; ++k)
            w[k] /= total;
    }

private:
    static constexpr int batch = exec::vector_width;

    /// Shared integrals of one particle with up to `batch` cells; the lanes past `count` repeat the first one.
    void integrate(Quad const& x, std::int32_t const* cells, int count, double* shared) const
    {
        double const log_radius = std::log(x.w);
        double const tuning = 0.579 * std::exp(3 * 0.132 * log_radius);
        exec::Lanes mu2, radius, log_cell, factor;
        for (int k = 0; k < batch; ++k)
        {
            std::int32_t const c = cells[k < count ? k : 0];
            mu2[k] = (x.xyz() - cell[c].xyz()).squaredNorm();
            radius[k] = cell_sizes[c].radius;
            log_cell[k] = cell_sizes[c].log_radius;
            factor[k] = cell_sizes[c].tuning;
        }
        ParticleAndCell<exec::Lanes> const pairs{x.w, radius / x.w, log_cell - log_radius, tuning * factor};
        TailArguments<exec::Lanes> const arguments = pairs(mu2.sqrt());
        exec::Lanes tails[4];
        take_tails(arguments, count, tails);
        exec::Lanes const sum = arguments.sum(tails[0], tails[1], tails[2], tails[3]);
        for (int k = 0; k < count; ++k)
            shared[k] = sum[k];
    }

    /// erfc of all arguments, packed so that no lane is idle; a tail below 1e-18 of the particle is nothing.
    static void take_tails(TailArguments<exec::Lanes> const& arguments, int count, exec::Lanes* tails)
    {
        double packed[4 * batch];
        std::int16_t place[4 * batch];
        int active = 0;
        for (int t = 0; t < 4; ++t)
        {
            tails[t].setZero();
            for (int k = 0; k < count; ++k)
            {
                // erfc(x) < exp(-x^2); the last two tails count s^3 times.
                double const x = arguments.x[t][k];
                double const limit2 = 41 + (t < 2 ? 0.0 : arguments.log_cube[k]);
                packed[active] = x;
                place[active] = static_cast<std::int16_t>(t * batch + k);
                active += !(x > 0 && x * x > limit2);
            }
        }
        exec::erfc_many(packed, active);
        for (int i = 0; i < active; ++i)
            tails[place[i] / batch][place[i] % batch] = packed[i];
    }
};

/// Sums of one cell over the particles in the cells around it.
struct SumKernel
{
    std::int32_t const* layer_offsets;
    std::int32_t const* layer_cells;
    std::int32_t const* reverse_slot;
    std::int32_t const* particle_offsets;
    std::int32_t const* particle_members;
    std::int32_t const* weight_offsets;
    double const* weights;
    Quad const* position;
    Impulse const* impulses;  ///< null: volumes only
    double* solid_volume;
    Quad* drag;

    GIMDEM_HD void operator()(std::int64_t c) const
    {
        double volume = 0, coefficient = 0;
        Vec3 impulse = Vec3::Zero();
        for (std::int32_t k = layer_offsets[c]; k < layer_offsets[c + 1]; ++k)
        {
            std::int32_t const other = layer_cells[k];
            for (std::int32_t m = particle_offsets[other]; m < particle_offsets[other + 1]; ++m)
            {
                std::int32_t const p = particle_members[m];
                double const w = weights[weight_offsets[p] + reverse_slot[k]];
                volume += w * sphere_volume(position[p].w);
                if (impulses == nullptr) continue;
                impulse += w * impulses[p].drag.xyz();
                coefficient += w * impulses[p].drag.w;
            }
        }
        solid_volume[c] = volume;
        drag[c] = Quad::of(impulse, coefficient);
    }
};

}  // namespace

Mapper::Mapper(exec::Execution execution, PolyMesh const& mesh)
    : execution_(execution), mesh_(mesh), layers_(mesh), start_cells_(mesh)
{
    cell_sizes_.resize(mesh.cell_count());
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        double const radius = std::cbrt(3 / (4 * std::numbers::pi) * mesh.volume(c));
        cell_sizes_[c] = {radius, std::log(radius), std::pow(radius, -3 * 0.132)};
    }

    reverse_slot_.resize(layers_.cells.size());
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
        for (std::int32_t k = layers_.offsets[c]; k < layers_.offsets[c + 1]; ++k)
        {
            std::int32_t const other = layers_.cells[k];
            std::int32_t slot = 0;
            while (layers_.cells[layers_.offsets[other] + slot] != c)
                ++slot;
            reverse_slot_[k] = slot;
        }
}

void Mapper::locate(ParticleState const& particles, exec::Buffer<std::uint8_t> const& wall_faces)
{
    std::int64_t const n = particles.count();
    if (cell_of_.size() != n)
    {
        cell_of_.resize(n);
        for (std::int64_t p = 0; p < n; ++p)
            cell_of_[p] = start_cells_.near(particles.position[p].xyz());
    }
    exec::Buffer<std::uint8_t> status(n);
    LocateKernel const kernel{{mesh_.view()},
                              particles.position.view().data,
                              wall_faces.view().data,
                              cell_of_.view().data,
                              status.view().data};
    exec::for_each(execution_, n, kernel);
    for (std::int64_t p = 0; p < n; ++p)
    {
        if (status[p] == 0) continue;
        Vec3 const x = particles.position[p].xyz();
        throw UserError(
            fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m is outside the mesh (its void fraction has "
                        "no cell); it left through an open patch or sank into a wall: check the insertion "
                        "box, [walls] also, the height of the mesh, and the time step",
                        particles.id[p], x.x(), x.y(), x.z()));
    }
    exec::group_by_key(cell_of_.host(), mesh_.cell_count(), by_cell_);
}

void Mapper::compute_weights(ParticleState const& particles)
{
    std::int64_t const n = particles.count();
    weight_offsets_.resize(n + 1);
    for (std::int64_t p = 0; p < n; ++p)
        weight_offsets_[p] = layers_.offsets[cell_of_[p] + 1] - layers_.offsets[cell_of_[p]];
    weights_.resize(exec::exclusive_scan(weight_offsets_.host()));
    exec::for_each(execution_, n,
                   WeightKernel{particles.position.view().data, cell_of_.view().data, mesh_.view().cell,
                                cell_sizes_.view().data, layers_.offsets.view().data, layers_.cells.view().data,
                                weight_offsets_.view().data, weights_.view().data});
}

void Mapper::sum_into_cells(ParticleState const& particles, exec::Buffer<Impulse> const& impulses, CellSums& sums) const
{
    sums.solid_volume.resize(mesh_.cell_count());
    sums.drag.resize(mesh_.cell_count());
    exec::for_each(execution_, mesh_.cell_count(),
                   SumKernel{layers_.offsets.view().data, layers_.cells.view().data, reverse_slot_.view().data,
                             by_cell_.offsets.view().data, by_cell_.members.view().data, weight_offsets_.view().data,
                             weights_.view().data, particles.position.view().data,
                             impulses.size() == particles.count() ? impulses.view().data : nullptr,
                             sums.solid_volume.view().data, sums.drag.view().data});
}

void Mapper::permute(std::span<std::int32_t const> order)
{
    if (cell_of_.size() == static_cast<std::int64_t>(order.size())) gimdem::permute(cell_of_, order);
}

}  // namespace gimdem
